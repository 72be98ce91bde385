#!/usr/bin/python3
"""Added mass and damping of a run by a fit over its last three periods, and the force beside linear theory
-> DIR/force.png. usage: fit.py DIR                                   SPDX-License-Identifier: BSD-3-Clause"""
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '..'))
import estran
run = estran.read(sys.argv[1])
t, force = (np.asarray(v) for v in run.column('cylinder force y'))
T = float(run['fv'].case['blocks'][1]['motion'][0]['period'])
w, z, M, C = 2 * np.pi / T, 0.05, 1000 * np.pi / 2, 2 * 9810.0
K = round(w**2 / 9.81, 2)
A0, B0 = (0.6144, 0.6961) if K < 0.9 else (0.6262, 0.3057)  # Ursell
late = t >= 3 * T
base = np.stack([np.ones(late.sum())] + [f(k * w * t[late]) for k in (1, 2) for f in (np.sin, np.cos)], 1)
a, s1, c1, s2, c2 = np.linalg.lstsq(base, force[late], rcond=None)[0]
A, B = (s1 / z + C) / (M * w**2), -c1 / (z * M * w**2)
print('K %.1f: added mass %.4f (%+.1f %%), damping %.4f (%+.1f %%) of rho pi a^2/2; second harmonic %.3f of the first' % (
    K, A, 100 * (A / A0 - 1), B, 100 * (B / B0 - 1), np.hypot(s2, c2) / np.hypot(s1, c1)))
print(estran.compare(run, to=os.path.join(run.dir, 'force.png')))
