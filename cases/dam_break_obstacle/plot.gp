# Pressures on the box and levels of a run beside the measurements:
# gnuplot -e "dir='out/dam_break_obstacle'" cases/dam_break_obstacle/plot.gp -> DIR/signals.png     SPDX-License-Identifier: BSD-3-Clause
if (!exists('dir')) dir = 'out/dam_break_obstacle'
if (!exists('case')) case = 'cases/dam_break_obstacle'
set terminal pngcairo size 1000,1300 font 'sans,11'
set output dir . '/signals.png'
set datafile separator ','
set multiplot layout 6,2 margins 0.07,0.98,0.04,0.97 spacing 0.09,0.055
set xrange [0:6]
set xtics offset 0,0.3
set key top right samplen 2
set title offset 0,-0.6
do for [k = 1:8] {
    name = 'P' . k
    set title name . (k < 5 ? sprintf(', front face, z = %s m', word('0.021 0.061 0.101 0.141', k)) : sprintf(', top, x = %s m', word('0.8035 0.7635 0.7235 0.6835', k - 4)))
    set ylabel 'p [kPa]' offset 1,0
    set yrange [(k < 5 ? -1 : -0.5):(k < 5 ? 12 : 3)]; set ytics (k < 5 ? 4 : 1)
    plot case . '/pressure.csv' using 't':(column(name) / 1000) with lines lw 2 lc rgb '#999999' title 'measured', \
         dir . '/series.csv' using 1:(column(name . ' [Pa]') / 1000) with lines lw 1.5 lc rgb '#c0392b' title 'sph'
}
do for [name in 'x2638 x1488 x992 x496'] {
    set title 'level at x = ' . substr(name, 2, strlen(name)) . ' mm'
    set ylabel 'h [m]'; set yrange [0:0.6]; set ytics 0.2
    plot case . '/height.csv' using 't':name with lines lw 2 lc rgb '#999999' title 'measured', \
         dir . '/series.csv' using 1:(column(name . ' [m]')) with lines lw 1.5 lc rgb '#2471a3' title 'sph'
}
