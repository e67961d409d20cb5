# --matrix [ROW...]: the same bits from every compiler, level of optimisation, standard library and processor.
#
# A row builds tests/golden with one toolchain, runs it, and holds every line that it prints against tests/data/golden.txt: passed is
# the lines that are equal. Its note is what tests/golden/canary.cpp finds that the compiler does to numbers, with the same flags.
# tests/golden/geometry.cpp alone is compiled with -ffp-contract=off, and says why. Below the compilers come rows of another kind.
. "$root/tests/lanes/bochs.sh"
golden=$root/tests/golden
golden_parts=(texel facade filter receive geometry grid lanes main)

# name | what it adds | packages | what this processor must have | compiler and flags | what runs the program
em_flags='-Wno-unused-command-line-argument -sSINGLE_FILE=1 -include tests/golden/std_bit_cast.hpp'
toolchain_rows() {
    cat <<TABLE
gcc-O0          | g++, not optimised              | g++                                      |         | g++ -O0                                            |
gcc-O1          | g++                             | g++                                      |         | g++ -O1                                            |
gcc-O2          | g++, which drops roundings here | g++                                      |         | g++ -O2                                            |
gcc-O3          | g++, which drops roundings here | g++                                      |         | g++ -O3                                            |
gcc-v3          | AVX2 and fused multiply-adds    | g++                                      | avx2    | g++ -O3 -march=x86-64-v3                           |
gcc-v4          | AVX-512                         | g++                                      | avx512f | g++ -O3 -march=x86-64-v4                           |
gcc-fma         | multiply-adds fused, -O2        | g++                                      | fma     | g++ -O2 -mfma -ffp-contract=fast                   |
gcc-native      | this processor, fused           | g++                                      | fma     | g++ -O3 -march=native -ffp-contract=fast           |
clang-O0        | clang 14, not optimised         | clang g++                                |         | clang++ -O0                                        |
clang-O2        | clang 14                        | clang g++                                |         | clang++ -O2                                        |
clang-O3        | clang 14                        | clang g++                                |         | clang++ -O3                                        |
clang-fma       | multiply-adds fused             | clang g++                                | fma     | clang++ -O3 -mavx2 -mfma -ffp-contract=fast        |
clang19-O0      | clang 19, not optimised         | clang-19 g++                             |         | clang++-19 -O0                                     |
clang19-O2      | clang 19                        | clang-19 g++                             |         | clang++-19 -O2                                     |
clang19-O3      | clang 19                        | clang-19 g++                             |         | clang++-19 -O3                                     |
clang19-v3      | AVX2, fused                     | clang-19 g++                             | avx2    | clang++-19 -O3 -march=x86-64-v3 -ffp-contract=fast |
clang19-v4      | AVX-512, fused                  | clang-19 g++                             | avx512f | clang++-19 -O3 -march=x86-64-v4 -ffp-contract=fast |
clang19-libc++  | another standard library        | clang-19 libc++-19-dev libc++abi-19-dev  |         | clang++-19 -O2 -stdlib=libc++                      |
nehalem         | a processor without AVX         | g++ qemu-user                            |         | g++ -O2                                            | qemu-x86_64 -cpu Nehalem
haswell         | AVX2 and FMA, emulated          | g++ qemu-user                            |         | g++ -O3 -march=x86-64-v3                           | qemu-x86_64 -cpu Haswell
aarch64-gcc     | 64-bit ARM, fuses by default    | g++-aarch64-linux-gnu qemu-user          |         | aarch64-linux-gnu-g++ -O3                          | qemu-aarch64 -L /usr/aarch64-linux-gnu
aarch64-clang19 | 64-bit ARM                      | clang-19 g++-aarch64-linux-gnu qemu-user |         | clang++-19 --target=aarch64-linux-gnu -O2          | qemu-aarch64 -L /usr/aarch64-linux-gnu
s390x-gcc       | big-endian, fuses by default    | g++-s390x-linux-gnu qemu-user            |         | s390x-linux-gnu-g++ -O2                            | qemu-s390x -L /usr/s390x-linux-gnu
wasm            | WebAssembly under node          | emscripten                               |         | em++ -O1 $em_flags                                 | node
wasm-simd       | its vectors                     | emscripten                               |         | em++ -O3 -msimd128 $em_flags                       | node
mingw           | Windows under wine              | g++-mingw-w64-x86-64-posix wine64        |         | x86_64-w64-mingw32-g++-posix -O2 -static           | run_in_wine
TABLE
}

# name | what it does; each is a function of its own below.
other_rows() {
    cat <<'TABLE'
geometry-fused   | geometry/ with fused multiply-adds: the lines called exact must not change
fast-math        | what -ffast-math is made of must be refused; and what it would change
can-fail         | four copies of the library, each with one thing broken: a line must change
tests-nehalem    | the tests of simd/ and backend/ themselves on a processor without AVX
tests-haswell    | and on one with AVX2
tests-aarch64    | those of texel/, filter/, receive/, simd/ and backend/ on 64-bit ARM
tests-s390x      | those of texel/, filter/ and receive/ on a big-endian processor
tests-wasm       | those of simd/ and backend/ in WebAssembly, with its vectors
tests-avx512     | and with AVX-512, on a machine that is emulated whole: half an hour
TABLE
}

# What continuous integration runs, the first first: one of a kind, without the packages that take longest.
quick_rows=(can-fail gcc-fma s390x-gcc clang-fma nehalem)

run_lane() {
    local names name wanted=("$@")
    mapfile -t names < <({ toolchain_rows; other_rows; } | sed 's/ *|.*//')
    case ${1:-} in
        list) { toolchain_rows; other_rows; } | awk -F' *[|] *' '{ printf "%-16s %s\n", $1, $2 }'
            printf '%-16s %s\n' quick "${quick_rows[*]}"
            exit 0 ;;
        quick) wanted=("${quick_rows[@]}" "${@:2}") ;;
        '') wanted=("${names[@]}") ;;
    esac
    for name in "${wanted[@]}"; do
        [[ " ${names[*]} " == *" $name "* ]] ||
            { echo "tests/run: --matrix has no row '$name'; --matrix list names them." >&2; exit 2; }
    done

    need_packages g++ libglm-dev
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
    mkdir "$work/glm"
    ln -s /usr/include/glm /usr/include/doctest "$work/glm" # all of /usr/include would be the wrong one for a cross compiler
    grep -v '^#' "$root/tests/data/golden.txt" >"$work/expected"
    for name in "${wanted[@]}"; do
        heading "$name"
        if declare -F "row_${name//-/_}" >/dev/null; then "row_${name//-/_}" "$name"; else toolchain_row "$name"; fi
        printf '%s\n' "${table[-1]}" # the table itself is minutes away
    done
}

# --- rows that are toolchains ---------------------------------------------------------------------------------------------------
toolchain_row() {
    local name=$1 began=$SECONDS packages needs compiler run note
    local -x NODE_PATH=/usr/share/nodejs # where Debian's em++ finds what its linker is written with, whichever node runs it
    IFS='|' read -r _ _ packages needs compiler run < <(toolchain_rows | grep "^$name ")
    read -ra packages <<<"$packages"
    read -ra needs <<<"$needs"
    read -ra compiler <<<"$compiler"
    read -ra run <<<"$run"
    can_run "$name" "${needs[*]}" "${compiler[0]}" "${packages[@]}" || return 0
    if ! build_golden "$name" "$root/include" "${compiler[@]}"; then
        row "$name" 0 1 0 $((SECONDS - began)) "does not build"
        return
    fi
    "${compiler[@]}" -std=c++20 "$golden/canary.cpp" -o "$(program canary "${compiler[0]}")" || true
    note=$("${run[@]}" "$(program canary "${compiler[0]}")" | tr -d '\r') || note="the canary does not run"
    "${run[@]}" "$(program "$name" "${compiler[0]}")" | tr -d '\r' >"$work/printed" || echo "$name: the program fails" >&2
    golden_row "$name" "$began" "$work/expected" "$note"
    [[ ! -d $work/wine ]] || stop_wine
}

# can_run NAME PROCESSOR_FLAG COMPILER PACKAGE...: false, with a row that says why, if this row cannot run here.
can_run() {
    if [[ -n $2 ]] && ! grep -qw "$2" /proc/cpuinfo; then
        skip "$1" "this processor has no $2"
    elif ! try_packages "${@:4}"; then
        skip "$1" "$missing_packages"
    elif ! command -v "$3" >/dev/null; then
        skip "$1" "there is no $3"
    else
        return 0
    fi
    return 1
}

# program NAME COMPILER: the file that a compiler links; em++ goes by the ending, and Windows wants its own.
program() {
    local ending=.exe
    [[ $2 == em++ ]] && ending=.js
    printf '%s' "$work/$1$ending"
}

# build_golden NAME INCLUDE COMPILER...: the golden program, its parts in parallel.
geometry_flags=-ffp-contract=off
build_golden() {
    local out=$work/$1.parts include=$2 compiler=("${@:3}")
    rm -rf "$out" && mkdir "$out"
    compile_parts "$out" "$include" "${golden_parts[*]}" "${compiler[@]}" &&
        "${compiler[@]}" "$out"/*.o -o "$(program "$1" "${compiler[0]}")"
}
compile_parts() {
    local out=$1 include=$2 part
    for part in $3; do
        if [[ $part == geometry ]]; then echo "$part $geometry_flags"; else echo "$part"; fi
    done | xargs -P "$jobs" -L 1 bash -c 'golden=$1 out=$2 include=$3 glm=$4 count=$5; shift 5
        compiler=("${@:1:count}") part=("${@:count+1}")
        "${compiler[@]}" -std=c++20 -I "$include" -isystem "$glm" "${part[@]:1}" -c "$golden/${part[0]}.cpp" -o "$out/${part[0]}.o"' \
        compile "$golden" "$out" "$include" "$work/glm" "$(($# - 3))" "${@:4}"
}

# golden_row NAME SECONDS_BEFORE EXPECTED NOTE: the row of what is in $work/printed.
golden_row() {
    local all equal
    all=$(wc -l <"$3")
    equal=$(grep -cxFf "$3" "$work/printed" || true)
    diff "$3" "$work/printed" || true
    cmp -s "$3" "$work/printed" || ((equal < all)) || equal=$((all - 1)) # lines too many
    row "$1" "$equal" $((all - equal)) 0 $((SECONDS - $2)) "$4"
}

# Wine with a prefix of its own, of 700 MB, that does not outlive the row.
wine=/usr/lib/wine/wine64 # Debian's wine64 has no launcher on the PATH
run_in_wine() { WINEPREFIX=$work/wine WINEDEBUG=-all "$wine" "$@" 2>"$work/wine.log"; }
stop_wine() {
    WINEPREFIX=$work/wine "${wine%64}server64" -k || true
    rm -rf "$work/wine"
}

# --- rows of another kind ---------------------------------------------------------------------------------------------------------
row_geometry_fused() {
    local began=$SECONDS compiler=(g++ -O3 -march=native -ffp-contract=fast) changed
    can_run "$1" fma g++ g++ || return 0
    mkdir -p "$work/fused"
    if geometry_flags=-ffp-contract=fast compile_parts "$work/fused" "$root/include" geometry "${compiler[@]}" &&
        one_part geometry "$work/fused/geometry.o" "${compiler[@]}"; then
        changed=$(grep -vxFf "$work/expected" "$work/printed" | grep ' rounded ' | cut -d' ' -f1 | tr '\n' ' ' || true)
        grep ' geometry exact ' "$work/printed" >"$work/exact.printed"
        mv "$work/exact.printed" "$work/printed"
        grep ' geometry exact ' "$work/expected" >"$work/exact"
        golden_row "$1" "$began" "$work/exact" "of the lines called rounded it changes: ${changed:-none}"
    else
        row "$1" 0 1 0 $((SECONDS - began)) "does not build"
    fi
}

# one_part PART OBJECT COMPILER...: links one part of the golden program alone, and runs it into $work/printed.
one_part() {
    echo "namespace golden { void print_$1(); } int main() { golden::print_$1(); }" >"$work/one.cpp"
    "${@:3}" -std=c++20 "$work/one.cpp" "$2" -o "$work/one.exe" && "$work/one.exe" >"$work/printed"
}

row_fast_math() {
    local began=$SECONDS compiler flag said refused=0 accepted=0 changed
    can_run "$1" '' g++ g++ || return 0
    for compiler in g++ clang++ clang++-19; do
        command -v "$compiler" >/dev/null || continue
        for flag in -ffast-math -ffinite-math-only -fno-signed-zeros -freciprocal-math -funsafe-math-optimizations; do
            [[ $compiler == g++ || $flag =~ fast|finite ]] || continue # clang tells nobody of the others
            said=$("$compiler" -std=c++20 "$flag" -I "$root/include" -fsyntax-only -x c++ - <<<'#include <gnomon/unit.hpp>' 2>&1 || true)
            if [[ $said == *error:*'gnomon: -ffast-math'* ]]; then
                refused=$((refused + 1))
            else
                echo "$compiler $flag is not refused"
                accepted=$((accepted + 1))
            fi
        done
    done
    changed="does not build"
    if build_golden "$1" "$root/include" g++ -O3 -march=native -ffast-math -DGNOMON_ALLOW_FAST_MATH; then
        "$(program "$1" g++)" >"$work/printed" || true
        echo "allowed, it changes lines of"
        { grep -vxFf "$work/expected" "$work/printed" || true; } | cut -d' ' -f1 | uniq -c
        changed=$(grep -cvxFf "$work/expected" "$work/printed" || true)
    fi
    row "$1" "$refused" "$accepted" 0 $((SECONDS - began)) "allowed, it would change $changed of $(wc -l <"$work/expected") lines"
}

# Breaks a copy of the library, and wants the part of the golden program that looks at it to print something else. The first two are
# what keeps compilers from changing numbers; where g++ does not drop the rounding of a pair the first cannot be seen, and is left out.
row_can_fail() {
    local began=$SECONDS caught=0 missed=0 part header change compiler=(g++ -O2)
    can_run "$1" '' g++ g++ || return 0
    "${compiler[@]}" -std=c++20 "$golden/canary.cpp" -o "$work/canary.exe"
    while IFS='|' read -r part header change; do
        [[ $change != *0.0f* ]] || "$work/canary.exe" | grep -q DROPS || continue
        rm -rf "$work/broken" "$work/broken.parts" && mkdir "$work/broken.parts" && cp -r "$root/include" "$work/broken"
        sed -i "$change" "$work/broken/gnomon/$header"
        if ! cmp -s "$work/broken/gnomon/$header" "$root/include/gnomon/$header" &&
            compile_parts "$work/broken.parts" "$work/broken" "$part" "${compiler[@]}" &&
            one_part "$part" "$work/broken.parts/$part.o" "${compiler[@]}" && grep -vxFf "$work/expected" "$work/printed"; then
            caught=$((caught + 1))
        else
            echo "not caught: $header with $change"
            missed=$((missed + 1))
        fi
    done <<'TABLE'
texel|texel/channel.hpp|s/static_cast<float>(code) + 0.0f/static_cast<float>(code)/
filter|filter/separable.hpp|s/return to_bits<36>(sum);/return sum;/
texel|texel/half.hpp|s/rest == tie && (kept & 1) != 0/rest == tie/
receive|texel/depth_mask.hpp|s/return select(.*/return e > m * (Real(1) - z);/
TABLE
    row "$1" "$caught" "$missed" 0 $((SECONDS - began)) "broken copies of the library that turned a line red"
}

row_tests_nehalem() { test_row "$1" "simd backend" "g++ qemu-user" "g++ -O1" "qemu-x86_64 -cpu Nehalem"; }
row_tests_haswell() { test_row "$1" "simd backend" "g++ qemu-user" "g++ -O1" "qemu-x86_64 -cpu Haswell"; }
row_tests_aarch64() {
    test_row "$1" "texel filter receive simd backend" "g++-aarch64-linux-gnu qemu-user" "aarch64-linux-gnu-g++ -O2" "qemu-aarch64 -L /usr/aarch64-linux-gnu"
}
row_tests_s390x() {
    test_row "$1" "texel filter receive" "g++-s390x-linux-gnu qemu-user" "s390x-linux-gnu-g++ -O1" "qemu-s390x -L /usr/s390x-linux-gnu"
}
row_tests_wasm() {
    local -x NODE_PATH=/usr/share/nodejs
    test_row "$1" "simd backend" emscripten "em++ -O1 -msimd128 -sALLOW_MEMORY_GROWTH=1 $em_flags" node
}

# Bochs 2.7 rounds a float that lies between two subnormal halves away from zero: what stores halves is left out.
row_tests_avx512() {
    can_run "$1" '' g++ g++ "${bochs_packages[@]}" || return 0
    bochs_kernel || { skip "$1" "cannot download the kernel that Bochs boots: $(tail -n 1 "$work/bochs/log")"; return 0; }
    test_row "$1" "simd backend" g++ "g++ -O1 -static -DGNOMON_TEST_ONE_ISA=gnomon::avx512 -DGNOMON_TEST_IT_IS_THERE" run_in_bochs \
        '*16f>*,codes are stored rounded down*'
}

# test_row NAME FOLDERS PACKAGES COMPILER RUN [TESTS]: passed and failed are test cases. Those of millions of pairs take minutes, and are
# left out, as are TESTS.
test_row() {
    local began=$SECONDS name=$1 folders packages compiler run file count binary
    read -ra folders <<<"$2"
    read -ra packages <<<"$3"
    read -ra compiler <<<"$4"
    read -ra run <<<"$5"
    can_run "$name" '' "${compiler[0]}" "${packages[@]}" doctest-dev || return 0
    binary=$(program "$name" "${compiler[0]}")
    mkdir -p "$work/$name"
    for file in main "${folders[@]/%//*}"; do printf '%s\n' "$root"/tests/$file.cpp; done |
        xargs -P "$jobs" -I {} bash -c 'file=$1 root=$2 glm=$3 out=$4; shift 4
            name=${file#"$root/tests/"}
            "$@" -std=c++20 -I "$root/include" -isystem "$glm" -c "$file" -o "$out/${name//\//.}.o"' \
            compile {} "$root" "$work/glm" "$work/$name" "${compiler[@]}" &&
        "${compiler[@]}" "$work/$name"/*.o -o "$binary" ||
        { row "$name" 0 1 0 $((SECONDS - began)) "does not build"; return; }
    "${run[@]}" "$binary" -tce="*million*${6:+,$6}" -nc -d | tr -d '\r' | tee "$work/printed" || true
    # [doctest] test cases: 190 | 188 passed | 0 failed | 2 skipped
    read -ra count < <(sed -n 's/.*test cases: *\([0-9]*\) *| *\([0-9]*\) passed *| *\([0-9]*\) failed *| *\([0-9]*\) skipped.*/\2 \3 \4/p' "$work/printed")
    row "$name" "${count[0]:-0}" "${count[1]:-1}" "${count[2]:-0}" $((SECONDS - began)) "test cases of ${folders[*]}"
}
