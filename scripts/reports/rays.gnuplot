# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The plots of scripts/rays.sh, one for each of `scenes`, as SVG and PNG, from the tables in `folder`: the shortest time
# of a ray over the rays in a call; lines are the camera's order, dashes the shuffled one.
set encoding utf8
set datafile separator "\t"

# as in structures.gnuplot: squares and diamonds are grids, circles stacks, triangles ropes
array keys[5] = ['queue-grid', 'loose-grid', 'kd', 'kd-ropes', 'bvh']
array colors[5] = ['#000000', '#009e73', '#0072b2', '#d55e00', '#cc79a7']
array shapes[5] = [5, 13, 7, 9, 3]
array kinds[6] = ['camera', 'shadow', 'ao', 'bounce', 'random', 'random']
array queries[6] = ['nearest', 'any', 'any', 'nearest', 'nearest', 'any']
array names[6] = ['camera rays, nearest hit', 'shadow rays, any hit', 'ambient-occlusion rays, any hit', \
                  'diffuse bounces, nearest hit', 'random rays, nearest hit', 'random rays, any hit']

is_of(key, kind, order, query) = \
    substr(strcol(1), 1, strstrt(strcol(1) . ',', ',') - 1) eq key && strcol(5) eq kind && strcol(6) eq order && \
    strcol(7) eq query

set grid linecolor rgb '#dddddd'
set border 3
set tics nomirror
set logscale xy
set xtics (1, 16, 256, 4096, 65536)
set xrange [0.8:200000]
set format y '%g'

do for [scene in scenes] {
  table = folder . '/' . scene . '.tsv'
  set yrange [*:*] # or stats sees only what the scene before had
  stats table using 11 nooutput
  set yrange [STATS_min / 1.2 : STATS_max * 1.2]
  do for [form = 1:2] {
    if (form == 1) { set terminal svg size 1180,700 font 'sans,12' background '#ffffff' }
    if (form == 2 && strstrt(GPVAL_TERMINALS, 'pngcairo')) { set terminal pngcairo size 1180,700 font 'sans,10' }
    if (form == 2 && !strstrt(GPVAL_TERMINALS, 'pngcairo')) { set terminal png size 1180,700 }
    set output folder . '/' . scene . (form == 1 ? '.svg' : '.png')
    set multiplot layout 2,3 margins 0.075,0.88,0.09,0.95 spacing 0.05,0.13
    do for [panel = 1:6] {
      set title names[panel]
      set xlabel panel > 3 ? 'rays in a call' : ''
      set ylabel panel % 3 == 1 ? 'ns a ray' : ''
      if (panel == 3) { set key at screen 0.89,0.95 left top Left reverse samplen 3 title scene left } else { set key off }
      plot for [k = 1:5] table using \
             (is_of(keys[k], kinds[panel], 'camera', queries[panel]) ? column(9) : NaN):11 with linespoints \
             pointtype shapes[k] linecolor rgb colors[k] title keys[k], \
           for [k = 1:5] table using \
             (is_of(keys[k], kinds[panel], 'shuffled', queries[panel]) ? column(9) : NaN):11 with linespoints \
             pointtype shapes[k] dashtype 2 linecolor rgb colors[k] notitle
    }
    unset multiplot
    set output
  }
}
