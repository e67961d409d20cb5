// gnomon: soft shadow maps. The backend that runs on a GPU: a map on it keeps its texels there (gl/soft_shadow_map.hpp).
#pragma once

#include <gnomon/backend/scalar.hpp>
#include <gnomon/gl/passes.hpp>
#include <gnomon/gl/transfer.hpp>

#include <memory>
#include <utility>
#include <vector>

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

namespace detail {

/// Things of any type, made once each: programs that several maps share.
class made_once {
  public:
    /// The T that is there, or what make() made: a result<T>, whose problem is made anew by every call.
    template <typename T, typename Make> [[nodiscard]] result<std::shared_ptr<T>> get(Make&& make) {
        for (const entry& each : entries_)
            if (each.key == &key_of<T>) return std::static_pointer_cast<T>(each.value);
        result<T> made = make();
        if (!made) return made.error();
        auto value = std::make_shared<T>(*std::move(made));
        entries_.push_back({&key_of<T>, value});
        return value;
    }

  private:
    template <typename T> static inline char key_of = 0; ///< its address stands for T
    struct entry {
        const void* key;
        std::shared_ptr<void> value;
    };
    std::vector<entry> entries_;
};

} // namespace detail

/// Where the loops run: on the GPU of one context. Copies share what they compiled. All of it is called, and the last copy destroyed,
/// while that context is current.
///
/// Images of the host's may be filtered and received on it too, which uploads them, draws, and waits for what is read back: the same
/// bits as `scalar` for unorm, as `scalar` by fast<Kernel> for half and float. That proves a GPU; it does not pay. Where GL cannot, for
/// lack of a format or of memory, `scalar` does it, and `problem` says why.
template <state_policy Policy> class backend_of {
  public:
    /// The functions that the context was made of must outlive this.
    explicit backend_of(const context& on) : context_(on), made_(std::make_shared<shared>()) {}

    [[nodiscard]] const gl::context& context() const noexcept { return context_; }
    /// Why the last call on images of the host's was done by `scalar`; empty if the GPU did it.
    [[nodiscard]] const gl::problem& problem() const noexcept { return made_->problem; }

    /// The programs for a texel and a kernel, compiled by the first call.
    template <texel_format Texel, kernel Kernel> [[nodiscard]] result<std::shared_ptr<passes<Texel, Kernel>>> passes_of() const {
        using all = passes<Texel, Kernel>;
        return made_->programs.template get<all>([&] { return all::make(context_); });
    }

    template <texel_format Texel, kernel Kernel>
    void filter_region(std::type_identity_t<image_view<const Texel>> from, image_view<Texel> to, texel_rect region,
                       filter_scratch<Texel, Kernel>& /*ours is on the GPU*/) const noexcept {
        region = clip(clip(region, to.size()), from.size());
        if (region.empty() || from.data() == to.data()) return;
        made_->problem = filter_on_gpu<Texel, Kernel>(from, to, region);
        if (!made_->problem) return;
        filter_scratch<Texel, kernel_in_gl<Texel, Kernel>> scratch(from.width());
        gnomon::filter_region(from, to, region, scratch);
    }

    template <texel_format Texel>
    void receive(strided_span<const Texel> texels, strided_span<const float> z, strided_span<float> intensity,
                 const rule& r) const noexcept {
        gnomon::receive(texels, z, intensity, r);
    }
    template <texel_format Texel>
    void receive(image_view<const Texel> map, strided_span<const float> x, strided_span<const float> y, strided_span<const float> z,
                 strided_span<float> intensity, const rule& r) const noexcept {
        gnomon::receive(map, x, y, z, intensity, r);
    }

  private:
    struct shared {
        detail::made_once programs = {};
        gl::problem problem = {};
    };

    template <texel_format Texel, kernel Kernel>
    [[nodiscard]] gl::problem filter_on_gpu(image_view<const Texel> from, image_view<Texel> to, texel_rect region) const {
        const auto run = passes_of<Texel, Kernel>();
        if (!run) return run.error();
        const texel_rect around = clip(grow(region, Kernel::radius), from.size()); // farther away nothing is read
        const auto map = map_textures::make(context_, {around.width(), around.height()}, format_of<Texel>, (*run)->scratch());
        if (!map) return map.error();
        const state_guard<Policy> forced(context_);
        context_.gl->BindTexture(enums::texture_2d, map->targets().casters);
        write_texels<Texel>(context_, from.part(around));
        const texel_rect there{region.x0 - around.x0, region.y0 - around.y0, region.x1 - around.x0, region.y1 - around.y0};
        (*run)->filter(context_, map->targets(), [&there](auto&& f) { f(there); });
        texel_reader<Texel> reader({around.width(), around.height()});
        reader.read(context_, map->targets().into_soft, to.part({around.x0, around.y0, around.x1, around.y1}), there);
        return context_.check("filtering an image of the host's");
    }

    gl::context context_;
    std::shared_ptr<shared> made_;
};

/// The backend that most engines want: it leaves the state it needed (state_policy::dirty).
using backend = backend_of<state_policy::dirty>;
/// The one that leaves all state as it was found.
using backend_that_restores = backend_of<state_policy::restore>;

} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD
