# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# The plot of docs/cell/cell.md, from two tables in `folder`, and into it as cell.png: spheres.tsv and assignment.tsv, of
# cgt-bench cell --frames --section spheres, and assignment.
set encoding utf8
set datafile separator "\t"
set grid linecolor rgb '#dddddd'
set border 3
set tics nomirror
set key top left
set xtics 500
array colors[4] = ['#000000', '#009e73', '#0072b2', '#d55e00']
array ways[4] = ['static', 'interleaved', 'dynamic', 'hybrid']
set terminal pngcairo size 900,380 font 'sans,10'
set output folder . '/cell.png'
set multiplot layout 1,2 margins 0.07,0.98,0.14,0.9 spacing 0.07,0.1
set title 'A frame by spheres, million cycles'
set xlabel 'spheres'
set yrange [0:*]
plot for [k = 1:3] folder . '/spheres.tsv' using 1:(column(2) == (k == 1 ? 1 : k == 2 ? 6 : 8) ? column(4) * 1e-6 : 1/0) \
    with points pointtype 7 linecolor rgb colors[k] title (k == 1 ? '1 SPE' : k == 2 ? '6 SPEs' : '8 SPEs')
set xtics 1
set title 'SPEs idle at the end, percent'
set xlabel 'SPEs'
plot for [k = 1:4] folder . '/assignment.tsv' using 1:(strcol(2) eq ways[k] ? column(4) : 1/0) \
    with points pointtype 7 linecolor rgb colors[k] title ways[k]
unset multiplot
