// What the passes on GL cost, and beside them, over the same scene in the same context, percentage closer filtering, variance maps
// and exponential variance maps: time, and how far each is from the exact shadow.
//
// By the clock on the wall around work and glFinish. Names end in the map's side:
//     filter/FORMAT/kTAPS/WHAT/1024  both passes of the filter; WHAT is `dense`, the whole map at once; `sparse10`, what casters in
//                                    10 % of the tiles reach, in one instanced draw; `scissor10`, one scissored draw for each
//     cast/FORMAT/1024               clearing, and casting rectangles on a quarter of the map
//     mask/FORMAT/1024               the decision for a whole screen, receivers one to one on texels, all behind all casters
//     frame, casters, blur and receive, each /TECHNIQUE/512 and /1024: a frame over the scene of gl/scene.hpp, and its passes one
//                                    by one. A frame's counters are its errors, gl/errors.hpp, and what share of the map it filters
// `--pictures FOLDER`, alone, writes what every technique shows as FOLDER/TECHNIQUE.pgm and prints errors. GNOMON_TEST_GL=3.3 or
// =es takes another context than the latest. Without a libEGL that makes contexts without a display it says so, and that is all.
#include "clusters.hpp"
#include "gl/errors.hpp"
#include "gl/techniques.hpp"

#include <gnomon/filter/sparse.hpp>

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace {
using namespace gnomon;
using namespace bench_gl;

constexpr int side = 1024, tile = 32, columns = side / tile;
constexpr extent whole_map{side, side};

struct bench {
    const gl::context& c;
    stopwatch clock;
    scene of = {};

    /// Made when first asked for, kept until the end.
    template <typename Make> static auto lazily(Make make) {
        using made = decltype(make());
        return [make, kept = std::make_shared<made>()]() -> made& {
            if (!*kept) *kept = make();
            return *kept;
        };
    }
    void add(const std::string& name, std::function<void(benchmark::State&)> work) {
        benchmark::RegisterBenchmark(name.c_str(), std::move(work))->UseManualTime()->Unit(benchmark::kMillisecond);
    }
};

/// A map of one texel and kernel whose casters are clusters of tiles, so many percent.
template <texel_format Texel, kernel Kernel> struct passes_of_one {
    gl::passes<Texel, Kernel> passes;
    gl::map_textures textures;
    tile_grid tiles{whole_map, tile};

    passes_of_one(const gl::context& c, int percent)
        : passes(must(gl::passes<Texel, Kernel>::make(c))),
          textures(must(gl::map_textures::make(c, whole_map, gl::format_of<Texel>, passes.scratch()))) {
        const gl::state_guard<> forced(c);
        for (const tile_rect t : clusters::covering(percent, columns)) tiles.mark(tiles.texels_of(t), Kernel::radius);
        passes.clear_casters(c, textures.targets(), casters()); // drivers compile at the first draw
        passes.cast(c, textures.targets(), casters());
        filter(c, true, gl::rectangles_by::instances);
    }
    /// What clear and cast walk over: depths grow along the map.
    [[nodiscard]] auto casters() const {
        return [this](auto&& f) {
            for_each_region_within(tiles, 0,
                                   [&](texel_rect r) { f(gl::surface{r, static_cast<float>(r.x0 + r.y0) / (3.0f * side)}); });
        };
    }
    void filter(const gl::context& c, bool dense, gl::rectangles_by way) {
        const gl::state_guard<> forced(c);
        passes.filter(
            c, textures.targets(),
            [&](auto&& f) { dense ? f(whole(whole_map)) : for_each_region_within(tiles, Kernel::radius, f); }, way);
    }
};

template <texel_format Texel, kernel Kernel>
void add_filter(bench& b, const std::string& of, const std::string& what, int percent, bool dense, gl::rectangles_by way) {
    const auto map = b.lazily([&b, percent] { return std::make_unique<passes_of_one<Texel, Kernel>>(b.c, percent); });
    b.add("filter/" + of + "/k" + std::to_string(2 * Kernel::radius + 1) + "/" + what + "/1024",
          [&b, map, dense, way](benchmark::State& state) {
              passes_of_one<Texel, Kernel>& one = *map();
              b.clock.run(state, [&] { one.filter(b.c, dense, way); });
              state.counters["area"] = dense ? 1.0 : clusters::grown_area(one.tiles, side, Kernel::radius);
          });
}

template <texel_format Texel, kernel Kernel> void add_dense_and_sparse(bench& b, const std::string& of) {
    add_filter<Texel, Kernel>(b, of, "dense", 25, true, gl::rectangles_by::instances);
    add_filter<Texel, Kernel>(b, of, "sparse10", 10, false, gl::rectangles_by::instances);
}

/// Clear and cast, and the mask of a full screen.
template <texel_format Texel> void add_passes(bench& b, const std::string& of) {
    if (gl::problem why = gl::supports<Texel>(b.c))
        return (void)std::fprintf(stderr, "bench/gl: skipped: %s\n", why.sentence.c_str());
    using one_of = passes_of_one<Texel, gaussian<4>>;
    add_dense_and_sparse<Texel, gaussian<4>>(b, of);
    const auto map = b.lazily([&b] { return std::make_unique<one_of>(b.c, 25); });
    b.add("cast/" + of + "/1024", [&b, map](benchmark::State& state) {
        one_of& one = *map();
        b.clock.run(state, [&] {
            const gl::state_guard<> forced(b.c);
            one.passes.clear_casters(b.c, one.textures.targets(), one.casters());
            one.passes.cast(b.c, one.textures.targets(), one.casters());
        });
    });
    struct masking {
        one_of map;
        stage on;
        gl::receive_pass<Texel> pass;
        gl::texture depths;
        masking(bench& from)
            : map(from.c, 25), on(from.c, from.of, side), pass(must(gl::receive_pass<Texel>::make(from.c, gl::receivers::texels))) {
            const gl::state_guard<> forced(from.c);
            depths = must(gl::make_texture(from.c, r32f_format, whole_map));
            const std::vector<float> far_away(std::size_t{side} * side, 0.9f);
            from.c.gl->TexSubImage2D(enums::texture_2d, 0, 0, 0, side, side, enums::red, enums::type_float, far_away.data());
        }
        void draw(const gl::context& c) {
            const gl::state_guard<> forced(c);
            pass.draw(c, {on.screen(), whole_map}, map.textures.targets().soft, depths.name(), rule{});
        }
    };
    const auto mask = b.lazily([&b] {
        auto made = std::make_unique<masking>(b);
        made->draw(b.c);
        return made;
    });
    b.add("mask/" + of + "/1024", [&b, mask](benchmark::State& state) {
        masking& one = *mask();
        b.clock.run(state, [&] { one.draw(b.c); });
    });
}

/// A stage of one size, with its judge.
struct place {
    stage on;
    judge by;
    place(const gl::context& c, const scene& of, int size) : on(c, of, size), by(of, on) {}
};

struct entry {
    std::string name;
    bool blurs;
    std::function<std::unique_ptr<technique>(const gl::context&, const stage&, const scene&)> make;
    std::function<error(const judge&, technique&)> compare;
};

/// The kernel of Castano's 5x5, by which its own exact shadow is blurred; that of one comparing sample is a tent alone, box<0>.
struct castano_5 {
    static constexpr int radius = 2, total = 12;
    static constexpr std::array<int, 5> weights{1, 3, 4, 3, 1};
};

template <typename Own, typename Map, typename... Arguments>
entry technique_of(const std::string& name, bool blurs, Arguments... arguments) {
    return {name, blurs,
            [=](const gl::context& c, const stage& on, const scene&) { return std::make_unique<Map>(c, on, arguments...); },
            [](const judge& by, technique& what) { return by.of<Own>(what); }};
}
template <typename Own, typename Map, typename... Arguments>
entry technique_with_scene(const std::string& name, Arguments... arguments) {
    return {name, true,
            [=](const gl::context& c, const stage& on, const scene& of) { return std::make_unique<Map>(c, on, of, arguments...); },
            [](const judge& by, technique& what) { return by.of<Own>(what); }};
}
template <texel_format Texel, kernel Kernel> entry gnomon_of(const std::string& name, bool dense) {
    return technique_with_scene<Kernel, gnomon_map<Texel, Kernel>>(name, dense);
}

std::vector<entry> all_techniques() {
    using k9 = gaussian<4>;
    return {gnomon_of<rg8, k9>("rg8.k9.dense", true),
            gnomon_of<rg8, k9>("rg8.k9", false),
            technique_with_scene<k9, sampled_gnomon_map<k9>>("rg8.k9.sampled"),
            gnomon_of<rg8, narrow<k9>>("rg8.narrow.k9", false),
            gnomon_of<rg8, binomial<2>>("rg8.k5", false),
            gnomon_of<rg16, k9>("rg16.k9", false),
            gnomon_of<rg16f, k9>("rg16f.k9", false),
            technique_of<k9, blurred_map<k9>>("plain.k9", true, plain_kind()),
            technique_of<box<0>, closer_map>("pcf2x2", false, pcf_2x2_text),
            technique_of<binomial<1>, closer_map>("pcf3x3", false, pcf_3x3_text),
            technique_of<castano_5, closer_map>("pcf5x5", false, pcf_5x5_text),
            technique_of<k9, blurred_map<k9>>("vsm", true, variance_kind(true)),
            technique_of<k9, blurred_map<k9>>("vsm.casters_only", true, variance_kind(false)),
            technique_of<k9, blurred_map<k9>>("evsm4", true, exponential_kind(true)),
            technique_of<k9, blurred_map<k9>>("evsm4.casters_only", true, exponential_kind(false))};
}

void add_frames(bench& b, int size) {
    const auto where = b.lazily([&b, size] { return std::make_unique<place>(b.c, b.of, size); });
    for (const entry& each : all_techniques()) {
        const auto what = b.lazily([&b, where, each] {
            auto made = each.make(b.c, where()->on, b.of);
            made->frame(); // drivers compile at the first draw
            return made;
        });
        const auto error_of = b.lazily([where, what, each] { return std::make_unique<error>(each.compare(where()->by, *what())); });
        const std::string name = "/" + each.name + "/" + std::to_string(size);
        b.add("frame" + name, [&b, what, error_of](benchmark::State& state) {
            technique& one = *what();
            b.clock.run(state, [&] { one.frame(); });
            state.counters["filtered"] = one.filtered();
            const error& off = *error_of();
            for (const auto& [called, value] : {std::pair{"rmse_ground", off.ground},
                                                {"rmse_platform", off.platform},
                                                {"rmse_own", off.own},
                                                {"leak", off.leak},
                                                {"dark", off.dark}})
                state.counters[called] = value;
        });
        const auto add_pass = [&](const char* pass, auto work) {
            b.add(pass + name, [&b, what, work](benchmark::State& state) {
                technique& one = *what();
                b.clock.run(state, [&] { work(one); });
            });
        };
        add_pass("casters", [](technique& one) { one.cast(); });
        if (each.blurs) add_pass("blur", [](technique& one) { one.filter(); });
        add_pass("receive", [](technique& one) { one.receive(); });
    }
}

void add_all(bench& b) {
    using k9 = gaussian<4>;
    for (const int percent : {1, 5, 10, 25, 50, 100}) {
        const std::string share = std::to_string(percent);
        if (percent != 10) add_filter<rg8, k9>(b, "rg8", "sparse" + share, percent, false, gl::rectangles_by::instances);
        add_filter<rg8, k9>(b, "rg8", "scissor" + share, percent, false, gl::rectangles_by::scissor);
    }
    add_dense_and_sparse<rg8, narrow<k9>>(b, "rg8.narrow");
    add_dense_and_sparse<rg8, binomial<2>>(b, "rg8");
    add_dense_and_sparse<rg8, gaussian<8>>(b, "rg8");
    add_dense_and_sparse<rg8, box<16>>(b, "rg8");
    add_passes<rg8>(b, "rg8");
    add_passes<rg16>(b, "rg16");
    add_passes<rg16f>(b, "rg16f");
    add_passes<rg32f>(b, "rg32f");
    add_passes<rgba8>(b, "rgba8");
    if (!b.c.color_buffer_float || !b.c.float_linear || !b.c.norm16)
        return (void)std::fputs("bench/gl: skipped: frames, for which 16-bit and float textures must be drawn into and sampled\n",
                                stderr);
    for (const int size : {512, 1024}) add_frames(b, size);
}

void write_picture(const std::string& name, const std::vector<float>& shadow, const stage& on) {
    std::FILE* file = std::fopen(name.c_str(), "wb");
    if (file == nullptr) return (void)std::fprintf(stderr, "bench/gl: cannot write %s\n", name.c_str());
    std::fprintf(file, "P5\n%d %d\n255\n", on.side, on.side);
    for (std::size_t i = 0; i < shadow.size(); ++i) {
        const float albedo = on.receivers[i].is_on(receiver::nothing)  ? 0.3f
                             : on.receivers[i].is_on(receiver::ground) ? 1.0f
                                                                       : 0.85f;
        std::fputc(static_cast<int>(255.0f * albedo * (1.0f - 0.8f * shadow[i])), file);
    }
    std::fclose(file);
}

void write_pictures(bench& b, const std::string& folder) {
    const place where(b.c, b.of, 512);
    write_picture(folder + "/exact.pgm", where.by.picture(), where.on);
    for (const entry& each : all_techniques()) {
        const auto what = each.make(b.c, where.on, b.of);
        const error off = each.compare(where.by, *what);
        std::printf("%-20s ground %.4f platform %.4f own %.4f leak %.4f dark %.4f\n", each.name.c_str(), off.ground, off.platform,
                    off.own, off.leak, off.dark);
        write_picture(folder + "/" + each.name + ".pgm", where.on.intensities(), where.on);
    }
}
} // namespace

int main(int count, char** words) {
    std::unique_ptr<test::gl_context> made; // the first of these
    for (const test::gl_kind kind : {test::gl_4_5, test::gl_3_3, test::gl_es})
        if (test::gl_asked_for(kind.name) && (!made || !*made)) made = std::make_unique<test::gl_context>(kind);
    if (!made || !*made) {
        std::fprintf(stderr, "bench/gl: skipped: %s\n", made ? made->why_not().c_str() : "no GL context is asked for");
        return 0;
    }
    bench b{made->context(), stopwatch(made->context())};
    if (count == 3 && std::string(words[1]) == "--pictures") {
        write_pictures(b, words[2]);
        return 0;
    }

    add_all(b);
    benchmark::Initialize(&count, words);
    if (benchmark::ReportUnrecognizedArguments(count, words)) return 1;
    {
        passes_of_one<rg8, gaussian<4>> heavy(b.c, 25); // one target: a change of targets would flush
        const std::string queries = b.clock.find_out([&] {
            const gl::state_guard<> forced(b.c);
            heavy.passes.blur_columns(b.c, heavy.textures.targets(), [](auto&& f) { f(whole(whole_map)); });
        });
        benchmark::AddCustomContext("gl", made->name());
        benchmark::AddCustomContext("timer queries", queries);
    }
    benchmark::RunSpecifiedBenchmarks();
}
