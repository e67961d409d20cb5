"""Builds of different flags have different names: no two of these may put their code into the same namespace."""
import platform
import re

import headers

FLAGS = """sse3 ssse3 sse4.1 sse4.2 avx avx2 popcnt lzcnt bmi bmi2 movbe fma f16c avx512f avx512cd avx512dq avx512bw avx512vl avx512vnni
avx512vbmi avx512vbmi2 avx512bitalg avx512vpopcntdq avx512fp16 avxvnni gfni sse4a xop fma4 tbm arch=x86-64-v3
arch=x86-64-v4""".split()


def name(compiler, include, *flags):
    text = headers.preprocess(compiler, include, "#include <gnomon/build.hpp>\nGNOMON_BUILD\n", "-P", *flags)
    return text.strip().splitlines()[-1]


def check(include, compiler):
    if platform.machine() not in ("x86_64", "AMD64"):
        return []
    builds = [[], ["-ffast-math"]] + [[f"-m{flag}"] for flag in FLAGS] + [["-march=x86-64-v3", f"-m{flag}"] for flag in FLAGS if flag.startswith("avx512")]
    complaints, seen = [], {}
    for flags in builds:
        said, words = name(compiler, include, *flags), " ".join(flags) or "no flags"
        if not re.fullmatch("[a-z][a-z0-9_]*", said):
            complaints.append(f"{words}: {said} is no name")
        if said in seen:
            complaints.append(f"{words}: {said}, and so is {seen[said]}")
        seen[said] = words
    return complaints


headers.main(check, [
    ("gnomon/build.hpp", "#undef GNOMON_HAS_FMA\n", "-mfma"),
    ("gnomon/build.hpp", "#undef GNOMON_HAS_AVX512VPOPCNTDQ\n", "-mavx512vpopcntdq"),
    ("gnomon/build.hpp", "#undef GNOMON_HAS_FAST_MATH\n", "-ffast-math"),
    ("gnomon/build.hpp", "#undef GNOMON_BUILD_LANES\n#define GNOMON_BUILD_LANES x86\n", "-msse3"),
])
