"""The constants of gl/enums.hpp are those of Khronos' header (Debian: libgl-dev)."""
import re

import headers

ENUMS = "gnomon/gl/enums.hpp"
OTHER = {"blend_min": "GL_MIN", "blend_max": "GL_MAX", "back_face": "GL_BACK", "clockwise": "GL_CW", "counter_clockwise": "GL_CCW",
         "type_half": "GL_HALF_FLOAT"}  # the rest is the same in capitals, without type_
ELSEWHERE = {"context_lost_webgl": 0x9242}  # WebGL's


def check(include, compiler):
    lines = headers.preprocess(compiler, include, "#include <GL/glcorearb.h>\n", "-dM").splitlines()
    theirs = {w[1]: w[2] for w in (line.split(None, 2) for line in lines) if len(w) == 3 and w[1].startswith("GL_")}
    ours = re.findall(r"\b([a-z]\w*) = (0x[0-9A-Fa-f]+|[0-9]+)\b", (include / ENUMS).read_text())
    complaints = [] if len(ours) > 100 else [f"{ENUMS}: found {len(ours)} constants alone"]
    for name, value in ours:
        if name in ELSEWHERE:
            right = ELSEWHERE[name]
        else:
            khronos = OTHER.get(name, "GL_" + name.removeprefix("type_").upper())
            right = int(theirs[khronos], 0) if khronos in theirs else None
        if right != int(value, 0):
            complaints.append(f"{ENUMS}: {name} = {value}, but Khronos says {right}")
    print(f"{len(ours)} constants")
    return complaints


headers.main(check, [
    (ENUMS, "constexpr unsigned rg8 = 0x822C;\n", "rg8 = 0x822C"),
    (ENUMS, "constexpr unsigned type_short = 0x1401;\n", "type_short = 0x1401"),
    (ENUMS, "constexpr unsigned no_such_thing = 7;\n", "Khronos says None"),
])
