// gallery: what can be said on the command line.
#pragma once

#include <optional>
#include <string>

namespace gallery {

struct options {
    std::string mesh; ///< an OBJ file; empty: the bunny if it is installed, else a torus knot
    std::string out;  ///< the folder for everything that is written
    int size = 640;   ///< width of a picture in pixels; its height is 3/4 of that
    /// Of gnomon_gl_headless:
    std::string egl = "libEGL.so.1";
    bool es = false; ///< OpenGL ES, not OpenGL
};

enum class program { gallery, gl_headless };

/// Reads the command line. Without a value the program ends with `exit_code`: after --help with 0, after a mistake, which was
/// explained on stderr, with 1.
[[nodiscard]] std::optional<options> parse(int argc, const char* const* argv, int& exit_code, program which = program::gallery);

} // namespace gallery
