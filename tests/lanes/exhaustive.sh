# --exhaustive: the test cases that visit a whole domain. They live beside their quick versions, are skipped there, and have names
# that begin with "exhaustive". One at a time, for each uses all processors; built by g++ -O2 for any x86-64, from the files that hold
# such cases alone.
run_lane() {
    local limit=${1-}
    [[ $# -le 1 && $limit =~ ^([1-9][0-9]{0,5})?$ ]] || { echo "tests/run: --exhaustive takes a whole number of seconds from 1 on, not '$*'." >&2; exit 2; }
    need_packages "${base_packages[@]}"
    local folders folder names name
    folders=$(grep -l '"exhaustive: ' tests/*/*.cpp | cut -d / -f 2 | sort -u)
    heading "configure and build"
    if ! cmake --preset quick -DGNOMON_EXAMPLES=OFF -DGNOMON_TEST_PARTS=cases -DGNOMON_TEST_FLAGS=-DGNOMON_EXHAUSTIVE \
        -DGNOMON_EXHAUSTIVE=ON -DCMAKE_CXX_FLAGS_RELEASE='-O2 -DNDEBUG' -B build/exhaustive ||
        ! cmake --build build/exhaustive -j "$jobs" --target $(printf 'gnomon_tests_%s ' $folders); then
        row exhaustive 0 1 0 "$SECONDS" "does not build"
        return
    fi
    local first=$SECONDS # of the scans, so that one always begins
    for folder in $folders; do
        if ! names=$("build/exhaustive/tests/gnomon_tests_$folder" -ltc -ns -tc='exhaustive*' | grep '^exhaustive'); then
            row "$folder" 0 1 0 0 "names no exhaustive case"
            continue
        fi
        while read -r name; do
            if [[ $limit ]] && ((SECONDS - first >= limit)); then
                skip "$folder" "$limit s are over: ${name#exhaustive: }"
            else
                scan_row "$folder" "$name"
            fi
        done <<<"$names"
    done
}

# scan_row FOLDER NAME: runs one test case; what it says of its progress is shown, and the last of it, "N cases", is noted.
scan_row() {
    heading "$1: $2"
    local began=$SECONDS log=build/exhaustive/scan.log status=0 cases
    "build/exhaustive/tests/gnomon_tests_$1" -ns -tc="${2//,/\\,}" 2>&1 | tee "$log" || status=1
    grep -q 'test cases: 1 | 1 passed' <(tr -s ' ' <"$log") || status=1 # a name that is not found passes nothing
    cases=$(sed -n 's/^\([0-9]*\) cases$/\1/p' "$log" | tail -n 1)
    row "$1" $((1 - status)) "$status" 0 $((SECONDS - began)) "${cases:-no} cases: ${2#exhaustive: }"
}
