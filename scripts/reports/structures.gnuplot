# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The plots of scripts/structures.sh, each as SVG and PNG, from times.dat and layouts.dat in `folder`.
set encoding utf8
set datafile separator "\t"
times = folder . '/times.dat'
layouts = folder . '/layouts.dat'

# structures and traversals: Okabe and Ito's colours; squares and diamonds are grids, circles stacks, triangles ropes
array keys[7] = ['queue-grid', 'kd single', 'kd packet', 'kd-ropes single', 'kd-ropes packet', 'auto', 'loose-grid']
array colors[7] = ['#000000', '#56b4e9', '#0072b2', '#e69f00', '#d55e00', '#999999', '#009e73']
array shapes[7] = [5, 6, 7, 8, 9, 2, 13]
array names[3] = ['primary rays', 'ambient-occlusion rays', 'random rays']

set grid linecolor rgb '#dddddd'
set border 3
set tics nomirror
set style fill solid 0.8 noborder

# above and below: scenes that lines join, and the one that stands alone
array joined[2] = ['clouds', 'blobs']
array alone[2] = ['clusters1m', 'stadium']
is_of(f, k) = strcol(1) eq f && strcol(2) eq k
# how many values a panel has: gnuplot fails on one without
values(row, number) = int(system(sprintf("awk -F'\t' '($1 == \"%s\" || $1 == \"%s\") && $%d != \"NaN\"' '%s' | wc -l", \
                                         joined[row], alone[row], number, times)))

do for [form = 1:2] {
  if (form == 1) { set terminal svg size 1180,700 font 'sans,12' background '#ffffff' }
  if (form == 2 && strstrt(GPVAL_TERMINALS, 'pngcairo')) { set terminal pngcairo size 1180,700 font 'sans,10' }
  if (form == 2 && !strstrt(GPVAL_TERMINALS, 'pngcairo')) { set terminal png size 1180,700 }
  ending = form == 1 ? '.svg' : '.png'

  # time of a ray: spheres above, triangles below; lines join scenes of one kind
  set logscale xy
  set format '10^{%T}'
  set xrange [1000:2000000]
  set output folder . '/rays' . ending
  set multiplot layout 2,3 margins 0.075,0.86,0.09,0.95 spacing 0.05,0.13
  with_key = values(1, 7) ? 1 : 2
  do for [row = 1:2] {
    do for [panel = 0:2] {
      if (!values(row, 5 + panel)) { set multiplot next; continue }
      set title (row == 1 ? 'spheres: ' : 'triangles: ') . names[panel + 1]
      set xlabel row == 2 ? 'primitives' : ''
      set ylabel panel == 0 ? 'ns a ray' : ''
      set key off
      if (row == with_key && panel == 2) { set key on at screen 0.875,0.95 left top Left reverse samplen 1 }
      plot for [k = 1:7] times using (is_of(joined[row], keys[k]) ? $3 : NaN):(column(5 + panel)) with linespoints \
             pointtype shapes[k] linecolor rgb colors[k] title keys[k], \
           for [k = 1:7] times using (is_of(alone[row], keys[k]) ? $3 : NaN):(column(5 + panel)) with points \
             pointtype shapes[k] linecolor rgb colors[k] notitle, \
           times using (is_of(alone[row], 'auto') ? $3 : NaN):(column(5 + panel)):(alone[row]) with labels offset 0,-1 \
             font ',9' notitle
    }
  }
  unset multiplot
  set output

  # time to build
  set output folder . '/build' . ending
  set multiplot layout 1,2 margins 0.07,0.84,0.12,0.93 spacing 0.07,0.1
  with_key = values(2, 4) ? 2 : 1
  do for [row = 1:2] {
    if (!values(row, 4)) { set multiplot next; continue }
    set title row == 1 ? 'spheres' : 'triangles'
    set xlabel 'primitives'
    set ylabel row == 1 ? 'ms to build' : ''
    if (row == with_key) { set key at screen 0.855,0.93 left top Left reverse samplen 1 } else { set key off }
    # single and packet traverse the same tree: one line for both
    plot for [k in '1 3 5 6 7'] times using (is_of(joined[row], keys[int(k)]) ? $3 : NaN):4 with linespoints \
           pointtype shapes[int(k)] linecolor rgb colors[int(k)] title word(keys[int(k)], 1), \
         for [k in '1 3 5 6 7'] times using (is_of(alone[row], keys[int(k)]) ? $3 : NaN):4 with points \
           pointtype shapes[int(k)] linecolor rgb colors[int(k)] notitle, \
         times using (is_of(alone[row], 'auto') ? $3 : NaN):4:(alone[row]) with labels offset 0,-1 font ',9' notitle
  }
  unset multiplot
  set output
  unset logscale

  # layouts: what a ray costs
  if (system("wc -l <'" . layouts . "'") + 0 > 0) {
    set output folder . '/layouts' . ending
    set style data histogram
    set style histogram clustered gap 1
    set format '% h'
    set xrange [*:*]
    set xtics rotate by 50 right font ',9'
    set xlabel ''
    set yrange [0:*]
    set key default
    set key inside right top samplen 1
    set title 'ns an ambient-occlusion ray'
    set ylabel ''
    plot layouts using 4:xticlabels(strcol(1) . ', ' . strcol(3)) linecolor rgb colors[2] title 'single', \
         '' using 5 linecolor rgb colors[3] title 'packet'
    set output
    unset xtics
    set xtics nomirror norotate
    set yrange [*:*]
    set style data points
    set key default
  }
}
