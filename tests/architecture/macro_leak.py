"""gnomon.hpp leaves no macros behind but GNOMON_*, and changes none of those that the standard headers define."""
import headers

ONLY = {"intrin.h": "defined(_MSC_VER)", "arm_neon.h": "defined(__ARM_NEON)", "wasm_simd128.h": "defined(__wasm_simd128__)"}


def macros(compiler, include, source):
    text = headers.preprocess(compiler, include, source, "-dM")
    return {line.split(None, 2)[1].split("(")[0]: line for line in text.splitlines() if line.startswith("#define ")}


def check(include, compiler):
    ours = headers.closure(include, "gnomon/gnomon.hpp")
    standard = sorted({n for h in ours for _, n in headers.includes(include, h) if not n.startswith("gnomon/")})
    before = macros(compiler, include, "".join(f"#if __has_include(<{n}>) && {ONLY.get(n, 1)}\n#include <{n}>\n#endif\n" for n in standard))
    after = macros(compiler, include, "#include <gnomon/gnomon.hpp>\n")
    return [f"gnomon.hpp leaves {line}" for name, line in sorted(after.items())
            if before.get(name) != line and not name.startswith("GNOMON_")] + \
           [f"gnomon.hpp removes {line}" for name, line in sorted(before.items()) if name not in after and name not in ("assert",)]


headers.main(check, [
    ("gnomon/texel/half.hpp", "#define SHADOW_BITS 16\n", "leaves #define SHADOW_BITS"),
    ("gnomon/texel/half.hpp", "#define small(x) x\n", "leaves #define small"),
    ("gnomon/rect.hpp", "#include <climits>\n#undef INT_MAX\n#define INT_MAX 3\n", "leaves #define INT_MAX"),
])
