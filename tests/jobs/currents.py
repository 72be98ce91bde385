"""currents.py - waves on a current by a series.csv: over its last PERIODS of T s (whole steps; trapezoid) the first harmonic of the gauges
g0, g1, ... that it has, 0.15 m apart (m, mean), wave length (m, slope of their phases), mean level (m), mean velocity `low' (m/s), mean
discharge `all' (m^2/s), volume (m^2) or mass (kg). usage: currents.py SERIES T PERIODS. SPDX-License-Identifier: BSD-3-Clause"""
import cmath
import csv
import math
import sys

T, periods = float(sys.argv[2]), int(sys.argv[3])
with open(sys.argv[1]) as f:
    titles, *rows = csv.reader(f)
t = [float(row[0]) for row in rows]
steps = [k for k in range(1, len(t)) if t[k - 1] >= t[-1] - periods * T]


def mean(title, wave=False):
    """Mean of a column over those steps, or its first harmonic; nan: no such column."""
    c = next((i for i, name in enumerate(titles) if name.startswith(title)), None)
    if c is None:
        return math.nan
    v = [float(row[c]) * (cmath.exp(2j * math.pi * t[k] / T) if wave else 1) for k, row in enumerate(rows)]
    return sum((t[k] - t[k - 1]) * (v[k] + v[k - 1]) / 2 for k in steps) / sum(t[k] - t[k - 1] for k in steps)


gauges = [name.split()[0] + ' ' for name in titles if name[0] == 'g' and name[1:2].isdigit()]
harmonics = [mean(g, wave=True) for g in gauges]
phases = [cmath.phase(harmonics[0])]
for before, now in zip(harmonics, harmonics[1:]):
    phases.append(phases[-1] + cmath.phase(now / before) % (2 * math.pi))
n, middle = len(gauges), (len(gauges) - 1) / 2
slope = sum((j - middle) * phase for j, phase in enumerate(phases)) / sum((j - middle) ** 2 for j in range(n))
print(*('%.6g' % x for x in (2 * sum(map(abs, harmonics)) / n, 2 * math.pi * 0.15 / slope, sum(map(mean, gauges)) / n, mean('low u'),
                             mean('all '), mean('volume' if any(name.startswith('volume') for name in titles) else 'mass'))))
