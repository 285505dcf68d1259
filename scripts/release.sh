#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# release.sh [--tarball]
# Makes the tarball of a release from the last commit, build/tarball/libcgt-VERSION.tar.gz, and checks it from nothing:
# unpacked elsewhere, without the repository, it builds, each component installs, a program links what was installed and
# draws, and the quick tests pass. Ends with what keeps the commit from being a release. Signs, tags and sends nothing.
# --tarball makes it and no more.
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -eq 0 ] || [ "$*" = --tarball ] || { sed -nE 's/^# (release\.sh .*)/usage: \1/p' "$0" >&2; exit 2; }
version=$(sed -nE 's/^#define CGT_VERSION_STRING "([0-9.]+)"$/\1/p' include/cgt/version.h)
tarball=$PWD/build/tarball/libcgt-$version.tar.gz
mkdir -p build/tarball
# the same commit makes the same bytes
git archive --prefix="libcgt-$version/" HEAD | gzip -9n >"$tarball"
echo "release.sh: $tarball"
[ $# -eq 0 ] || exit 0
sha256sum "$tarball"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
log=$PWD/build/tarball/log
: >"$log"
# logged COMMAND...: what it says is shown only where it fails
logged() {
    if ! "$@" >>"$log" 2>&1; then
        tail -n 30 "$log" >&2
        echo "release.sh: the above failed: $*; the whole log is $log" >&2
        exit 1
    fi
}
tar -xzf "$tarball" -C "$work"
tree=$work/libcgt-$version build=$work/libcgt-$version/build/release
export CCACHE_BASEDIR=$tree # where the compiler is called through ccache, it finds what other builds made
logged cmake -S "$tree" -B "$build" -DCGT_WERROR=ON -DCGT_BUILD_TESTS=OFF
logged cmake --build "$build" -j "$(nproc)"
logged sh "$tree/tests/packaging/check_components.sh" "$build" cmake "$tree"
logged cmake --install "$build" --prefix "$work/prefix"
pc=$(find "$work/prefix" -name cgt-picture.pc)
# shellcheck disable=SC2046 # flags are several words
logged cc "$tree/examples/draw_spheres.c" -o "$work/draw" \
    $(PKG_CONFIG_PATH=${pc%/*} pkg-config --cflags --libs cgt-picture-static)
logged sh -c 'cd "$1" && ./draw && [ -s spheres.png ]' sh "$work"
echo "release.sh: it builds, installs, and draws"
logged cmake "$build" -DCGT_BUILD_TESTS=ON
logged cmake --build "$build" -j "$(nproc)" --target quick_tests
logged ctest --test-dir "$build" -L quick -j "$(nproc)" --output-on-failure --no-tests=error
sed -nE 's/^([0-9]+% tests passed.*)/release.sh: \1/p' "$log"

# ---- what a release needs besides ----

missing=0
lacks() {
    echo "release.sh: no release yet: $1"
    missing=$((missing + 1))
}
case $version in 0.*) soname=${version%.*} ;; *) soname=${version%%.*} ;; esac
[ -z "$(git status --porcelain --untracked-files=no)" ] || lacks "what is not committed is not in it"
! head -n 1 NEWS | grep -q 'not released' || lacks "NEWS: $(head -n 1 NEWS)"
! head -n 1 packaging/debian/changelog | grep -q UNRELEASED || lacks "packaging/debian/changelog is UNRELEASED"
[ -e "tests/repository/abi/$soname.abi" ] || lacks "its binary interface is not described: scripts/abi.sh --write"
grep -q "^libcgt $version\b" <(head -n 1 NEWS) || lacks "NEWS begins with another version: $(head -n 1 NEWS)"
head -n 1 packaging/debian/changelog | grep -qF "($version-" || lacks "packaging/debian/changelog is of another version"
grep -qF "\"$version\"" packaging/vcpkg/vcpkg.json || lacks "vcpkg.json is of another version"
[ $missing -gt 0 ] || echo "release.sh: $version can be released"
