"""Several runs of a case: their figures in a table.  SPDX-License-Identifier: BSD-3-Clause"""
import csv
import os
import subprocess

from . import page, reading

launcher = os.path.join(os.path.dirname(os.path.dirname(os.path.realpath(__file__))), 'run')


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


def run(case, folder, settings, more=()):
    """Runs the case into the folder unless it is done there; its Run, or None with the last words printed."""
    if not os.path.exists(os.path.join(folder, 'summary.json')):
        words = [launcher, case, '-o', folder, '--force', *more]
        for k, v in settings.items():
            words += ['-p', '%s=%s' % (k, v)]
        said = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if said.returncode > 1:
            print('%s: exit code %d: %s' % (folder, said.returncode, said.stdout.strip().split('\n')[-1]))
            return None
    return reading.read(folder)


def figures(of):
    """Errors, criteria and drifts of a run, by name."""
    found, s = {}, of.summary
    for name, value, _ in page.criteria(of):
        found[name] = value
    for group in ('error', 'compare', 'drift'):
        for k, v in s.get(group, {}).items():
            found.setdefault('%s.%s' % (group, k), v)
    return {k: float(v) for k, v in found.items() if isinstance(v, (int, float)) and not isinstance(v, bool)}


def write(path, head, rows):
    with open(path, 'w', newline='') as f:
        to = csv.writer(f, lineterminator='\n')
        to.writerow(head)
        to.writerows(rows)
