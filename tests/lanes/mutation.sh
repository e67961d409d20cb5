# Every mutant of include/, or of the headers that are named: a row a header, passed is found by a test, failed is a survivor that
# tests/mutation/survivors.txt does not explain, skipped is one that it does.
run_lane() {
    need_packages "${base_packages[@]}" clang libclang-rt-dev lld
    local began=$SECONDS status=0 name found unexplained explained seconds
    local summary=$root/build/mutation/summary.tsv

    heading "mutation: can it find nothing?"
    if python3 -B tests/mutation/self_test.py; then
        row "self test" 1 0 0 $((SECONDS - began))
    else
        row "self test" 0 1 0 $((SECONDS - began)) "so the rows below prove nothing"
    fi

    heading "mutation: every header that is asked for"
    rm -f "$summary"
    python3 -B tests/mutation/mutate.py --jobs "$jobs" "$@" || status=$?
    if [[ ! -f $summary ]]; then
        row mutants 0 1 0 $((SECONDS - began)) "did not come to an end, status $status; the next run goes on"
        return
    fi
    while IFS=$'\t' read -r name found unexplained explained seconds; do
        row "${name#gnomon/}" "$found" "$unexplained" "$explained" "$seconds"
    done <"$summary"
}
