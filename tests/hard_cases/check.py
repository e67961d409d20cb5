"""Every hard case is a test or waits, by name, for a header that does not exist yet; never both, never neither.

    check.py TESTS INCLUDE              looks
    check.py TESTS INCLUDE --self-test  looks at copies with one fault planted each"""
import collections
import pathlib
import re
import shutil
import sys
import tempfile

CASES = """
    h01_clear_texel_is_lit h02_empty_mask_with_depth_is_lit h03_clear_is_fixed_point h04_weight_sum_cancels
    h05_negative_lobes_rejected h06_running_sum_returns_to_zero h07_casters_at_near_and_far_plane h08_receiver_out_of_range
    h09_receiver_on_caster_is_lit h10_denormals_and_ftz_same_picture h11_far_bound_keeps_order h12_mixed_far_bounds
    h13_translucent_layers_over h14_map_border_is_clear h15_sparse_equals_dense h16_mip_chain_drift h17_huge_world_offset
    h18_extreme_near_far h19_degenerate_matrix_and_w h20_vsm_variance_clamped h21_evsm_exponent_limit h22_msm_needs_bias
    h23_psm_order_through_infinity h24_slope_offset_grazing h25_plane_bias_singular h26_plane_self_shadow h27_concave_receiver
    h28_compiler_canaries""".split()

COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
TEST = re.compile(r'\bTEST_CASE(?:_TEMPLATE)?\(\s*"(h\d\d\w*)')


def tested(tests):
    """The first word of every test case that begins like a hard case."""
    return {name for file in sorted(tests.rglob("*.cpp")) for name in TEST.findall(COMMENT.sub("", file.read_text()))}


def complaints(tests, include):
    found, waiting, half = tested(tests), {}, {}
    lines = [line.split() for line in (tests / "hard_cases" / "waiting.txt").read_text().splitlines() if line and not line.startswith("#")]
    for line in lines:
        part, words = (half, line[1:]) if line[0] == "half" else (waiting, line)
        if len(words) < 3:
            yield f"waiting.txt: {' '.join(line)}: says no case, header and expectation"
            continue
        part[words[0]] = words[1]
        if (include / "gnomon" / words[1]).exists():
            yield f"{words[0]} waits for {words[1]}, which is there: write its test and take it off waiting.txt"
    listed = collections.Counter(line[1] if line[0] == "half" else line[0] for line in lines if len(line) > 1)
    for name in sorted(name for name, times in listed.items() if times > 1):
        yield f"{name} is listed twice in waiting.txt"
    for name in sorted((found | set(listed)) - set(CASES)):
        yield f"{name} is no name of a hard case"
    for name in CASES:
        if name in found and name in waiting:
            yield f"{name} is tested and waits"
        if name in half and name not in found:
            yield f"{name} is called half built, but no test says what is so now"
        if name not in found and name not in waiting and name not in half:
            yield f"{name} is neither tested nor waiting"


def plant(tests, include, file, old, new):
    """Complaints about a copy of the tests in which `old` became `new`, or which gained `new` at the end."""
    with tempfile.TemporaryDirectory() as folder:
        copy, headers = pathlib.Path(folder) / "tests", pathlib.Path(folder) / "include"
        shutil.copytree(tests, copy)
        shutil.copytree(include, headers)
        path = (headers if file.startswith("gnomon/") else copy) / file
        path.parent.mkdir(parents=True, exist_ok=True)
        text = path.read_text() if path.exists() else ""
        if old not in text:
            return []
        path.write_text(text.replace(old, new) if old else text + new)
        return list(complaints(copy, headers))


def self_test(tests, include):
    first = sorted(tested(tests))[0]
    waits = next(line for line in (tests / "hard_cases" / "waiting.txt").read_text().splitlines() if re.match(r"h\d\d", line))
    name, header = waits.split()[:2]
    here = next(f.relative_to(tests).as_posix() for f in sorted((tests / "hard_cases").glob("*.cpp")) if f'"{first}' in f.read_text())
    faults = [
        ("hard_cases/waiting.txt", waits, "", f"{name} is neither"),
        ("hard_cases/waiting.txt", "", f"\n{first} none.hpp words\n", f"{first} is tested and waits"),
        ("hard_cases/waiting.txt", "", f"\n{waits}\n", f"{name} is listed twice"),
        ("hard_cases/waiting.txt", "", "\nh29_unheard_of none.hpp words\n", "h29_unheard_of is no name"),
        ("hard_cases/waiting.txt", waits, name, "says no case, header and expectation"),
        ("hard_cases/waiting.txt", waits, f"half {waits}", f"{name} is called half built"),
        ("grid/more.cpp", "", f'TEST_CASE(\n    "{name}: by somebody else") {{}}\n', f"{name} is tested and waits"),
        ("grid/more.cpp", "", 'TEST_CASE("h17: by its number alone") {}\n', "h17 is no name"),
        (here, f'"{first}', f'"// {first}', f"{first} is neither"),
        (here, "TEST_CASE", "// TEST_CASE", f"{first} is neither"),
        (f"gnomon/{header}", "", "\n", f"{name} waits for {header}, which is there"),
    ]
    for file, old, new, words in faults:
        if not any(words in c for c in plant(tests, include, file, old, new)):
            yield f"MISSED in {file}: {old!r} -> {new!r}: {words}"


given = [pathlib.Path(a) for a in sys.argv[1:3]]
result = list((self_test if "--self-test" in sys.argv else complaints)(*given))
print("\n".join(result))
sys.exit(1 if result else 0)
