# Lines, branches and MC/DC of include/ by clang 19; then the checkers that see what no comparison of results does.
run_lane() {
    if ! try_packages "${base_packages[@]}" clang-19 libclang-rt-19-dev llvm-19 valgrind; then
        skip coverage "$missing_packages"
        return
    fi
    coverage_row
    ubsan_row
    preset_row tsan gnomon_tests_threads
    uninitialised_row
    valgrind_row
}

# programs PRESET: the doctest programs that it built.
programs() {
    local program
    for program in "build/$1/tests"/gnomon_tests_*; do
        [[ -f $program && -x $program ]] && printf '%s\n' "$program"
    done
}

# build PRESET [TARGET...]: false, after a row that says so, if it does not build.
build() {
    local began=$SECONDS preset=$1
    heading "$preset: configure and build"
    cmake --preset "$preset" && cmake --build --preset "$preset" -j "$jobs" ${2:+--target "${@:2}"} && return 0
    row "$preset" 0 1 0 $((SECONDS - began)) "does not build"
    return 1
}

# Every program writes a profile of its own and is reported by itself; check.py merges, because llvm-cov drops what two programs
# compiled differently.
coverage_row() {
    local began=$SECONDS out=build/coverage/report good=0 bad=0 program name check=(python3 -B tests/coverage/check.py)
    heading "coverage: the check can fail"
    if "${check[@]}" --self-test; then good=1; else bad=1; fi
    build coverage || return 0
    heading "coverage: run"
    rm -rf "$out" && mkdir -p "$out"
    while read -r program; do
        name=$out/${program##*/}
        if LLVM_PROFILE_FILE=$name.profraw "$program" --minimal &&
            llvm-profdata-19 merge -sparse "$name.profraw" -o "$name.profdata" &&
            llvm-cov-19 export "$program" -instr-profile="$name.profdata" 2>"$name.log" >"$name.json"; then
            good=$((good + 1))
        else
            bad=$((bad + 1))
        fi
    done < <(programs coverage)
    heading "coverage: lines, functions, branches, MC/DC"
    if "${check[@]}" include tests/coverage/exclusions.txt "$out"/*.json | tee "$out/report.txt"; then
        good=$((good + 1))
    else
        bad=$((bad + 1))
    fi
    row coverage "$good" "$bad" 0 $((SECONDS - began)) "$(sed -n 's/^all  */lines /p' "$out/report.txt")"
}

# preset_row PRESET [TARGET...]: the doctest programs of a preset, all cases of one after the other.
preset_row() {
    local began=$SECONDS good=0 bad=0 program
    build "$@" || return 0
    heading "$1: run"
    while read -r program; do
        [[ $# -eq 1 || " ${*:2} " == *" ${program##*/} "* ]] || continue
        if "$program" --minimal; then good=$((good + 1)); else bad=$((bad + 1)); fi
    done < <(programs "$1")
    ((good + bad > 0)) || bad=1
    row "$1" "$good" "$bad" 0 $((SECONDS - began))
}

# No build knows that every object depends on the list of what is meant; so another list is another build.
ubsan_row() {
    local list=tests/coverage/ubsan_ignore.txt
    cmp -s "$list" build/ubsan/ignored.txt || rm -rf build/ubsan
    mkdir -p build/ubsan && cp "$list" build/ubsan/ignored.txt
    preset_row ubsan
}

uninitialised_row() {
    local began=$SECONDS program=build/uninitialised
    heading "msan: every stage on fresh memory"
    mkdir -p build
    if clang++-19 -std=c++20 -Iinclude -O1 -g1 -fno-omit-frame-pointer -fsanitize=memory -fsanitize-memory-track-origins \
        -fno-sanitize-recover=all tests/coverage/uninitialised.cpp -o "$program" && "$program"; then
        row msan 1 0 0 $((SECONDS - began))
    else
        row msan 0 1 0 $((SECONDS - began))
    fi
}

# On the programs of the coverage row, whose code is not optimised: a choice of cases, because each takes a hundred times as long.
valgrind_row() {
    local began=$SECONDS good=0 bad=0 program cases
    heading "valgrind: a choice of test cases"
    while read -r program cases; do
        if LLVM_PROFILE_FILE=/dev/null valgrind --quiet --error-exitcode=1 --leak-check=full \
            "build/coverage/tests/gnomon_tests_$program" --minimal "--test-case=$cases"; then
            good=$((good + 1))
        else
            bad=$((bad + 1))
        fi
    done <<'TEXT'
texel *image*,*view*,*span*,a clear texel*
grid *cleared*,*no depth*,*forgotten*,*without a map*,*a few words*
filter *without asserts*,*shares nothing*,*the scratch may hold*,*has to be written*,clearing*
backend *partly*off the map*,*in strips*,*past them*,receivers anywhere: every width*,results may take*,*without asserts*
threads *
TEXT
    row valgrind "$good" "$bad" 0 $((SECONDS - began))
}
