#!/bin/sh
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# Files and folders that the user may not read or write, and disks that are full: a sentence with the path, exit code 1,
# and nothing is left behind. Root may do everything, so the programs run as nobody then.
#   permissions_cli.sh CGT_RENDER DATA_DIR CGT_CONVERT
convert=$(cd "$(dirname "$3")" && pwd)/$(basename "$3")
set -- "$1" "$2"
. "$(dirname "$0")/../cli.sh"
render=$program
wanted=1 # exit code

user=""
if [ "$(id -u)" -eq 0 ]; then
    user="setpriv --reuid=65534 --regid=65534 --clear-groups"
    if ! $user true 2>/dev/null; then
        echo "no setpriv here, and root may do everything"
        exit 77
    fi
    chmod 755 "$tmp"
fi
if ! $user "$render" --version >/dev/null 2>&1; then
    echo "another user cannot run $render: its folders are closed"
    exit 77
fi

# what lies in $tmp/$1, but for the names that follow
left() {
    folder=$1
    shift
    for file in $(ls -A "$tmp/$folder"); do
        case " $* " in *" $file "*) ;; *) echo "$file" ;; esac
    done
}
# refuses FOLDER "EXPECTED FILES" PATTERN PROGRAM ARGUMENTS...: the exit code, the sentence, and no more than these
# files
refuses() {
    folder=$1 files=$2 pattern=$3 program=$4
    shift 4
    (cd "$tmp" && exec $user "$program" "$@") >"$tmp/stdout" 2>"$tmp/stderr" </dev/null
    got=$?
    [ $got -eq $wanted ] || fail "exit code $got, not $wanted: $program $*: $(head -n 3 "$tmp/stderr")"
    says err "$pattern"
    more=$(left "$folder" $files)
    [ -z "$more" ] || fail "left behind by $program $*: $more"
}
own() {
    [ -z "$user" ] || chown 65534:65534 "$@"
}

size="-q -s 64x36 -c 0,-9,2,0,0,0,0,0,1,40"
printf '1\none\nC 0 0 0\n' >"$tmp/one.xyz"
printf '1\none\nC 0 0 0\n1\ntwo\nC 1 0 0\n' >"$tmp/two.xyz"
mkdir "$tmp/out" "$tmp/closed" "$tmp/readable" "$tmp/shared"
own "$tmp/out"
chmod 644 "$tmp/one.xyz" "$tmp/two.xyz"

# ---- Inputs --------------------------------------------------------------------------------------------------------

cp "$tmp/one.xyz" "$tmp/secret.xyz"
cp "$tmp/one.xyz" "$tmp/closed/in.xyz"
chmod 000 "$tmp/secret.xyz" "$tmp/closed"
refuses out "" 'secret.xyz: Permission denied' "$render" $size -o out/%d.png secret.xyz
refuses out "" 'closed/in.xyz: Permission denied' "$render" $size -o out/%d.png closed/in.xyz
refuses out "" 'secret.xyz: Permission denied' "$render" $size -o out/%d.png one.xyz secret.xyz
printf 'size=64x36\n' >"$tmp/secret.txt"
chmod 000 "$tmp/secret.txt"
wanted=2 # as for an option that is wrong
refuses out "" 'secret.txt: Permission denied' "$render" $size --settings secret.txt -o out/%d.png one.xyz
wanted=1
refuses out "" 'secret.xyz: Permission denied' "$convert" secret.xyz out/a.frames

# ---- Outputs -------------------------------------------------------------------------------------------------------

chmod 555 "$tmp/readable"
refuses readable "" 'readable/0.png: cannot write: Permission denied' "$render" $size -o readable/%d.png one.xyz
refuses readable "" 'readable/new: .*Permission denied' "$render" $size -o readable/new/%d.png one.xyz
refuses readable "" 'readable/log: .*Permission denied' "$render" $size --log-file readable/log -o out/%d.png one.xyz
rm -f "$tmp/out"/*
refuses readable "" 'readable/sheet.png: cannot write: Permission denied' "$render" $size -o out/%d.png \
    --contact-sheet readable/sheet.png two.xyz
rm -f "$tmp/out"/*
if command -v ffmpeg >/dev/null 2>&1; then
    refuses readable "" 'readable/a.mp4: cannot write: Permission denied' "$render" $size -o readable/a.mp4 two.xyz
fi
refuses readable "" 'readable/a.frames: .*Permission denied' "$convert" one.xyz readable/a.frames

# A file of somebody else's that exists: in a folder where the name could be given to another file, and in a shared one,
# where it could not.
if [ -n "$user" ]; then
    for folder in out shared; do
        chmod 777 "$tmp/$folder"
        [ $folder = out ] || chmod 1777 "$tmp/$folder"
        echo theirs >"$tmp/$folder/0.png"
        echo theirs >"$tmp/$folder/a.frames"
        chmod 644 "$tmp/$folder/0.png" "$tmp/$folder/a.frames"
        refuses $folder "0.png a.frames" "$folder/0.png: cannot write: Permission denied" "$render" $size -o $folder/%d.png one.xyz
        refuses $folder "0.png a.frames" "$folder/a.frames: .*Permission denied" "$convert" one.xyz $folder/a.frames
        chmod 666 "$tmp/$folder/0.png"
        if [ $folder = shared ]; then # may be written, but not be replaced
            refuses $folder "0.png a.frames" "$folder/0.png: cannot write: Operation not permitted" "$render" $size \
                -o $folder/%d.png one.xyz
        fi
        for file in 0.png a.frames; do
            [ "$(cat "$tmp/$folder/$file")" = theirs ] || fail "$folder/$file was overwritten"
        done
    done
fi

# ---- A full disk ---------------------------------------------------------------------------------------------------

# A file system of 64 KB, which nobody else sees and which goes with its process.
mkdir "$tmp/small"
full() {
    files=$1 pattern=$2 program=$3
    shift 3
    (cd "$tmp" && unshare -m sh -c 'mount -t tmpfs -o size=64k,mode=777 none small && "$@"; got=$?; ls -A small >left; exit $got' \
        sh $user "$program" "$@") >"$tmp/stdout" 2>"$tmp/stderr" </dev/null
    got=$?
    [ $got -eq 1 ] || fail "exit code $got, not 1, on a full disk: $program $*: $(head -n 3 "$tmp/stderr")"
    says err "$pattern"
    found=$(tr '\n' ' ' <"$tmp/left")
    [ "$found" = "$files" ] || fail "a full disk has '$found', not '$files': $program $*"
}
if unshare -m sh -c "mount -t tmpfs -o size=64k none '$tmp/small'" 2>/dev/null; then
    # lines that no compression makes small
    awk 'BEGIN { srand(1); for (f = 0; f < 2; f++) { print "20000\nf"; for (i = 0; i < 20000; i++)
        print "C", 9 * rand(), 9 * rand(), 9 * rand() } }' >"$tmp/many.xyz"
    full "" 'small/0.png: cannot write: No space left on device' "$render" -q -s 1280x720 -k id -t 1 -o small/%d.png many.xyz
    full "" 'small/run.gif: cannot write' "$render" -q -s 640x360 -k id -o small/run.gif many.xyz
    full "" 'small/a.frames.*: No space left on device' "$convert" many.xyz small/a.frames
else
    echo "no file systems can be mounted here: full disks are not tested"
fi

[ $failures -eq 0 ] || exit 1
echo "all good"
