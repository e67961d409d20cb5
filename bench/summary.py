"""summary.py FILTER.json RECEIVE.json [--sparse, --grid, --pipeline, --threads FILE.json] [--summary FILE.json]: what Google Benchmark measured, as ratios of medians of processor time.

The table goes to stdout; FILE.json is a flat object, name -> number. A name without a backend is that of simd<>, `.avx2` of
simd<avx2>; of a filter, a name without `.exact` is the fast form."""
import argparse
import json
import math
import pathlib
import sys

SIZES, TAPS = (256, 512, 1024, 2048, 4096), (3, 5, 7, 9, 13)


def medians(path):
    runs = json.loads(pathlib.Path(path).read_text())["benchmarks"]
    return {run["run_name"]: run["cpu_time"] for run in runs if run.get("aggregate_name") == "median"}


def filters(time):
    """Ratios of what was measured; nothing of what was not."""
    ratios = {}

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
            if logs:
                ratios[f"filter.{of}.geomean.vs_opencv{suffix}"] = math.exp(sum(logs) / len(logs))
    return ratios


def receives(time):
    ratios = {}
    for name, floor in time.items():
        what, of, size = name.split("/")
        if what != "copy":
            continue
        where = {"128": "l2", "1024": "beyond"}.get(size, size)
        for mine, suffix in (("simd", ""), ("simd.avx2", ".avx2"), ("simd.sse2", ".sse2")):
            if ours := time.get(f"{mine}/{of}/{size}"):
                ratios[f"receive.{of}.f32.of_copy_{where}{suffix}"] = floor / ours
                ratios[f"receive.{of}.f32.vs_scalar_{where}{suffix}"] = time[f"scalar/{of}/{size}"] / ours
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
        ratios[f"sparse.empty.of_dense{suffix}"] = time[f"empty{suffix}{of}"] / dense
    return ratios


def grids(path):
    """Nanoseconds, not ratios: of the whole grid, and of each mark, question and clearing."""
    runs = json.loads(pathlib.Path(path).read_text())["benchmarks"]
    return {f"grid.{run['run_name']}.ns": run["cpu_time"] / run["calls"] for run in runs if run.get("aggregate_name") == "median"}


def pipelines(path):
    time, of = medians(path), "/u8x2/k9/1024"
    floors = min(time[name + of] for name in ("copy", "stream") if name + of in time) + time["receive.copy" + of]
    return {f"pipeline.u8x2.blur_receive.over_sum_of_floors{suffix}": time[f"both{suffix}{of}"] / floors
            for suffix in ("", ".avx2") if f"both{suffix}{of}" in time}


def threads(path):
    """By the clock on the wall. Where there is one processor, no number tells anything."""
    runs = json.loads(pathlib.Path(path).read_text())["benchmarks"]
    time = {run["run_name"]: run["real_time"] for run in runs if run.get("aggregate_name") == "median"}
    of = "u8x2/k9/1024/real_time"
    return {("threads2.scaling" if what == "filter" else f"threads2.{what}.scaling"): time[f"{what}/1/{of}"] / time[f"{what}/2/{of}"]
            for what in ("filter", "sparse", "receive")}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("filter")
    parser.add_argument("receive")
    others = {"sparse": sparses, "grid": grids, "pipeline": pipelines, "threads": threads}
    for name in others:
        parser.add_argument(f"--{name}")
    parser.add_argument("--summary", type=pathlib.Path)
    given = parser.parse_args()
    ratios = filters(medians(given.filter)) | receives(medians(given.receive))
    for name, ratios_of in others.items():
        if path := getattr(given, name):
            ratios |= ratios_of(path)
    for name, ratio in sorted(ratios.items()):
        print(f"{name:44}{ratio:8.2f}")
    if not any("opencv" in name for name in ratios):
        print("no peers: OpenCV was not there when the benches were built")
    if given.summary:
        given.summary.write_text(json.dumps({name: round(ratio, 4) for name, ratio in sorted(ratios.items())}, indent=1) + "\n")
    return 0 if ratios else 1


if __name__ == "__main__":
    sys.exit(main())
