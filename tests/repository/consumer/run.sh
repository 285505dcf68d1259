#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# run.sh SOURCE_DIR BUILD_DIR CMAKE CC toolchain=FILE [EMULATOR...]
# Installs the library, moves it to another place, and there
#   compiles each installed header alone, as C and, but for the C-only vocabulary, as C++
#   compiles and runs a program written for an SPU with the vocabulary alone, in each of its forms
#   looks for licence and texts
#   builds and runs a project that uses find_package(cgt), with and without components, as C and as C++, and the readers
#   builds and runs the same programs through pkg-config, static and shared, though both are installed
#   configures the library alone
#   builds and runs them with add_subdirectory, where a project without a build type still gets an optimised library
set -eu
source=$1 build=$2 cmake=$3 cc=$4 toolchain=${5#toolchain=}
shift 5
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$cmake" --install "$build" --component library --prefix "$work/first" >"$work/install.log" || { cat "$work/install.log"; exit 1; }
mv "$work/first" "$work/moved"
prefix=$work/moved
if grep -rlF "$work/first" "$prefix" || grep -rlF "$build" "$prefix/include" "$prefix"/lib*; then
    echo "the files above hold a path of the build"
    exit 1
fi

echo "== headers alone"
cxx=$(printf '%s\n' "$cc" | sed -E 's/clang([^/]*)$/clang++\1/; s/gcc([^/]*)$/g++\1/; s/(^|\/)cc$/\1c++/')
count=0
for header in "$prefix"/include/cgt/*.h "$prefix"/include/cgt/spu/*.h; do
    name=${header#"$prefix/include/"}
    case $name in
    # machine-specific or partial headers: spu_intrinsics.h includes the right ones
    cgt/spu/spu_sse.h|cgt/spu/spu_neon.h|cgt/spu/spu_wasm.h|cgt/spu/spu_avx*|cgt/spu/spu_wide_*|cgt/spu/spu_portable_*) continue ;;
    esac
    printf '#include <%s>\n#include <%s>\nextern int cgt_header_alone;\n' "$name" "$name" >"$work/alone.c"
    mpi=
    [ "$name" != cgt/mpi.h ] || mpi=$(mpicc --showme:incdirs | sed 's/[^ ]*/-isystem &/g')
    # shellcheck disable=SC2086 # flags are several words
    "$cc" -std=c11 -Wall -Wextra -Wpedantic -Werror -I"$prefix/include" $mpi -fsyntax-only "$work/alone.c"
    case $name in
    cgt/spu*|cgt/vec_types.h) ;; # _Generic: C only
    *)  if command -v "$cxx" >/dev/null; then
            # shellcheck disable=SC2086
            "$cxx" -x c++ -std=c++11 -Wall -Wextra -Wpedantic -Werror -I"$prefix/include" $mpi -fsyntax-only "$work/alone.c"
        else
            echo "$name not tried as C++: no $cxx"
        fi ;;
    esac
    count=$((count + 1))
done
[ "$count" -ge 3 ]
if command -v "$cxx" >/dev/null; then # the structures of research.h are constants of C++, too
    printf '#include <cgt/research.h>\n%s\nconstexpr cgt_structure ropes = CGT_STRUCTURE_KD_ROPES, bih = CGT_STRUCTURE_BIH;\n' \
        'extern const cgt_structure ropes, bih;' >"$work/alone.c"
    "$cxx" -x c++ -std=c++11 -Wall -Wextra -Wpedantic -Werror -I"$prefix/include" -fsyntax-only "$work/alone.c"
fi

echo "== SPU source"
for flags in "" -DCGT_SPU_PORTABLE -DCGT_SPU_EXACT "-DCGT_SPU_EXACT -DCGT_SPU_PORTABLE" "-D__SPU__ -DCGT_SPU_HOST"; do
    # shellcheck disable=SC2086 # flags are several words
    "$cc" -std=c11 -O1 -Wall -Wextra -Wpedantic -Werror $flags -I"$prefix/include/cgt" \
        "$source/tests/repository/consumer/spu_source.c" -o "$work/spu_source"
    "$@" "$work/spu_source"
done

# configure FOLDER ARGUMENTS...: configures the project in $work/FOLDER; prints what CMake said where it failed
configure() {
    folder=$1
    shift
    "$cmake" -S "$source/tests/repository/consumer" -B "$work/$folder" -DCMAKE_C_COMPILER="$cc" \
        ${toolchain:+-DCMAKE_TOOLCHAIN_FILE="$toolchain"} "$@" >"$work/log" 2>&1
}
build() {
    "$cmake" --build "$work/$1" -j2 >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
}
# expect_spheres COMMAND...: the other example writes the same file in every build
expect_spheres() {
    (cd "$work" && "$@")
    [ -e "$work/first_spheres" ] || cp "$work/spheres.png" "$work/first_spheres"
    cmp "$work/spheres.png" "$work/first_spheres"
    rm "$work/spheres.png"
}
# expect_picture COMMAND...: the example draws the same picture in every build
expect_picture() {
    "$@" >"$work/picture" 2>"$work/steps"
    [ "$(wc -l <"$work/steps")" -eq 10 ]
    [ "$(wc -c <"$work/picture")" -eq 307215 ]
    [ -e "$work/first_picture" ] || cp "$work/picture" "$work/first_picture"
    cmp "$work/picture" "$work/first_picture"
}

# expect_frames COMMAND...: the program over the readers prints the frames of a run as awk counts them, and the
# columns of another format; a run that is cut off ends in a sentence
run=$source/examples/data/pour2k.lammpstrj
awk '/TIMESTEP/ { getline; step = $1 } /NUMBER/ { getline; printf "frame %d: step %d, %d spheres, 0 bonds, box 20\n", n++, step, $1 }' \
    "$run" >"$work/expected"
head -c 20000 "$run" >"$work/cut.lammpstrj"
expect_frames() {
    "$@" "$run" >"$work/frames"
    cmp "$work/frames" "$work/expected"
    [ "$("$@" "$source/tests/readers/data/water.pdb" name | grep -c ': step [012], 12 spheres, 0 bonds, box 15, name O$')" -eq 3 ]
    if "$@" "$work/cut.lammpstrj" >"$work/frames" 2>"$work/sentence"; then
        echo "a run that is cut off was read to its end"
        exit 1
    fi
    grep -q '^[^:]*/cut.lammpstrj:[0-9]*: ' "$work/sentence"
}

echo "== licence and texts"
doc=$prefix/share/doc/cgt
[ -s "$doc/LICENSE" ]
[ -s "$doc/NEWS" ]
"$cmake" --install "$build" --component documentation --prefix "$prefix" >"$work/install.log"
[ -s "$doc/README.md" ]
[ -s "$doc/docs/guide/api.md" ]
cmp "$doc/examples/simulate.c" "$source/examples/simulate.c"
cmp "$doc/examples/data/pour2k.lammpstrj" "$source/examples/data/pour2k.lammpstrj"
# every link between the texts holds there, too
(cd "$doc" && find . -name '*.md' | while read -r text; do
    tr '\n' ' ' <"$text" | grep -o '](\([^)]*\))' | sed -e 's/^](//' -e 's/[)#].*$//' | grep -v '^https*:' | while read -r link; do
        [ -z "$link" ] || [ -e "$(dirname "$text")/$link" ] || echo "$text: no file for the link $link"
    done
done) >"$work/broken"
[ ! -s "$work/broken" ] || { cat "$work/broken"; exit 1; }

echo "== find_package"
# by itself cgt::cgt is the archive; each component makes it the library of that name
everything="shared;picture;trajectory"
[ ! -e "$prefix/include/cgt/mpi.h" ] || everything="$everything;mpi"
for components in "" static "$everything"; do
    folder=package$(echo "$components" | tr -d ";")
    configure "$folder" -DCMAKE_PREFIX_PATH="$prefix" -DCONSUMER_COMPONENTS="$components" ||
        { cat "$work/log"; exit 1; }
    build "$folder"
    shared=$(readelf -d "$work/$folder/simulate" | grep -c 'NEEDED.*libcgt\.so' || true)
    case $components in
    shared*) [ "$shared" -eq 1 ] ;;
    *)       [ "$shared" -eq 0 ] ;;
    esac
    for library in cgt static shared; do
        "$@" "$work/$folder/consumer_$library"
    done
    for library in picture picture_static picture_shared; do
        expect_spheres "$@" "$work/$folder/draw_spheres_$library"
    done
    expect_frames "$@" "$work/$folder/print_frames"
done
if [ "${everything##*;}" = mpi ]; then
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    (cd "$work" && "$work/packagesharedpicturetrajectorympi/mpi_balls" 1 first)
fi
for program in simulate simulate_cxx; do
    [ "$program" = simulate ] || [ -e "$work/package/$program" ] || continue # no C++ compiler
    expect_picture "$@" "$work/package/$program"
    expect_picture "$@" "$work/package$(echo "$everything" | tr -d ";")/$program"
done
if configure refused -DCMAKE_PREFIX_PATH="$prefix" -DCONSUMER_COMPONENTS="shared;fast"; then
    echo "a component that does not exist was found"
    exit 1
fi
tr '\n' ' ' <"$work/log" | tr -s ' ' | grep -qF 'cgt has no component "fast": there are "shared", "static", "picture", "trajectory"' ||
    { cat "$work/log"; exit 1; }

echo "== pkg-config"
if ! command -v pkg-config >/dev/null; then
    echo "pkg-config is not installed"
    exit 1
fi
pc=$(find "$prefix" -name cgt.pc)
export PKG_CONFIG_LIBDIR="${pc%/*}"
version=$(sed -nE 's/.*VERSION_STRING "(.*)"/\1/p' "$prefix/include/cgt/version.h")
for name in cgt cgt-static cgt-picture cgt-picture-static cgt-trajectory; do
    [ "$(pkg-config --modversion "$name")" = "$version" ]
done
libdir=$(pkg-config --variable=libdir cgt)
if [ "${everything##*;}" = mpi ]; then
    for name in cgt-mpi cgt-mpi-static; do
        [ "$(pkg-config --modversion "$name")" = "$version" ]
        # shellcheck disable=SC2046
        OMPI_CC=$cc mpicc -std=c11 "$source/examples/mpi_balls.c" -o "$work/$name" $(pkg-config --cflags --libs "$name") -lm \
            -Wl,-rpath,"$libdir"
        (cd "$work" && "./$name" 1 "$name")
        cmp "$work/first_0.png" "$work/${name}_0.png"
    done
fi
# compile NAME FLAGS...: the consumer and the example
compile() {
    name=$1
    shift
    "$cc" -std=c11 "$source/tests/repository/consumer/consumer.c" -o "$work/$name" "$@"
    "$cc" -std=c11 -ffp-contract=off "$source/examples/simulate.c" -o "$work/simulate_$name" "$@" -lm
}
# shellcheck disable=SC2046 # flags are several words
compile shared $(pkg-config --cflags --libs cgt) -Wl,-rpath,"$libdir"
# the archive, though the shared library lies beside it: without a path to that the program would not start
# shellcheck disable=SC2046
compile static $(pkg-config --cflags --libs cgt-static)
# shellcheck disable=SC2046
"$cc" -std=c11 "$source/examples/draw_spheres.c" -o "$work/spheres_shared" $(pkg-config --cflags --libs cgt-picture) -lm \
    -Wl,-rpath,"$libdir"
# shellcheck disable=SC2046
"$cc" -std=c11 "$source/examples/draw_spheres.c" -o "$work/spheres_static" \
    $(pkg-config --cflags --libs cgt-picture-static)
expect_spheres "$@" "$work/spheres_shared"
expect_spheres "$@" "$work/spheres_static"
mkdir "$work/archive"
cp "$libdir/libcgt.a" "$work/archive" # alone, so that the linker cannot take the shared one
# shellcheck disable=SC2046
compile private -L"$work/archive" $(pkg-config --cflags --libs --static cgt | sed "s|-L[^ ]*||")
for name in shared static private; do
    "$@" "$work/$name"
    expect_picture "$@" "$work/simulate_$name"
done
# shellcheck disable=SC2046
"$cc" -std=c11 -Wall -Wextra -Werror "$source/tests/repository/consumer/print_frames.c" -o "$work/print_frames" \
    $(pkg-config --cflags --libs cgt-trajectory) -Wl,-rpath,"$libdir"
expect_frames "$@" "$work/print_frames"
if readelf -d "$libdir/libcgt-trajectory.so" | grep 'NEEDED.*assimp'; then
    echo "the readers need assimp before a mesh is read"
    exit 1
fi

echo "== the library alone"
"$cmake" -S "$source" -B "$work/alone" -DCGT_ONLY_LIBRARY=ON -DCGT_ONLY_VARIANTS=portable -DCMAKE_C_COMPILER="$cc" \
    ${toolchain:+-DCMAKE_TOOLCHAIN_FILE="$toolchain"} >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
grep -q '"file".*/src/core/memory.c"' "$work/alone/compile_commands.json"
if grep '"file"' "$work/alone/compile_commands.json" | grep -vE '/(src|backends|picture)/[a-z_/]*\.c"'; then
    echo "the files above are compiled with CGT_ONLY_LIBRARY"
    exit 1
fi

echo "== add_subdirectory"
# flags_of FOLDER: those that a file of the library gets
flags_of() { grep -F 'src/core/memory.c' "$work/$1/compile_commands.json" | grep '"command"'; }
configure below -DCONSUMER_SOURCE="$source" -DCGT_ONLY_VARIANTS=portable || { cat "$work/log"; exit 1; }
flags_of below | grep -q -e ' -O3 '
flags_of below | grep -q -e '-DNDEBUG'
# a choice of the user's stands; it also makes the test shorter
configure below -DCMAKE_C_FLAGS=-O1 || { cat "$work/log"; exit 1; }
if flags_of below | grep -q -e ' -O3 '; then
    echo "-O1 in CFLAGS was overridden"
    exit 1
fi
build below
"$@" "$work/below/consumer_cgt"
"$@" "$work/below/consumer_shared"
for program in simulate simulate_cxx; do
    [ "$program" = simulate ] || [ -e "$work/below/$program" ] || continue
    expect_picture "$@" "$work/below/$program"
done
