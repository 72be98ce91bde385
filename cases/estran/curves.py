"""Curves: series of a run, and beside the references that its case names.  SPDX-License-Identifier: BSD-3-Clause"""
import csv
import os

import matplotlib

matplotlib.use('Agg')
import matplotlib.figure as mfigure
import numpy as np

from . import drawing, reading

red, black = '#c0392b', '#8a8a8a'


def table(path):
    """Columns of a reference: its first line without # names them; t is the first."""
    with open(path) as f:
        rows = list(csv.reader(line for line in f if line.strip() and not line.startswith('#')))
    names = [n.strip() for n in rows[0]]
    numbers = [[float(v) if v.strip() else np.nan for v in r] for r in rows[1:]]
    return {n: np.array([r[k] if k < len(r) else np.nan for r in numbers]) for k, n in enumerate(names)}


def home(run):
    """The folder of the run's case: as the run was started with, from here or in cases/."""
    case = run.summary.get('case', '')
    cases = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
    for place in (case, os.path.join(cases, case)):
        if os.path.isfile(place):
            return os.path.dirname(place) or '.'
        if os.path.isdir(place):
            return place
    return '.'


def references(run, folder=None):
    """For each curve that the case compares: its name and the reference's times and values in the run's units."""
    folder = folder or home(run)
    found = {}
    for row in run.case.get('accept', []):
        path = os.path.join(folder, row.get('reference', ''))
        if not row.get('reference') or row['what'] in found or not os.path.exists(path):
            continue
        of = table(path)
        unit = list(row.get('unit', [1, 1]))
        column = row.get('column') or row['what']
        if column in of:
            found[row['what']] = (next(iter(of.values())) * unit[0] + row.get('start', 0), of[column] * unit[1])
    return found


def draw(run, names, known, to, title=None, columns=2):
    """Curves of these columns of the series in a picture each."""
    columns = min(columns, len(names))
    rows = -(-len(names) // columns)
    with matplotlib.rc_context(dict(drawing.style, **{'font.size': 13})):
        figure = mfigure.Figure((4.4 * columns + 0.2, 2.7 * rows + 0.3), 100, layout='constrained')
        places = figure.subplots(rows, columns, squeeze=False, sharex=True).ravel()
        for name, axes in zip(names, places):
            t, v = run.column(name)
            if name in known:
                axes.plot(*known[name], color=black, lw=2.4, label='reference')
            axes.plot(t, v, color=red, lw=1.4, label='run')
            axes.set_title('%s (%s)' % (name, v.units), fontsize=13)
            axes.set_xlim(0, float(t[-1]))
            axes.grid(alpha=0.3)
            if name in known:
                inside = v[np.isfinite(v)]
                ref = known[name][1][(known[name][0] <= t[-1]) & np.isfinite(known[name][1])]
                both = np.concatenate([np.percentile(inside, [0.2, 99.8]), ref if len(ref) else inside[:1]])
                margin = 0.06 * (np.ptp(both) or 1)
                axes.set_ylim(both.min() - margin, both.max() + margin)
        for axes in places[len(names):]:
            axes.set_visible(False)
        for axes in places[max(0, len(names) - columns):len(names)]:
            axes.set_xlabel('t (s)')
        if known:
            places[0].legend(fontsize=11, framealpha=0.8)
        if title:
            figure.suptitle(title)
        figure.savefig(to)
    return to


def compare(run, folder=None, to=None):
    """Draws all curves that the case compares -> DIR/signals.png; None if it compares none."""
    run = reading.read(run) if isinstance(run, (str, os.PathLike)) else run
    known = references(run, folder)
    return draw(run, list(known), known, to or os.path.join(run.dir, 'signals.png')) if known else None


def series(run, names, to=None):
    """Draws columns of the series -> DIR/series.png."""
    run = reading.read(run) if isinstance(run, (str, os.PathLike)) else run
    known = {k: v for k, v in references(run).items() if k in names}
    return draw(run, list(names), known, to or os.path.join(run.dir, 'series.png'))
