#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# when_changed.sh NAME SOURCE_DIR "INPUT..." COMMAND...
# Runs a test that compiles for itself or takes the library apart, unless it has passed here before with the same inputs,
# command and compilers: then exit code 77, skipped. Inputs are files and folders, seen from SOURCE_DIR; "names:FOLDER"
# stands for the list of files in it. What passed is kept in ${XDG_CACHE_HOME:-~/.cache}/libcgt/passed for 60 days;
# CGT_TEST_ALWAYS=1 runs all.
set -eu
name=$1 source=$2 inputs=$3
shift 3
case $source in *' '*) exec "$@" ;; esac # INPUTs are split at blanks
passed=${XDG_CACHE_HOME:-$HOME/.cache}/libcgt/passed
mkdir -p "$passed"
export LC_ALL=C

state() {
    cat "$0"
    echo "$name $*" | sed "s#$source##g"
    for word in "$@"; do
        case ${word##*/} in
        *cc|gcc*|clang*) "$word" --version ;;
        esac
    done
    for input in $inputs; do
        case $input in
        names:*) (cd "$source" && find "${input#names:}" -type f | sort) ;;
        *) (cd "$source" && find "$input" -type f | sort | xargs sha256sum) | sed "s#$source##g" ;;
        esac
    done
}
state "$@" >"$passed/$name.$$"
key=$(sha256sum <"$passed/$name.$$" | cut -d' ' -f1)
rm "$passed/$name.$$"
if [ "${CGT_TEST_ALWAYS:-}" != 1 ] && [ -e "$passed/$key" ]; then
    echo "$name: skipped: it has passed with the same files, command and compiler"
    exit 77
fi
"$@"
find "$passed" -type f -mtime +60 -delete
echo "$name" >"$passed/$key"
