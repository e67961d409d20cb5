// gnomon: soft shadow maps. The backend that runs on a GPU: a map on it keeps its texels there (gl/soft_shadow_map.hpp).
#pragma once

#include <gnomon/backend/scalar.hpp>
#include <gnomon/gl/passes.hpp>
#include <gnomon/gl/receive_pass.hpp>
#include <gnomon/gl/transfer.hpp>

#include <bit>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
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
        entries_.push_back({&key_of<T>, value, [](void* made_before) { static_cast<T*>(made_before)->forget(); }});
        return value;
    }
    void forget() noexcept {
        for (const entry& each : entries_) each.forget(each.value.get());
        entries_.clear();
    }

  private:
    template <typename T> static inline char key_of = 0; ///< its address stands for T
    struct entry {
        const void* key;
        std::shared_ptr<void> value;
        void (*forget)(void*);
    };
    std::vector<entry> entries_;
};

/// A receiver as a texel of four floats.
struct receiver {
    float x = {}, y = {}, z = {}, w = {};
};

/// So many numbers as lines of a texture.
[[nodiscard]] constexpr extent lines_of(int count) noexcept {
    const int width = lesser(greater(count, 1), 1024);
    return {width, (greater(count, 1) + width - 1) / width};
}

/// Decides, and writes the bits of an intensity.
template <texel_format Texel, bool Points> struct receive_bits {
    receive_pass<Texel> decide;

    [[nodiscard]] static result<receive_bits> make(const context& c) {
        if (problem why = supports<Texel>(c)) return why;
        constexpr std::string_view call = Points ? "gnomon_shadow_at(gnomon_map, receiver.xy, receiver.z)"
                                                 : "gnomon_shadow(gnomon_map, ivec2(gl_FragCoord), receiver.x)";
        auto made = receive_pass<Texel>::make(c,
                                              filled(R"(
uniform sampler2D gnomon_map;
uniform sampler2D gnomon_receivers;
layout(location = 0) out uvec2 gnomon_bits;

void main() {
    vec4 receiver = texelFetch(gnomon_receivers, ivec2(gl_FragCoord), 0);
    gnomon_bits = uvec2(floatBitsToUint(@call), 0u);
}
)",
                                                     {{"call", std::string(call)}}),
                                              "gnomon_receivers");
        if (!made) return made.error();
        return receive_bits{*std::move(made)};
    }
    void forget() noexcept { decide.forget(); }
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
        if (region.empty() || share_texels<Texel>(from, to)) return;
        made_->problem = filter_on_gpu<Texel, Kernel>(from, to, region);
        if (!made_->problem) return;
        filter_scratch<Texel, kernel_in_gl<Texel, Kernel>> scratch(from.width());
        gnomon::filter_region(from, to, region, scratch);
    }

    /// Fades past a far bound may be off by a few units in the last place; see receive_text.
    template <texel_format Texel>
    void receive(strided_span<const Texel> texels, strided_span<const float> z, strided_span<float> intensity,
                 const rule& r) const noexcept {
        const int count = lesser(texels.size(), lesser(z.size(), intensity.size()));
        made_->problem = receive_on_gpu<Texel, false>(
            count, detail::lines_of(count), [&](int i) { return texels[i]; }, [&](int i) { return detail::receiver{.x = z[i]}; },
            intensity, r);
        if (made_->problem) gnomon::receive(texels, z, intensity, r);
    }
    template <texel_format Texel>
    void receive(image_view<const Texel> map, strided_span<const float> x, strided_span<const float> y, strided_span<const float> z,
                 strided_span<float> intensity, const rule& r) const noexcept {
        const int count = lesser(lesser(x.size(), y.size()), lesser(z.size(), intensity.size()));
        made_->problem = receive_on_gpu<Texel, true>(
            count, map.size(), [&](int i) { return map(i % map.width(), i / map.width()); },
            [&](int i) { return detail::receiver{.x = x[i], .y = y[i], .z = z[i]}; }, intensity, r);
        if (made_->problem) gnomon::receive(map, x, y, z, intensity, r);
    }

    /// The context is lost: forgets what was compiled, for all copies, and calls nothing of GL. Maps that share it must forget as well.
    void forget() noexcept { made_->programs.forget(); }

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
        return context_.problem_while("filtering an image of the host's");
    }

    /// Uploads a map and receivers, decides about each, and reads back the bits of the intensities: integers are drawable everywhere.
    template <texel_format Texel, bool Points, typename TexelAt, typename ReceiverAt>
    [[nodiscard]] gl::problem receive_on_gpu(int count, extent map_size, TexelAt&& texel_at, ReceiverAt&& receiver_at,
                                             strided_span<float> intensity, const rule& r) const {
        using pass = detail::receive_bits<Texel, Points>;
        const auto run = made_->programs.template get<pass>([&] { return pass::make(context_); });
        if (!run) return run.error();
        if (count == 0 || map_size.empty()) {
            for (int i = 0; i < count; ++i) intensity[i] = 0.0f;
            return {};
        }
        const extent lines = detail::lines_of(count);
        const state_guard<Policy> forced(context_);
        image<Texel> texels(map_size, Texel::clear());
        for (int i = 0; i < (Points ? map_size.width * map_size.height : count); ++i)
            texels(i % map_size.width, i / map_size.width) = texel_at(i);
        image<detail::receiver> receivers(lines);
        for (int i = 0; i < count; ++i) receivers(i % lines.width, i / lines.width) = receiver_at(i);

        const auto map = make_texture(context_, format_of<Texel>, map_size);
        if (!map) return map.error();
        write_texels<Texel>(context_, texels.view());
        if (gl::problem why = context_.problem_while("uploading a map's texels"))
            return why; // the next texture is made after old errors
        const auto where = make_texture(context_, rgba32f_format, lines);
        if (!where) return where.error();
        for (int y = 0; y < lines.height; ++y)
            context_.gl->TexSubImage2D(enums::texture_2d, 0, 0, y, lines.width, 1, enums::rgba, enums::type_float,
                                       &receivers(0, y));
        if (gl::problem why = context_.problem_while("uploading receivers")) return why;
        const auto made = make_texture(context_, rg32ui_format, lines);
        if (!made) return made.error();
        const auto into = make_framebuffer(context_, {made->name()});
        if (!into) return into.error();
        (*run)->decide.draw(context_, {into->name(), lines}, map->name(), where->name(), r);
        std::vector<std::uint32_t> bits(4 * static_cast<std::size_t>(lines.width) * static_cast<std::size_t>(lines.height));
        context_.gl->ReadPixels(0, 0, lines.width, lines.height, enums::rgba_integer, enums::type_unsigned_int, bits.data());
        for (int i = 0; i < count; ++i) intensity[i] = std::bit_cast<float>(bits[4 * static_cast<std::size_t>(i)]);
        return context_.problem_while("receiving on the host's behalf");
    }

    gl::context context_;
    std::shared_ptr<shared> made_;
};

/// The backend that most engines want: it leaves the state it needed (state_policy::dirty).
using backend = backend_of<state_policy::dirty>;
/// The one that leaves all state as it was found.
using backend_that_restores = backend_of<state_policy::restore>;

} // namespace gl

static_assert(backend_for<gl::backend, rg8, box<1>> && backend_for<gl::backend_that_restores, rgba32f, gaussian<4>>);

} // namespace gnomon::inline GNOMON_BUILD
