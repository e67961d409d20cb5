# --gl: tests/*/*_gl.cpp on every GL that can be had here, each kind in a process of its own, for Mesa has one OpenGL ES and one rasteriser
# in a process. Built by g++ -O0. Ends with what was compared, texel by texel, with the backend scalar.
gl_kinds() { # name | words of GNOMON_TEST_GL, which tests/support/gl_context.hpp explains | packages beside Mesa's
    cat <<'TABLE'
GL 4.5, GL 3.3, ES 3.2     | 4.5 3.3 es       |
ES 3.0                     | es3.0            |
ES 3.0, eight bits alone   | es3.0 eight_bits |
softpipe GL 3.3            | softpipe 3.3     |
zink GL 4.5, ES            | zink 4.5 es      | mesa-vulkan-drivers
TABLE
}

run_lane() {
    need_packages "${base_packages[@]}"
    local name words packages report=$root/build/gl/compared.tsv
    heading "configure and build"
    if ! cmake --preset quick -DGNOMON_EXAMPLES=OFF '-DGNOMON_TEST_PARTS=cases;gl' -B build/gl ||
        ! cmake --build build/gl -j "$jobs" --target gnomon_tests_gl gnomon_tests_on_gl; then
        row gl 0 1 0 "$SECONDS" "does not build"
        return
    fi
    rm -f "$report"
    gl_row "without a context" "" "$root/build/gl/tests/gnomon_tests_gl" "$report"
    while IFS='|' read -r name words packages; do
        read -ra packages <<<"$packages"
        if ((${#packages[@]})) && ! try_packages "${packages[@]}"; then
            skip "$name" "$missing_packages"
            continue
        fi
        gl_row "$(echo $name)" "$(echo $words)" "$root/build/gl/tests/gnomon_tests_on_gl" "$report"
    done < <(gl_kinds)
    compared_table "$report"
}

# gl_row NAME WORDS PROGRAM REPORT: all cases in one process; a case that says that it found no context is skipped.
gl_row() {
    heading "$1"
    local began=$SECONDS log=$root/build/gl/run.log own=$4.own cases fails skips
    rm -f "$own"
    GNOMON_TEST_GL=$2 GNOMON_GL_REPORT=$own "$3" -nv </dev/null 2>&1 | tee "$log" || true
    cases=$(sed -n 's/^\[doctest\] test cases: *\([0-9]*\) .*/\1/p' "$log")
    fails=$(sed -n 's/^\[doctest\] test cases:.*| *\([0-9]*\) failed.*/\1/p' "$log")
    skips=$(grep -c 'skipped: no GL context' "$log") || true
    if [[ -z $cases ]]; then
        row "$1" 0 1 0 $((SECONDS - began)) "ends before its tests do"
    elif ((skips == cases)); then
        row "$1" 0 "$fails" "$skips" $((SECONDS - began)) "$(sed -n 's/.*\(skipped: no GL context.*\)/\1/p' "$log" | head -n 1)"
    elif [[ -n $2 && ! -s $own ]]; then
        row "$1" 0 1 0 $((SECONDS - began)) "compared nothing"
    else
        row "$1" $((cases - fails - skips)) "$fails" "$skips" $((SECONDS - began))
    fi
    [[ ! -s $own ]] || cat "$own" >>"$4"
}

# compared_table FILE: what test::gl_report wrote there, summed up over the radii of kernels.
compared_table() {
    [[ -s $1 ]] || return 0
    printf '\n%-26s %-14s %-34s %12s %12s\n' context format pass compared differing
    awk -F'\t' '{ sub(/ R=[0-9]+$/, "", $3)
                  key = $1 "\t" $2 "\t" $3
                  if (!(key in compared)) order[++count] = key
                  compared[key] += $4; differing[key] += $5 }
        END { for (i = 1; i <= count; ++i) { split(order[i], part, "\t")
                  printf "%-26s %-14s %-34s %12d %12d\n", part[1], part[2], part[3], compared[order[i]], differing[order[i]] } }' "$1" | sort
}
