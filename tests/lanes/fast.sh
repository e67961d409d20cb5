# The lane without a name, and --quick: presets of CMakePresets.json.
run_lane() { preset_lanes quick strict asan; }

preset_lanes() {
    local packages=("${base_packages[@]}") preset began report status
    [[ $* == *quick* ]] && packages+=(libbenchmark-dev)
    [[ $* == *strict* ]] && packages+=(clang libclang-rt-dev)
    need_packages "${packages[@]}"
    for preset in "$@"; do
        heading "$preset: configure and build"
        began=$SECONDS report=$root/build/$preset/tests.xml
        rm -f "$report"
        if cmake --preset "$preset" && cmake --build --preset "$preset" -j "$jobs"; then
            heading "$preset: test"
            ctest --preset "$preset" -j "$jobs" --output-junit "$report" && status=0 || status=$?
            ctest_row "$preset" "$began" "$status" "$report"
        else
            row "$preset" 0 1 0 $((SECONDS - began)) "does not build" # counts as one failure
        fi
    done
}
