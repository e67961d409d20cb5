"""summary.py FILTER.json RECEIVE.json [--summary FILE.json]: what Google Benchmark measured, as ratios of medians of processor time.

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


WHERE = {"128": "l2", "1024": "l3", "4096": "dram"}  # where a map of that side lies on most machines


def receives(time):
    ratios = {}
    for name, of_lanes in time.items():
        what, of, size = name.split("/")
        if what in ("points", "points.avx2") and (floor := time.get(f"gather{what.removeprefix('points')}/{of}/{size}")):
            where = "" if size == "1024" else "_" + WHERE[size]
            ratios[f"receive.bilinear.{of.removesuffix('.f32')}.of_gather{where}{what.removeprefix('points')}"] = floor / of_lanes
        if what not in ("simd", "simd.avx2", "simd.sse2"):
            continue
        suffix = what.removeprefix("simd")
        for peer, called in (("copy", "of_copy"), ("scalar", "vs_scalar")):
            if theirs := time.get(f"{peer}/{of}/{size}"):
                ratios[f"receive.{of}.{called}_{WHERE[size]}{suffix}"] = theirs / of_lanes
        if theirs := time.get(f"opencv/{of}/{size}"):
            where = "" if WHERE[size] == "l2" else "_" + WHERE[size]
            ratios[f"receive.{of.removesuffix('.f32')}.vs_opencv{where}{suffix}"] = theirs / of_lanes
    return ratios


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("filter")
    parser.add_argument("receive")
    parser.add_argument("--summary", type=pathlib.Path)
    given = parser.parse_args()
    ratios = filters(medians(given.filter)) | receives(medians(given.receive))
    for name, ratio in sorted(ratios.items()):
        print(f"{name:44}{ratio:8.2f}")
    if not any("opencv" in name for name in ratios):
        print("no peers: OpenCV was not there when the benches were built")
    if given.summary:
        given.summary.write_text(json.dumps({name: round(ratio, 4) for name, ratio in sorted(ratios.items())}, indent=1) + "\n")
    return 0 if ratios else 1


if __name__ == "__main__":
    sys.exit(main())
