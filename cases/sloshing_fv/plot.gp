# Level at the left wall and in the middle against second-order theory (Wu & Taylor, Applied Ocean Research 16,
# 1994). usage: gnuplot -e "dir='out/sloshing_fv'" cases/sloshing_fv/plot.gp   SPDX-License-Identifier: BSD-3-Clause
if (!exists("dir")) dir = 'out/sloshing_fv'
set datafile separator ','
g = 9.81; d = 0.5; a = 0.025; k = pi
w = sqrt(g*k*tanh(k*d)); w4 = sqrt(2*g*k*tanh(2*k*d))
first(x,t) = a*cos(w*t)*cos(k*x)
second(x,t) = (2*(w*a)**2*cos(2*w*t) + a**2/w**2*(k**2*g**2 + w**4) \
               - a**2/w**2*(k**2*g**2 + 3*w**4)*cos(w4*t))*cos(2*k*x)/(8*g)
theory(x,t) = d + first(x,t) + second(x,t)
series = dir.'/series.csv'
stats series using ((column('left [m]') - theory(0,column(1)))**2) name 'E' nooutput
stats series using ((column('left [m]') - d - first(0,column(1)))**2) name 'F' nooutput
stats series using ((column('middle [m]') - theory(0.5,column(1)))**2) name 'M' nooutput
print sprintf('left wall: rms deviation %.4f a of the second order, %.4f a of the first; middle %.4f a', \
              sqrt(E_mean)/a, sqrt(F_mean)/a, sqrt(M_mean)/a)
set terminal pngcairo size 1000,500 font 'sans,12'
set output dir.'/levels.png'
set xlabel 't (s)'; set ylabel 'level (m)'; set key outside top horizontal; set grid; set samples 1000
plot series using 1:(column('left [m]')) with points pt 6 ps 0.5 title 'left wall', theory(0,x) title 'second order', \
     d + first(0,x) dt 2 title 'linear', series using 1:(column('middle [m]')) with points pt 4 ps 0.5 title 'middle', \
     theory(0.5,x) title 'second order'
