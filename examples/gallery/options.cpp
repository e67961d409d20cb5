#include "options.hpp"

#pragma GCC diagnostic ignored "-Wnull-dereference" // g++ 12 sees one in std::string, once CLI11 is inlined
#include <CLI/CLI.hpp>

#include <iostream>

#ifndef GNOMON_GALLERY_DEFAULT_OUT
#define GNOMON_GALLERY_DEFAULT_OUT "build/gallery"
#endif

namespace gallery {

std::optional<options> parse(int argc, const char* const* argv, int& exit_code, program which) {
    const bool gl = which == program::gl_headless;
    const std::string name = gl ? "gnomon_gl_headless" : "gnomon_gallery";
    options chosen{.mesh = {}, .out = GNOMON_GALLERY_DEFAULT_OUT + std::string(gl ? "-gl" : "")};
    CLI::App app(
        gl ? "Draws the scenes of the gallery with the shadow map on OpenGL, without a display, beside the same by the CPU,\n"
             "and writes pictures, a table of what differs and a page."
           : "Draws the scenes of Simpler Soft Shadow Mapping with gnomon, measures them against exact percentage-closer\n"
             "filtering, and writes pictures, a table and a page.",
        name);
    app.add_option("--mesh", chosen.mesh, "OBJ file that casts the shadows [the bunny of glmark2-data, or a torus knot]")
        ->type_name("FILE");
    app.add_option("--out", chosen.out, "folder to write to")->type_name("DIR")->capture_default_str();
    app.add_option("--size", chosen.size, "width of a picture in pixels")
        ->type_name("N")
        ->check(CLI::Range(64, 1600))
        ->capture_default_str();
    if (!gl) app.footer("With ./examples/run: --gl draws the same on OpenGL, --window opens a window. Each has a --help.");
    if (gl) {
        app.add_option("--egl", chosen.egl, "library that makes the context")->type_name("FILE")->capture_default_str();
        app.add_flag("--es", chosen.es, "OpenGL ES 3 in place of OpenGL 3.3");
    }
    try {
        app.parse(argc, argv);
        return chosen;
    } catch (const CLI::CallForHelp&) {
        std::cout << app.help();
        exit_code = 0;
    } catch (const CLI::ParseError& e) {
        std::cerr << name << ": " << e.what() << "; see --help\n";
        exit_code = 1;
    }
    return std::nullopt;
}

} // namespace gallery
