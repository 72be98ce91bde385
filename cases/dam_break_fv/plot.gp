# Front and the measured one. usage: gnuplot -e "dir='out/dam_break_fv'" cases/dam_break_fv/plot.gp
# SPDX-License-Identifier: BSD-3-Clause
if (!exists("dir")) dir = 'out/dam_break_fv'
set datafile separator ','
a = 0.05715; s = sqrt(2*9.81/a)
set terminal pngcairo size 800,500 font 'sans,12'
set output dir.'/front.png'
set xlabel 'T = t sqrt(2 g/a)'; set ylabel 'Z = front/a'; set key bottom right; set grid
set xrange [0:3.4]; set yrange [0.9:4.2]
plot dir.'/series.csv' using (column(1)*s):(column('water up to x [m]')/a) with lines lw 2 title 'fv', \
     'cases/dam_break_fv/reference.csv' using 1:2 with points pt 7 title 'Martin and Moyce 1952', \
     '' using ($1-0.265):2 with points pt 6 title 'their clock 0.265 earlier'
