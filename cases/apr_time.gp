# Error against processor time, uniform spacing beside refinement, of the runs in CASE/time.csv (columns: line, spacing, particles, processor time s, error):
# gnuplot -e "case='cases/apr_vortices'; what='error of the velocity'" cases/apr_time.gp -> CASE/time.svg     SPDX-License-Identifier: BSD-3-Clause
if (!exists('case')) case = 'cases/apr_vortices'
if (!exists('what')) what = 'error'
rows(l) = sprintf("< awk -F, '$1 == \"%s\"' %s/time.csv", l, case)
set terminal svg size 620,400 font 'sans,13' background 'white'
set output case . '/time.svg'
set datafile separator ','
set logscale xy
set grid back lt 1 lw 0.5 lc rgb '#cccccc'
set key top right
set offsets graph 0.15, graph 0.15, graph 0.1, graph 0.1
set xlabel 'processor time (s)'; set ylabel what
others = system(sprintf("cut -d, -f1 %s/time.csv | grep -v '^#' | grep -v uniform | grep -v refined | sort -u | tr '\\n' ' '", case))
more = words(others) > 0 ? ", for [l in others] rows(l) using 4:5 with linespoints pt 6 lw 1 title l" : ""
eval "plot rows('uniform') using 4:5 with linespoints pt 7 lw 2 lc rgb '#666666' title 'uniform', \
     rows('uniform') using 4:5:2 with labels offset 0, 0.9 notitle, \
     rows('refined') using 4:5 with linespoints pt 7 lw 2 lc rgb '#c0392b' title 'refined', \
     rows('refined') using 4:5:2 with labels offset 0, 0.9 notitle" . more
