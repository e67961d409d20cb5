# The lane without a name, --quick and --compilers: presets of CMakePresets.json.
run_lane() { preset_lanes quick asan; }

preset_lanes() {
    local packages=("${base_packages[@]}") preset began report status
    [[ $* == *quick* ]] && packages+=(libbenchmark-dev)
    [[ $* == *asan* || $* == *strict* ]] && packages+=(clang libclang-rt-dev)
    need_packages "${packages[@]}"
    for preset in "$@"; do
        heading "$preset: configure and build"
        began=$SECONDS report=$root/build/$preset/tests.xml
        rm -f "$report"
        if cmake --preset "$preset" && cmake --build --preset "$preset" -j "$jobs"; then
            heading "$preset: test"
            if ctest --preset "$preset" -N 2>&1 | grep RegularExpression; then # ctest goes on, and leaves out nothing
                row "$preset" 0 1 0 $((SECONDS - began)) "its filter is not understood"
                continue
            fi
            ctest --preset "$preset" -j "$jobs" --output-junit "$report" && status=0 || status=$?
            ctest_row "$preset" "$began" "$status" "$report"
        else
            row "$preset" 0 1 0 $((SECONDS - began)) "does not build" # counts as one failure
        fi
    done
}
