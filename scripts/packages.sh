#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# packages.sh [--twice] [--test]
# Makes the Debian packages of the last commit from its tarball (release.sh), in build/packages, and checks them: lintian
# finds neither errors nor warnings. --twice builds them again in another folder and compares the bytes. --test, as root or by sudo,
# runs the tests of packaging/debian/tests by autopkgtest on this machine, which installs the packages and what they
# need, and removes the packages again. Nothing is signed.
# Needs what control says and devscripts' tools: scripts/dependencies.sh build render tests packages.
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
dpkg-checkbuilddeps packaging/debian/control
version=$(sed -nE 's/^#define CGT_VERSION_STRING "([0-9.]+)"$/\1/p' include/cgt/version.h)
top=$PWD/build/packages
rm -rf "$top"
mkdir -p "$top"
export SOURCE_DATE_EPOCH
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
scripts/release.sh --tarball
orig=$top/libcgt_$version.orig.tar.gz
cp "build/tarball/libcgt-$version.tar.gz" "$orig"

# build FOLDER: the packages of the tarball, in a folder of their own
build() {
    local tree=$1/libcgt-$version start=$SECONDS
    mkdir -p "$1"
    tar -xzf "$orig" -C "$1"
    cp -R "$tree/packaging/debian" "$tree/debian"
    if ! (cd "$tree" && dpkg-buildpackage -b -us -uc) >"$1/build.log" 2>&1; then
        tail -n 30 "$1/build.log"
        echo "packages.sh: the build failed; the whole log is $1/build.log"
        exit 1
    fi
    echo "packages.sh: built in $((SECONDS - start)) s: $1"
}
build "$top/first"
# no package for Debian's archive was asked for yet, so there is no bug to close
lintian --allow-root --tag-display-limit 0 --suppress-tags initial-upload-closes-no-bugs --fail-on error,warning \
    "$top"/first/*.changes 2>&1 | tee "$top/lintian.log"
(cd "$top/first" && wc -c ./*.deb)

if [ $twice = yes ]; then
    build "$top/second/further/down"
    for package in "$top"/first/*.deb; do
        cmp "$package" "$top/second/further/down/${package##*/}"
    done
    echo "packages.sh: two builds in two folders have the same bytes"
fi
if [ $tests = yes ]; then
    status=0 root=()
    [ "$(id -u)" = 0 ] || root=(sudo)
    "${root[@]}" autopkgtest --no-built-binaries --output-dir "$top/autopkgtest" "$top"/first/*.deb "$top/first/libcgt-$version" -- null \
        >"$top/autopkgtest.log" 2>&1 || status=$?
    [ ${#root[@]} = 0 ] || sudo chown -R "$(id -u):$(id -g)" "$top/autopkgtest"
    for package in "$top"/first/*.deb; do
        dpkg-query -W -f '${Package} ${db:Status-Status}\n' "$(dpkg-deb -f "$package" Package)" 2>/dev/null || true
    done | awk '$2 == "installed" { print $1 }' | xargs -r "${root[@]}" dpkg --purge >>"$top/autopkgtest.log" 2>&1
    cat "$top/autopkgtest/summary" || true
    [ $status -eq 0 ] || { echo "packages.sh: autopkgtest ended with $status; its log is $top/autopkgtest.log"; exit 1; }
fi
