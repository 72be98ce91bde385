#!/usr/bin/python3
"""Error of the velocity where the case refines, and elsewhere, over U: root of the mean square over the particles of the
last snapshot. usage: inside.py DIR                                    SPDX-License-Identifier: BSD-3-Clause"""
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '..'))
import estran
part = estran.read(sys.argv[1]).at()['sph']
x, u, k = np.asarray(part.x, float), np.asarray(part['velocity'], float), 2 * np.pi
level = np.asarray(part['level']) if 'level' in part else np.zeros(len(x))
decay = np.exp(-2 * k**2 * 0.005 * part.time)
exact = decay * np.stack([np.sin(k * x[:, 0]) * np.cos(k * x[:, 1]), -np.cos(k * x[:, 0]) * np.sin(k * x[:, 1])], 1)
inside = (abs(x - 0.5) < 0.12).all(1)
square = ((u[:, :2] - exact) ** 2).sum(1)
error = [np.sqrt(np.average(square[w], weights=0.25 ** level[w])) if w.any() else np.nan for w in (inside, ~inside)]
print('inside %.6f  outside %.6f  particles %d %d' % (*error, inside.sum(), (~inside).sum()))
