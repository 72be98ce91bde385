# Force of a run beside the equation of Morison, in the last period:
# gnuplot -e "dir='out/oscillating_cylinder_fv'" cases/oscillating_cylinder_fv/plot.gp -> DIR/force.png     SPDX-License-Identifier: BSD-3-Clause
if (!exists('dir')) dir = 'out/oscillating_cylinder_fv'
if (!exists('case')) case = 'cases/oscillating_cylinder_fv'
set terminal pngcairo size 700,420 font 'sans,11'
set output dir . '/force.png'
set datafile separator ','
set datafile commentschars '#'
set xrange [25:30]; set yrange [-2:2]
set xlabel 't [s]'; set ylabel 'force along x [N/m]'
plot case . '/morison.csv' using ($1 + 25):2 with points pt 7 ps 0.6 lc rgb '#444444' title 'Morison, c_d 2.09, c_m 1.45', \
     dir . '/series.csv' using 't [s]':'cylinder force x [N]' with lines lw 2 lc rgb '#c0392b' title 'fv'
