#!/usr/bin/python3
"""Drag, lift and frequency of shedding from the second half of a run: C = 2 F/(rho U^2 D), mean and half range, St = f D/U
from the rising zeros of the lift. usage: coefficients.py DIR         SPDX-License-Identifier: BSD-3-Clause"""
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '..'))
import estran
t, drag = estran.read(sys.argv[1]).column('cylinder force x')
lift = estran.read(sys.argv[1]).column('cylinder force y')[1]
late = t >= t[-1] / 2
t, drag, lift = t[late], 2 * drag[late], 2 * lift[late]
ends = np.convolve(np.ones(len(t)), np.ones(7), 'same')
smooth_drag, smooth_lift = (np.convolve(v, np.ones(7), 'same') / ends for v in (drag, lift - lift.mean()))
i = np.flatnonzero((smooth_lift[:-1] < 0) & (smooth_lift[1:] >= 0))
zeros = t[i] - smooth_lift[i] * (t[i + 1] - t[i]) / (smooth_lift[i + 1] - smooth_lift[i])
n = len(zeros) - 1
print('C_D %.4f +- %.4f  C_L %.4f  (mean %.4f)  St %s  periods %d' % (
    drag.mean(), np.ptp(smooth_drag) / 2, np.ptp(smooth_lift) / 2, lift.mean(),
    '%.4f' % (n / (zeros[-1] - zeros[0])) if n > 0 else '-', max(n, 0)))
