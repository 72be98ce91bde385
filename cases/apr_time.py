#!/usr/bin/python3
"""Error against processor time, uniform spacing beside refinement, of the runs in CASE/time.csv (columns: line, spacing,
particles, processor time s, error) -> CASE/time.svg.
SPDX-License-Identifier: BSD-3-Clause"""
import argparse
import csv
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from estran import drawing
import matplotlib.figure

p = argparse.ArgumentParser(description=__doc__.split('SPDX')[0])
p.add_argument('case', metavar='CASE', help='folder with time.csv')
p.add_argument('what', nargs='?', default='error', help='what the error is of, on the picture')
o = p.parse_args()
case, what = o.case, o.what
lines = {}
with open(os.path.join(case, 'time.csv')) as f:
    for row in csv.reader(line for line in f if not line.startswith('#')):
        lines.setdefault(row[0], []).append((float(row[3]), float(row[4]), row[1].strip()))
with matplotlib.rc_context(dict(drawing.style, **{'font.size': 13})):
    figure = matplotlib.figure.Figure((6.2, 4), 100, layout='constrained')
    axes = figure.subplots()
    for name, p in lines.items():
        colour = {'uniform': '#666666', 'refined': '#c0392b'}.get(name)
        axes.loglog([q[0] for q in p], [q[1] for q in p], 'o-', color=colour, lw=2 if colour else 1, label=name)
        for cpu, error, spacing in p if colour else ():
            axes.annotate(spacing, (cpu, error), (0, 6), textcoords='offset points', fontsize=10, ha='center')
    axes.set_xlabel('processor time (s)')
    axes.set_ylabel(what)
    axes.margins(0.15)
    axes.grid(alpha=0.3)
    axes.legend()
    figure.savefig(os.path.join(case, 'time.svg'), metadata={'Date': None})
