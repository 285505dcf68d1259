# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Shared by the tests of command lines. Sourced by a script with the arguments PROGRAM DATA_DIR [EMULATOR...]:
#   . "$(dirname "$0")/cli.sh"
# Sets program, data, emulator, tmp, a folder removed with the script, and slow: "yes" where CGT_TEST_SCALE is below
# 0.1, else nothing; there pictures are smaller and frames fewer.
set -u
program=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
name=$(basename "$1")
data=$(cd "$2" && pwd)
shift 2
emulator="$*"
slow=$(awk -v scale="${CGT_TEST_SCALE:-1}" 'BEGIN { if (scale < 0.1) print "yes" }')
tmp=$(mktemp -d) || exit 1
trap 'rm -rf "$tmp"' EXIT
failures=0

fail() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}

# run CODE ARGUMENTS...: runs the program in $tmp, output in $tmp/stdout and $tmp/stderr, and checks the exit code.
run() {
    wanted=$1
    shift
    (cd "$tmp" && exec $emulator "$program" "$@") >"$tmp/stdout" 2>"$tmp/stderr" </dev/null
    got=$?
    [ "$got" -eq "$wanted" ] || fail "exit code $got, not $wanted: $name $*: $(head -n 3 "$tmp/stderr")"
}

# says out|err PATTERN: the output or the error text has a line that matches.
says() {
    grep -q -e "$2" "$tmp/std$1" || fail "no \"$2\" in std$1: $(head -n 3 "$tmp/std$1")"
}

# refuses CODE PATTERN ARGUMENTS...: an error with a text, no picture in the folder no. $refused: options that go before.
# A script that has a better check defines its own.
refused='-q -s 32x18 -o no/%d.png'
refuses() {
    refused_code=$1
    refused_text=$2
    shift 2
    rm -rf "$tmp/no"
    run "$refused_code" $refused "$@"
    says err "$refused_text"
    says err "$name: "
    [ ! -s "$tmp/stdout" ] || fail "output in addition to an error: $name $*"
    [ -z "$(ls "$tmp/no" 2>/dev/null)" ] || fail "pictures in addition to an error: $name $*"
}

# draw NAME OPTIONS...: renders one picture as NAME.png, with the options $drawn_with, too.
drawn_with=
draw() {
    drawn=$1
    shift
    run 0 -q --no-metadata -s 96x54 $drawn_with -o "$drawn.png" "$@"
}

# differs A B TEXT, same A B TEXT: two pictures are not the same, are the same.
differs() { cmp -s "$tmp/$1.png" "$tmp/$2.png" && fail "$3 changes nothing"; }
same() {
    cmp -s "$tmp/$1.png" "$tmp/$2.png" ||
        fail "$3: $(cmp -l "$tmp/$1.png" "$tmp/$2.png" 2>&1 | wc -l) bytes differ, sizes $(wc -c <"$tmp/$1.png") and $(wc -c <"$tmp/$2.png")"
}
