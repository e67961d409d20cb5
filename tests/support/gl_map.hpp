// Passes and textures of one map on the GL under test, and all that is in them as images of the host's.
#pragma once

#include "egl.hpp"
#include "gl_report.hpp"
#include "images.hpp"

#include <gnomon/gl/passes.hpp>
#include <gnomon/gl/transfer.hpp>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace test {

template <gnomon::texel_format Texel> [[nodiscard]] const char* format_name() { return gnomon::gl::format_of<Texel>.name; }

/// A map of one texel and kernel. Use it under a state_guard, as here: all members set up their own.
template <gnomon::texel_format Texel, gnomon::kernel Kernel> class gl_map {
  public:
    using guard = gnomon::gl::state_guard<>;

    gl_map(const gnomon::gl::context& c, gnomon::extent size) : c_(c), size_(size) {
        auto passes = gnomon::gl::passes<Texel, Kernel>::make(c);
        CHECK(passes.error().sentence == "");
        if (!passes) return;
        passes_ = *std::move(passes);
        auto textures = gnomon::gl::map_textures::make(c, size, gnomon::gl::format_of<Texel>, passes_.scratch());
        CHECK(textures.error().sentence == "");
        if (textures) textures_ = *std::move(textures);
    }

    gnomon::gl::passes<Texel, Kernel>& passes() { return passes_; }
    const gnomon::gl::map_targets& targets() const { return textures_.targets(); }

    /// What is on the GPU.
    gnomon::image<Texel> casters() const { return read(targets().into_casters); }
    gnomon::image<Texel> soft() const { return read(targets().into_soft); }
    /// Sums between the passes, four for every texel.
    std::vector<std::uint32_t> scratch() const {
        const guard forced(c_);
        std::vector<std::uint32_t> sums(4 * static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height));
        c_.gl->BindFramebuffer(gnomon::gl::enums::framebuffer, targets().into_scratch);
        c_.gl->ReadPixels(0, 0, size_.width, size_.height, gnomon::gl::enums::rgba_integer, gnomon::gl::enums::type_unsigned_int,
                          sums.data());
        return sums;
    }
    /// Puts an image there as it is; depths of casters are not.
    void write_casters(const gnomon::image<Texel>& from) { write(targets().casters, from); }
    void write_soft(const gnomon::image<Texel>& from) { write(targets().soft, from); }
    /// Fills the scratch with what no pass may trust.
    void spoil_scratch() {
        const guard forced(c_);
        gnomon::gl::begin_pass(c_, {.framebuffer = targets().into_scratch, .size = size_});
        constexpr unsigned rubbish[4] = {0xFFFFFFFFu, 0xA5A5A5A5u, 0xFFFFFFFFu, 0x80000001u};
        constexpr float narrow_rubbish[4] = {0.75f, 0.5f, 1.0f, 0.25f};
        if (passes_.scratch() == gnomon::gl::format_of<Texel>)
            c_.gl->ClearBufferfv(gnomon::gl::enums::color, 0, narrow_rubbish);
        else
            c_.gl->ClearBufferuiv(gnomon::gl::enums::color, 0, rubbish);
    }
    void filter(gnomon::texel_rect region, gnomon::gl::rectangles_by way = gnomon::gl::rectangles_by::instances) {
        const guard forced(c_);
        passes_.filter(c_, targets(), [&](auto&& f) { f(region); }, way);
    }

  private:
    gnomon::image<Texel> read(unsigned framebuffer) const {
        const guard forced(c_);
        gnomon::image<Texel> image(size_, Texel::caster(0.25f));
        gnomon::gl::texel_reader<Texel> reader(size_);
        reader.read(c_, framebuffer, image.view(), whole(size_));
        return image;
    }
    void write(unsigned texture, const gnomon::image<Texel>& from) {
        const guard forced(c_);
        c_.gl->BindTexture(gnomon::gl::enums::texture_2d, texture);
        gnomon::gl::write_texels<Texel>(c_, from.view());
    }

    gnomon::gl::context c_;
    gnomon::extent size_;
    gnomon::gl::passes<Texel, Kernel> passes_{};
    gnomon::gl::map_textures textures_{};
};

} // namespace test
