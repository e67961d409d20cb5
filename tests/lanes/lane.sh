# Sourced by tests/run: what every lane needs. A lane is a file beside this one that defines run_lane; it builds under build/,
# and says with `row` what came out. `finish` prints the table.
jobs=$(nproc)
base_packages=(g++ cmake ninja-build pkg-config python3 doctest-dev libglm-dev libcli11-dev libembree-dev libstb-dev
    libtinyobjloader-dev nlohmann-json3-dev glmark2-data qemu-user libegl1 libgl1-mesa-dri libepoxy-dev libgles-dev)

table=() passed=0 failed=0

# row NAME PASSED FAILED SKIPPED SECONDS [NOTE]: one line of the table. A row with nothing passed and nothing failed is one that was
# skipped, and its NOTE says why.
row() {
    table+=("$(printf '%-28s %8d %8d %8d %6d s  %s' "$1" "$2" "$3" "$4" "$5" "${6:-}")")
    passed=$((passed + $2)) failed=$((failed + $3))
}
skip() { row "$1" 0 0 1 0 "skipped: $2"; }

# heading TEXT: says what begins, since it may take minutes.
heading() { printf '\n== %s ==\n' "$1"; }

# junit_count WHAT REPORT: tests, failures, skipped or disabled of a junit report.
junit_count() { sed -n "s/^[[:space:]]*$1=\"\([0-9]*\)\".*/\1/p" "$2" | head -n 1; }

# ctest_row NAME SECONDS_BEFORE STATUS REPORT: the row of a ctest run that wrote a junit report.
ctest_row() {
    local tests=0 fails=0 skips=0
    if [[ -f $4 ]]; then
        tests=$(junit_count tests "$4") fails=$(junit_count failures "$4")
        skips=$(($(junit_count skipped "$4") + $(junit_count disabled "$4")))
    fi
    (($3 == 0 || fails > 0)) || fails=1 # ctest itself failed
    row "$1" $((tests - skips - (tests > 0 ? fails : 0))) "$fails" "$skips" $((SECONDS - $2))
}

finish() {
    printf '\n%-28s %8s %8s %8s %8s\n' '' passed failed skipped time
    printf '%s\n' "${table[@]}"
    printf '\n%d passed, %d failed\n' "$passed" "$failed"
    ((failed == 0 && passed > 0)) # where all was skipped, nothing is proved
}
