"""One page of a run, to be opened offline: verdict, pictures, curves, price, the case. SPDX-License-Identifier: BSD-3-Clause"""
import base64
import html
import os

import numpy as np

from . import curves, drawing, reading

head = '''<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>%s</title>
<style>body{font:16px sans-serif;max-width:60em;margin:2em auto;padding:0 1em}table{border-collapse:collapse}
td,th{padding:.15em .8em;text-align:left}tr:nth-child(even){background:#f4f4f4}img{max-width:100%%}
.met{color:#070}.missed{color:#a50}pre{background:#f4f4f4;padding:.8em;overflow:auto;font-size:13px}</style>
'''


def image(path):
    kind = 'svg+xml' if path.endswith('.svg') else 'png'
    with open(path, 'rb') as f:
        return '<p><img alt="%s" src="data:image/%s;base64,%s">' % (
            html.escape(os.path.basename(path)), kind, base64.b64encode(f.read()).decode())


def rows(table):
    return '\n'.join('<tr>' + ''.join('<td%s>%s' % c if isinstance(c, tuple) else '<td>' + html.escape(str(c)) for c in r)
                     for r in table)


def short(v):
    return '%.4g' % v if isinstance(v, (int, float)) and not isinstance(v, bool) else '' if v is None else str(v)


def verdict(run):
    to = []
    for name, value, allowed in reading.criteria(run):
        met = isinstance(value, (int, float)) and allowed is not None and abs(value) <= allowed
        to.append((name, short(value), short(allowed), (' class=met', 'met') if met else (' class=missed', 'missed')))
    return '<table><tr><th>criterion<th>measured<th>allowed<th></tr>%s</table>' % rows(to) if to else '<p>The case has no criteria.'


def faults(run):
    """Why a program does not accept its own run."""
    said = {p.summary.get('not_accepted') for p in run.programs.values()} | {run.summary.get('not_accepted')}
    return '\n'.join('<p class=missed>Not accepted: %s' % html.escape(s) for s in sorted(s for s in said if s))


def gauges(run):
    """The columns of the case's gauges, of all programs."""
    names = [p['name'] for p in run.case.get('probes', []) if p.get('name')]
    found = []
    for name in names:
        try:
            if np.isfinite(np.asarray(run.column(name)[1], float)).any():
                found.append(name)
        except LookupError:  # of a kind that has no column of its name
            continue
    return found


def price(run):
    s = run.summary
    to = [('status', s.get('status')), ('version', s.get('version')), ('ranks', s.get('ranks')),
          ('wall time (s)', short(s.get('wall_s'))), ('processor time (s)', short(s.get('cpu_s')))]
    to += [('processor time of %s (s)' % k, short(v)) for k, v in s.get('cpu_of', {}).items()]
    for group in ('error', 'drift', 'watch', 'compare'):
        to += [('%s.%s' % (group, k), short(v)) for k, v in s.get(group, {}).items() if not isinstance(v, dict)]
    return '<table>%s</table>' % rows(r for r in to if r[1] not in (None, ''))


def report(run, to=None, fields=None):
    """Writes DIR/report.html and returns its name. fields: what to draw (default: of the usual ones those there are)."""
    run = reading.read(run) if isinstance(run, (str, os.PathLike)) else run
    name = os.path.basename(os.path.abspath(run.dir))
    page = [head % html.escape(name), '<h1>%s</h1>' % html.escape(name), verdict(run), faults(run)]
    if run.times:
        first = drawing.default_field(run)
        others = [f for f in ('pressure', 'vorticity') if f in run.fields and f != first]
        for field in fields or [first] + others[:1]:
            page.append(image(drawing.plot(run, field)))
    signals = curves.compare(run)
    if signals:
        page += ['<h2>Beside the references of the case</h2>', image(signals)]
    energy = [k for k in ('kinetic energy', 'max Mach', 'dt') if k in run.series]
    for title, names, file in (('Gauges', gauges(run), 'gauges.png'), ('Over the run', energy, 'history.png')):
        if names:
            page += ['<h2>%s</h2>' % title, image(curves.draw(run, names, {}, os.path.join(run.dir, file), columns=3))]
    page += ['<h2>Figures</h2>', price(run)]
    for p in run.programs.values():
        with open(os.path.join(run.dir, p.name + '-case.cfg')) as f:
            page.append('<h2>Case of %s, with its defaults</h2><pre>%s</pre>' % (p.name, html.escape(f.read())))
    to = to or os.path.join(run.dir, 'report.html')
    with open(to, 'w') as f:
        f.write('\n'.join(page))
    return to
