#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# check_recipes.sh SOURCE_DIR BUILD_DIR CMAKE CC
# All packages have one version and soname; and the recipes of Conan and vcpkg, run with stand-ins for these programs,
# make packages that a project finds and uses. Both take the libraries from BUILD_DIR, once they have shown that they would
# compile the same.
source=$1 build=$2 cmake=$3 cc=$4
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
. "$source/tests/repository/findings.sh"
version=$(sed -nE 's/^#define CGT_VERSION_STRING "([0-9.]+)"$/\1/p' "$source/include/cgt/version.h")
packaging=$source/packaging

{
    head -n 1 "$packaging/debian/changelog" | grep -F "libcgt ($version-" || echo "debian/changelog: not $version"
    python3 -c 'import json, sys; port = json.load(open(sys.argv[1])); assert port["name"] == "libcgt"; print(port["version"])' \
        "$packaging/vcpkg/vcpkg.json" | grep -xF "$version" || echo "vcpkg.json: not $version"
    sed -nE 's/^Package: (libcgt.*[0-9])$/\1/p' "$packaging/debian/control" | while read -r package; do
        case $package in *"${version%.*}") echo "$package" ;; *) echo "debian/control: $package: not ${version%.*}" ;; esac
        [ -e "$packaging/debian/$package.install" ] || echo "debian: not $package.install"
    done
} >"$work/versions" 2>&1
[ "$(grep -c . "$work/versions")" -ge 4 ] && ! grep 'not\|Error' "$work/versions" >"$work/wrong" ||
    fail "versions of the packages" "$work/versions"

rm -rf recipes
mkdir recipes
# the settings of the build that change a command; its texts, too, which the recipes leave out
set -- -DCMAKE_C_COMPILER="$cc"
for name in CMAKE_BUILD_TYPE CMAKE_C_FLAGS CMAKE_C_FLAGS_RELEASE CGT_ONLY_VARIANTS CGT_WERROR CGT_BUILD_TEXT; do
    set -- "$@" "-D$name=$(sed -nE "s/^$name:[A-Z]+=//p" "$build/CMakeCache.txt")"
done
python3 "$source/tests/packaging/run_conanfile.py" "$packaging/conan/conanfile.py" recipes "$build" "$cmake" "$@" \
    >"$work/log" 2>&1 || { fail "the recipe of Conan" "$work/log"; exit 1; }
grep -qx "libcgt $version" "$work/log" || fail "Conan's version" "$work/log"
profile=$(printf ';%s' "$@")
"$cmake" -DPORTFILE="$packaging/vcpkg/portfile.cmake" -DWORK="$PWD/recipes" -DBUILT="$PWD/recipes/build" \
    "-DPROFILE=${profile#;}" \
    -P "$source/tests/packaging/run_portfile.cmake" >"$work/log" 2>&1 || { fail "the port of vcpkg" "$work/log"; exit 1; }

# both as a project finds them
for prefix in package vcpkg; do
    "$cmake" -S "$source/tests/repository/consumer" -B "recipes/use_$prefix" -DCMAKE_C_COMPILER="$cc" \
        -DCMAKE_PREFIX_PATH="$PWD/recipes/$prefix" >"$work/log" 2>&1 &&
        "$cmake" --build "recipes/use_$prefix" -j2 --target consumer_static --target consumer_shared >>"$work/log" 2>&1 &&
        "recipes/use_$prefix/consumer_static" >>"$work/log" 2>&1 &&
        "recipes/use_$prefix/consumer_shared" >>"$work/log" 2>&1 || fail "a project over recipes/$prefix" "$work/log"
    grep "^cgt_DIR.*/recipes/$prefix/" "recipes/use_$prefix/CMakeCache.txt" >/dev/null ||
        fail "another cgt was found than that of recipes/$prefix" "recipes/use_$prefix/CMakeCache.txt"
done
[ $status -ne 0 ] || echo "Conan and vcpkg, by stand-ins: $version"
exit $status
