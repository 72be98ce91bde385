# Levels and pressures beside the measured ones. usage: gnuplot -e "dir='out/dam_break_obstacle_fv'" cases/dam_break_obstacle_fv/plot.gp
# SPDX-License-Identifier: BSD-3-Clause
if (!exists("dir")) dir = 'out/dam_break_obstacle_fv'
data = 'cases/dam_break_obstacle/' # the measured ones
set datafile separator ','
set terminal pngcairo size 1100,900 font 'sans,11'
set output dir.'/signals.png'
set multiplot layout 3,2
set grid; set xrange [0:4]; set xlabel 't, s'
do for [x in "2638 1488 992 496"] {
    set ylabel 'level at x = '.x.' mm, m'
    plot data.'height.csv' using 't':'x'.x with lines lw 1 lc 'gray40' title 'measured', \
         dir.'/series.csv' using 't [s]':'x'.x.' [m]' with lines lw 2 title 'fv'
}
set xrange [0.3:2]
do for [p in "P1 P3"] {
    set ylabel p.', Pa'
    plot data.'pressure.csv' using 't':p with lines lw 1 lc 'gray40' title 'measured', \
         dir.'/series.csv' using 't [s]':p.' [Pa]' with lines lw 2 title 'fv'
}
