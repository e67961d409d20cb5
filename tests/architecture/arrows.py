"""Includes run one way: unit, rect <- texel <- grid <- filter <- receive <- baseline, identity <- backend <- facade <- gl.

geometry/ may see everything up to backend/, and is the only place of GLM; simd/ sees itself and texel/, and only backend/ and
geometry/ see it."""
import re

import headers

ROOT = ["version", "build", "config", "fwd", "unit", "rect"]  # these may see one another
LAYERS = ["root", "texel", "grid", "filter", "receive", "baseline identity", "backend", "soft_shadow_map", "gnomon", "gl"]
RANK = {name: rank for rank, names in enumerate(LAYERS) for name in names.split()}


def place(header):
    """gnomon/texel/half.hpp is at texel; gnomon/unit.hpp at root; gnomon/soft_shadow_map.hpp is a place of its own."""
    parts = header.removesuffix(".hpp").split("/")
    return parts[1] if len(parts) > 2 or parts[1] not in ROOT else "root"


def may_include(here, there):
    if here == there:
        return True
    if here == "simd":
        return RANK.get(there, 99) <= RANK["texel"]
    if here == "geometry":
        return there == "simd" or RANK.get(there, 99) <= RANK["backend"]
    if there == "simd":
        return here == "backend"
    return RANK.get(there, 99) < RANK[here]


def check(include, _compiler):
    complaints = []
    names = headers.all_headers(include)
    if not names:
        complaints.append(f"no header under {include}")
    for header in names:
        here = place(header)
        text = (include / header).read_text()
        if here not in RANK and here not in ("geometry", "simd"):
            complaints.append(f"{header}: arrows.py does not know where {here} stands")
            continue
        if ("\n#pragma once" in text) == ("#ifdef GNOMON_ON" in text):  # the latter is included once for each target
            complaints.append(f"{header}: no #pragma once, or one in a header for several targets")
        if re.search(r"^\s*namespace gnomon\b(?!::inline GNOMON_BUILD\b)", text, re.MULTILINE):
            complaints.append(f"{header}: opens gnomon without its build; write namespace gnomon::inline GNOMON_BUILD")
        if "define GLM_" in text:
            complaints.append(f"{header}: defines a GLM macro, which changes GLM for everybody")
        for quote, name in headers.includes(include, header):
            if quote == '"':
                complaints.append(f'{header}: "{name}" in quotes; write <gnomon/...>')
            if name.startswith("glm/") and here != "geometry":
                complaints.append(f"{header}: <{name}>, but GLM belongs to geometry/")
            if name.startswith(("GL/", "GLES", "KHR/", "EGL/", "epoxy/", "glad/", "GLFW/", "SDL")):
                complaints.append(f"{header}: <{name}>, but the host owns GL")
            if not name.startswith("gnomon/"):
                continue
            if not (include / name).exists():
                complaints.append(f"{header}: <{name}> does not exist")
            elif header in headers.closure(include, name):
                complaints.append(f"{header}: <{name}> includes it back")
            elif name != "gnomon/config.hpp" and not may_include(here, place(name)):
                complaints.append(f"{header}: <{name}> is against the arrows")
    for name in headers.closure(include, "gnomon/gnomon.hpp"):
        if place(name) in ("geometry", "gl"):
            complaints.append(f"gnomon/gnomon.hpp brings along {name}")
    for name in headers.closure(include, "gnomon/backend/reconstruct.hpp"):
        if place(name) == "grid" or (place(name) == "filter" and name != "gnomon/filter/sample.hpp"):
            complaints.append(f"gnomon/backend/reconstruct.hpp brings along {name}")
    return complaints


headers.main(check, [
    ("gnomon/rect.hpp", "#include <gnomon/texel/half.hpp>\n", "against the arrows"),
    ("gnomon/texel/half.hpp", "#include <gnomon/grid/bit_row.hpp>\n", "against the arrows"),
    ("gnomon/filter/kernel.hpp", "#include <gnomon/receive/bias.hpp>\n", "against the arrows"),
    ("gnomon/backend/scalar.hpp", "#include <gnomon/soft_shadow_map.hpp>\n", "includes it back"),
    ("gnomon/geometry/light_frame.hpp", "# include <gnomon/soft_shadow_map.hpp>\n", "against the arrows"),
    ("gnomon/gnomon.hpp", "#include <gnomon/geometry/footprint.hpp>\n", "brings along"),
    ("gnomon/gnomon.hpp", "#include <gnomon/gl/functions.hpp>\n", "brings along"),
    ("gnomon/backend/scalar.hpp", "#include <gnomon/gl/enums.hpp>\n", "against the arrows"),
    ("gnomon/gl/functions.hpp", "#include <GL/glcorearb.h>\n", "the host owns GL"),
    ("gnomon/gl/context.hpp", "#include <epoxy/gl.h>\n", "the host owns GL"),
    ("gnomon/receive/decide.hpp", "#include <gnomon/filter/kernel.hpp>\n", "reconstruct.hpp brings along"),
    ("gnomon/texel/half.hpp", "  #  include <glm/vec3.hpp>\n", "GLM belongs"),
    ("gnomon/texel/half.hpp", '#include "channel.hpp"\n', "in quotes"),
    ("gnomon/unit.hpp", "#include <gnomon/rect.hpp>\n", "includes it back"),
    ("gnomon/texel/half.hpp", "namespace gnomon::detail {\n}\n", "without its build"),
    ("gnomon/texel/half.hpp", "namespace gnomon { inline int one() { return 1; } }\n", "without its build"),
    ("gnomon/geometry/light_frame.hpp", "#define GLM_FORCE_SWIZZLE\n", "GLM macro"),
])
