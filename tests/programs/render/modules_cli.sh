#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The modules of cgt-render: in the build tree, in an installed tree that was moved, and absent. There, too, licence,
# completion and man page.
#   modules_cli.sh CGT_RENDER DATA_DIR CMAKE BUILD_DIR IMAGES GLTF
# IMAGES: ON where the build has OpenImageIO; GLTF: ON where it has tinygltf.
cmake=$3 build=$4 images=$5 gltf=$6
set -- "$1" "$2"
. "$(dirname "$0")/../cli.sh"
printf '1\none\nC 0 0 0\n' >"$tmp/one.xyz"

# The program itself starts without what only some formats need.
if command -v ldd >/dev/null 2>&1; then
    ldd "$program" >"$tmp/libraries" 2>/dev/null
    grep -E 'OpenImageIO|assimp' "$tmp/libraries" && fail "cgt-render is linked to the libraries above"
    [ "$(wc -l <"$tmp/libraries")" -lt 40 ] || fail "cgt-render loads $(wc -l <"$tmp/libraries") libraries"
fi

# A triangle.
cat >"$tmp/one.gltf" <<'END'
{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":
{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,
"byteLength":36}],"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,
END
printf '%s"}]}' AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA >>"$tmp/one.gltf"
tr -d '\n' <"$tmp/one.gltf" >"$tmp/triangle.gltf"

# writes FORMAT...: pictures of these formats, which begin as they do.
writes() {
    for format in "$@"; do
        run 0 -q -s 64x36 -o "$format/%d.$format" one.xyz
        magic=$(head -c 3 "$tmp/$format/0.$format" 2>/dev/null | od -An -v -tx1 | tr -d ' \n')
        case $format:$magic in
        png:89504e | exr:762f31 | jpg:ffd8ff | jpeg:ffd8ff | tif:49492a | tiff:49492a) ;;
        *) fail "0.$format begins with $magic" ;;
        esac
        rm -rf "${tmp:?}/$format"
    done
}
writes png
[ "$images" != ON ] || writes exr jpg jpeg tif tiff
[ "$gltf" != ON ] || run 0 -q -n triangle.gltf

"$cmake" --install "$build" --component programs --prefix "$tmp/first" >"$tmp/log" 2>&1 || fail "$(tail -n 3 "$tmp/log")"
mv "$tmp/first" "$tmp/moved"
program=$tmp/moved/bin/cgt-render
for file in doc/cgt/LICENSE bash-completion/completions/cgt-render; do
    [ -s "$tmp/moved/share/$file" ] || fail "share/$file is not installed"
done
if [ -e "$build/man/cgt-render.1" ]; then
    cmp -s "$build/man/cgt-render.1" "$tmp/moved/share/man/man1/cgt-render.1" || fail "the man page is not installed"
fi
if [ -x "$program" ]; then
    writes png
    [ "$images" != ON ] || writes exr jpg
    if [ "$gltf" = ON ]; then
        run 0 -q -n triangle.gltf
        find "$tmp/moved" -name 'cgt-gltf.so' -exec rm {} +
        run 1 -q -n triangle.gltf
        says err 'triangle.gltf: glTF needs tinygltf, and the module for it cannot be loaded'
    fi
    find "$tmp/moved" -name 'cgt-image.so' -exec rm {} +
    run 1 -q -s 64x36 -o gone.exr one.xyz
    says err 'gone.exr: EXR, JPEG and TIFF need OpenImageIO, and the module for it cannot be loaded'
    run 0 -q -s 64x36 -o there.png one.xyz
else
    fail "no program was installed: $(find "$tmp/moved" -type f | head -n 5)"
fi

[ $failures -eq 0 ] || exit 1
echo "all good"
