# Levels against Lobovsky's. usage: gnuplot -e "dir='out/lobovsky'" cases/dam_break_fv/plot_levels.gp
# SPDX-License-Identifier: BSD-3-Clause
if (!exists("dir")) dir = 'out/lobovsky'
set datafile separator ','
H = 0.3; s = sqrt(9.81/H); reference = 'cases/dam_break_fv/reference_levels.csv'
set terminal pngcairo size 900,600 font 'sans,12'
set output dir.'/levels.png'
set xlabel 't sqrt(g/H)'; set ylabel 'level/H'; set key top right; set grid
set xrange [0:7]; set yrange [0:1.05]
plot for [k=1:4] dir.'/series.csv' using (column(1)*s):(column(sprintf('H%d [m]',k))/H) with lines lw 2 lc k title sprintf('fv H%d',k), \
     for [k=1:4] reference using 1:(column(k+1)) with points pt 7 ps 0.4 lc k title sprintf('measured H%d',k)
