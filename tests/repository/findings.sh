# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Shared by the checks that go on after the first thing they find. Sourced:
#   . "${0%/*}/findings.sh"
# Sets work, a folder removed with the script, and status, 0 until something fails. Sorts are those of the locale C.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export LC_ALL=C
status=0

# fail TEXT FILE: says so, with the lines of the file.
fail() {
    echo "FAILED: $1"
    sed 's/^/    /' "$2"
    status=1
}
