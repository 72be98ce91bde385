#!/usr/bin/python3
"""Largest |p| at each gauge while the pulse passes, over rho c0 U/2, and what comes back later at the first, over what
passed there. usage: reflection.py DIR                                 SPDX-License-Identifier: BSD-3-Clause"""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '..'))
import estran

run = estran.read(sys.argv[1])
of = {k: abs(run.column(k)[1]) for k in ('before', 'inside', 'behind')}
early = run.series['t'] <= 0.1
passed = of['before'][early].max()
print('before %.4f  inside %.4f  behind %.4f  reflected %.4f' % (
    passed / 100, of['inside'].max() / 100, of['behind'].max() / 100, of['before'][~early].max() / passed))
