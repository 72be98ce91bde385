"""Several runs of a case: their figures in a table.  SPDX-License-Identifier: BSD-3-Clause"""
import argparse
import csv
import hashlib
import os
import re
import subprocess

import numpy as np

from . import reading

launcher = os.path.join(os.path.dirname(os.path.dirname(os.path.realpath(__file__))), 'run')


def setting(word):
    """A word key=value of a command line as key and value."""
    key, equals, value = word.partition('=')
    if not key or not equals:
        raise argparse.ArgumentTypeError('%s: expected key=value, as in sph.dx=0.01' % word)
    return key, value


def values(text):
    """The values of a list like 0.1,0.2 or (16,16),(32,32): commas within brackets part nothing."""
    found, depth = [''], 0
    for c in text:
        depth += (c in '([{') - (c in ')]}')
        if c == ',' and depth == 0:
            found.append('')
        else:
            found[-1] += c
    return [v.strip() for v in found]


def files_of(case, words=()):
    """A case's file and all that it names in quotes, or that these words set keys to: included parts, tables, shapes, grids."""
    folder, parts, found = os.path.dirname(case) or '.', [case], set()
    names = [word.partition('=')[2].strip('"') for word in words]
    while parts:
        part = parts.pop()
        if part not in found and os.path.isfile(part):
            found.add(part)
            with open(part, encoding='utf-8', errors='replace') as f:
                text = f.read()
            parts += [os.path.join(folder, name) for name in re.findall(r'@include\s*"([^"]+)"', text)]
            names += re.findall(r'"([^"\n]+)"', text)
    return sorted(found | {os.path.join(folder, name) for name in names if os.path.isfile(os.path.join(folder, name))})


def state_of(case, words):
    """What a run of the case with these words would depend on: the words, the case's file, the files that it names, the programs."""
    at = next((c for c in (case, os.path.join(case, 'case.cfg'), os.path.join(os.path.dirname(launcher), case, 'case.cfg'))
               if os.path.isfile(c)), case)
    to = hashlib.sha256('\0'.join(words).encode())
    build = os.environ.get('ESTRAN_BUILD') or os.path.join(os.path.dirname(os.path.dirname(launcher)), 'build')
    programs = [os.path.join(build, name) for name in ('sph', 'fv', 'coupler')]
    for path in files_of(at, words) + list(filter(os.path.isfile, programs)):
        with open(path, 'rb') as f:
            to.update(f.read())
    return to.hexdigest()


def run(case, folder, settings, more=()):
    """Runs the case into the folder unless it is done there as asked for; its Run, or None with the last words printed."""
    words = list(more)
    for k, v in settings.items():
        words += ['-p', '%s=%s' % (k, v)]
    state, kept = state_of(case, words), os.path.join(folder, 'asked.txt')
    there = os.path.exists(os.path.join(folder, 'summary.json'))
    if there and os.path.exists(kept):
        with open(kept) as f:
            if f.read().strip() == state:
                return reading.read(folder)
    if there:
        print('%s: other settings, another case or other programs than of the run that is there: run again' % folder)
    said = subprocess.run([launcher, case, '-o', folder, '--force'] + words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if said.returncode > 1:
        lines = [line for line in said.stdout.strip().split('\n') if not line.startswith('mpirun ')] or ['no output']
        print('%s: exit code %d: %s' % (folder, said.returncode, lines[0 if said.returncode == 2 else -1]))
        return None
    with open(kept, 'w') as f:
        f.write(state + '\n')
    return reading.read(folder)


def figures(of):
    """Errors, criteria and drifts of a run, by name."""
    found, s = {}, of.summary
    for name, value, _ in reading.criteria(of):
        found[name] = value
    for group in ('error', 'compare', 'drift'):
        for k, v in s.get(group, {}).items():
            found.setdefault('%s.%s' % (group, k), v)
    return {k: float(v) for k, v in found.items() if isinstance(v, (int, float)) and not isinstance(v, bool)}


def signals(of):
    """Columns of the series that the case asks for, gauges and what bodies bear, in the order of the file: name -> (times, values)."""
    names = [row['name'] for group in ('probes', 'bodies') for row in of.case.get(group, []) if 'name' in row]
    asked = re.compile('(?:%s)(?: |$)' % '|'.join(map(re.escape, names)))
    found = {}
    for place in [p.series for p in of.programs.values()] if names else []:
        t, *_ = place.values()
        for name, v in place.items():
            if asked.match(name) and np.isfinite(v).any():
                found.setdefault(name, (t, v))
    return found


def extremes(of):
    """Largest and smallest value and the average over time of each signal, by name."""
    found = {}
    for name, (t, v) in signals(of).items():
        t, v = t[np.isfinite(v)], v[np.isfinite(v)]
        found['%s max' % name], found['%s min' % name] = float(v.max()), float(v.min())
        found['%s mean' % name] = float(np.trapz(v, t) / (t[-1] - t[0]) if t[-1] > t[0] else v[0])
    return found


def distances(of, last):
    """Of each signal the root mean square difference from that of another run, over the times that both have, as a
    share of the other's range."""
    found, others = {}, signals(last)
    for name, (t, v) in signals(of).items():
        other = others.get(name)
        both = np.isfinite(v) & (t <= other[0][-1]) if other else []
        if np.any(both) and np.nanmax(other[1]) > np.nanmin(other[1]):
            there = np.isfinite(other[1])
            d = np.asarray(v[both]) - np.interp(t[both], other[0][there], other[1][there])
            found[name] = float(np.sqrt(np.mean(d * d)) / (np.nanmax(other[1]) - np.nanmin(other[1])))
    return found


def write(path, head, rows):
    with open(path, 'w', newline='') as f:
        to = csv.writer(f, lineterminator='\n')
        to.writerow(head)
        to.writerows(rows)
