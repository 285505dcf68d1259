#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# test.sh [SUITE]...      SUITE: release, clang, asan-ubsan, tsan, aarch64, ppc64, native; without any: all but native,
#                         whose flags the suite of clang has, too
# Installs what the tests need, builds each suite's preset of CMakePresets.json and runs ctest on it. The last line
# counts the tests of all suites; the exit code is 0 where none failed.
set -euo pipefail
cd "$(dirname "$0")/.."
suites=("$@")
[ ${#suites[@]} -gt 0 ] || suites=(release clang asan-ubsan tsan aarch64 ppc64)

purposes=(build render tests)
for suite in "${suites[@]}"; do
    case $suite in
    release|native|asan-ubsan|tsan) ;;
    clang) purposes+=(clang) ;;
    aarch64|ppc64) purposes+=(cross) ;;
    *) echo "test.sh: unknown suite '$suite': release, clang, asan-ubsan, tsan, aarch64, ppc64, native" >&2; exit 2 ;;
    esac
done
scripts/dependencies.sh "${purposes[@]}"
jobs=$(nproc)
mkdir -p build
passed=0 failed=0 skipped=0 broken=()

# What a suite cannot do without is ON, so that nothing is left out in silence.
settings_of() {
    local oracle=ON meshes=ON render=OFF
    case $1 in
    release|asan-ubsan) render=ON ;;
    native|clang) ;; # another compiler, other flags: of the library, not of the programs' C++
    tsan) oracle=OFF meshes=OFF ;; # Embree, assimp and OpenImageIO bring threads that the sanitizer cannot see into
    aarch64|ppc64) oracle=OFF meshes=OFF ;; # Debian has none of them for a cross build
    esac
    echo -DCGT_WERROR=ON -DCGT_BUILD_TESTS=ON -DCGT_BUILD_ORACLE=$oracle -DCGT_BUILD_MESHES=$meshes \
        -DCGT_BUILD_RENDER=$render
}

# The thread sanitizer of gcc 12 dies at start where the kernel spreads addresses wider than it knows; without that
# spreading it works.
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

build_suite() {
    case $1 in aarch64|ppc64) scripts/cross_cmocka.sh "$1" ;; esac
    local settings
    read -ra settings <<<"$(settings_of "$1")"
    cmake --preset "$1" "${settings[@]}"
    cmake --build --preset "$1" -j "$jobs"
}

run_suite() {
    local suite=$1 log=build/test_$1.log runner=""
    echo "==== $suite: build, $(date +%T)"
    if ! (build_suite "$suite") >"$log" 2>&1; then
        grep -E '(error|warning|Error)[ :]' "$log" | head -n 40 || true
        tail -n 30 "$log"
        echo "test.sh: $suite: the build failed; the whole log is $log"
        broken+=("$suite")
        return
    fi
    grep -E '^-- (Variants|Left out)' "$log" || true
    if [ "$suite" = tsan ] && ! runner=$(tsan_runner); then
        broken+=("$suite")
        return
    fi
    echo "==== $suite: test, $(date +%T)"
    log=build/ctest_$suite.log
    local ok=yes
    # shellcheck disable=SC2086 # the runner is several words or none
    $runner ctest --preset "$suite" -j "$jobs" --no-tests=error </dev/null 2>&1 | tee "$log" || ok=no
    # ctest counts what exited with 77 as passed and lists it apart
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
[ ${#broken[@]} -eq 0 ] || echo "suites that could not be built or run: ${broken[*]}"
echo "$passed passed, $((failed + ${#broken[@]})) failed"
[ $failed -eq 0 ] && [ ${#broken[@]} -eq 0 ]
