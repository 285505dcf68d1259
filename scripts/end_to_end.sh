#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# end_to_end.sh [NAME=FILE.lammpstrj...]
# From text to pictures and movies, at 1280x720: cgt-render beside the peers that Debian has, each by its own road: LAMMPS
# (rerun with dump image), Tachyon and POV-Ray (a scene file made of one frame, which is not in their time). Like cameras: the
# automatic one of cgt-render, which the others get; LAMMPS takes its own, from a like side. Without files, LAMMPS makes a
# melt of 32,000 atoms (61 frames) and one of a million (8 frames): columns id type xu yu zu, 1.0 and 33 MB of text a frame.
# Rows come in turns. Prints tab-separated values, a row for each road: milliseconds a frame (least and median over the
# rounds: wall clock, start of the program included), CPU milliseconds a frame (least), peak memory in MB, bytes a frame.
#   ROUNDS  default 3
#   BIN     folder of cgt-render; default build/release/bin
#   WORK    folder for inputs and outputs, kept; default: a temporary one, removed
#   PEERS   which of "lammps tachyon povray"; default: those that are installed
# Needs /usr/bin/time (Debian: time), and ffmpeg for the movies.
set -euo pipefail
bin=$(cd "${BIN:-$(dirname "$0")/../build/release/bin}" && pwd)
rounds=${ROUNDS:-3}
[ -x "$bin/cgt-render" ] || { echo "end_to_end.sh: no $bin/cgt-render: run scripts/test.sh release first" >&2; exit 1; }
[ -x /usr/bin/time ] || { echo "end_to_end.sh: no /usr/bin/time: apt-get install time" >&2; exit 1; }
work=${WORK:-$(mktemp -d)}
mkdir -p "$work"
[ -n "${WORK:-}" ] || trap 'rm -rf "$work"' EXIT
peers=${PEERS-lammps tachyon povray}

# melt NAME CELLS STEPS EVERY: a crystal of CELLS^3 * 4 atoms that melts.
melt() {
    [ -f "$work/$1.lammpstrj" ] && return
    command -v lmp >/dev/null || { echo "end_to_end.sh: no files, and no lmp to make them: apt-get install lammps" >&2; exit 1; }
    cat >"$work/$1.in" <<END
units lj
atom_style atomic
lattice fcc 0.8442
region box block 0 $2 0 $2 0 $2
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 3.0 87287 loop geom
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0 2.5
fix 1 all nve
dump 1 all custom $4 $work/$1.lammpstrj id type xu yu zu
dump_modify 1 sort id
run $3
END
    lmp -in "$work/$1.in" -log none >"$work/$1.log" || { tail -n 5 "$work/$1.log" >&2; exit 1; }
}

# scene FILE: one frame for Tachyon and POV-Ray, with the camera in $camera.
scene() {
    awk -v camera="$camera" -v base="$1" '
        BEGIN {
            split(camera, c, ",")
            for (i = 1; i <= 3; i++) { d[i] = c[3 + i] - c[i]; l += d[i] ^ 2 }
            for (i = 1; i <= 3; i++) d[i] /= sqrt(l)
            half = c[10] * 3.14159265 / 360
            t = base ".dat"; p = base ".pov"
            print "BEGIN_SCENE\nRESOLUTION 1280 720\nCAMERA\nZOOM " cos(half) / sin(half) / 2 > t
            print "ASPECTRATIO 1\nANTIALIASING 0\nRAYDEPTH 1\nCENTER " c[1], c[2], c[3] "\nVIEWDIR " d[1], d[2], d[3] > t
            print "UPDIR " c[7], c[8], c[9] "\nEND_CAMERA\nDIRECTIONAL_LIGHT DIRECTION 0.4 0.6 -0.7 COLOR 1 1 1" > t
            print "TEXDEF A AMBIENT 0.2 DIFFUSE 0.8 SPECULAR 0 OPACITY 1 COLOR 1 0.5 0.1 TEXFUNC 0" > t
            printf "camera { location <%s,%s,%s> up y right -x*16/9 sky <%s,%s,%s> angle %s look_at <%s,%s,%s> }\n", c[1], c[2],
                c[3], c[7], c[8], c[9], atan2(sin(half) / cos(half) * 16 / 9, 1) * 360 / 3.14159265, c[4], c[5], c[6] > p
            print "light_source { <-400,-600,700> rgb 1 parallel point_at <0,0,0> shadowless }" > p
            print "#declare A = texture { pigment { rgb <1,0.5,0.1> } finish { ambient 0.2 diffuse 0.8 } }" > p
        }
        /^ITEM: ATOMS/ { if (frames++) exit; atoms = 1; next }
        /^ITEM/ { atoms = 0 }
        atoms {
            print "SPHERE CENTER " $3, $4, $5 " RAD 0.5 A" > t
            print "sphere { <" $3 "," $4 "," $5 ">,0.5 texture { A } }" > p
        }
        END { print "END_SCENE" > t }' "$2"
}

# lammps_input FILE: the box of its first frame, before the first is read.
lammps_input() {
    local box
    box=$(awk '/^ITEM: BOX BOUNDS/ { left = 3; next } left-- > 0 { printf "%s %s ", $1, $2 } /^ITEM: ATOMS/ { exit }' "$1")
    cat >"$work/rerun.in" <<END
units lj
atom_style atomic
region box block $box
create_box 1 box
mass 1 1.0
pair_style zero 2.5 nocoeff
pair_coeff * *
neighbor 0.3 bin
atom_modify sort 0 0
dump 1 all image 1 $work/lmp/*.png type type size 1280 720 adiam 1.0 box no 0.02 view 66 297 zoom 1.6
rerun $1 dump x y z wrapped no box yes replace no purge yes add yes
END
}

# road NAME FRAMES COMMAND...: one run; appends wall, CPU, memory and bytes.
road() {
    local name=$1 frames=$2
    shift 2
    rm -rf "$work/out" "$work/lmp"
    mkdir "$work/out" "$work/lmp"
    if ! /usr/bin/time -o "$work/time" -f "%e %U %S %M" timeout 300 "$@" >"$work/said" 2>&1; then
        echo "end_to_end.sh: $name failed: $(tail -n 2 "$work/said")" >&2
        return
    fi
    local bytes
    bytes=$(find "$work/out" "$work/lmp" -type f -printf '%s\n' | awk '{ s += $1 } END { print s + 0 }')
    awk -v OFS='\t' -v name="$name" -v frames="$frames" -v bytes="$bytes" \
        '{ print name, $1 / frames * 1e3, ($2 + $3) / frames * 1e3, $4 * 1.024 / 1000, bytes / frames }' "$work/time" >>"$work/rows"
}

one_round() {
    local name file frames
    for input in "$@"; do
        name=${input%%=*} file=${input#*=}
        frames=$(grep -c '^ITEM: TIMESTEP' "$file")
        road "$name: text to png" "$frames" "$bin/cgt-render" -q -a 1 --style plain -o "$work/out/%05d.png" "$file"
        road "$name: text to png, the default style" "$frames" "$bin/cgt-render" -q -a 1 -o "$work/out/%05d.png" "$file"
        road "$name: text to png, camera given, by type" "$frames" "$bin/cgt-render" -q -a 1 --style plain -k type -c "$camera" \
            -o "$work/out/%05d.png" "$file"
        if command -v ffmpeg >/dev/null; then
            road "$name: text to mp4" "$frames" "$bin/cgt-render" -q -a 1 --style plain -o "$work/out/run.mp4" "$file"
        fi
        [[ " $peers " != *" lammps "* ]] || ! command -v lmp >/dev/null || {
            lammps_input "$file"
            road "$name: LAMMPS rerun, dump image png" "$frames" lmp -in "$work/rerun.in" -log none
        }
        [[ " $peers " != *" tachyon "* ]] || ! command -v tachyon >/dev/null ||
            road "$name: Tachyon, one frame to tga" 1 tachyon "$work/$name.dat" -o "$work/out/x.tga"
        [[ " $peers " != *" povray "* ]] || ! command -v povray >/dev/null ||
            road "$name: POV-Ray, one frame to png" 1 povray "+I$work/$name.pov" "+O$work/out/x.png" +W1280 +H720 -D -V -A
    done
}

inputs=("$@")
if [ $# -eq 0 ]; then
    melt melt32k 20 300 5
    melt melt1m 63 7 1
    inputs=("melt32k=$work/melt32k.lammpstrj" "melt1m=$work/melt1m.lammpstrj")
fi
: >"$work/rows"
for input in "${inputs[@]}"; do
    camera=$("$bin/cgt-render" -q -n --last 0 "${input#*=}" | sed -n 's/^camera *-c //p')
    scene "$work/${input%%=*}" "${input#*=}"
    for _ in $(seq "$rounds"); do
        one_round "$input"
    done
done
printf 'road\tleast ms\tmedian ms\tCPU ms\tMB\tKB a frame\n'
awk -F'\t' -v OFS='\t' '
    { if (!($1 in n)) order[++roads] = $1; wall[$1, ++n[$1]] = $2
      if (n[$1] == 1 || $3 < cpu[$1]) cpu[$1] = $3
      if ($4 > memory[$1]) memory[$1] = $4
      bytes[$1] = $5 }
    END {
        for (r = 1; r <= roads; r++) {
            k = order[r]; m = n[k]
            for (i = 2; i <= m; i++)
                for (j = i; j > 1 && wall[k, j - 1] > wall[k, j]; j--) {
                    t = wall[k, j]; wall[k, j] = wall[k, j - 1]; wall[k, j - 1] = t
                }
            median = m % 2 ? wall[k, (m + 1) / 2] : (wall[k, m / 2] + wall[k, m / 2 + 1]) / 2
            printf "%s\t%.1f\t%.1f\t%.1f\t%.0f\t%.0f\n", k, wall[k, 1], median, cpu[k], memory[k], bytes[k] / 1e3
        }
    }' "$work/rows"
