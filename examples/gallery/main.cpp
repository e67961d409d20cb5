// The gallery: the scenes of seed 000, drawn with gnomon in every storage format and measured against exact filtering.
//
//   options -> mesh -> for each scene: rays, lightmap, view, truth -> for each variant: gnomon, pictures, scores -> sheet, table, page
#include "failure.hpp"
#include "options.hpp"
#include "output.hpp"
#include "page.hpp"
#include "report.hpp"
#include "truth.hpp"

#include <unistd.h>

#include <cstdio>
#include <exception>
#include <new>

using namespace gallery;

namespace {

void progress(const std::string& what) {
    if (isatty(STDERR_FILENO)) std::fprintf(stderr, "\r\033[K%s", what.c_str());
}

row row_of(output_folder& out, std::string& csv, const scene& s, const variant& how, const mesh& m,
           const gnomon::light_frame& frame, const view& seen, const exact_map& exact, const std::vector<float>& truth) {
    row result{.about = how, .exhibits = {}, .numbers = {}};
    const auto show = [&](const std::string& name, const std::string& caption, const std::string& short_caption, const picture& p) {
        const std::string file = how.id + "_" + name + ".png";
        out.write(file, png(p));
        result.exhibits.push_back({file, caption, short_caption, resized(p, thumbnail_width, thumbnail_height)});
    };
    show("shadowless", "without dynamic shadow", "no shadow", shade(seen, s, std::vector<float>(seen.points.size(), 0.0f)));
    show("hard", "hard depth test at the nearest texel", "hard depth test", shade(seen, s, hard_shadow(exact, seen.points)));
    show("truth", "exact percentage-closer filtering, the truth", "exact PCF, truth", shade(seen, s, truth));
    std::vector<measured> table;
    std::vector<answer> answers = answers_of(s, how, m, frame, seen.points);
    for (answer& a : answers) {
        show(a.format, "gnomon, " + a.bits + " (" + a.format + ")", a.bits == "half" ? "" : "gnomon " + a.bits,
             shade(seen, s, a.intensity));
        table.push_back({a, compare(a.intensity, truth)});
        table.back().what.intensity.clear();
    }
    const answer& first = answers.front();
    const int factor = amplification(table.front().error.rmse);
    const std::string times = " x " + std::to_string(factor);
    show("difference", first.bits + " minus truth," + times, first.bits + " error" + times,
         shade_difference(seen, s, first.intensity, truth, static_cast<float>(factor)));
    result.numbers = numbers_of(table, seen.points.size());
    csv += csv_of(how.id, table);
    return result;
}

void run(const options& chosen) {
    const mesh m = choose_mesh(chosen.mesh);
    output_folder out(chosen.out);
    std::vector<row> rows;
    std::string csv = csv_head();
    for (const scene& s : all_scenes()) {
        progress("gallery: " + s.variants.front().id);
        const ray_world world(s, m);
        const gnomon::light_frame frame = frame_of(s, map_extent, soft_kernel::radius);
        const view seen = look(s, world, bake(s, world), frame, chosen.size);
        const exact_map exact = exact_map_of(s, m, frame);
        const std::vector<float> truth = exact_shadow(exact, seen.points, soft_kernel::weights);
        for (const variant& how : s.variants) {
            progress("gallery: " + how.id);
            rows.push_back(row_of(out, csv, s, how, m, frame, seen, exact, truth));
        }
    }
    progress("");
    out.write("contact_sheet.png",
              png(contact_sheet(rows, "red: too dark   blue: too light   errors are those of 8 bit, so many times too strong")));
    out.write("table.csv", csv);
    out.write("index.html", html("gnomon: soft shadows, measured", about_the_gallery(m.name), rows));
    out.commit();
    std::printf("%s\n", (out.path() / "index.html").c_str());
}

} // namespace

int main(int argc, char** argv) {
    int exit_code = 0;
    const auto chosen = parse(argc, argv, exit_code);
    if (!chosen) return exit_code;
    try {
        run(*chosen);
        return 0;
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "gnomon_gallery: there is not enough memory for this mesh and --size\n");
    } catch (const std::exception& e) {
        std::fprintf(stderr, "gnomon_gallery: %s\n", e.what());
    }
    return 1;
}
