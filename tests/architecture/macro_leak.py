"""gnomon.hpp, and all of gl/, leave no macros behind but GNOMON_*, and change none of those that the standard headers define.

gl/ leaves nothing of its own: what lists GL's functions is gone."""
import headers

ONLY = {"intrin.h": "defined(_MSC_VER)", "arm_neon.h": "defined(__ARM_NEON)", "wasm_simd128.h": "defined(__wasm_simd128__)"}


def macros(compiler, include, source):
    text = headers.preprocess(compiler, include, source, "-dM")
    return {line.split(None, 2)[1].split("(")[0]: line for line in text.splitlines() if line.startswith("#define ")}


def leaks(include, compiler, names):
    ours = set().union(*(headers.closure(include, name) for name in names))
    standard = sorted({n for h in ours for _, n in headers.includes(include, h) if not n.startswith("gnomon/")})
    before = macros(compiler, include, "".join(f"#if __has_include(<{n}>) && {ONLY.get(n, 1)}\n#include <{n}>\n#endif\n" for n in standard))
    after = macros(compiler, include, "".join(f"#include <{name}>\n" for name in names))
    return [f"{names[0]} leaves {line}" for name, line in sorted(after.items())
            if before.get(name) != line and (not name.startswith("GNOMON_") or name.startswith("GNOMON_GL_"))] + \
           [f"{names[0]} removes {line}" for name, line in sorted(before.items()) if name not in after and name not in ("assert",)]


def check(include, compiler):
    gl = [h for h in headers.all_headers(include) if h.startswith("gnomon/gl/")]
    return leaks(include, compiler, ["gnomon/gnomon.hpp"]) + leaks(include, compiler, gl)


headers.main(check, [
    ("gnomon/texel/half.hpp", "#define SHADOW_BITS 16\n", "leaves #define SHADOW_BITS"),
    ("gnomon/texel/half.hpp", "#define small(x) x\n", "leaves #define small"),
    ("gnomon/rect.hpp", "#include <climits>\n#undef INT_MAX\n#define INT_MAX 3\n", "leaves #define INT_MAX"),
    ("gnomon/gl/functions.hpp", "#define GL_RG8 0x822B\n", "leaves #define GL_RG8"),
    ("gnomon/gl/context.hpp", "#define GNOMON_GL_CALL\n", "leaves #define GNOMON_GL_CALL"),
])
