#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# parts.sh PROGRAMS_WEB
# The parts of the page that need no browser, by Node: 77 where there is none.
command -v node >/dev/null || { echo "parts.sh: there is no Node here"; exit 77; }
exec node "$(dirname "$0")/test_parts.js" "$1"
