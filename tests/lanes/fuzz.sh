# libFuzzer on the targets of tests/fuzz, with clang 19 and its address and undefined behaviour sanitizers. Everything goes to build/fuzz.
# First the committed corpus must pass, and a copy of the library with a planted bug must not: that shows that a target can fail.
#
# What a run finds new is kept in build/fuzz/corpus/TARGET, and the next run goes on from there. To commit the best of it anew:
#   build/fuzz/TARGET -merge=1 EMPTY_FOLDER tests/fuzz/corpus/TARGET build/fuzz/corpus/TARGET
fuzz=$root/build/fuzz
planted_seconds=60

run_lane() {
    local seconds=${1:-60}
    if (($# > 1)) || [[ ! $seconds =~ ^[1-9][0-9]{0,5}$ ]]; then
        echo "tests/run: --fuzz takes a whole number of seconds, from 1 to 999999, and nothing else; 60 if none is given." >&2
        exit 2
    fi
    need_packages "${base_packages[@]}" clang-19 libclang-rt-19-dev patch
    mkdir -p "$fuzz/artifacts" "$fuzz/logs"

    local targets=() bugs=() file
    for file in tests/fuzz/*.cpp; do
        [[ $file == */replay.cpp ]] || targets+=("$(basename "$file" .cpp)") # which is the main of the fast lane
    done
    for file in tests/fuzz/bugs/*.patch; do bugs+=("$(basename "$file" .patch)"); done

    heading "fuzz: build ${#targets[@]} targets, replay their corpus"
    in_parallel corpus "${targets[@]}"
    heading "fuzz: find ${#bugs[@]} planted bugs"
    in_parallel planted_bug "${bugs[@]}"
    heading "fuzz: $seconds s for each target"
    in_parallel fuzzed "${targets[@]}"
}

# in_parallel FUNCTION ITEM...: FUNCTION ITEM for each, as many at once as there are processors. FUNCTION prints one line, the note of
# the item's row; if it fails, the row does.
in_parallel() {
    local function=$1 item began outcome note
    shift
    rm -f "$fuzz/logs/$function"-*.row
    for item in "$@"; do
        while (($(jobs -rp | wc -l) >= jobs)); do wait -n || true; done
        (
            began=$SECONDS outcome='1 0'
            note=$("$function" "$item") || outcome='0 1'
            echo "$outcome $((SECONDS - began)) $note" >"$fuzz/logs/$function-$item.row"
            printf '%-34s %s\n' "$item" "$note"
        ) &
    done
    wait
    for item in "$@"; do
        read -r passed_here failed_here took note <"$fuzz/logs/$function-$item.row" ||
            { passed_here=0 failed_here=1 took=0 note="it was cut off"; }
        [[ $item != *-* ]] || note="${item#*-}: $note"
        row "${item%%-*} ${function//_/ }" "$passed_here" "$failed_here" 0 "$took" "$note"
    done
}

# build_target TARGET OUTPUT [SOURCES]: SOURCES is where include/ and examples/ are read from.
build_target() {
    local sources=${3:-$root} more=()
    [[ $1 != input ]] || more=(-DGNOMON_FUZZ_TINYOBJ "$sources"/examples/gallery/{mesh,options}.cpp)
    clang++-19 -std=c++20 -O1 -g -fno-omit-frame-pointer -fsanitize=fuzzer,address,undefined,float-cast-overflow \
        -fno-sanitize-recover=all -I"$sources/include" -I"$sources/examples" "$root/tests/fuzz/$1.cpp" "${more[@]}" -o "$2"
}

# run_target PROGRAM LOG ARGUMENT...: true if nothing was found.
run_target() {
    "$1" -timeout=20 -rss_limit_mb=2048 -print_final_stats=1 "${@:3}" >"$2" 2>&1
}

# what_was_found LOG: the first sentence about it.
what_was_found() {
    sed -n 's/^gnomon: fuzz: this does not hold: //p; s/.*runtime error: //p; s/^==[0-9]*==ERROR: //p' "$1" | head -n 1
}

corpus() {
    local log=$fuzz/logs/corpus-$1.log
    build_target "$1" "$fuzz/$1" >"$log" 2>&1 || { echo "does not build: $log"; return 1; }
    run_target "$fuzz/$1" "$log" -runs=0 "tests/fuzz/corpus/$1" || { echo "$(what_was_found "$log"): $log"; return 1; }
    echo "$(find "tests/fuzz/corpus/$1" -type f | wc -l) files"
}

# A bug is named TARGET-WHAT.patch, and changes include/ or examples/.
planted_bug() {
    local target=${1%%-*} copy=$fuzz/bugs/$1 log=$fuzz/logs/bug-$1.log began
    rm -rf "$copy" && mkdir -p "$copy/artifacts" "$copy/corpus" && cp -R include examples "$copy"
    patch -d "$copy" -p1 --no-backup-if-mismatch -F0 <"tests/fuzz/bugs/$1.patch" >"$log" 2>&1 ||
        { echo "the patch no longer applies: renew tests/fuzz/bugs/$1.patch"; return 1; }
    build_target "$target" "$copy/$target" "$copy" >"$log" 2>&1 || { echo "does not build: $log"; return 1; }
    began=$(date +%s%N)
    if run_target "$copy/$target" "$log" -seed=1 -max_total_time=$planted_seconds -artifact_prefix="$copy/artifacts/" \
        "$copy/corpus" "tests/fuzz/corpus/$target" || ! compgen -G "$copy/artifacts/crash-*" >/dev/null; then
        echo "not found in $planted_seconds s: the target checks too little"
        return 1
    fi
    echo "found in $((($(date +%s%N) - began) / 1000000)) ms: $(what_was_found "$log")"
}

fuzzed() {
    local log=$fuzz/logs/fuzz-$1.log runs
    [[ -x $fuzz/$1 ]] || { echo "not built"; return 1; }
    mkdir -p "$fuzz/corpus/$1"
    if ! run_target "$fuzz/$1" "$log" -max_total_time="$seconds" -artifact_prefix="$fuzz/artifacts/$1-" "$fuzz/corpus/$1" \
        "tests/fuzz/corpus/$1"; then
        echo "$(what_was_found "$log"): $(sed -n 's/.*Test unit written to //p' "$log" | tail -n 1), log $log"
        return 1
    fi
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
    echo "$seconds s: $runs runs, $(sed -n 's/^stat::average_exec_per_sec: *//p' "$log") a second"
}
