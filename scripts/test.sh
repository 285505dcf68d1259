#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# test.sh [--whole] [SUITE]...
# Installs what the tests need, builds, and runs ctest. Without arguments: the suite `release`, all tests on this
# machine. The last line counts the tests; the exit code is 0 if none failed.
#   quick     those of the release suite that take no time: ten seconds together, to run after every change
#   release   every test, gcc, all variants that the CPU runs
#   sanitize  clang's address and undefined-behaviour sanitizers, the widest variant of this CPU and the portable one
#   tsan      the thread sanitizer, the tests that use threads, the same two variants
#   aarch64   cross-built for Arm, run by qemu: what another instruction set can break
#   ppc64     cross-built for big-endian POWER, run by qemu: what byte order can break
#   i686      cross-built for 32-bit x86, run as it is, where the kernel does that: the library, the readers and the tests
#             that another system can break, at -O1
#   armhf     the same for 32-bit Arm, by qemu
#   riscv64   the same for RISC-V, by qemu
#   s390x     the same for s390x, which is big-endian, by qemu
#   musl      the same with the C library musl, and cgt-convert and cgt-bench
#   windows   the same for Windows by MinGW-w64, run by Wine, with cgt-render and the DLLs, too; the widest variant and
#             the portable one
#   wasm      the same for WebAssembly by Emscripten, run by Node: same bits, and all vector words in its vectors
#   web       the page of scripts/web.sh, in Chromium without a window
#   packages  the Debian packages of scripts/packages.sh, built twice, installed and tried
#   clang     every test, built by clang -march=native
#   native    every test, built by gcc -march=native
#   spu       the kernels, and programs of an SPU, by the SPU's own compiler, run by the simulator; builds the compiler
#             where it is missing (scripts/spu_toolchain.sh)
#   all       release, sanitize, tsan, aarch64, ppc64 and windows: what .ci/run runs; and spu where its compiler is
#             there already
#   everything  the whole matrix, before a release
# What `everything` and --whole run and the single suites and `all` leave out:
#   all suites  tests by row of the variant table, for the rows between the portable one and the widest that this CPU
#               runs: these have the text of one of the two. Vector words and whatever asks the library for all its
#               variants run for every row. Of sanitize, tsan and aarch64 it is the widest row alone
#   release     the full length of the tests that run again with clusters in all triangles (*_clusters): a third of it;
#               -O3 for the modules in C++ (-O0)
#   sanitize    these tests; pointer-overflow in kernels, which takes half the compiler's time (addresses that are used are
#               the address sanitizer's); tests of numbers in kernels that are built apart and others run, and other long
#               ones (CGT_TEST_LONG); -O1 for the modules in C++ (-O0)
#   tsan        tests with the label `workers`: fuzz_hits, test_cell_kd, test_float_environment, test_stacks,
#               test_structure_contracts
#   aarch64     -O3 (-O1), clusters, and tests without the labels isa and platform
#   ppc64       -O3 (-O1), and tests without the labels endian and platform
#   windows     all variants and their words
#   i686        all of it, as the other platforms of few tests
# Compiler results come from ccache where it is installed. Test durations are kept between runs in
# ${XDG_CACHE_HOME:-~/.cache}/libcgt, so that ctest starts the longest tests first.
set -euo pipefail
cd "$(dirname "$0")/.."

platforms=(i686 armhf riscv64 s390x musl windows wasm) # cross builds of few tests
known=(quick release clang native sanitize tsan aarch64 ppc64 spu "${platforms[@]}" web packages)
is_platform() { [[ " ${platforms[*]} " == *" $1 "* ]]; }
suites=() whole_matrix=no
[ "${1:-}" != --whole ] || { whole_matrix=yes; shift; }
for name in "${@:-release}"; do
    case $name in
    all)
        suites+=(release sanitize tsan aarch64 ppc64 windows)
        if scripts/spu_toolchain.sh --find >/dev/null; then
            suites+=(spu)
        else
            echo "test.sh: the suite spu is left out, since the SPU's compiler is missing: scripts/test.sh spu builds it"
        fi
        ;;
    everything) suites+=("${known[@]:1}") whole_matrix=yes ;;
    *)
        [[ " ${known[*]} " != *" $name "* ]] || { suites+=("$name"); continue; }
        echo "test.sh: unknown suite '$name': $(sed -nE 's/^#   ([a-z0-9]+) .*/\1/p' "$0" | paste -sd' ')" >&2
        exit 2 ;;
    esac
done

purposes=(build render tests)
for suite in "${suites[@]}"; do
    case $suite in
    clang|sanitize) purposes+=(clang) ;;
    aarch64|ppc64) purposes+=(cross) ;;
    web) purposes+=(web) ;;
    packages) purposes+=(packages) ;;
    *) ! is_platform "$suite" || purposes+=("$suite") ;;
    esac
done
scripts/dependencies.sh "${purposes[@]}"
if [[ " ${suites[*]} " == *" spu "* ]]; then
    scripts/spu_toolchain.sh
fi

jobs=$(nproc)
! command -v ninja >/dev/null || export CMAKE_GENERATOR=Ninja # of new builds: make takes 42 s of CPU to find nothing to do
export NODE_PATH=${NODE_PATH:-/usr/share/nodejs} # where Emscripten finds acorn
cache=${XDG_CACHE_HOME:-$HOME/.cache}/libcgt
mkdir -p build "$cache"
if command -v ccache >/dev/null; then
    export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
    export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=${CCACHE_SLOPPINESS:-time_macros}
fi
passed=0 failed=0 skipped=0 broken=()

widest=$(scripts/widest_row.sh)

# The CMake settings of a suite, one a line. What it cannot do without is ON, so that nothing is left out in silence.
settings_of() {
    local oracle=ON meshes=ON gltf=ON render=OFF programs=OFF labels="" clusters=FULL rows="" level=3 modules=3 long=ON
    local settings=(-DCGT_WERROR=ON -DCGT_BUILD_TESTS=ON)
    if [ $whole_matrix = no ]; then
        rows="portable;$widest"
        [[ $1 != sanitize && $1 != tsan ]] || rows=$widest
    fi
    case $1 in
    quick|release)
        render=ON
        # C++ is that of modules alone, which tests do not time
        [ $whole_matrix = yes ] || { clusters=SHORT; modules=0; }
        settings+=("-DCMAKE_CXX_FLAGS_RELEASE=-O$modules -DNDEBUG") ;;
    sanitize)
        oracle=OFF render=ON # Embree's own code is not instrumented, and the release suite asks it
        settings+=("-DCGT_ONLY_VARIANTS=$widest;neon")
        if [ $whole_matrix = yes ]; then
            settings+=(-DCGT_SANITIZE_ALL=ON)
        else
            settings+=(-DCGT_SANITIZE_ALL=OFF)
            clusters=OFF long=OFF
            settings+=("-DCMAKE_CXX_FLAGS_DEBUG=-O0 -g1")
        fi ;;
    clang) gltf=OFF ;; # what assimp loses of glTF is refused
    native) ;;
    tsan)
        oracle=OFF meshes=OFF render=ON labels=threads # assimp and Embree bring threads that the sanitizer cannot see into
        settings+=("-DCGT_ONLY_VARIANTS=$widest;neon")
        [ $whole_matrix = no ] || labels+=";workers" ;;
    aarch64)
        oracle=OFF meshes=OFF # Debian has neither for a cross build
        [ $whole_matrix = yes ] || labels="isa;platform" rows=neon clusters=OFF level=1 ;;
    ppc64)
        oracle=OFF meshes=OFF
        [ $whole_matrix = yes ] || labels="endian;platform" rows="" level=1 ;;
    spu) oracle=OFF meshes=OFF labels=spu ;;
    *)
        labels=platform
        [ "$1" != wasm ] || labels+=";words"
        [[ $1 != musl && $1 != windows ]] || { programs=ON labels+=";system"; }
        if [ "$1" = windows ]; then
            render=ON
            if [ $whole_matrix = yes ]; then
                labels+=";words" settings+=(-DCGT_ONLY_VARIANTS=)
            else
                settings+=("-DCGT_ONLY_VARIANTS=$widest")
            fi
        fi
        printf '%s\n' "${settings[@]}" -DCGT_ONLY_LIBRARY=ON -DCGT_BUILD_ORACLE=OFF -DCGT_BUILD_EXAMPLES=$programs \
            -DCGT_BUILD_BENCH=$programs -DCGT_BUILD_RENDER=$render "-DCGT_TEST_LABELS=$labels"
        return ;;
    esac
    case $1 in
    aarch64|ppc64) settings+=("-DCMAKE_C_FLAGS_RELEASE=-O$level -DNDEBUG") ;;
    esac
    [ $meshes = ON ] || gltf=OFF
    printf '%s\n' "${settings[@]}" -DCGT_BUILD_ORACLE=$oracle -DCGT_BUILD_MESHES=$meshes -DCGT_BUILD_GLTF=$gltf \
        -DCGT_BUILD_RENDER=$render "-DCGT_TEST_LABELS=$labels" "-DCGT_TEST_ROWS=$rows" -DCGT_TEST_CLUSTERS=$clusters \
        -DCGT_TEST_LONG=$long
    [ -z "$labels" ] && echo -DCGT_BUILD_BENCH=ON || echo -DCGT_BUILD_BENCH=OFF
}

# The thread sanitizer of gcc 12 dies at start where the kernel randomises addresses more than it knows; without
# randomisation it works.
tsan_runner() {
    local probe=build/tsan_probe
    echo 'int main(void) { return 0; }' >$probe.c
    cc -fsanitize=thread $probe.c -o $probe
    if $probe >/dev/null 2>&1; then
        return
    elif setarch "$(uname -m)" -R $probe >/dev/null 2>&1; then
        echo "setarch $(uname -m) -R"
    else
        echo "test.sh: a program built with -fsanitize=thread cannot run on this machine" >&2
        return 1
    fi
}

# quick is a part of release: it builds and runs there.
preset_of() {
    [ "$1" = quick ] && echo release || echo "$1"
}

build_suite() {
    local settings preset target=all
    preset=$(preset_of "$1")
    case $1 in
    aarch64|ppc64) cmake/toolchains/cross_cmocka.sh "$1" ;;
    *) ! is_platform "$1" || cmake/toolchains/cross_cmocka.sh "$1" ;;
    esac
    case $1 in
    tsan|aarch64|ppc64) target=test_programs ;;
    esac
    ! is_platform "$1" || target=platform_tests
    [ "$1" != quick ] || target=quick_tests
    mapfile -t settings < <(settings_of "$1")
    [ "$1" != spu ] || settings+=("-DCGT_SPU_TOOLCHAIN=$(scripts/spu_toolchain.sh --find)")
    cmake --preset "$preset" "${settings[@]}"
    cmake --build --preset "$preset" -j "$jobs" --target "$target"
}

# The page in a browser; pictures of it lie in build/web_pictures.
run_web() {
    local log=build/test_web.log start=$SECONDS settings good ok=yes
    mapfile -t settings < <(settings_of release)
    if ! (scripts/web.sh && cmake --preset release "${settings[@]}" &&
        cmake --build --preset release -j "$jobs" --target cgt-render native_pick) >"$log" 2>&1; then
        tail -n 30 "$log"
        echo "test.sh: web: the build failed; the whole log is $log"
        broken+=(web)
        return
    fi
    echo "==== web: built in $((SECONDS - start)) s"
    log=build/ctest_web.log
    node tests/web/test_page.js build/web build/release/bin/cgt-render build/release/tests/native_pick \
        build/web_pictures </dev/null 2>&1 | tee "$log" || ok=no
    good=$(grep -c '^passed: ' "$log" || true)
    [ "$good" -gt 0 ] && { [ $ok = yes ] || grep -q '^FAILED: ' "$log"; } || broken+=(web) # it may have died
    passed=$((passed + good))
    failed=$((failed + $(grep -c '^FAILED: ' "$log" || true)))
}

# Two builds of the Debian packages, compared, installed and tried.
run_packages() {
    local log=build/test_packages.log start=$SECONDS
    if scripts/packages.sh --twice --test </dev/null 2>&1 | tee "$log"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
    fi
    echo "==== packages: built and tried in $((SECONDS - start)) s"
}

run_suite() {
    case $1 in
    web) run_web; return ;;
    packages) run_packages; return ;;
    i686)
        if ! /usr/i686-linux-gnu/lib/ld-linux.so.2 /usr/i686-linux-gnu/lib/libc.so.6 >/dev/null 2>&1; then
            echo "test.sh: i686: this machine's kernel refuses 32-bit programs, and qemu hangs in tests with threads"
            skipped=$((skipped + 1))
            return
        fi ;;
    esac
    local suite=$1 log=build/test_$1.log runner="" start=$SECONDS preset only=()
    preset=$(preset_of "$suite")
    [ "$suite" != quick ] || only=(-L quick)
    if ! (build_suite "$suite") >"$log" 2>&1; then
        grep -E '(error|warning|Error)[ :]' "$log" | head -n 40 || true
        tail -n 30 "$log"
        echo "test.sh: $suite: the build failed; the whole log is $log"
        broken+=("$suite")
        return
    fi
    echo "==== $suite: built in $((SECONDS - start)) s"
    grep -E '^-- (Variants|Left out)' "$log" || true
    settings_of "$suite" | sed -nE 's/-DCGT_BUILD_([A-Z]+)=OFF/\1/p' | paste -sd' ' |
        sed -nE 's/^(.+)/-- Not in this suite: \1/p'
    if [ "$suite" = tsan ] && ! runner=$(tsan_runner); then
        broken+=("$suite")
        return
    fi

    log=build/ctest_$suite.log
    start=$SECONDS
    local ok=yes durations=build/$preset/Testing/Temporary/CTestCostData.txt
    if [ ! -e "$durations" ] && [ -e "$cache/durations_$preset.txt" ]; then
        mkdir -p "${durations%/*}"
        cp "$cache/durations_$preset.txt" "$durations"
    fi
    # shellcheck disable=SC2086 # the runner is several words or none
    # One more than processors: some tests wait for programs.
    $runner ctest --preset "$preset" "${only[@]}" -j $((jobs + 1)) --no-tests=error </dev/null 2>&1 | tee "$log" || ok=no
    [ ! -e "$durations" ] || cp "$durations" "$cache/durations_$preset.txt"
    echo "==== $suite: tested in $((SECONDS - start)) s"

    # ctest counts a test that exits with 77 as passed and lists it apart.
    local lost skips total
    lost=$(sed -nE 's/^[0-9]+% tests passed, ([0-9]+) tests failed out of ([0-9]+).*/\1/p' "$log")
    total=$(sed -nE 's/^[0-9]+% tests passed, ([0-9]+) tests failed out of ([0-9]+).*/\2/p' "$log")
    skips=$(grep -cE '^[[:space:]]+[0-9]+ - .*\(Skipped\)$' "$log" || true)
    if [ -z "$total" ] || { [ $ok = no ] && [ "$lost" -eq 0 ]; }; then
        broken+=("$suite")
        return
    fi
    passed=$((passed + total - lost - skips))
    failed=$((failed + lost))
    skipped=$((skipped + skips))
}

for suite in "${suites[@]}"; do
    run_suite "$suite"
done
[ $skipped -eq 0 ] || echo "$skipped skipped, with the reason above"
left_out=
for suite in "${known[@]:1}"; do
    [[ " ${suites[*]} " == *" $suite "* ]] || left_out+=" $suite"
done
[ -z "$left_out" ] || echo "suites left out:$left_out"
[ ${#broken[@]} -eq 0 ] || echo "suites that could not be built or run: ${broken[*]}"
echo "$passed passed, $((failed + ${#broken[@]})) failed"
[ $failed -eq 0 ] && [ ${#broken[@]} -eq 0 ]
