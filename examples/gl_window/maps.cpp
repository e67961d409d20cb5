#include "maps.hpp"

#include <gallery/failure.hpp>
#include <gallery/formats.hpp>

namespace gl_window {

namespace {

template <gnomon::texel_format Texel, gnomon::kernel Kernel> class map_of final : public shadow_map {
  public:
    map_of(const gl::backend& run, gnomon::bias_towards towards)
        : run_(run), map_({.width = map_side, .height = map_side, .tile = tile_size}, run), casts_(run.context()) {
        map_.decision.caster.towards = towards;
    }

    [[nodiscard]] const gl::problem& problem() const override { return map_.problem(); }
    void draw(const gl_headless::gpu_scene& s) override {
        map_.clear();
        s.cast_into(map_, casts_);
        map_.filter();
    }
    [[nodiscard]] unsigned soft_texture() const override { return map_.soft_texture(); }
    [[nodiscard]] const gnomon::tile_grid& tiles() const override { return map_.tiles().tiles(); }
    [[nodiscard]] std::string receive_text() const override { return gl::receive_text<Texel>(map_.decision); }
    [[nodiscard]] std::vector<float> receive(const gallery::receivers& points) const override {
        std::vector<float> intensity(points.size());
        run_.template receive<Texel>(map_.soft(), points.x, points.y, points.z, intensity, map_.decision);
        return intensity;
    }
    [[nodiscard]] gallery::kernel_weights weights() const override { return Kernel::weights; }
    [[nodiscard]] int bytes_per_texel() const override { return sizeof(Texel); }

  private:
    gl::backend run_;
    gnomon::soft_shadow_map<Texel, Kernel, gl::backend> map_;
    gl_headless::caster_programs<Texel> casts_;
};

template <gnomon::kernel Kernel, gnomon::effects Effects>
std::unique_ptr<shadow_map> with_kernel(const choice& c, const gl::backend& run) {
    std::unique_ptr<shadow_map> made;
    int index = 0;
    gallery::in_all_formats<Effects>("", [&]<typename Texel>(const gallery::format_name&) {
        if (index++ != c.format) return;
        if (const gl::problem why = gl::supports<Texel>(run.context())) throw gallery::failure(why.sentence);
        made = std::make_unique<map_of<Texel, Kernel>>(run, c.towards);
    });
    return made;
}

template <gnomon::effects Effects> std::unique_ptr<shadow_map> with_effects(const choice& c, const gl::backend& run) {
    if (c.gaussian)
        return c.wide ? with_kernel<gnomon::gaussian<8>, Effects>(c, run) : with_kernel<gnomon::gaussian<3>, Effects>(c, run);
    return c.wide ? with_kernel<gnomon::box<8>, Effects>(c, run) : with_kernel<gnomon::box<3>, Effects>(c, run);
}

} // namespace

std::unique_ptr<shadow_map> make_map(const choice& c, const gl::backend& run) {
    using gnomon::effects;
    if (c.far_bound && c.translucency) return with_effects<effects{.far_bound = true, .translucency = true}>(c, run);
    if (c.far_bound) return with_effects<effects{.far_bound = true}>(c, run);
    if (c.translucency) return with_effects<effects{.translucency = true}>(c, run);
    return with_effects<effects{}>(c, run);
}

} // namespace gl_window
