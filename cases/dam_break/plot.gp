# Pressure, levels, front and kinetic energy of a run beside the measurements:
# gnuplot -e "dir='out/dam_break'" cases/dam_break/plot.gp -> DIR/signals.png     SPDX-License-Identifier: BSD-3-Clause
if (!exists('dir')) dir = 'out/dam_break'
if (!exists('case')) case = 'cases/dam_break'
H = 0.3; rho = 997.0; g = 9.81; section = 0.18 # m, kg/m^3, m/s^2, m^2 of the column
T(t) = t * sqrt(g / H)
P(p) = p / (rho * g * H)
E(e) = e / (rho * g * section * 0.5 * H) # over the potential energy at the start
set terminal pngcairo size 1000,1150 font 'sans,11'
set output dir . '/signals.png'
set datafile separator ','
set multiplot layout 5,2 margins 0.07,0.98,0.05,0.97 spacing 0.09,0.065
set xrange [0:6.9]
set xtics offset 0,0.3
set ytics 0.5
set key top left samplen 2
set title offset 0,-0.6
do for [k = 1:4] {
    name = word('S1 S2 S3 S4', k)
    set title name . sprintf(', %s mm above the bed', word('3 15 30 80', k))
    set ylabel 'p / (rho g H)' offset 1,0; set yrange [-0.3:3.5]; set ytics 1
    plot case . '/pressure.csv' using 't':name with lines lw 2 lc rgb '#999999' title 'measured', \
         dir . '/series.csv' using (T($1)):(P(column(name . ' [Pa]'))) with lines lw 1.5 lc rgb '#c0392b' title 'sph'
}
set key top right
do for [k = 1:4] {
    name = word('H1 H2 H3 H4', k)
    set title name . sprintf(', level at x = %s m', word('0.3 0.865 1.114 1.3625', k))
    set ylabel 'h / H'; set yrange [0:1.1]; set ytics 0.5
    plot case . '/level.csv' using 't':name with lines lw 2 lc rgb '#999999' title 'measured', \
         dir . '/series.csv' using (T($1)):(column(name . ' [m]') / H) with lines lw 1.5 lc rgb '#c0392b' title 'sph'
}
# front: when levels of 0.02 H, and at last the wall's first sensor with 0.05 rho g H, tell of water
arrival(f, names, t, h, p) = sprintf("< awk -F, -v names='%s' -v st=%.9g -v sh=%.9g -v sp=%.9g '\
    BEGIN { split(names, want, \";\"); split(\"0.865 1.114 1.3625 1.61\", x, \" \") } \
    /^#/ { next } !n { n = NF; for (k = 1; k <= 4; k++) for (i = 1; i <= NF; i++) if ($i == want[k]) c[k] = i; next } \
    { for (k = 1; k <= 4; k++) if (c[k] && !done[k] && (k < 4 ? $c[k] * sh > 0.02 : $c[k] * sp > 0.05)) \
      { done[k] = 1; print $1 * st \",\" x[k] / 0.3 } }' %s", names, t, h, p, f)
set title 'front'; set ylabel 'x / H'; set xlabel 't sqrt(g/H)' offset 0,0.6; set yrange [2:6]; set ytics 1
set key bottom right
plot arrival(case . '/level.csv', 'H2;H3;H4;-', 1, 1, 1) with points pt 7 ps 1.2 lc rgb '#999999' title 'measured', \
     arrival(case . '/pressure.csv', '-;-;-;S1', 1, 1, 1) with points pt 7 ps 1.2 lc rgb '#999999' notitle, \
     arrival(dir . '/series.csv', 'H2 [m];H3 [m];H4 [m];S1 [Pa]', sqrt(g / H), 1 / H, 1 / (rho * g * H)) \
         with linespoints pt 6 ps 1.2 lc rgb '#c0392b' title 'sph'
set title 'kinetic energy'; set ylabel 'E_k / E(0)'; set yrange [0:0.6]; set ytics 0.2
plot dir . '/series.csv' using (T($1)):(E(column('kinetic energy [J]'))) with lines lw 1.5 lc rgb '#c0392b' title 'sph'
unset multiplot
