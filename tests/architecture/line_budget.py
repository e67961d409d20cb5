"""What every file of a user pays for an include: lines that are left after the preprocessor, without the empty ones."""
import headers

TEXEL, STORAGE, FILTER, UMBRELLA, INTRINSICS = 13000, 19000, 20000, 24000, 68500
OWN = {"gnomon/backend/reconstruct.hpp": 62500}  # what it costs to drop in reconstruction by itself; 41,000 of them are intrinsics
STORES = {"gnomon/texel/image.hpp", "gnomon/grid/tile_grid.hpp"}  # these own memory, so they include <vector>
HEAVY = {"algorithm", "cmath", "functional", "memory", "ranges", "string", "iostream"}
LIGHT_FOLDERS = {"texel", "grid", "filter", "receive", "backend"}


def folder(header):
    return header.split("/")[1]


def budget(include, header):
    if header in OWN:
        return OWN[header]
    if any(folder(h) == "simd" and h != "gnomon/simd/region.hpp" for h in headers.closure(include, header)):
        return INTRINSICS  # 40,000 of them are immintrin.h, and what is written for lanes comes once for each target
    if folder(header) in ("filter", "receive", "baseline", "identity"):
        return FILTER
    if folder(header) in ("backend", "soft_shadow_map.hpp", "gnomon.hpp"):
        return UMBRELLA
    return STORAGE if STORES & headers.closure(include, header) else TEXEL


def check(include, compiler):
    for header in headers.all_headers(include):
        if folder(header) in LIGHT_FOLDERS:
            yield from (f"{header}: <{n}> is too heavy for {folder(header)}/" for _, n in headers.includes(include, header) if n in HEAVY)
        if folder(header) in ("geometry", "simd", "gl"):
            continue  # GLM, immintrin.h and GL text have their own price
        lines = sum(1 for line in headers.preprocess(compiler, include, f"#include <{header}>\n", "-P").splitlines() if line.strip())
        allowed = budget(include, header)
        print(f"{lines:6} of {allowed}  {header}")
        if lines > allowed:
            yield f"{header}: {lines} lines after preprocessing, {allowed} are allowed"


headers.main(check, [
    ("gnomon/filter/kernel.hpp", "#include <algorithm>\n", "too heavy"),
    ("gnomon/texel/half.hpp", "#include <regex>\n", "lines after preprocessing"),
    ("gnomon/soft_shadow_map.hpp", "#include <regex>\n", "gnomon/gnomon.hpp"),
    ("gnomon/backend/reconstruct.hpp", "#include <regex>\n", "62500 are allowed"),
])
