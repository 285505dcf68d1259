#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# packages.sh [--twice] [--test]
# Makes the release's tarball and its Debian packages from the last commit, in build/packages, and checks them: lintian
# finds no error. --twice builds them again in another folder and compares the bytes. --test installs them, as root, and
# runs the tests of packaging/debian/tests, as autopkgtest would. Nothing is signed.
# Needs devscripts' and debhelper's packages; says which are missing.
set -euo pipefail
cd "$(dirname "$0")/.."
twice=no tests=no
for option; do
    case $option in
    --twice) twice=yes ;;
    --test) tests=yes ;;
    *) sed -nE 's/^# (packages\.sh .*)/usage: \1/p' "$0" >&2; exit 2 ;;
    esac
done
version=$(sed -nE 's/^#define CGT_VERSION_STRING "([0-9.]+)"$/\1/p' include/cgt/version.h)
top=$PWD/build/packages
rm -rf "$top"
mkdir -p "$top"
export SOURCE_DATE_EPOCH
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
git archive --prefix="libcgt-$version/" HEAD | gzip -9n >"$top/libcgt_$version.orig.tar.gz"
echo "packages.sh: $top/libcgt_$version.orig.tar.gz"
dpkg-checkbuilddeps packaging/debian/control

# build FOLDER: the packages of the tarball, in a folder of their own
build() {
    local tree=$1/libcgt-$version
    mkdir -p "$1"
    tar -xzf "$top/libcgt_$version.orig.tar.gz" -C "$1"
    cp -R "$tree/packaging/debian" "$tree/debian"
    if ! (cd "$tree" && dpkg-buildpackage -b -us -uc) >"$1/build.log" 2>&1; then
        tail -n 30 "$1/build.log"
        echo "packages.sh: the build failed; the whole log is $1/build.log"
        exit 1
    fi
}
build "$top/first"
lintian --no-tag-display-limit --fail-on error "$top"/first/*.changes | tee "$top/lintian.log"
(cd "$top/first" && ls ./*.deb)

if [ $twice = yes ]; then
    build "$top/second/further/down"
    for package in "$top"/first/*.deb; do
        cmp "$package" "$top/second/further/down/${package##*/}"
    done
    echo "packages.sh: two builds in two folders have the same bytes"
fi
if [ $tests = yes ]; then
    apt-get install -y --no-install-recommends $(ls "$top"/first/*.deb | grep -v dbgsym) >"$top/install.log" 2>&1 ||
        { tail -n 20 "$top/install.log"; exit 1; }
    for test in library tools python; do
        AUTOPKGTEST_TMP=$(mktemp -d) "packaging/debian/tests/$test" >"$top/$test.log" 2>&1 ||
            { cat "$top/$test.log"; echo "FAILED: packaging/debian/tests/$test"; exit 1; }
        echo "packages.sh: test $test passes"
    done
fi
