#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# wasm_freetype.sh
# Builds FreeType for WebAssembly into build/sysroot-wasm, where the toolchain file looks for it: what draws the TrueType
# font of the page, no more, of the version that Debian's programs draw with, so that letters have the same pixels.
# Nothing is done where it is there.
set -euo pipefail
cd "$(dirname "$0")/../.."
sysroot=$PWD/build/sysroot-wasm source=$PWD/build/freetype-source
[ ! -e "$sysroot/lib/libfreetype.a" ] || exit 0
cmake/toolchains/debian_source.sh freetype "$source"

# Without packed and variable fonts, and those of pictures.
options=$source/include/freetype/config/ftoption.h
sed -i '/^#define  *FT_CONFIG_OPTION_\(USE_ZLIB\|SVG\)/d; /^#define  *TT_CONFIG_OPTION_GX_VAR_SUPPORT/d' "$options"
cat >"$source/include/freetype/config/ftmodule.h" <<'END'
FT_USE_MODULE(FT_Module_Class, autofit_module_class)
FT_USE_MODULE(FT_Driver_ClassRec, tt_driver_class)
FT_USE_MODULE(FT_Module_Class, psnames_module_class)
FT_USE_MODULE(FT_Module_Class, sfnt_module_class)
FT_USE_MODULE(FT_Renderer_Class, ft_smooth_renderer_class)
END

objects=$sysroot/freetype
mkdir -p "$objects" "$sysroot/include" "$sysroot/lib"
for part in base/ft{system,init,debug,base,bitmap,glyph} autofit/autofit psnames/psnames sfnt/sfnt smooth/smooth \
    truetype/truetype; do
    echo "$part"
done | xargs -P "$(nproc)" -I PART sh -c 'emcc -msimd128 -pthread -Os -DFT2_BUILD_LIBRARY -I "$1/include" \
    -c "$1/src/PART.c" -o "$2/$(basename PART).o"' sh "$source" "$objects"
emar rcs "$objects/libfreetype.a" "$objects"/*.o
cp -r "$source/include" "$sysroot/include/freetype2"
mv "$objects/libfreetype.a" "$sysroot/lib/libfreetype.a"
echo "wasm_freetype: $sysroot/lib/libfreetype.a"
