# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# One plot of scripts/accuracy.sh, as SVG and PNG: time against error, from a table of cgt-bench accuracy. Variables:
#   table  the TSV: whole frames of one scene, or the tests alone
#   plot   the files to write, without their endings
#   frames 1: whole frames; 0: the tests alone
set encoding utf8
set datafile separator "\t"

# Okabe and Ito's colours for variants, gnuplot's filled symbols for ways
array variants[6] = ['portable', 'sse', 'neon', 'avx2', 'avx512', 'spu']
array titles[6] = ['portable', 'sse', 'neon', 'avx2', 'avx512', 'the SPU''s arithmetic']
array colors[6] = ['#000000', '#0072b2', '#e69f00', '#009e73', '#d55e00', '#cc79a7']
array shapes[6] = [13, 7, 9, 15, 11, 5]
if (frames) {
  array ways[5] = ['exact', 'fast', 'fast watertight', 'fast moller-trumbore', 'fast accelerated']
  array names[5] = ['EXACT', 'FAST', 'watertight', 'Möller-Trumbore', 'accelerated']
  way_of(x) = strcol(4) . (strcol(5) eq '-' || strcol(5) eq 'auto' ? '' : ' ' . strcol(5))
  variant_of(x) = strcol(3)
  time = 9; wrong = 15; ulp = 18; cost = 19
} else {
  array ways[5] = ['sphere', 'watertight', 'moller-trumbore', 'accelerated', '']
  array names[5] = ['sphere', 'watertight', 'Möller-Trumbore', 'accelerated', '']
  way_of(x) = strcol(2)
  variant_of(x) = strcol(4) eq 'spu' ? 'spu' : strcol(3)
  time = 5; wrong = 11; ulp = 14
}
ways_used = frames ? 5 : 4
variants_used = frames ? 5 : 6
is_of(v, w) = variant_of(0) eq variants[v] && way_of(0) eq ways[w]

# A logarithm has no place for 0: it gets one below all other values.
wrong_floor = 0.01
ulp_floor = 0.25
above(x, lowest) = x > 0 ? x : lowest

set grid linecolor rgb '#dddddd'
set border 3
set tics nomirror
set style fill solid 0.8 noborder
set boxwidth 0.35
rows = frames ? 3 : 2

do for [form = 1:2] {
  if (form == 1) { set terminal svg size 670,330 * rows font 'sans,12' background '#ffffff' }
  if (form == 2 && strstrt(GPVAL_TERMINALS, 'pngcairo')) { set terminal pngcairo size 670,330 * rows font 'sans,10' }
  if (form == 2 && !strstrt(GPVAL_TERMINALS, 'pngcairo')) { set terminal png size 670,330 * rows }
  set output plot . (form == 1 ? '.svg' : '.png')
  set multiplot layout rows,1 margins 0.13,0.66,0.07,0.97 spacing 0,0.09
  set key at screen 0.68,0.97 left top Left reverse samplen 1
  set xlabel frames ? 'ms per frame, build included' : 'ns per test'
  if (frames) { set xrange [0:*] } else { set logscale x }

  # wrong answers; the key names the ways
  set logscale y
  set format y '10^{%T}'
  set yrange [wrong_floor / 2:*]
  set ytics auto
  set ytics add ('none' wrong_floor)
  set ylabel frames ? 'wrong pixels per million' : 'wrong answers per million'
  plot for [v = 1:variants_used] for [w = 1:ways_used] table using (is_of(v, w) ? column(time) : NaN):(above(1e6 * column(wrong), wrong_floor)) \
         with points pointtype shapes[w] pointsize 1.2 linecolor rgb colors[v] notitle, \
       for [w = 1:ways_used] keyentry with points pointtype shapes[w] linecolor rgb '#777777' title names[w]

  # the worst error of t; the key names the variants
  set key at screen 0.68,screen 0.97 - 0.96 / rows
  set format y '%g'
  set ytics auto
  set yrange [ulp_floor / 2:*]
  set ytics add ('0' ulp_floor)
  set ylabel 'worst error of t, ulp'
  plot for [v = 1:variants_used] for [w = 1:ways_used] table using (is_of(v, w) ? column(time) : NaN):(above(column(ulp), ulp_floor)) \
         with points pointtype shapes[w] pointsize 1.2 linecolor rgb colors[v] notitle, \
       for [v = 1:variants_used] keyentry with points pointtype 7 linecolor rgb colors[v] title titles[v]

  # what EXACT costs
  if (frames) {
    set key at screen 0.68,0.3
    unset logscale y
    set yrange [*:*]
    set ytics auto
    set xrange [0.4:5.6]
    set xtics ('' 0)
    do for [v = 1:5] { set xtics add (variants[v] v) }
    set xlabel ''
    set ylabel 'cost over FAST, % of the frame'
    plot 0 with lines linecolor rgb '#777777' notitle, \
         for [v = 1:5] table using (is_of(v, 1) ? v : NaN):cost with boxes linecolor rgb '#d55e00' \
           title v == 1 ? 'EXACT' : ''
    set xtics auto
  }
  unset multiplot
  set output
}
