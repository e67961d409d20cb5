// What bench/gl measures with: its context, the clock, and the few things of GL that gnomon has no need of.
#pragma once

#include "peers.hpp"
#include "scene.hpp"

#include <support/gl_context.hpp>

#include <gnomon/gl/backend.hpp>

#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bench_gl {

namespace gl = gnomon::gl;
namespace enums = gnomon::gl::enums;
using gnomon::extent;

/// A bench has no use for half of what it wants.
template <typename T> T must(gl::result<T> made) {
    if (made) return *std::move(made);
    std::fprintf(stderr, "bench/gl: %s\n", made.error().sentence.c_str());
    std::exit(1);
}

/// GL's timer queries, where a context has them.
struct timer_queries {
    static constexpr unsigned time_elapsed = 0x88BF, query_result = 0x8866;
    void (*gen)(int, unsigned*) = nullptr;
    void (*begin)(unsigned, unsigned) = nullptr;
    void (*end)(unsigned) = nullptr;
    void (*get)(unsigned, unsigned, std::uint64_t*) = nullptr;
    unsigned name = 0;

    explicit timer_queries(const gl::context& c) {
        if (c.es) return; // only by EXT_disjoint_timer_query
        const auto find = [](auto& pointer, const char* called) {
            pointer =
                gl::detail::as_function<std::remove_reference_t<decltype(pointer)>>(test::egl::library().get_proc_address(called));
        };
        find(gen, "glGenQueries");
        find(begin, "glBeginQuery");
        find(end, "glEndQuery");
        find(get, "glGetQueryObjectui64v");
        if (gen != nullptr && begin != nullptr && end != nullptr && get != nullptr) gen(1, &name);
    }
};

/// The clock on the wall around work and glFinish; beside it a query, if it was found to tell the truth.
class stopwatch {
  public:
    explicit stopwatch(const gl::context& c) : c_(c), query_(c) {}

    /// Milliseconds of work(), by the wall and by a query, 0 without.
    template <typename Work> std::pair<double, double> time(Work&& work, bool ask) {
        using clock = std::chrono::steady_clock;
        using milliseconds = std::chrono::duration<double, std::milli>;
        const auto start = clock::now();
        if (ask) query_.begin(timer_queries::time_elapsed, query_.name);
        work();
        if (ask) query_.end(timer_queries::time_elapsed);
        c_.gl->Finish();
        const milliseconds passed = clock::now() - start;
        std::uint64_t nanoseconds = 0;
        if (ask) query_.get(query_.name, timer_queries::query_result, &nanoseconds);
        return {passed.count(), static_cast<double>(nanoseconds) * 1e-6};
    }

    /// Times something heavy both ways, and says whether queries are worth a counter: between 0.8 and 1.05 of the wall, five times.
    template <typename Work> std::string find_out(Work&& work) {
        if (query_.name == 0) return "there are none";
        (void)time(work, true);
        truthful_ = true;
        std::pair<double, double> worst{1.0, 1.0};
        for (int tries = 0; tries < 5; ++tries) {
            const auto [wall, query] = time(work, true);
            truthful_ = truthful_ && query > 0.8 * wall && query < 1.05 * wall;
            if (query * worst.first <= wall * worst.second) worst = {wall, query};
        }
        char sentence[160];
        std::snprintf(sentence, sizeof sentence, "%s: what took %.3f ms by the clock took %.3f ms by a query",
                      truthful_ ? "beside the clock, as counter query_ms" : "not used", worst.first, worst.second);
        return sentence;
    }

    template <typename Work> void run(benchmark::State& state, Work&& work) {
        double queried = 0.0;
        c_.gl->Finish();
        for ([[maybe_unused]] auto _ : state) {
            const auto [wall, query] = time(work, truthful_);
            state.SetIterationTime(wall * 1e-3);
            queried += query;
        }
        if (truthful_) state.counters["query_ms"] = benchmark::Counter(queried, benchmark::Counter::kAvgIterations);
    }

  private:
    const gl::context& c_;
    timer_queries query_;
    bool truthful_ = false;
};

inline constexpr gl::format r8_format{
    "R8", enums::r8, 1, enums::red, enums::type_unsigned_byte, enums::rgba, enums::type_unsigned_byte};
inline constexpr gl::format r32f_format{"R32F", enums::r32f, 1, enums::red, enums::type_float, enums::rgba, enums::type_float};
inline constexpr gl::format depth24_format{"DEPTH_COMPONENT24",     enums::depth_component24, 1,
                                           enums::depth_component,  enums::type_unsigned_int, enums::depth_component,
                                           enums::type_unsigned_int};

/// From texts without a header; samplers take the units 0, 1 ... in this order.
[[nodiscard]] inline gl::program program_of(const gl::context& c, std::string_view vertex, std::string_view fragment,
                                            std::initializer_list<const char*> samplers = {}) {
    std::string header(gl::glsl_header(gl::glsl_version_of(c)));
    if (c.es) header += "precision highp sampler2DShadow;\n";
    gl::program made = must(gl::make_program(c, header + std::string(vertex), header + std::string(fragment)));
    c.gl->UseProgram(made.name());
    for (int unit = 0; const char* sampler : samplers) c.gl->Uniform1i(c.gl->GetUniformLocation(made.name(), sampler), unit++);
    return made;
}

inline void sample_linearly(const gl::context& c, unsigned texture) {
    c.gl->BindTexture(enums::texture_2d, texture);
    for (const unsigned filter : {enums::texture_min_filter, enums::texture_mag_filter})
        c.gl->TexParameteri(enums::texture_2d, filter, static_cast<int>(enums::linear));
}

/// A texture with LINEAR samples; of depths, compared ones.
[[nodiscard]] inline gl::texture linear_texture(const gl::context& c, const gl::format& as, extent size) {
    gl::texture made = must(gl::make_texture(c, as, size));
    sample_linearly(c, made.name());
    constexpr int compare_ref_to_texture = 0x884E; // LEQUAL is what a new texture has
    if (as.upload == enums::depth_component)
        c.gl->TexParameteri(enums::texture_2d, enums::texture_compare_mode, compare_ref_to_texture);
    return made;
}

/// The scene as GL has it, for maps of one size: its triangles, receivers on a screen as large, and two targets for intensities,
/// one as an engine has it and one that rounds nothing.
class stage {
  public:
    stage(const gl::context& c, const scene& of, int texels)
        : side(texels), receivers(seen(of, texels)), c_(c), mesh_(c), nothing_(c) {
        const gl::state_guard<> forced(c);
        const std::vector<glm::vec3> corners = triangles(of, casters_);
        all_ = corners.size();
        c.gl->BindVertexArray(mesh_.name());
        buffer_ =
            must(gl::make_buffer(c, static_cast<std::ptrdiff_t>(sizeof(glm::vec3) * all_), corners.data(), enums::static_draw));
        c.gl->EnableVertexAttribArray(0);
        c.gl->VertexAttribPointer(0, 3, enums::type_float, 0, sizeof(glm::vec3), nullptr);
        points_ = must(gl::make_texture(c, gl::rgba32f_format, size()));
        c.gl->TexSubImage2D(enums::texture_2d, 0, 0, 0, side, side, enums::rgba, enums::type_float, receivers.data());
        screen_ = must(gl::make_texture(c, r8_format, size()));
        finer_ = must(gl::make_texture(c, r32f_format, size()));
        into_screen_ = must(gl::make_framebuffer(c, {screen_.name()}));
        into_finer_ = must(gl::make_framebuffer(c, {finer_.name()}));
    }

    const int side;
    const std::vector<receiver> receivers;

    [[nodiscard]] extent size() const { return {side, side}; }
    /// The texture of the receivers.
    [[nodiscard]] unsigned points() const { return points_.name(); }
    [[nodiscard]] unsigned screen() const { return into_screen_.name(); }
    [[nodiscard]] unsigned finer_screen() const { return into_finer_.name(); }

    void draw_casters(bool with_ground) const {
        c_.gl->BindVertexArray(mesh_.name());
        c_.gl->DrawArrays(enums::triangles, 0, static_cast<int>(with_ground ? all_ : casters_));
    }
    /// One fragment for every pixel of what is bound.
    void draw_all(unsigned framebuffer, const gl::program& by) const {
        gl::begin_pass(c_, {.framebuffer = framebuffer, .size = size()});
        c_.gl->UseProgram(by.name());
        c_.gl->BindVertexArray(nothing_.name());
        c_.gl->DrawArrays(enums::triangles, 0, 3);
    }
    /// Intensities of all receivers, by a program whose samplers are the map and the points.
    void receive(unsigned framebuffer, const gl::program& by, unsigned map) const {
        gl::bind_textures(c_, {map, points()});
        draw_all(framebuffer, by);
    }
    /// What the finer screen holds.
    [[nodiscard]] std::vector<float> intensities() const {
        const gl::state_guard<> forced(c_);
        std::vector<float> four(4 * receivers.size()), one;
        c_.gl->BindFramebuffer(enums::framebuffer, finer_screen());
        c_.gl->ReadPixels(0, 0, side, side, enums::rgba, enums::type_float, four.data());
        for (std::size_t i = 0; i < four.size(); i += 4) one.push_back(four[i]);
        return one;
    }

  private:
    const gl::context& c_;
    gl::vertex_array mesh_, nothing_;
    gl::buffer buffer_;
    std::size_t casters_ = 0, all_ = 0;
    gl::texture points_, screen_, finer_;
    gl::framebuffer into_screen_, into_finer_;
};

} // namespace bench_gl
