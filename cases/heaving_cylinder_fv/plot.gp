# Force beside linear theory, and added mass and damping by a fit over the last three periods:
# gnuplot -e "dir='out/heaving_cylinder_fv'" cases/heaving_cylinder_fv/plot.gp   (slow=1 with slow.cfg)   -> DIR/force.png     SPDX-License-Identifier: BSD-3-Clause
if (!exists('dir')) dir = 'out/heaving_cylinder_fv'
if (!exists('case')) case = 'cases/heaving_cylinder_fv'
if (!exists('slow')) slow = 0
K = slow ? 0.6 : 1.2
A0 = slow ? 0.6144 : 0.6262
B0 = slow ? 0.6961 : 0.3057
w = sqrt(K*9.81); T = 2*pi/w; z = 0.05; M = 1000*pi/2; C = 2*9810.0
set terminal pngcairo size 800,420 font 'sans,11'
set datafile separator ','
set datafile commentschars '#'
f(x) = a + s1*sin(w*x) + c1*cos(w*x) + s2*sin(2*w*x) + c2*cos(2*w*x)
a = 15409.5; s1 = -300; c1 = -300; s2 = 1; c2 = 1
set fit quiet logfile '/dev/null'
fit [3*T:6*T] f(x) dir . '/series.csv' using 't [s]':'cylinder force y [N]' via a, s1, c1, s2, c2
A = (s1/z + C)/(M*w*w); B = -c1/(z*M*w*w)
print sprintf('K %.1f: added mass %.4f (%+.1f %%), damping %.4f (%+.1f %%) of rho pi a^2/2; second harmonic %.3f of the first', K, A, 100*(A/A0 - 1), B, 100*(B/B0 - 1), sqrt(s2**2 + c2**2)/sqrt(s1**2 + c1**2))
set output dir . '/force.png'
set xrange [0:6]; set xlabel 't/T'; set ylabel 'force up, less that at rest [N/m]'
g(x) = (A0*M*w*w - C)*z*sin(w*x) - B0*M*w*w*z*cos(w*x)
set key top left
set samples 600
plot dir . '/series.csv' using (column('t [s]')/T):(column('cylinder force y [N]') - 15409.5) with lines lw 2 lc rgb '#c0392b' title 'fv', \
     (x > 2 ? g(x*T) : 1/0) with lines dt 2 lw 2 lc rgb '#444444' title 'linear theory'
