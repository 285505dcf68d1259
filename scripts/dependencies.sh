#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# dependencies.sh PURPOSE...
# Installs the Debian packages that the purposes below need and that are missing, as root or through sudo, and says
# which. Where nothing is missing, apt is not called at all. On other systems: install what the table names.
# On a bare Debian 12 (debootstrap's minbase), build and demo are 73 packages (82 MB to download, 311 MB on disk): the
# compiler and libc6-dev are 41 of them (210 MB), CMake 21 (87 MB). Less is not to be had: a build without CMake would be
# a second description of it, and still 52 packages (223 MB). build and render are 353 without SDL 2 (273 MB, 1.1 GB);
# tests adds some 170 (123 MB, 450 MB), of which ffmpeg and Open MPI bring 100 (54 MB, 180 MB), LAMMPS 13 (19 MB, 93 MB).
# Without these three the tests of movies, of MPI and of LAMMPS' own files are skipped.
set -euo pipefail
purposes="build|demo|render|tests|clang|cross|i686|armhf|riscv64|s390x|musl|windows|wasm|page|web|site|spu|packages|lint"

packages_of() {
    case $1 in
    build)  echo gcc libc6-dev make cmake ;;                                       # the library
    demo)   echo libisal-dev libarchive-dev libfreetype-dev fonts-dejavu-core ;;   # cgt-render, without modules
    render) packages_of demo
            echo g++ libopenimageio-dev libassimp-dev libtinygltf-dev nlohmann-json3-dev \
                 libsdl2-dev libimgui-dev libfontconfig-dev ;;                                # with them, and cgt-view
    tests)  echo ninja-build libcmocka-dev libembree-dev openimageio-tools pkg-config binutils g++ \
                 assimp-testmodels glmark2-data gnuplot-nox \
                 ffmpeg libopenmpi-dev openmpi-bin lammps liblammps-dev python3-lammps \
                 python3-cffi python3-numpy python3-pytest python3-pip python3-setuptools python3-wheel mypy python3-mpi4py \
                 libdeflate-dev zlib1g-dev libgmp-dev help2man locales xvfb xdotool abigail-tools mkdocs ;;         # native tests
    clang)  echo clang libclang-rt-14-dev ;;                                       # the tests by another compiler
    cross)  echo gcc-aarch64-linux-gnu libc6-dev-arm64-cross gcc-powerpc64-linux-gnu libc6-dev-ppc64-cross \
                 qemu-user xz-utils ;;                                             # cross tests
    i686)   echo gcc-i686-linux-gnu libc6-dev-i386-cross xz-utils ;;               # each a suite of scripts/test.sh
    armhf)  echo gcc-arm-linux-gnueabihf libc6-dev-armhf-cross qemu-user xz-utils ;;
    riscv64) echo gcc-riscv64-linux-gnu libc6-dev-riscv64-cross qemu-user xz-utils ;;
    s390x)  echo gcc-s390x-linux-gnu libc6-dev-s390x-cross qemu-user xz-utils ;;
    musl)   echo musl-tools xz-utils ;;
    site)   echo mkdocs libjs-jquery python3 ;;                                    # scripts/site.sh
    wasm)   echo emscripten nodejs xz-utils ;;
    page)   packages_of wasm
            echo fonts-dejavu-core ;;                                              # scripts/web.sh
    web)    packages_of page
            echo chromium ;;                                                       # the page, in a browser
    windows) echo gcc-mingw-w64-x86-64-posix libz-mingw-w64-dev wine64 xz-utils ;;
    spu)    echo gcc g++ make xz-utils libgmp-dev libmpfr-dev libmpc-dev ;;        # scripts/spu_toolchain.sh
    packages) echo autopkgtest build-essential debhelper dh-python fakeroot lintian python3-all-dev ;; # scripts/packages.sh
    lint)   echo clang-format-14 clang-tidy-14 codespell ;;                        # scripts/lint.sh
    *)      echo "dependencies.sh: unknown purpose '$1': ${purposes//|/, }" >&2
            return 1 ;;
    esac
}

[ $# -gt 0 ] || { echo "usage: dependencies.sh $purposes ..." >&2; exit 2; }
wanted=()
for purpose in "$@"; do
    list=$(packages_of "$purpose" | paste -sd' ')
    read -ra names <<<"$list"
    wanted+=("${names[@]}")
done

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "dependencies.sh: this is no Debian system; trusting that these are installed: ${wanted[*]}"
    exit 0
fi

missing=()
for name in "${wanted[@]}"; do
    status=$(dpkg-query -W -f='${db:Status-Status}\n' "$name" 2>/dev/null || true)
    grep -qx installed <<<"$status" || [[ " ${missing[*]} " == *" $name "* ]] || missing+=("$name")
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || {
        echo "dependencies.sh: missing, and neither root nor sudo: apt-get install ${missing[*]}" >&2
        exit 1
    }
    as_root=(sudo)
fi
echo "dependencies.sh: installing ${missing[*]}"
"${as_root[@]}" apt-get -q update
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends \
    -o Dpkg::Use-Pty=0 install "${missing[@]}" </dev/null
