#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# run.sh SOURCE_DIR BUILD_DIR CMAKE CC toolchain=FILE [EMULATOR...]
# Installs the library, moves it to another place, and there
#   compiles each installed header alone, as C and, but for the C-only vocabulary, as C++
#   compiles and runs a program written for an SPU with the vocabulary alone, in each of its forms
#   looks for the licence (check_components.sh looks at the texts)
#   builds and runs a project that uses find_package(cgt), with and without components, as C and as C++, and the readers
#   calls find_package(cgt) twice, and loads each library while a program runs
#   builds and runs the same programs through pkg-config, static and shared, though both are installed
#   configures the library alone
#   builds and runs them with add_subdirectory, where a project without a build type still gets an optimised library. It
#   would compile the same as BUILD_DIR has compiled, so that those libraries serve
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

# the example of figures writes on them
has_text=no
[ -z "$(find "$prefix" -name cgt-figure.pc -exec grep freetype2 {} +)" ] || has_text=yes

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
    "$cmake" -S "$source/tests/repository/consumer" -B "$work/$folder" -G "Unix Makefiles" -DCMAKE_C_COMPILER="$cc" \
        ${toolchain:+-DCMAKE_TOOLCHAIN_FILE="$toolchain"} "$@" >"$work/log" 2>&1
}
build() {
    folder=$1
    shift
    "$cmake" --build "$work/$folder" -j2 "$@" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
}
# expect_file NAME COMMAND...: another example writes the same file, NAME.png, in every build
expect_file() {
    name=$1
    shift
    (cd "$work" && "$@")
    [ -e "$work/first_$name" ] || cp "$work/$name.png" "$work/first_$name"
    cmp "$work/$name.png" "$work/first_$name"
    rm "$work/$name.png"
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

echo "== licence"
[ -s "$prefix/share/doc/cgt/LICENSE" ]
[ -s "$prefix/share/doc/cgt/NEWS" ]

echo "== find_package"
# by itself cgt::cgt is the archive; each component makes it the library of that name
everything="shared;picture;figure;trajectory"
[ ! -e "$prefix/include/cgt/mpi.h" ] || everything="$everything;mpi"
for components in "" "static;figure" "$everything"; do
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
        expect_file spheres "$@" "$work/$folder/draw_spheres_$library"
    done
    if [ $has_text = yes ]; then
        for library in figure figure_static figure_shared; do
            expect_file figure "$@" "$work/$folder/draw_$library"
        done
    fi
    expect_frames "$@" "$work/$folder/print_frames"
done
if [ "${everything##*;}" = mpi ]; then
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    (cd "$work" && "$work/packagesharedpicturefiguretrajectorympi/mpi_balls" 1 first)
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
tr '\n' ' ' <"$work/log" | tr -s ' ' | grep -qF 'cgt has no component "fast": there are "shared", "static", "picture", "figure", "trajectory"' ||
    { cat "$work/log"; exit 1; }

echo "== find_package twice"
# twice FIRST SECOND TARGET: a project that finds the library with components, then with others, and links TARGET
twice() {
    mkdir -p "$work/twice"
    printf '#include <cgt/cgt.h>\nint main(void) { return cgt_get_version() == 0; }\n' >"$work/twice/main.c"
    cat >"$work/twice/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.13)
project(twice C)
find_package(cgt REQUIRED $1)
find_package(cgt REQUIRED $2)
add_executable(main main.c)
target_link_libraries(main $3)
END
    rm -rf "$work/twice/build"
    "$cmake" -S "$work/twice" -B "$work/twice/build" -DCMAKE_C_COMPILER="$cc" -DCMAKE_PREFIX_PATH="$prefix" \
        ${toolchain:+-DCMAKE_TOOLCHAIN_FILE="$toolchain"} >"$work/log" 2>&1 &&
        "$cmake" --build "$work/twice/build" >>"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
}
says_otherwise() { tr '\n' ' ' <"$work/log" | tr -s ' ' | grep -q "cgt::cgt is cgt::$1 since an earlier find_package"; }
twice "" "COMPONENTS trajectory" "cgt::cgt cgt::trajectory"
twice "" "COMPONENTS static" cgt::cgt
twice "COMPONENTS shared" "" cgt::cgt
if says_otherwise shared || says_otherwise static; then
    cat "$work/log"
    exit 1
fi
twice "" "COMPONENTS shared" cgt::cgt
says_otherwise static || { cat "$work/log"; exit 1; }
twice "COMPONENTS shared" "COMPONENTS static" cgt::cgt
says_otherwise shared || { cat "$work/log"; exit 1; }
if [ "${everything##*;}" = mpi ]; then
    twice "" "COMPONENTS mpi" cgt::mpi
    twice "COMPONENTS trajectory" "COMPONENTS mpi" cgt::mpi
fi

echo "== libraries that are loaded while a program runs"
cat >"$work/load.c" <<'END'
#include <dlfcn.h>
#include <stdio.h>
int main(int argc, char **argv)
{
    for (int i = 1; i < argc; i++)
        if (!dlopen(argv[i], RTLD_NOW | RTLD_LOCAL)) {
            puts(dlerror());
            return 1;
        }
    return 0;
}
END
"$cc" -std=c11 "$work/load.c" -o "$work/load" -ldl
find "$prefix" -name 'libcgt*.so' >"$work/libraries"
[ "$(wc -l <"$work/libraries")" -ge 3 ]
while read -r library; do
    "$@" "$work/load" "$library"
done <"$work/libraries"

echo "== pkg-config"
if ! command -v pkg-config >/dev/null; then
    echo "pkg-config is not installed"
    exit 1
fi
pc=$(find "$prefix" -name cgt.pc)
export PKG_CONFIG_PATH="${pc%/*}" # before the system's, which have FreeType
version=$(sed -nE 's/.*VERSION_STRING "(.*)"/\1/p' "$prefix/include/cgt/version.h")
for name in cgt cgt-static cgt-picture cgt-picture-static cgt-figure cgt-figure-static cgt-trajectory; do
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
expect_file spheres "$@" "$work/spheres_shared"
expect_file spheres "$@" "$work/spheres_static"
for name in cgt-figure cgt-figure-static; do
    # shellcheck disable=SC2046
    "$cc" -std=c11 "$source/examples/draw_figure.c" -o "$work/$name" $(pkg-config --cflags --libs "$name") -lm \
        -Wl,-rpath,"$libdir"
    [ $has_text = no ] || expect_file figure "$@" "$work/$name"
done
awk '/^```/ { inside = $0 == "```c"; next } inside' "$source/docs/guide/figure.md" >"$work/water.c" # as the guide says
# shellcheck disable=SC2046
"$cc" -std=c11 -Wall -Wextra -Wshadow -Werror "$work/water.c" -o "$work/water" $(pkg-config --cflags --libs cgt-figure-static)
expect_file water "$@" "$work/water"
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
if grep '"file"' "$work/alone/compile_commands.json" | grep -vE '/(src|backends|picture|figure)/[a-z_/]*\.c"'; then
    echo "the files above are compiled with CGT_ONLY_LIBRARY"
    exit 1
fi

echo "== add_subdirectory"
# flags_of FOLDER: those that a file of the library gets
flags_of() { grep -F 'src/core/memory.c' "$work/$1/compile_commands.json" | grep '"command"'; }
setting() { sed -nE "s/^$1:[A-Z]+=//p" "$build/CMakeCache.txt"; }
configure below -DCONSUMER_SOURCE="$source" -DCGT_ONLY_VARIANTS="$(setting CGT_ONLY_VARIANTS)" \
    -DCGT_WERROR="$(setting CGT_WERROR)" -DCMAKE_C_FLAGS="$(setting CMAKE_C_FLAGS)" || { cat "$work/log"; exit 1; }
flags_of below | grep -q -e ' -O3 '
flags_of below | grep -q -e '-DNDEBUG'
# commands_of FOLDER: what is compiled of the libraries, and how, a word a line; but for what a build type sets
commands_of() {
    awk -F '"' '$2 == "command" { command = $4 } $2 == "file" { print $4, command }' "$1/compile_commands.json" |
        grep -E "^$source/(src|backends|picture|figure)/" | grep -E '/cgt_(objects|[a-z_]*archive_objects|kernel_[a-z0-9]+)\.dir/' |
        sed -E 's/ -o [^ ]*//; s/ -O[0-9s]?//g; s/ -g[0-9]?//g; s/ -DNDEBUG//g' | while read -r file command; do
        printf '%s %s\n' "$file" "$(printf '%s\n' "$command" | tr -s ' ' '\n' | LC_ALL=C sort -u | tr '\n' ' ')"
    done | LC_ALL=C sort
}
commands_of "$work/below" >"$work/commands_below"
commands_of "$build" >"$work/commands"
[ "$(wc -l <"$work/commands")" -gt 100 ]
diff "$work/commands_below" "$work/commands" || { echo "add_subdirectory (<) compiles otherwise than the build (>)"; exit 1; }
# the programs alone: make's targets without what they depend on
mkdir -p "$work/below/cgt/lib"
cp -P "$build"/lib/lib* "$work/below/cgt/lib"
built="consumer_cgt consumer_shared simulate"
[ ! -e "$work/below/CMakeFiles/simulate_cxx.dir" ] || built="$built simulate_cxx"
for program in $built; do
    build below --target "$program/fast"
done
"$@" "$work/below/consumer_cgt"
"$@" "$work/below/consumer_shared"
for program in simulate simulate_cxx; do
    [ "$program" = simulate ] || [ -e "$work/below/$program" ] || continue
    expect_picture "$@" "$work/below/$program"
done
# a choice of the user's stands
configure below -DCMAKE_C_FLAGS=-O1 || { cat "$work/log"; exit 1; }
if flags_of below | grep -q -e ' -O3 '; then
    echo "-O1 in CFLAGS was overridden"
    exit 1
fi
