# Heave of a run beside linear theory:
# gnuplot -e "dir='out/body_heave'" cases/body_heave/plot.gp -> DIR/heave.png     SPDX-License-Identifier: BSD-3-Clause
if (!exists('dir')) dir = 'out/body_heave'
if (!exists('case')) case = 'cases/body_heave'
z0 = 0.2; release = 2.0 # m, s; sqrt(a/g) = 1
set terminal pngcairo size 700,420 font 'sans,11'
set output dir . '/heave.png'
set datafile separator ','
set xrange [0:8]; set yrange [-1:1]
set xlabel 't sqrt(g/a)'; set ylabel 'z/z0'
plot case . '/heave.csv' using 't':'z' with points pt 7 ps 1.5 lc rgb '#444444' title 'linear theory', \
     dir . '/series.csv' using ($1 - release):(column('buoy y [m]')/z0) with lines lw 2 lc rgb '#c0392b' title 'sph'
