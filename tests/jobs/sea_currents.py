#!/usr/bin/python3
"""sea_currents.py - seas on a current of +0.3 and -0.1 m/s between two zones of kind wave: each component near the peak has the
amplitude that JONSWAP's spectrum gives it, the length that the dispersion relation in the water's frame gives its frequency over the
ground, and below it the velocity of linear theory. What the current holds is refused.
usage: sea_currents.py BUILD [sph]: fv, or sph on the first of them (4 minutes). SPDX-License-Identifier: BSD-3-Clause"""
import cmath
import math
import os
import sys

import lib

G, DEPTH, LOW, HEIGHT, GAMMA = 9.81, 0.16, 0.03, 0.02, 3.3  # m/s^2; m: depth, gauge of velocity over the floor, significant height
PLACES = [1.8 + 0.15 * i for i in range(9)]  # m, of the gauges
BAND = 0.8, 1.3  # of the peak's frequency: nine tenths of the energy


def case(solver, current, period, repeat, end):
    """A tank of 4.8 m; the peak is 1 m long."""
    gauges = ''.join('{ name = "g%d"; kind = "level"; at = (%g, 0.17); }, ' % (i, x) for i, x in enumerate(PLACES))
    return """format = 1;
time:    { end = %g; };
fluid:   { gravity = (0, -%g); };
domain:  { dim = 2; max = (4.8, 0.25); };
initial: { field = "uniform"; velocity = (%g, 0); };
shapes:  ( { form = "below"; level = %g; } );
walls:   ( { side = "x_min"; kind = "wave"; }, { side = "x_max"; kind = "wave"; }, { side = "y_min"; }, { side = "y_max"; } );
waves:   { kind = "sea"; height = %g; period = %g; peak = %g; repeat = %g; zone = 1.5; current = %g; };
probes:  ( %s{ name = "low"; kind = "velocity"; at = (%g, %g); } );
%s
output:  { snapshots = false; series = 1; };
""" % (end, G, current, DEPTH, HEIGHT, period, GAMMA, repeat, current, gauges, PLACES[4], LOW, solver)


def number(omega, current):
    """Wave number of (omega - k U)^2 = g k tanh kh, the smaller one, by bisection below the place of the highest frequency."""
    over_ground = lambda k: math.sqrt(G * k * math.tanh(k * DEPTH)) + k * current
    low, high = 0.0, 1.0
    while over_ground(high) < omega:
        if over_ground(1.01 * high) < over_ground(high):
            return math.nan  # the current holds such waves
        high *= 1.01
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if over_ground(middle) < omega else (low, middle)
    return low


def amplitudes(current, period, repeat):
    """Of the components, by n, at n/repeat from half to three times the peak's frequency: together of the significant height."""
    density = {}
    for n in range(math.ceil(0.5 * repeat / period), math.floor(3 * repeat / period) + 1):
        if math.isnan(number(2 * math.pi * n / repeat, current)):
            break
        f = n * period / repeat
        s = 0.07 if f <= 1 else 0.09
        density[n] = f ** -5 * math.exp(-1.25 * f ** -4) * GAMMA ** math.exp(-(f - 1) ** 2 / (2 * s * s))
    total = sum(density.values())
    return {n: 0.25 * HEIGHT * math.sqrt(2 * d / total) for n, d in density.items()}


def harmonic(t, v, omega, start):
    """Complex amplitude of e^(i omega t) from `start' to the end, by the trapezoid."""
    steps = [k for k in range(1, len(t)) if t[k - 1] >= start]
    mean = sum((t[k] - t[k - 1]) * (v[k] + v[k - 1]) / 2 for k in steps) / (t[-1] - t[steps[0] - 1])
    w = [(x - mean) * cmath.exp(-1j * omega * at) for x, at in zip(v, t)]
    return 2 * sum((t[k] - t[k - 1]) * (w[k] + w[k - 1]) / 2 for k in steps) / (t[-1] - t[steps[0] - 1])


def judge(columns, current, period, repeat, end):
    """Of the components of the band: height over the one wanted; rms, by energy, of the errors of length and of the velocity
    below; rms of what is no such wave (it has waves that come back), over the waves."""
    t = columns['t [s]']

    def of(title, omega):
        return harmonic(t, next(v for name, v in columns.items() if name.startswith(title)), omega, end - repeat)

    wanted = got = wrong = rest = length = 0.0
    for n, a in amplitudes(current, period, repeat).items():
        if not BAND[0] <= n * period / repeat <= BAND[1]:
            continue
        omega = 2 * math.pi * n / repeat
        k = number(omega, current)
        levels = [of('g%d ' % i, omega) for i in range(len(PLACES))]
        wave = sum(h * cmath.exp(1j * k * x) for h, x in zip(levels, PLACES)) / len(PLACES)
        here = wave * cmath.exp(-1j * k * PLACES[4])
        below = here * (omega - k * current) * math.cosh(k * LOW) / math.sinh(k * DEPTH)
        wanted += a * a
        got += abs(wave) ** 2
        length += (phase_slope(levels) / k - 1) ** 2 * a * a
        wrong += abs(of('low u', omega) / below - 1) ** 2 * a * a
        rest += sum(abs(h - wave * cmath.exp(-1j * k * x)) ** 2 for h, x in zip(levels, PLACES)) / len(PLACES)
    return math.sqrt(got / wanted), math.sqrt(length / wanted), math.sqrt(wrong / wanted), math.sqrt(rest / got)


def phase_slope(h):
    """Wave number by the slope of the phases, from gauge to gauge less than half a turn each."""
    phases = [0.0]
    for before, now in zip(h, h[1:]):
        phases.append(phases[-1] + cmath.phase(before / now))
    middle = sum(PLACES) / len(PLACES)
    return sum((x - middle) * p for x, p in zip(PLACES, phases)) / sum((x - middle) ** 2 for x in PLACES)


def run(program, solver, current, period, repeat, end):
    """Wanted: height 5 % (cases/wave_sea), length 1 %, velocity and what is no such wave 5 %."""
    name = '%s on %g m/s' % (program, current)
    lib.write('sea.cfg', case(solver, current, period, repeat, end))
    if lib.run(os.path.join(lib.build, program), 'sea.cfg', '-o', 'out', '--force', log='run.log', most=3000) != 0:
        return lib.bad('a sea in ' + name, 'run.log')
    height, length, velocity, rest = judge(lib.series('out/series.csv'), current, period, repeat, end)
    print('sea_currents: %s: height %.3f of the one wanted, lengths %.2f %% off, velocity %.1f %%, other waves %.1f %%' %
          (name, height, 100 * length, 100 * velocity, 100 * rest))
    for what, error, most in (('height', abs(height - 1), 0.05), ('length', length, 0.01), ('velocity', velocity, 0.05), ('rest', rest, 0.05)):
        if not error <= most:
            lib.bad('a sea in %s: %s is off by %.3g' % (name, what, error))


lib.scratch()
if sys.argv[2:] == ['sph']:
    run('sph', 'sph: { dx = 0.0125; };', 0.3, 0.7159, 6.0, 12.0)
else:
    run('fv', 'fv: { cells = (144, 20); };', 0.3, 0.7159, 8.0, 16.0)
    run('fv', 'fv: { cells = (144, 20); };', -0.1, 1.0, 8.0, 18.0)
    lib.refused('fv', case('fv: { cells = (144, 20); };', -0.9, 1.0, 8.0, 18.0), 'waves.current: -0.9 m/s')
lib.end('%d faults' % lib.failed)
