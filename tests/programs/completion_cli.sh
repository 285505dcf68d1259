#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
# shellcheck shell=bash
#
# programs/completion/cgt.bash against the programs: it offers all long options of --help and no others, and words that
# the programs take.
#   completion_cli.sh COMPLETION FOLDER_OF_PROGRAMS PROGRAM...
# Started by any shell, it goes on in bash. Without bash: exit code 77.
if [ -z "${CGT_COMPLETION_IN_BASH:-}" ]; then
    command -v bash >/dev/null 2>&1 || { echo "no bash"; exit 77; }
    CGT_COMPLETION_IN_BASH=1 exec bash "$0" "$@"
fi
set -u
completion=$1 folder=$(cd "$2" && pwd)
shift 2
PATH=$folder:$PATH
failures=0
fail() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}
# shellcheck source=/dev/null
. "$completion"

# offers WORD...: what is offered where the last word is being written, one a line.
offers() {
    COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
    _cgt "$1"
    [ ${#COMPREPLY[@]} -eq 0 ] || printf '%s\n' "${COMPREPLY[@]}"
}
# expect TEXT WORD...: exactly this, in any order
expect() {
    local wanted=$1 got
    shift
    got=$(offers "$@" | sort | tr '\n' ' ')
    [ "$got" = "$wanted" ] || fail "'$*' is offered '$got', not '$wanted'"
}

# has PROGRAM: whether it is among those of this build
programs=" $* "
has() { [[ $programs == *" $1 "* ]]; }

# all_options PROGRAM [SUB-COMMAND]: as --usage lists them, which has another layout than --help
all_options() { "$@" --usage | grep -o -e '--[a-z0-9][a-z0-9-]*' | sort -u; }
for program in "$@"; do
    all_options "$program" >/dev/null || fail "$program --usage"
    missing=$(comm -3 <(all_options "$program") <(offers "$program" -- | tr -d = | sort -u))
    [ -z "$missing" ] || fail "$program: listed or offered alone: $missing"
    [ "$(offers "$program" -- | wc -l)" -ge 3 ] || fail "$program: few options"
    [[ $(complete -p "$program") == *_cgt* ]] || fail "no completion for $program"
done

if has cgt-render; then
    expect '--stats --style= ' cgt-render --st
    expect 'paper plain ' cgt-render --style=p
    expect 'paper plain ' cgt-render --style = p # as where = breaks words
    expect 'paper plain soft ' cgt-render --style =
    expect 'plasma ' cgt-render --colormap pl
    expect '' cgt-render --settings pa # files, by bash itself
    expect '' cgt-render po
    # Each word is taken, and some other word is not.
    for option in style colormap color up preset cell cell-assignment material; do
        words=$(_cgt_values cgt-render --$option)
        [ -n "$words" ] || fail "no words for --$option"
        needs=() # what the option is refused without
        [ $option != material ] || needs=(--bounces 1)
        [ $option != cell-assignment ] || needs=(--cell native)
        for word in $words; do
            cgt-render "${needs[@]}" --$option="$word" --print-settings x.xyz >/dev/null 2>&1 || fail "--$option=$word is refused"
        done
        cgt-render "${needs[@]}" --$option='no such/word' --print-settings x.xyz >/dev/null 2>&1 && fail "--$option takes any word"
    done
    help=$(cgt-render --help | tr -s ' \n' ' ')
    words=$(_cgt_values cgt-render --format)
    [[ $help == *"whatever its name: ${words// /, };"* && $words == lammps*frames ]] || fail "--format offers $words"
fi
if has cgt-bench; then
    listed=$(cgt-bench --help | sed -n 's/^  \([a-z]\{3,\}\)  .*/\1/p' | sort | tr '\n' ' ')
    expect "$listed" cgt-bench ''
    expect 'frame ' cgt-bench fr
    expect '--packet= --packets= ' cgt-bench frame --pac
    expect '' cgt-bench frame -k e
    expect 'nested ' cgt-bench frame --loop n
    expect 'scattered shuffled skipping sorted ' cgt-bench light -O s
    expect 'camera shuffled tile ' cgt-bench rays -O ''
    missing=$(comm -3 <(all_options cgt-bench frame) <(offers cgt-bench frame -- | tr -d = | sort -u))
    [ -z "$missing" ] || fail "cgt-bench frame: listed or offered alone: $missing"
fi
[ $failures -eq 0 ] || exit 1
echo "completion of $*"
