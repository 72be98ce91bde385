# Heave of a run beside linear theory:
# gnuplot -e "dir='out/body_sphere'" cases/body_sphere/plot.gp -> DIR/heave.png     SPDX-License-Identifier: BSD-3-Clause
if (!exists('dir')) dir = 'out/body_sphere'
if (!exists('case')) case = 'cases/body_sphere'
z0 = 0.03; release = 0.2; T = 0.123656 # m, s: sqrt(a/g)
set terminal pngcairo size 700,420 font 'sans,11'
set output dir . '/heave.png'
set datafile separator ','
set xrange [0:8]; set yrange [-1:1]
set xlabel 't sqrt(g/a)'; set ylabel 'z/z0'
plot case . '/heave.csv' using 't':'z' with points pt 7 ps 1.5 lc rgb '#444444' title 'linear theory', \
     dir . '/series.csv' using (($1 - release)/T):(column('buoy z [m]')/z0) with lines lw 2 lc rgb '#c0392b' title 'sph'
