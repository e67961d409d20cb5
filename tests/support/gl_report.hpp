// The table that ./tests/run --gl ends with: what was compared on which GL, and how much of it differed.
#pragma once

#include "egl.hpp"

#include <cstdio>
#include <string>

namespace test {

/// A row of the table, for the context that is current: "rg16", "blur of columns", texels compared, texels differing.
/// Written to the file that GNOMON_GL_REPORT names; without it, nowhere. Checks nothing: say CHECK(differing == 0) beside it.
inline void gl_report(const std::string& format, const std::string& pass, long long compared, long long differing) {
    const char* name = std::getenv("GNOMON_GL_REPORT");
    if (name == nullptr || gl_context::current() == nullptr) return;
    if (std::FILE* file = std::fopen(name, "a")) {
        std::fprintf(file, "%s\t%s\t%s\t%lld\t%lld\n", gl_context::current()->name().c_str(), format.c_str(), pass.c_str(),
                     compared, differing);
        std::fclose(file);
    }
}

} // namespace test
