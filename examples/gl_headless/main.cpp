// gl_headless: the gallery's scenes with the shadow map on GL, without a display, beside the same by the CPU; and what differs.
//
//   options -> EGL -> mesh -> for each scene: rays, lightmap, view -> for each variant and format: both maps, pictures -> table, page
#include "table.hpp"

#include "../headless_gl.hpp"

#include <gallery/options.hpp>
#include <gallery/output.hpp>
#include <gallery/page.hpp>
#include <gallery/score.hpp>

#include <unistd.h>

#include <cstdio>
#include <exception>
#include <new>

using namespace gallery;
namespace gl = gnomon::gl;

namespace {

void progress(const std::string& what) {
    if (isatty(STDERR_FILENO)) std::fprintf(stderr, "\r\033[K%s", what.c_str());
}

/// Of a run: where everything goes.
struct report {
    output_folder out;
    std::vector<row> rows = {};
    std::string csv = gl_headless::csv_head();
    long long faults = 0;
};

/// The pictures of one format: by the CPU, by GL, and the difference.
void show(report& to, row& in, const scene& s, const view& seen, const gl_headless::comparison& c) {
    const bool on_sheet = c.name.bits == "8 bit" || c.name.bits == "32 bit";
    const auto add = [&](const std::string& name, const std::string& caption, const std::string& short_caption, const picture& p) {
        const std::string file = in.about.id + "_" + c.name.texel + name + ".png";
        to.out.write(file, png(p));
        in.exhibits.push_back({file, caption + " (" + c.name.texel + ")", on_sheet ? short_caption : "",
                               resized(p, thumbnail_width, thumbnail_height)});
    };
    const int factor = amplification(gallery::compare(c.gpu, c.cpu).rmse);
    const std::string times = " x " + std::to_string(factor);
    add("", c.name.bits + " by the CPU", "CPU " + c.name.bits, shade(seen, s, c.cpu));
    add("_gl", c.name.bits + " by GL", "GL " + c.name.bits, shade(seen, s, c.gpu));
    add("_difference", "GL minus CPU," + times, "GL - CPU" + times,
        shade_difference(seen, s, c.gpu, c.cpu, static_cast<float>(factor)));
}

void add_row(report& to, const gl::backend& run, const gl_headless::gpu_scene& on_gpu, const scene& s, const variant& how,
             const mesh& m, const gnomon::light_frame& frame, const view& seen) {
    row added{.about = how, .exhibits = {}, .numbers = {}};
    std::vector<gl_headless::comparison> table;
    for_each_format(s, how, [&]<typename Texel>(const format_name& name) {
        progress("gl_headless: " + how.id + " " + name.texel);
        gl_headless::comparison c = gl_headless::compare<Texel>(name, run, on_gpu, s, how, m, frame, seen.points);
        if (c.missing.empty()) show(to, added, s, seen, c);
        to.faults += c.filtered_alike;
        c.cpu.clear();
        c.gpu.clear();
        table.push_back(std::move(c));
    });
    added.numbers = gl_headless::numbers_of(table, seen.points.size());
    to.csv += gl_headless::csv_of(how.id, table);
    to.rows.push_back(std::move(added));
}

/// What is the same on both sides differs nowhere, or the exit code is 1.
int run(const options& chosen) {
    const headless_gl display(chosen.es ? headless_gl::api::es : headless_gl::api::desktop, chosen.es ? 30 : 33, chosen.egl);
    if (!display) throw failure(display.why_not());
    const gl::functions functions = gl::load([&](const char* name) { return display.get_proc_address(name); });
    const auto context = gl::context::of(functions);
    if (!context) throw failure(context.error().sentence);
    const auto text_of = [&](unsigned name) { return reinterpret_cast<const char*>(functions.GetString(name)); };
    const std::string renderer = std::string(text_of(gl::enums::renderer)) + ", " + text_of(gl::enums::version);

    const mesh m = choose_mesh(chosen.mesh);
    const gl::backend on_gl(*context);
    report to{.out = output_folder(chosen.out)};
    for (const scene& s : all_scenes()) {
        progress("gl_headless: " + s.variants.front().id);
        const ray_world world(s, m);
        const gnomon::light_frame frame = frame_of(s, map_extent, soft_kernel::radius);
        const view seen = look(s, world, bake(s, world), frame, chosen.size);
        const gl_headless::gpu_scene on_gpu(*context, s, m, frame);
        for (const variant& how : s.variants) add_row(to, on_gl, on_gpu, s, how, m, frame, seen);
    }
    progress("");
    to.out.write(
        "contact_sheet.png",
        png(contact_sheet(to.rows, "grey: the same   red: darker by GL   blue: lighter by GL   so many times too strong")));
    to.out.write("table.csv", to.csv);
    to.out.write("index.html", html("gnomon: the same shadows by CPU and GL", gl_headless::about(renderer, m.name), to.rows));
    to.out.commit();
    std::printf("%s\n", (to.out.path() / "index.html").c_str());
    if (to.faults == 0) return 0;
    std::fprintf(stderr, "gnomon_gl_headless: from equal casters GL filters %lld texels otherwise than the CPU; see table.csv\n",
                 to.faults);
    return 1;
}

} // namespace

int main(int argc, char** argv) {
    int exit_code = 0;
    const auto chosen = parse(argc, argv, exit_code, program::gl_headless);
    if (!chosen) return exit_code;
    try {
        return run(*chosen);
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "gnomon_gl_headless: there is not enough memory for this mesh and --size\n");
    } catch (const std::exception& e) {
        std::fprintf(stderr, "gnomon_gl_headless: %s\n", e.what());
    }
    return 1;
}
