#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# web.sh
# Builds the page that traces: build/web/cgt-web.html, .js, .wasm.gz and .ttf.gz, the font of its texts, which any server
# delivers as they are. Where its answers have the headers of docs/guide/web.md, the page uses all threads.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/dependencies.sh page
export NODE_PATH=${NODE_PATH:-/usr/share/nodejs} # Emscripten's acorn
if command -v ccache >/dev/null; then
    export CMAKE_C_COMPILER_LAUNCHER=ccache
fi
cmake/toolchains/wasm_freetype.sh
cmake --preset wasm -B build/page -DCGT_ONLY_LIBRARY=ON -DCGT_BUILD_TEXT=ON
cmake --build build/page -j "$(nproc)" --target cgt-web

out=build/web
mkdir -p "$out"
gzip -9nc build/page/bin/cgt-web.wasm >"$out/cgt-web.wasm.gz"
gzip -9nc /usr/share/fonts/truetype/dejavu/DejaVuSans.ttf >"$out/cgt-web.ttf.gz"
# One script: Emscripten's, that of its threads as a text, those of the page.
{
    cat build/page/bin/cgt-web.js
    printf 'const threadScript = '
    node -e 'process.stdout.write(JSON.stringify(require("fs").readFileSync(process.argv[1], "utf8")))' \
        build/page/bin/cgt-web.worker.js
    printf ';\n'
    cat programs/web/web_{ask,files,movie,out,panel,page}.js
} >"$out/cgt-web.js"
# Every sixth frame of a run, in the page itself.
awk '/^ITEM: TIMESTEP/ { frame++ } frame % 6 == 0' examples/data/pour2k.lammpstrj | gzip -9n | base64 -w 120 >"$out/shipped"
sed -e "/@SHIPPED@/{r $out/shipped" -e 'd}' programs/web/cgt-web.html >"$out/cgt-web.html"
rm "$out/shipped"
wc -c "$out"/cgt-web.*
