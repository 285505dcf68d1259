#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# spu_sizes.sh
# Prints the table of docs/reports/cell_sizes.md: what every kernel takes of an SPU's local store, compiled at -Os and at
# -O2 by the SPU's own compiler, which is built where it is missing. A size is the code and the constants of a file, all
# of its functions; a program has those that it uses.
set -euo pipefail
cd "$(dirname "$0")/.."
toolchain=$(scripts/spu_toolchain.sh | tee /dev/stderr | tail -n 1)
{
    cmake --preset spu -DCGT_SPU_TOOLCHAIN="$toolchain" -DCGT_BUILD_TESTS=OFF -DCGT_BUILD_RENDER=OFF \
        -DCGT_BUILD_MESHES=OFF
    cmake --build build/spu -j "$(nproc)" --target cgt_kernel_spu cgt_kernel_spu_small
} >&2

cd build/spu/spu
echo "| file of \`src/kernel/\` or \`src/papers/kernel/\` | -Os | -O2 |"
echo "|---|---:|---:|"
(cd cgt_kernel_spu && find kernel papers/kernel -name '*.c.o' | LC_ALL=C sort) | while read -r object; do
    name=${object#papers/}
    size=$("$toolchain/spu-elf-size" {cgt_kernel_spu_small,cgt_kernel_spu}/"$object" |
        awk 'NR > 1 { printf " %d |", $1 }')
    name=${name#kernel/}
    echo "| \`${name%.o}\` |$size"
done
