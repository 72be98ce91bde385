# Levels between walls that lean by 45 degrees against theory (Lamb, Hydrodynamics, art. 258).
# usage: gnuplot -e "dir='out/canal'" cases/sloshing_fv/canal.gp   SPDX-License-Identifier: BSD-3-Clause
if (!exists("dir")) dir = 'out/canal'
set datafile separator ','
w = sqrt(9.81/0.6)
level(x, t) = 0.6 + x/30*cos(w*t)
series = dir.'/series.csv'
stats series using ((column('right [m]') - level(0.3, column(1)))**2) name 'R' nooutput
stats series using ((column('left [m]') - level(-0.3, column(1)))**2) name 'L' nooutput
print sprintf('rms deviation over the amplitude: right %.4f, left %.4f', sqrt(R_mean)/0.01, sqrt(L_mean)/0.01)
set terminal pngcairo size 1000,400 font 'sans,12'
set output dir.'/canal.png'
set xlabel 't (s)'; set ylabel 'level (m)'; set key outside top horizontal; set grid; set samples 1000
plot series using 1:(column('right [m]')) with points pt 6 ps 0.5 title 'x = 0.3 m', level(0.3, x) title 'theory', \
     series using 1:(column('left [m]')) with points pt 4 ps 0.5 title 'x = -0.3 m', level(-0.3, x) title 'theory'
