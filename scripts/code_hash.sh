#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# code_hash.sh
# Prints a short hash of the revision's files without its texts, on which neither fuzzers nor planted bugs depend.
set -euo pipefail
cd "$(dirname "$0")/.."
git ls-tree -r HEAD -- . | grep -vE $'\t(docs/|[A-Z]+(\\.md)?$)' | sha256sum | cut -c 1-12
