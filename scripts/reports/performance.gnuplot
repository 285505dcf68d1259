# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The plots of scripts/performance.sh, each as SVG and PNG, from growth.dat, limit.dat, fields.dat and embree.dat in
# `folder`. Colours are Okabe and Ito's.
set encoding utf8
set datafile separator "\t"
growth = folder . '/growth.dat'
limit = folder . '/limit.dat'
fields = folder . '/fields.dat'
embree = folder . '/embree.dat'

array keys[4] = ['bounds', 'build', 'primary rays', 'frame']
array colors[7] = ['#56b4e9', '#0072b2', '#e69f00', '#000000', '#d55e00', '#009e73', '#cc79a7']
array parts[6] = ['#999999', '#0072b2', '#56b4e9', '#e69f00', '#d55e00', '#009e73']
array shapes[4] = [6, 4, 8, 7]
array kinds[2] = ['spheres', 'triangles']
array sweeps[3] = ['primitives', 'pixels', 'threads']
array terms[6] = ['empty frame', 'read', 'scatter', 'tests', 'objects', 'resolve']

set grid linecolor rgb '#dddddd'
set border 3
set tics nomirror

is_of(s, k) = strcol(1) eq s && strcol(2) eq k

do for [form = 1:2] {
  if (form == 1) { set terminal svg size 1180,700 font 'sans,12' background '#ffffff' }
  if (form == 2 && strstrt(GPVAL_TERMINALS, 'pngcairo')) { set terminal pngcairo size 1180,700 font 'sans,10' }
  if (form == 2 && !strstrt(GPVAL_TERMINALS, 'pngcairo')) { set terminal png size 1180,700 }
  ending = form == 1 ? '.svg' : '.png'

  # time against what grows
  set output folder . '/growth' . ending
  set multiplot layout 2,3 margins 0.07,0.87,0.09,0.95 spacing 0.05,0.13
  do for [row = 1:2] {
    do for [panel = 1:3] {
      set title kinds[row]
      set xlabel row == 2 ? sweeps[panel] : ''
      set ylabel panel == 1 ? 'ms' : ''
      set logscale xy
      set format '10^{%T}'
      if (panel == 3) { unset logscale x; set format x '%g'; set xtics 1 } else { set xtics autofreq }
      if (row == 1 && panel == 3) { set key at screen 0.885,0.95 left top Left reverse samplen 1 } else { set key off }
      plot for [k = 1:4] growth using (is_of(sweeps[panel], kinds[row]) ? $3 : NaN):(column(3 + k)) with linespoints \
             pointtype shapes[k] linecolor rgb colors[k] title keys[k]
    }
  }
  unset multiplot
  set output

  # memory
  set output folder . '/memory' . ending
  unset title
  set logscale x
  unset logscale y
  set format x '10^{%T}'
  set format y '%g'
  set xtics autofreq
  set yrange [0:*]
  set xlabel 'primitives'
  set ylabel 'bytes a primitive'
  set key default
  set key inside right top samplen 1
  plot for [k = 1:2] growth using (is_of('primitives', kinds[k]) ? $3 : NaN):8 with linespoints pointtype 6 \
         linecolor rgb colors[2 + k] title kinds[k] . ': all that the scene holds', \
       for [k = 1:2] growth using (is_of('primitives', kinds[k]) ? $3 : NaN):9 with linespoints pointtype 7 \
         linecolor rgb colors[2 + k] title kinds[k] . ': structure'
  set output
  unset logscale

  # the terms of the limit, and what was measured: as parts of the measured frame
  set format '%g'
  set xlabel ''
  set style fill solid 0.8 noborder
  set boxwidth 0.7
  set output folder . '/limit' . ending
  set ylabel 'part of the measured frame'
  set yrange [0:1.05]
  set key outside right top Left reverse samplen 1
  set style data histogram
  set style histogram rowstacked
  plot for [k = 1:6] limit using (column(1 + k) / column(8)):xticlabels(1) linecolor rgb parts[k] title terms[k], \
       1 with lines linecolor rgb '#000000' title 'measured'
  set output
  set yrange [0:*]

  # what a frame asks for
  set output folder . '/fields' . ending
  set style histogram clustered gap 1
  set ylabel 'ms of primary rays'
  plot fields using 2:xticlabels(1) linecolor rgb colors[1] title 't into a plane', \
       '' using 3 linecolor rgb colors[2] title 't, id', '' using 4 linecolor rgb colors[4] title 't, id, normal', \
       '' using 5 linecolor rgb colors[3] title 't to a visitor', '' using 6 linecolor rgb colors[5] title 't, id', \
       '' using 7 linecolor rgb colors[7] title 't, id, normal'
  set output

  # against Embree
  stats embree using 0 nooutput
  if (STATS_records > 0) {
    set output folder . '/embree' . ending
    set ylabel 'Embree''s frame over the library''s'
    plot embree using 2:xticlabels(1) linecolor rgb colors[2] title 'low: rebuilt', \
         '' using 3 linecolor rgb colors[3] title 'medium: rebuilt', '' using 4 linecolor rgb colors[6] title 'refit', \
         1 with lines linecolor rgb '#000000' title 'as fast as Embree'
    set output
  }
  set yrange [*:*]
  set style data points
}
