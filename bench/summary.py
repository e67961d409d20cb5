"""summary.py FOLDER [--summary FILE.json]: what Google Benchmark measured, as ratios of medians of processor time.

The table goes to stdout; FILE.json is a flat object, name -> number. A name without a backend is that of simd<>, `.avx2` of
simd<avx2>; of a filter, a name without `.exact` is the fast form."""
import argparse
import json
import math
import pathlib
import statistics
import sys

SIZES, TAPS = (256, 512, 1024, 2048, 4096), (3, 5, 7, 9, 13)


def medians(path):
    runs = json.loads(pathlib.Path(path).read_text())["benchmarks"]
    return {run["run_name"]: run["cpu_time"] for run in runs if run.get("aggregate_name") == "median"}


def filters(path):
    """Ratios of what was measured; nothing of what was not."""
    time, ratios = medians(path), {}

    def peer(of, taps, size):
        return min((time[name] for what in ("blur", "sep") if (name := f"{what}/{of}/k{taps}/{size}") in time), default=None)

    def floor(of, size):
        return min(time[name] for what in ("copy", "stream") if (name := f"{what}/{of}/k0/{size}") in time)

    for what, suffix in (("fast", ""), ("fast.avx2", ".avx2"), ("exact", ".exact"), ("exact.avx2", ".exact.avx2")):
        for of in ("u8x2", "u16x2", "f32x2"):
            logs = []
            for taps in (*TAPS, 33):
                for size in SIZES:
                    ours = time.get(f"{what}/{of}/k{taps}/{size}")
                    if ours is None:
                        continue
                    theirs = peer(of, taps, size)
                    if theirs and taps in TAPS:
                        logs.append(math.log(theirs / ours))
                    if size == 1024:
                        ratios[f"filter.{of}.k{taps}.of_floor{suffix}"] = floor(of, size) / ours
                        if theirs:
                            ratios[f"filter.{of}.k{taps}.vs_opencv{suffix}"] = theirs / ours
                        if what.startswith("fast") and (work := time.get(f"work{what.removeprefix('fast')}/{of}/k{taps}/{size}")):
                            ratios[f"filter.{of}.k{taps}.of_work{suffix}"] = work / ours
            if len(logs) == len(TAPS) * len(SIZES):
                ratios[f"filter.{of}.geomean.vs_opencv{suffix}"] = math.exp(sum(logs) / len(logs))
    for what, suffix in (("box", ""), ("box.avx2", ".avx2")):
        for of in ("u8x2", "f32x2"):
            at = {radius: time.get(f"{what}/{of}/k{2 * radius + 1}/1024") for radius in (1, 8, 32)}
            for radius in (1, 8):
                if at[radius] and at[32]:
                    ratios[f"filter.box.{of}.r32.over_r{radius}{suffix}"] = at[32] / at[radius]
            if of == "u8x2" and at[1] and at[32]:
                ratios[f"filter.box.u8x2.r32.over_r1.exact{suffix}"] = at[32] / at[1]  # a box of bytes is exact either way
            for radius in (1, 32):
                if at[radius] and (theirs := time.get(f"boxcv/{of}/k{2 * radius + 1}/1024")):
                    ratios[f"filter.box.{of}.r{radius}.vs_opencv{suffix}"] = theirs / at[radius]
    return ratios


WHERE = {"128": "l2", "1024": "l3", "4096": "dram"}  # where a map of that side lies on most machines


def receives(path):
    time, ratios = medians(path), {}
    for name, of_lanes in time.items():
        what, of, size = name.split("/")
        base, dot, lanes = what.partition(".")
        suffix, theirs = dot + lanes, time.get(f"{base}.scalar/{of}/{size}")
        if base in ("points", "fields") and lanes != "scalar" and theirs:
            ratios[f"receive.{base}.{of}.vs_scalar_{WHERE[size]}{suffix}"] = theirs / of_lanes
        if base == "points" and (floor := time.get(f"gather{suffix}/{of}/{size}")):
            where = "" if size == "1024" else "_" + WHERE[size]
            ratios[f"receive.bilinear.{of.removesuffix('.f32')}.of_gather{where}{suffix}"] = floor / of_lanes
        if base == "points" and lanes != "scalar" and (theirs := time.get(f"remap/{of}/{size}")):
            ratios[f"receive.bilinear.{of.removesuffix('.f32')}.vs_remap_{WHERE[size]}{suffix}"] = theirs / of_lanes
        if base == "fields" and (rows := time.get(f"simd{suffix}/{of}/{size}")):
            ratios[f"receive.fields.{of}.over_rows_{WHERE[size]}{suffix}"] = of_lanes / rows
        if what not in ("simd", "simd.avx2", "simd.sse2"):
            continue
        for peer, called in (("copy", "of_copy"), ("scalar", "vs_scalar")):
            if theirs := time.get(f"{peer}/{of}/{size}"):
                ratios[f"receive.{of}.{called}_{WHERE[size]}{suffix}"] = theirs / of_lanes
        for rung in ("vsm", "pcf3", "pcf5", "pcf7"):
            if theirs := time.get(f"{rung}{suffix}/{of}/{size}"):
                ratios[f"receive.{of.removesuffix('.f32')}.vs_{rung}_{WHERE[size]}{suffix}"] = theirs / of_lanes
        forms = {form: time[peer] for form in ("copied", "multiplied") if (peer := f"opencv.{form}/{of}/{size}") in time}
        for peer, theirs in forms.items() | {("opencv", min(forms.values()))} if forms else ():
            where = "" if WHERE[size] == "l2" else "_" + WHERE[size]
            called = "vs_opencv" if peer == "opencv" else f"vs_opencv_{peer}"
            ratios[f"receive.{of.removesuffix('.f32')}.{called}{where}{suffix}"] = theirs / of_lanes
    return ratios


def rasters(path):
    """Of all sizes of triangles and both lights the geometric mean; of small ones, under a sun, how many millions a second."""
    time, ratios = medians(path), {}
    rate = {run["run_name"]: run["items_per_second"] for run in json.loads(pathlib.Path(path).read_text())["benchmarks"]
            if run.get("aggregate_name") == "median"}
    for what, suffix in (("simd", ""), ("simd.avx2", ".avx2"), ("simd.sse2", ".sse2")):
        logs = []
        for name in time:
            mine, *rest = name.split("/")
            if mine != what:
                continue
            light, edge, size = rest
            over = time[f"scalar/{light}/{edge}/{size}"] / time[name]
            ratios[f"raster.{light}.{edge}.lanes_over_scalar{suffix}"] = over
            logs.append(math.log(over))
            if floor := time.get(f"copy/{edge}/{size}"):
                ratios[f"raster.{light}.{edge}.over_copy{suffix}"] = time[name] / floor
        if logs:
            ratios[f"raster.lanes_over_scalar{suffix}"] = math.exp(sum(logs) / len(logs))
            ratios[f"raster.mtris_per_s{suffix}"] = rate[f"{what}/sun/e2/1024"] / 1e6
    return ratios


def sparses(path):
    """Time over what the same area costs in a map that is filtered whole."""
    time, ratios = medians(path), {}
    area = {run["run_name"]: run["area"] for run in json.loads(pathlib.Path(path).read_text())["benchmarks"]
            if "area" in run and run.get("aggregate_name") == "median"}
    of = "/u8x2/k9/1024"
    for suffix in ("", ".avx2"):
        dense = time.get(f"dense{suffix}{of}")
        if dense is None:
            continue
        for share in ("10pct", "50pct"):
            ideal = dense * area[f"{share}{suffix}{of}"]
            ratios[f"sparse.u8x2.{share}.over_ideal{suffix}"] = time[f"{share}{suffix}{of}"] / ideal
        if parts := time.get(f"85pct{suffix}{of}"):
            ratios[f"sparse.u8x2.85pct.of_dense{suffix}"] = parts / dense
        ratios[f"sparse.empty.of_dense{suffix}"] = time[f"empty{suffix}{of}"] / dense
    return ratios


def grids(path):
    """Nanoseconds, of the whole grid and of each mark, question and clearing; and how many scans of its bare rows those of the grid are."""
    runs = json.loads(pathlib.Path(path).read_text())["benchmarks"]
    time = {run["run_name"]: run["cpu_time"] / run["calls"] for run in runs if run.get("aggregate_name") == "median"}
    over = {f"grid.{name}.over_scan": time[name] / time["scan32"] for name in time
            if "scan32" in time and name.endswith("32") and name != "scan32"}
    return {f"grid.{name}.ns": ns for name, ns in time.items()} | over


def pipelines(path):
    time, of = medians(path), "/u8x2/k9/1024"
    floors = min(time[name + of] for name in ("copy", "stream") if name + of in time) + time["receive.copy" + of]
    return {f"pipeline.u8x2.blur_receive.over_sum_of_floors{suffix}": time[f"both{suffix}{of}"] / floors
            for suffix in ("", ".avx2") if f"both{suffix}{of}" in time}


def threads(path):
    """By the clock on the wall. Where there is one processor there is no number."""
    file = json.loads(pathlib.Path(path).read_text())
    runs = file["benchmarks"] if file["context"]["num_cpus"] > 1 else []
    time = {run["run_name"]: run["real_time"] for run in runs if run.get("aggregate_name") == "median"}
    of = "u8x2/k9/1024/real_time"
    return {("threads2" if what == "filter" else f"threads2.{what}") + f".scaling{suffix}":
            time[f"{what}{suffix}/1/{of}"] / time[f"{what}{suffix}/2/{of}"]
            for what in ("filter", "sparse", "receive") for suffix in ("", ".avx2") if f"{what}{suffix}/1/{of}" in time}


def flags(path):
    """What a build without flags takes longer than one with all of them, the median over its kernels; and what asking costs."""
    time, ratios = medians(path), {}
    for suffix in ("", ".avx2"):
        plain = [ours / native for name, ours in time.items() for what, kernel in [name.split("/", 1)]
                 if what == f"o2_plain{suffix}" and (native := time.get(f"o3_native{suffix}/{kernel}"))]
        if plain:
            ratios[f"flags.o2_plain.over_o3_native{suffix}"] = statistics.median(plain)
            ratios[f"flags.o2_plain.over_o3_native.worst{suffix}"] = max(plain)
    for name, asked in time.items():
        what, kernel, *_ = name.split("/")
        if what == "asked":
            ratios[f"flags.asked.over_unasked.{kernel}.64"] = asked / time[f"unasked/{kernel}/64"]
    return ratios


GL_PEERS = ("plain.k9", "rg8.k9.sampled", "pcf2x2", "pcf3x3", "pcf5x5", "vsm", "vsm.casters_only", "evsm4", "evsm4.casters_only")
GL_ERRORS = ("rmse_ground", "rmse_own", "rmse_platform", "leak", "dark")


def on_gl(path):
    """By the clock on the wall, of_X being time over that of X. Names of maps of 512 texels a side end so; others have 1024."""
    runs = [run for run in json.loads(pathlib.Path(path).read_text())["benchmarks"] if run.get("aggregate_name") == "median"]
    by_name = {run["run_name"].removesuffix("/manual_time"): run for run in runs}
    time, ratios = {name: run["real_time"] for name, run in by_name.items()}, {}

    def over(name, ours, theirs):
        if ours in time and theirs in time:
            ratios[f"gl.{name}"] = time[ours] / time[theirs]

    for name in time:
        what, of, *rest = name.split("/")
        size = name.rpartition("/")[2]
        suffix = "" if size == "1024" else f".{size}"
        dense = f"frame/rg8.k9.dense/{size}"
        if what == "filter":
            taps, which = rest[:2]
            if which != "dense":
                over(f"filter.{of}.{taps}.{which}.of_dense", name, f"filter/{of}/{taps}/dense/1024")
            else:
                over(f"filter.{of}.{taps}.dense.of_rg8_k9", name, "filter/rg8/k9/dense/1024")
        elif what in ("cast", "mask"):
            over(f"{what}.{of}.of_rg8", name, f"{what}/rg8/1024")
        elif what == "frame":
            over(f"frame.{of}.of_rg8_dense{suffix}", name, dense)
            for peer in GL_PEERS if of in ("rg8.k9", "rg8.k9.dense") else ():
                over(f"frame.{of}.vs_{peer}{suffix}", f"frame/{peer}/{size}", name)
            ratios[f"gl.frame.{of}.filtered{suffix}"] = by_name[name]["filtered"]
            for error in GL_ERRORS:
                ratios[f"gl.error.{of}.{error}{suffix}"] = by_name[name][error]
        else:
            over(f"{what}.{of}.of_rg8_dense_frame{suffix}", name, dense)
    return ratios


def gl_table(ratios):
    """What a person asks of them first: time, the passes' shares of it and the errors of each technique at 1024 texels a side."""
    order = {name.removeprefix("gl.frame.").removesuffix(".of_rg8_dense"): ratio for name, ratio in ratios.items()
             if name.startswith("gl.frame.") and name.endswith(".of_rg8_dense")}
    if order:
        print(f"{'a frame on GL; rg8.k9.dense = 1':32}   frame casters   blur receive  rmse: ground    own platform    leak    dark")
    for name, frame in sorted(order.items(), key=lambda item: item[1]):
        passes = [ratios.get(f"gl.{what}.{name}.of_rg8_dense_frame", 0.0) for what in ("casters", "blur", "receive")]
        errors = [ratios[f"gl.error.{name}.{what}"] for what in GL_ERRORS]
        print(f"{name:32}{frame:8.2f}{passes[0]:8.2f}{passes[1]:7.2f}{passes[2]:8.2f}" +
              f"{errors[0]:14.4f}{errors[1]:7.4f}{errors[2]:9.4f}{errors[3]:8.4f}{errors[4]:8.4f}")


MEASURED = {"filter": filters, "receive": receives, "sparse": sparses, "grid": grids, "pipeline": pipelines, "threads": threads,
            "raster": rasters, "flags": flags, "gl": on_gl}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, help="where bench/run left NAME.json of each bench")
    parser.add_argument("--summary", type=pathlib.Path)
    given = parser.parse_args()
    ratios = {}
    for name, ratios_of in MEASURED.items():
        if not (path := given.folder / f"{name}.json").exists():
            continue
        try:
            ratios |= ratios_of(path)
        except json.JSONDecodeError:
            print(f"left out: {path} was not written to its end", file=sys.stderr)
    for name, ratio in sorted(ratios.items()):
        print(f"{name:52}{ratio:8.3g}")
    gl_table(ratios)
    if not any("opencv" in name for name in ratios):
        print("no peers: OpenCV was not there when the benches were built")
    if given.summary:
        written = given.summary.with_name(given.summary.name + ".part")
        written.write_text(json.dumps({name: round(ratio, 4) for name, ratio in sorted(ratios.items())}, indent=1) + "\n")
        written.replace(given.summary)
    return 0 if ratios else 1


if __name__ == "__main__":
    sys.exit(main())
