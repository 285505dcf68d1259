#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# picture_peers.sh CGT_RENDER TRAJECTORY FRAME FOLDER [TURNS]
# Makes like pictures of one frame (LAMMPS text with columns id type x y z or xu yu zu, spheres of radius 0.5) by cgt-render,
# Tachyon, POV-Ray and LAMMPS, where they are installed, in turns, and prints the processor time of each, in ms a picture: the
# least of the turns. cgt-render reads the whole file; the others get the one frame. Pictures stay in FOLDER.
set -euo pipefail
render=$(realpath "$1") input=$(realpath "$2") frame=$3 folder=$4 turns=${5:-3}
mkdir -p "$folder"
cd "$folder"
width=1280 height=720

# The frame as x y z, and its camera.
awk -v wanted="$frame" '/^ITEM: TIMESTEP/ { n++ } /^ITEM: ATOMS/ { atoms = n == wanted + 1; next } /^ITEM:/ { atoms = 0 }
    atoms { print $3, $4, $5 }' "$input" >frame.txt
[ -s frame.txt ] || { echo "picture_peers.sh: there is no frame $frame in $input" >&2; exit 1; }
awk 'BEGIN { print "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS" } { lines[NR] = $0; for (c = 1; c <= 3; c++) {
         if (NR == 1 || $c < low[c]) low[c] = $c; if (NR == 1 || $c > high[c]) high[c] = $c } }
     END { print NR "\nITEM: BOX BOUNDS ss ss ss"; for (c = 1; c <= 3; c++) print low[c] - 1, high[c] + 1
         print "ITEM: ATOMS id type x y z"; for (i = 1; i <= NR; i++) print i, 1, lines[i] }' frame.txt >frame.lammpstrj
camera=$("$render" -q -n -k 5090d0 --view 0.5,-1,0.45 frame.lammpstrj | sed -n 's/^camera *-c //p')
IFS=, read -r ex ey ez tx ty tz ux uy uz fov <<<"$camera"

# Tachyon's zoom is 1 over the tangent of half of the vertical angle times two, for height over width; its camera
# is left-handed: the scene is mirrored.
{
    zoom=$(awk -v f="$fov" 'BEGIN { a = f * 3.14159265 / 360; print 0.5 * cos(a) / sin(a) }')
    printf 'BEGIN_SCENE\nRESOLUTION %d %d\nCAMERA\nZOOM %s\nASPECTRATIO 1.0\nANTIALIASING 0\nRAYDEPTH 4\n' $width $height "$zoom"
    awk -v e="$ex $ey $ez" -v t="$tx $ty $tz" 'BEGIN { split(e, a); split(t, b)
        print "CENTER", -a[1], a[2], a[3] "\nVIEWDIR", a[1] - b[1], b[2] - a[2], b[3] - a[3] }'
    printf 'UPDIR %s %s %s\nEND_CAMERA\nDIRECTIONAL_LIGHT DIRECTION -0.3 0.8 -0.9 COLOR 0.6 0.6 0.6\n' "$ux" "$uy" "$uz"
    printf 'BACKGROUND 0.02 0.03 0.04\n'
    printf 'TEXDEF A AMBIENT 0 DIFFUSE 0.9 SPECULAR 0 OPACITY 1 COLOR 0.08 0.28 0.63 TEXFUNC 0\n'
    awk '{ print "SPHERE CENTER", -$1, $2, $3, "RAD 0.5 A" }' frame.txt
    echo END_SCENE
} >scene.dat
{
    printf 'global_settings { assumed_gamma 1 }\nbackground { rgb <0.02, 0.03, 0.04> }\n'
    printf 'camera { perspective location <%s, %s, %s> right <-%s, 0, 0> up z sky z look_at <%s, %s, %s> angle %s }\n' \
        "$ex" "$ey" "$ez" "$(awk -v w=$width -v h=$height 'BEGIN { print w / h }')" "$tx" "$ty" "$tz" \
        "$(awk -v f="$fov" -v w=$width -v h=$height \
            'BEGIN { a = f * 3.14159265 / 360; print 360 / 3.14159265 * atan2(w / h * sin(a), cos(a)) }')"
    printf 'light_source { <-3000, -8000, 9000> rgb 0.8 parallel point_at <0, 0, 0> }\n'
    printf '#default { pigment { rgb <0.08, 0.28, 0.63> } finish { ambient 0.3 diffuse 0.7 } }\n'
    awk '{ printf "sphere { <%s, %s, %s>, 0.5 }\n", $1, $2, $3 }' frame.txt
} >scene.pov
cat >scene.in <<END
units lj
atom_style atomic
region box block $(sed -n '6,8p' frame.lammpstrj | tr '\n' ' ')
create_box 1 box
mass 1 1
pair_style zero 1.5
pair_coeff * *
thermo_modify lost ignore
dump 1 all image 1 lammps.*.png type type view 66 295 size $width $height ssao yes 4711 0.6 zoom 1.4
dump_modify 1 adiam 1 1.0
rerun frame.lammpstrj dump x y z box no replace no add yes
END

# cpu NAME COMMAND...: user and system time of a command; keeps the least of each name.
declare -A least
cpu() {
    local name=$1 begin end
    shift
    command -v "$1" >/dev/null 2>&1 || return 0
    TIMEFORMAT='%U %S'
    begin=$({ time "$@" >log.txt 2>&1; } 2>&1) || { echo "picture_peers.sh: $name failed: $(tail -n 1 log.txt)" >&2; return 0; }
    end=$(awk '{ printf "%d", 1000 * ($1 + $2) }' <<<"$begin")
    if [ -z "${least[$name]:-}" ] || [ "$end" -lt "${least[$name]}" ]; then least[$name]=$end; fi
}
common=(-a 1 -q -c "$camera" -k 5090d0 frame.lammpstrj -t 1)
for ((turn = 0; turn < turns; turn++)); do
    cpu 'cgt-render plain' "$render" "${common[@]}" --style plain -o plain.png
    cpu 'cgt-render shadows' "$render" "${common[@]}" --ambient 0 -o shadows.png
    cpu 'cgt-render soft, 16 samples' "$render" "${common[@]}" --ambient 16 -o soft.png
    cpu 'Tachyon shadows' tachyon scene.dat -numthreads 1 -fullshade -format PPM -o tachyon_shadows.ppm
    cpu 'Tachyon occlusion, 16 samples' tachyon scene.dat -numthreads 1 -fullshade -add_skylight 0.6 -skylight_samples 16 -format PPM -o tachyon_soft.ppm
    cpu 'POV-Ray shadows' povray +Iscene.pov +Opovray.png +W$width +H$height -D -A +WT1
    cpu 'LAMMPS ssao' lmp -in scene.in
done
printf 'program\tms\n'
for name in "${!least[@]}"; do printf '%s\t%s\n' "$name" "${least[$name]}"; done | sort -t '	' -k 2n
