#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# code_hash.sh
# Prints a short hash of the files as they are, without texts, on which neither fuzzers nor planted bugs depend.
set -euo pipefail
cd "$(dirname "$0")/.."
if git rev-parse >/dev/null 2>&1; then
    git ls-files --cached --others --exclude-standard
else
    find . -type f -not -path './build/*' -not -path './out/*' | sed 's#^\./##'
fi | grep -vE '^(docs/|[A-Z]+(\.md)?$)' | LC_ALL=C sort | while IFS= read -r file; do [ ! -f "$file" ] || echo "$file"; done |
    xargs -d '\n' sha256sum | sha256sum | cut -c 1-12
