"""currents.py - regular waves on a current, for waves_currents.py and waves_currents_sph.py: their gauges and what a series.csv says of
the waves. SPDX-License-Identifier: BSD-3-Clause"""
import cmath
import math
import re

from lib import bad, column, name as job, near, says, series, start, write

DEPTH = 0.16  # m; kh 1 with waves of 1 m
HARMONIC = 0.0147448  # m, the first of that wave of 0.03 m (Fourier sum of common/waves/steady.h)
APART = 0.15  # m, of the nine gauges g0, g1, ...


def gauges(first, z):
    return ', '.join('{ name = "g%d"; kind = "level"; at = (%g, %g); }' % (k, first + APART * k, z) for k in range(9))


class Waves:
    """Over the last `periods' of T s of a series (whole steps; trapezoid): first harmonic of the gauges that it has (m, mean), wave
    length (m, slope of their phases), mean level (m), mean velocity `low' (m/s), mean discharge `all' (m^2/s), volume (m^2) or mass
    (kg)."""

    def __init__(self, path, T, periods):
        self.columns, t = series(path), column(path, 't ')
        self.steps = [k for k in range(1, len(t)) if t[k - 1] >= t[-1] - periods * T]
        self.t, turns = t, [cmath.exp(2j * math.pi * now / T) for now in t]
        titles = [title for title in self.columns if re.match(r'g\d ', title)]
        harmonics = [self.mean([value * turn for value, turn in zip(self.columns[title], turns)]) for title in titles]
        phases = [cmath.phase(harmonics[0])]
        for before, now in zip(harmonics, harmonics[1:]):
            phases.append(phases[-1] + cmath.phase(now / before) % (2 * math.pi))
        n, middle = len(phases), (len(phases) - 1) / 2
        slope = sum((j - middle) * phase for j, phase in enumerate(phases)) / sum((j - middle) ** 2 for j in range(n))
        self.harmonic, self.length = 2 * sum(map(abs, harmonics)) / n, 2 * math.pi * APART / slope
        self.level = sum(self.mean(self.columns[title]) for title in titles) / n
        self.low, self.through = self.mean_of('low u'), self.mean_of('all ')
        self.water = self.mean_of('volume' if any(title.startswith('volume') for title in self.columns) else 'mass')

    def mean(self, v):
        t, steps = self.t, self.steps
        return sum((t[k] - t[k - 1]) * (v[k] + v[k - 1]) / 2 for k in steps) / sum(t[k] - t[k - 1] for k in steps)

    def mean_of(self, title):
        return next((self.mean(values) for name, values in self.columns.items() if name.startswith(title)), math.nan)

    def judge(self, case, **wanted):
        """What is wanted of a figure, and how far from it is right."""
        found = ['%s %.6g (%.6g)' % (what, getattr(self, what), value) for what, (value, _) in wanted.items()]
        print('%s: %s: %s' % (job, case, ', '.join(found)))
        for what, (value, most) in wanted.items():
            near('%s: %s' % (case, what), getattr(self, what), value, most, case + '.txt')


def below_troughs(program, case, text, *words):
    """The mean velocity that --check tells, m/s, along with these words."""
    write(case + '.cfg', text)
    told = case + '.told'
    if start(program, case + '.cfg', '--check', log=told) != 0 or not all(says(each, told) for each in words):
        bad('--check: not told %s' % (words,), told)
    found = re.search('mean velocity below the troughs ([-0-9.]+) m', open(told).read())
    return float(found[1]) if found else math.nan
