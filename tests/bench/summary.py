"""summary.py SUMMARY: what bench/summary.py makes of times that are known. Each ratio was worked out by hand from the times above it."""
import json
import pathlib
import subprocess
import sys
import tempfile

TIMES = {
    "filter": {
        # lanes of 512 bits and of 256, exact and fast; the better of OpenCV's two ways counts, and the lower of the two floors
        "fast/u8x2/k9/1024": 2, "fast.avx2/u8x2/k9/1024": 4, "exact/u8x2/k9/1024": 16, "exact.avx2/u8x2/k9/1024": 32,
        "blur/u8x2/k9/1024": 12, "sep/u8x2/k9/1024": 8, "copy/u8x2/k0/1024": 1, "stream/u8x2/k0/1024": 0.5,
        "work/u8x2/k9/1024": 1.5, "work.avx2/u8x2/k9/1024": 2,
        "fast/u8x2/k33/1024": 5, "blur/u8x2/k33/1024": 45, "sep/u8x2/k33/1024": 50,  # not of the mean
        "fast/f32x2/k5/1024": 8, "copy/f32x2/k0/1024": 6, "stream/f32x2/k0/1024": 7,  # nobody measured OpenCV
        "box/u8x2/k3/1024": 10, "box/u8x2/k17/1024": 15, "box/u8x2/k65/1024": 12, "boxcv/u8x2/k65/1024": 30, "boxcv/u8x2/k3/1024": 25, "box/f32x2/k17/1024": 20, "box/f32x2/k65/1024": 25, "boxcv/f32x2/k65/1024": 75,
        "box.avx2/u8x2/k3/1024": 10,
    },
    "receive": {
        "simd/u8x2.z16/128": 4, "simd.avx2/u8x2.z16/128": 5, "copy/u8x2.z16/128": 3, "scalar/u8x2.z16/128": 40,
        "simd/u8x2.z16/4096": 10, "copy/u8x2.z16/4096": 9,
        "simd/f32x2.f32/128": 2, "opencv.copied/f32x2.f32/128": 24, "opencv.multiplied/f32x2.f32/128": 30, "simd/f32x2.f32/1024": 5, "opencv.copied/f32x2.f32/1024": 28, "opencv.multiplied/f32x2.f32/1024": 20,
        "fields/u8x2.f32/128": 8, "fields.scalar/u8x2.f32/128": 24, "fields.avx2/u8x2.f32/128": 12, "simd/u8x2.f32/128": 4, "simd.avx2/u8x2.f32/128": 3,
        "points/u8x2.f32/1024": 10, "gather/u8x2.f32/1024": 7, "points.scalar/u8x2.f32/1024": 80, "points.avx2/u8x2.f32/128": 10, "gather.avx2/u8x2.f32/128": 6,
        "remap/u8x2.f32/1024": 45, "vsm/f32x2.f32/128": 3, "pcf7.avx2/f32x2.f32/128": 50,
    },
    "sparse": {"dense/u8x2/k9/1024": 100, "10pct/u8x2/k9/1024": 15, "50pct/u8x2/k9/1024": 90, "85pct/u8x2/k9/1024": 98, "empty/u8x2/k9/1024": 0.5},
    "grid": {"merge32": 3000, "scan32": 600, "mark": 500},
    "pipeline": {"copy/u8x2/k9/1024": 2, "stream/u8x2/k9/1024": 1, "receive.copy/u8x2/k9/1024": 3, "both/u8x2/k9/1024": 10},
    "threads": {f"{what}/{count}/u8x2/k9/1024/real_time": time for what, times in
                {"filter": (10, 5), "sparse": (9, 6), "receive": (8, 5), "filter.avx2": (9, 5)}.items() for count, time in zip((1, 2), times)},
    "flags": {"o2_plain/a": 10, "o3_native/a": 10, "o2_plain/b": 11, "o3_native/b": 10, "o2_plain/c": 15, "o3_native/c": 10, "o2_plain.avx2/a": 12, "o3_native.avx2/a": 10,
              "asked/a/64": 21, "unasked/a/64": 20},
    "raster": {"scalar/sun/e2/1024": 8, "simd/sun/e2/1024": 4, "scalar/lamp/e2/1024": 16, "simd/lamp/e2/1024": 2, "copy/e2/1024": 2.5},
}
for size in (256, 512, 1024, 2048, 4096):  # five cells are 2 and twenty are 8, so the mean of all is 2^2.6; of some there is none
    TIMES["filter"][f"copy/u16x2/k0/{size}"] = 2
    for taps in (3, 5, 7, 9, 13):
        TIMES["filter"] |= {f"fast/u16x2/k{taps}/{size}": 4, f"sep/u16x2/k{taps}/{size}": 8 if size == 256 else 32}
COUNTERS = {"10pct/u8x2/k9/1024": {"area": 0.125}, "50pct/u8x2/k9/1024": {"area": 0.6}, "merge32": {"calls": 10}, "scan32": {"calls": 10}, "mark": {"calls": 5},
            "simd/sun/e2/1024": {"items_per_second": 7e6}}
EXPECTED = {
    "filter.u8x2.k9.vs_opencv": 4, "filter.u8x2.k9.vs_opencv.avx2": 2, "filter.u8x2.k9.vs_opencv.exact": 0.5,
    "filter.u8x2.k9.vs_opencv.exact.avx2": 0.25, "filter.u8x2.k9.of_floor": 0.25, "filter.u8x2.k9.of_floor.avx2": 0.125,
    "filter.u8x2.k9.of_floor.exact": 0.0312, "filter.u8x2.k9.of_floor.exact.avx2": 0.0156,
    "filter.u8x2.k9.of_work": 0.75, "filter.u8x2.k9.of_work.avx2": 0.5,
    "filter.u16x2.geomean.vs_opencv": 6.0629, "filter.u16x2.k3.vs_opencv": 8, "filter.u16x2.k5.vs_opencv": 8, "filter.u16x2.k7.vs_opencv": 8,
    "filter.u16x2.k9.vs_opencv": 8, "filter.u16x2.k13.vs_opencv": 8, "filter.u16x2.k3.of_floor": 0.5, "filter.u16x2.k5.of_floor": 0.5,
    "filter.u16x2.k7.of_floor": 0.5, "filter.u16x2.k9.of_floor": 0.5, "filter.u16x2.k13.of_floor": 0.5, "filter.u8x2.k33.vs_opencv": 9, "filter.u8x2.k33.of_floor": 0.1,
    "filter.f32x2.k5.of_floor": 0.75, "filter.box.u8x2.r32.over_r1": 1.2, "filter.box.u8x2.r32.over_r1.exact": 1.2, "filter.box.u8x2.r32.vs_opencv": 2.5, "filter.box.u8x2.r1.vs_opencv": 2.5, "filter.box.u8x2.r1.vs_opencv.avx2": 2.5, "filter.box.u8x2.r32.over_r8": 0.8,
    "filter.box.f32x2.r32.over_r8": 1.25, "filter.box.f32x2.r32.vs_opencv": 3,
    "receive.u8x2.z16.of_copy_l2": 0.75, "receive.u8x2.z16.of_copy_l2.avx2": 0.6, "receive.u8x2.z16.vs_scalar_l2": 10,
    "receive.u8x2.z16.vs_scalar_l2.avx2": 8, "receive.u8x2.z16.of_copy_dram": 0.9, "receive.f32x2.vs_opencv": 12,
    "receive.f32x2.vs_opencv_copied": 12, "receive.f32x2.vs_opencv_multiplied": 15, "receive.f32x2.vs_opencv_copied_l3": 5.6,
    "receive.f32x2.vs_opencv_multiplied_l3": 4,
    "receive.points.u8x2.f32.vs_scalar_l3": 8, "receive.fields.u8x2.f32.vs_scalar_l2": 3, "receive.fields.u8x2.f32.over_rows_l2": 2,
    "receive.fields.u8x2.f32.vs_scalar_l2.avx2": 2, "receive.fields.u8x2.f32.over_rows_l2.avx2": 4,
    "receive.bilinear.u8x2.vs_remap_l3": 4.5, "receive.f32x2.vs_vsm_l2": 1.5, "raster.sun.e2.over_copy": 1.6,
    "receive.f32x2.vs_opencv_l3": 4, "receive.bilinear.u8x2.of_gather": 0.7, "receive.bilinear.u8x2.of_gather_l2.avx2": 0.6,
    "sparse.u8x2.10pct.over_ideal": 1.2, "sparse.u8x2.50pct.over_ideal": 1.5, "sparse.u8x2.85pct.of_dense": 0.98, "sparse.empty.of_dense": 0.005,
    "grid.merge32.ns": 300, "grid.scan32.ns": 60, "grid.mark.ns": 100, "grid.merge32.over_scan": 5, "pipeline.u8x2.blur_receive.over_sum_of_floors": 2.5,
    "threads2.scaling": 2, "threads2.scaling.avx2": 1.8, "threads2.sparse.scaling": 1.5, "threads2.receive.scaling": 1.6,
    "flags.o2_plain.over_o3_native": 1.1, "flags.o2_plain.over_o3_native.worst": 1.5,
    "flags.o2_plain.over_o3_native.avx2": 1.2, "flags.o2_plain.over_o3_native.worst.avx2": 1.2, "flags.asked.over_unasked.a.64": 1.05,
    "raster.sun.e2.lanes_over_scalar": 2, "raster.lamp.e2.lanes_over_scalar": 8, "raster.lanes_over_scalar": 4,
    "raster.lamp.e2.over_copy": 0.8, "raster.mtris_per_s": 7,
}


def main(summary):
    with tempfile.TemporaryDirectory() as folder:
        for bench, times in TIMES.items():
            clock, other = ("real_time", "cpu_time") if bench == "threads" else ("cpu_time", "real_time")
            runs = [{"run_name": name, "aggregate_name": aggregate, clock: time * scale, other: time * time * 7,
                     "items_per_second": 0, **COUNTERS.get(name, {})}
                    for name, time in times.items() for aggregate, scale in (("mean", 3), ("median", 1), ("stddev", 0.1))]
            pathlib.Path(folder, f"{bench}.json").write_text(json.dumps({"context": {"num_cpus": 2}, "benchmarks": runs}))
        written = pathlib.Path(folder, "written.json")
        subprocess.run([sys.executable, "-B", summary, folder, "--summary", written], check=True, stdout=subprocess.DEVNULL)
        made = json.loads(written.read_text())
    wrong = [f"{name}: {made.get(name, 'not there')}, not {EXPECTED.get(name, 'there')}"
             for name in sorted(made.keys() | EXPECTED.keys()) if made.get(name) != EXPECTED.get(name)]
    print("\n".join(wrong) or f"{len(made)} ratios")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
