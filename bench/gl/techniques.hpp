// Shadow maps of all kinds over one scene: casters into a map, a filter if there is one, and receivers from it.
#pragma once

#include "rig.hpp"

#include <gnomon/gl/receive_pass.hpp>
#include <gnomon/gl/soft_shadow_map.hpp>

#include <string>
#include <string_view>
#include <utility>

namespace bench_gl {

/// One technique on one stage. Passes may be called again and again, each after those before it.
class technique {
  public:
    technique(const gl::context& c, const stage& on) : c_(c), on_(on) {}
    virtual ~technique() = default;
    technique(const technique&) = delete;
    technique& operator=(const technique&) = delete;

    virtual void cast() = 0;
    virtual void filter() {}
    virtual void receive(unsigned framebuffer) = 0;

    void receive() { receive(on_.screen()); }
    void frame() {
        cast();
        filter();
        receive();
    }
    /// The share of the map that `filter` writes.
    [[nodiscard]] virtual double filtered() const { return 1.0; }

  protected:
    const gl::context& c_;
    const stage& on_;
};

/// gnomon as an engine uses it: the facade, with the scene's triangles drawn by the engine, and the library's mask pass.
template <gnomon::texel_format Texel, gnomon::kernel Kernel> class gnomon_map : public technique {
  public:
    /// `dense` clears and filters the whole map, as if there were no tiles.
    gnomon_map(const gl::context& c, const stage& on, const scene& of, bool dense)
        : technique(c, on), of_(of), dense_(dense), map_({.width = on.side, .height = on.side}, gl::backend(c)),
          casters_(program_of(c, mesh_vertex_text,
                              gl::caster_text<Texel>() + "in float bench_depth;\nvoid main() { gnomon_caster(bench_depth); }\n")),
          receivers_(must(gl::receive_pass<Texel>::make(c, gl::receivers::points))) {
        if (map_.problem()) must(gl::result<int>(map_.problem()));
    }

    using technique::receive;
    void cast() override {
        map_.clear();
        map_.cast([&](const gl::map_targets&) {
            c_.gl->UseProgram(casters_.name());
            on_.draw_casters(false);
            return touched{};
        });
        if (dense_)
            map_.mark(whole(map_.size()), {0.0f, 1.0f});
        else
            of_.for_each_caster(
                [this](const surface& s) { map_.mark(s.texels(on_.side), {s.centre.z - s.reach().z, s.centre.z + s.reach().z}); });
    }
    void filter() override { map_.filter(); }
    void receive(unsigned framebuffer) override {
        const gl::state_guard<> forced(c_);
        receivers_.draw(c_, {framebuffer, on_.size()}, map_.soft_texture(), on_.points(), map_.decision);
    }
    [[nodiscard]] double filtered() const override {
        const gnomon::regions_to_filter<Kernel> regions(map_.tiles().tiles());
        return static_cast<double>(gnomon::detail::texels_in(regions)) / (1.0 * on_.side * on_.side);
    }

  protected:
    [[nodiscard]] unsigned soft_texture() const { return map_.soft_texture(); }

  private:
    /// Nothing: what casters touch is marked one by one.
    struct touched {
        gnomon::texel_rect texels = {};
        gnomon::depth_interval depth = {};
    };

    const scene& of_;
    bool dense_;
    gnomon::soft_shadow_map<Texel, Kernel, gl::backend> map_;
    gl::program casters_;
    gl::receive_pass<Texel> receivers_;
};

/// gnomon's 8-bit map, read by a sampler and decided as plain_text has it: what exactness costs a receiver.
template <gnomon::kernel Kernel> class sampled_gnomon_map : public gnomon_map<gnomon::rg8, Kernel> {
  public:
    sampled_gnomon_map(const gl::context& c, const stage& on, const scene& of)
        : gnomon_map<gnomon::rg8, Kernel>(c, on, of, false),
          receivers_(
              program_of(c, screen_vertex_text, std::string(plain_text) + std::string(receive_main_text), {"map", "points"})) {
        const gl::state_guard<> forced(c);
        sample_linearly(c, this->soft_texture());
    }

    using technique::receive;
    void receive(unsigned framebuffer) override {
        const gl::state_guard<> forced(this->c_);
        this->on_.receive(framebuffer, receivers_, this->soft_texture());
    }

  private:
    gl::program receivers_;
};

/// Percentage closer filtering: depths alone.
class closer_map : public technique {
  public:
    closer_map(const gl::context& c, const stage& on, std::string_view receive)
        : technique(c, on), casters_(program_of(c, mesh_vertex_text, pcf_casters_text)),
          receivers_(program_of(c, screen_vertex_text, std::string(receive) + std::string(receive_main_text), {"map", "points"})) {
        const gl::state_guard<> forced(c);
        map_ = linear_texture(c, depth24_format, on.size());
        into_map_ = must(gl::make_framebuffer(c, {}, map_.name()));
    }

    using technique::receive;
    void cast() override {
        const gl::state_guard<> forced(c_);
        gl::begin_pass(c_, {.framebuffer = into_map_.name(), .size = on_.size(), .depth = gl::depth_use::nearest_stays});
        constexpr float far_plane = 1.0f;
        c_.gl->ClearBufferfv(enums::depth, 0, &far_plane);
        c_.gl->DepthFunc(enums::less);
        c_.gl->UseProgram(casters_.name());
        on_.draw_casters(false);
    }
    void receive(unsigned framebuffer) override {
        const gl::state_guard<> forced(c_);
        on_.receive(framebuffer, receivers_, map_.name());
    }
    [[nodiscard]] double filtered() const override { return 0.0; }

  private:
    gl::texture map_;
    gl::framebuffer into_map_;
    gl::program casters_, receivers_;
};

/// What a map of blurred numbers is.
struct blurred_kind {
    gl::format texels;
    std::string casters, receive;
    float clear[4];
    bool with_ground;      ///< is what receives in the map too?
    bool reversed = false; ///< are depths gnomon's, which grow towards the light?
};

/// Numbers that are drawn, blurred along rows and columns in floats, and sampled: variance maps, and gnomon's pair done plainly.
template <gnomon::kernel Kernel> class blurred_map : public technique {
  public:
    blurred_map(const gl::context& c, const stage& on, blurred_kind kind)
        : technique(c, on), kind_(std::move(kind)), casters_(program_of(c, mesh_vertex_text, kind_.casters)),
          rows_(program_of(c, screen_vertex_text, blur_text<Kernel>("1, 0"), {"map"})),
          columns_(program_of(c, screen_vertex_text, blur_text<Kernel>("0, 1"), {"map"})),
          receivers_(program_of(c, screen_vertex_text, kind_.receive + std::string(receive_main_text), {"map", "points"})) {
        const gl::state_guard<> forced(c);
        for (gl::texture* each : {&map_, &scratch_, &soft_}) *each = linear_texture(c, kind_.texels, on.size());
        depth_ = must(gl::make_texture(c, kind_.reversed ? gl::depth_format : depth24_format, on.size()));
        into_map_ = must(gl::make_framebuffer(c, {map_.name()}, depth_.name()));
        into_scratch_ = must(gl::make_framebuffer(c, {scratch_.name()}));
        into_soft_ = must(gl::make_framebuffer(c, {soft_.name()}));
    }

    using technique::receive;
    void cast() override {
        const gl::state_guard<> forced(c_);
        gl::begin_pass(c_, {.framebuffer = into_map_.name(), .size = on_.size(), .depth = gl::depth_use::nearest_stays});
        const float farthest = kind_.reversed ? 0.0f : 1.0f;
        c_.gl->ClearBufferfv(enums::color, 0, kind_.clear);
        c_.gl->ClearBufferfv(enums::depth, 0, &farthest);
        if (!kind_.reversed) c_.gl->DepthFunc(enums::less);
        c_.gl->UseProgram(casters_.name());
        on_.draw_casters(kind_.with_ground);
    }
    void filter() override {
        const gl::state_guard<> forced(c_);
        gl::bind_textures(c_, {map_.name()});
        on_.draw_all(into_scratch_.name(), rows_);
        gl::bind_textures(c_, {scratch_.name()});
        on_.draw_all(into_soft_.name(), columns_);
    }
    void receive(unsigned framebuffer) override {
        const gl::state_guard<> forced(c_);
        on_.receive(framebuffer, receivers_, soft_.name());
    }

  private:
    blurred_kind kind_;
    gl::texture map_, depth_, scratch_, soft_;
    gl::framebuffer into_map_, into_scratch_, into_soft_;
    gl::program casters_, rows_, columns_, receivers_;
};

[[nodiscard]] inline blurred_kind variance_kind(bool with_ground) {
    return {gl::rg32f_format, std::string(vsm_casters_text), std::string(vsm_text), {1.0f, 1.0f, 0.0f, 0.0f}, with_ground};
}
[[nodiscard]] inline blurred_kind exponential_kind(bool with_ground) {
    const float near_warp = std::exp(40.0f), far_warp = -std::exp(-5.0f); // of depth 1
    return {gl::rgba32f_format,
            std::string(evsm_warp_text) + std::string(evsm_casters_text),
            std::string(evsm_warp_text) + std::string(evsm_text),
            {near_warp, far_warp, near_warp * near_warp, far_warp * far_warp},
            with_ground};
}
[[nodiscard]] inline blurred_kind plain_kind() {
    return {gl::rg8_format,
            gl::caster_text<gnomon::rg8>() + "in float bench_depth;\nvoid main() { gnomon_caster(bench_depth); }\n",
            std::string(plain_text),
            {},
            false,
            true};
}

} // namespace bench_gl
