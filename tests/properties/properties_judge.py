"""properties_judge.py - the laws. verdict reads DIR/plan and what the runs left in DIR. Every tolerance has its reason beside it.
SPDX-License-Identifier: BSD-3-Clause"""
import collections
import os
import re


def figure(text):
    """A number; 0 for what is none."""
    try:
        return float(text)
    except ValueError:
        return 0.0


class Run:
    """Exit code, words, columns and summary of a run. A name that a summary has twice is its first."""

    def __init__(self, directory, name, program):
        self.name, self.program, self.sick = name, program, None
        self.code = int(self.text(directory, name + '.code') or -1)
        words = self.text(directory, name + '.out').split('\n')
        self.refusal = next((line for line in words if re.search(r'\.cfg(:\d+)?: [a-z]+[^ ]*: ', line)), '')
        self.reason = next((line for line in words if re.search('diverged at|stopped|limit', line)), '')
        self.warned = ''.join(line for line in words if 'warning' in line)
        titles, *lines = [line.split(',') for line in self.text(directory, name + '/series.csv').splitlines()] or [[]]
        # what is of the whole flow by one name, per metre of depth or not
        whole = {'[J/m]': '[J]', '[kg/m]': '[kg]', '[N s/m]': '[kg m/s]', '[m^2]': '[m^dim]', '[m^3]': '[m^dim]', '[m^2/s^2]': '[m^dim/s^2]', '[m^3/s^2]': '[m^dim/s^2]'}
        titles = [re.sub(r'\[[^]]*\]$', lambda unit: whole.get(unit[0], unit[0]), title) for title in titles]
        self.columns = {title: [figure(line[k]) for line in lines] for k, title in enumerate(titles)}
        self.t = next(iter(self.columns.values()), [])
        self.rows = len(lines)
        for line in lines:
            for title, value in zip(titles, line):
                self.sick = self.sick or re.search('nan|inf', value) and '%s at t = %s' % (title, line[0])
        said = self.text(directory, name + '/summary.json')
        self.present = bool(said)
        self.summary = {key: figure(value) for key, value in reversed(re.findall(r'"(\w+)": ([^,{\[\n]*)', said))}
        self.sick = self.sick or next(iter(re.findall(r'.*: -?(?:nan|inf).*', said)), None)

    @staticmethod
    def text(directory, name):
        path = os.path.join(directory, name)
        return open(path, errors='replace').read() if os.path.exists(path) else ''

    def first(self, title):
        return self.columns[title][0]

    def last(self, title):
        return (self.columns.get(title) or [0.0])[-1]


class Twin:
    """The same scene moved (each axis to another, with a sign, shifted) and in other units."""

    def __init__(self, words):
        self.name, numbers = words[0], [float(word) for word in words[1:]]
        self.axis, self.sign, self.shift = [int(a) for a in numbers[:3]], numbers[3:6], numbers[9:12]
        self.L, self.U, self.R = numbers[6:9]

    @property
    def handed(self):
        """The determinant of the motion."""
        a, b, c = self.axis
        return (1 if (a, b, c) in ((0, 1, 2), (1, 2, 0), (2, 0, 1)) else -1) * self.sign[0] * self.sign[1] * self.sign[2]


def unit(title):
    """What stands in brackets; of a moment, whatever it is, that word."""
    return 'moment' if 'moment' in title and 'momentum' not in title else title[title.find('[') + 1:title.rfind(']')]


class Judge:
    def __init__(self, directory):
        self.know, self.runs, self.twins, self.violations = collections.defaultdict(float), {}, [], []
        for line in open(os.path.join(directory, 'plan')):
            kind, *words = line.split()
            if kind == 'run':
                self.runs[words[0]] = Run(directory, *words[:2])
            elif kind == 'twin':
                self.twins.append(Twin(words))
            else:
                self.know[words[0]] = ' '.join(words[1:]) if words[0] == 'family' else float(words[1])
        self.base = self.runs['base']

    def bad(self, law, text):
        self.violations.append('%s: %s' % (law, text))

    def measure(self, title, l, u, r, p, mass):
        """A column's unit by a length, a velocity, a density, a pressure over density and a mass; nothing: none of them."""
        d = self.know['dim']
        return {'moment': r * p * l ** d, 's': l / u, 'J': mass * u * u, 'm^dim/s^2': u * u * l ** (d - 2), 'kg': mass, 'kg m/s': mass * u,
                'kg/m^3': r, 'Pa': r * p, 'm': l, 'm/s': u, '1/s': u / l, 'rad/s': u / l, 'm^dim': l ** d,
                'N': r * p * l ** (d - 1), 'N/m': r * p * l ** (d - 1)}.get(unit(title))

    def factor(self, title, twin):
        """What a column's unit is times in the twin."""
        return self.measure(title, twin.L, twin.U, twin.R, twin.U ** 2, twin.R * twin.L ** self.know['dim']) or 1.0

    def scale(self, title):
        """What is large for a column; 0: its own values."""
        know = self.know
        if re.search('mass of level changes|^through', title):
            return know['mass']
        if re.match('(particles|guards) level', title):  # who crosses an edge now, rounding decides
            return 1e5 * max(2, 0.01 * self.base.first('particles [-]'))
        if unit(title) in ('moment', 'J', 'm^dim/s^2', 'kg m/s', 'Pa', 'm', 'rad/s', 'm/s', 'N', 'N/m'):
            p = know['speed'] ** 2 + know['gravity'] * know['length']
            return self.measure(title, know['length'], know['speed'], know['rho'], p, know['mass'])
        return 1.0 if unit(title) == 'rad' else 0.1 if re.search('max Mach|error', title) else 0.0

    @staticmethod
    def answer(title, twin):
        """The column of the twin that answers to the base's; its sign there, and what is added to it. Bodies show places,
        velocities u v w, and what turns with the hand: rotations rx ry rz, spins ox oy oz, moments; in the plane angle and spin."""
        side = re.match('((?:through|level) )([xyz])_m(ax|in)', title)
        if side:
            a = 'xyz'.index(side[2])
            upper = (side[3] == 'ax') != (twin.sign[a] < 0)
            return side[1] + 'xyz'[twin.axis[a]] + ('_max' if upper else '_min') + title[side.end():], 1, 0
        turned = twin.handed if re.match(r'b\d (angle|spin) |b\d.* [ro][xyz] \[', title) or unit(title) == 'moment' else 1
        letters = 'uvw' if re.match(r'b\d [uvw] \[', title) else 'xyz'
        found = re.search(r' [uvw] \[' if letters == 'uvw' else r' [ro]?[xyz] \[', title)
        if not found or re.search('water up to|^moment z', title):
            return title, turned, 0
        place = found.end() - 3
        a = letters.index(title[place])
        b = twin.axis[a]
        moved = twin.shift[b] if re.match(r'b\d [xyz] \[m\]', title) else 0
        return title[:place] + letters[b] + title[place + 1:], turned * twin.sign[a], moved

    def compared(self, title, t):
        """Counts and residuals say how a figure was reached, not what it is."""
        if re.search('divergence|put back|gain|paired|odd-even|growth|residual|iteration|krylov|pseudo|water up to|watch', title):
            return False
        if '[s]' in title:
            return False
        if re.match(r'P\d \[m\]|moment z', title):  # the moment is about the origin
            return t in ('units', 'ranks')
        if re.match(r'P\d \[Pa\]', title):
            return t != 'carried'
        if 'error' in title and re.search('wave|channel', self.know['family']):  # relative to a start at rest
            return False
        # extremes jump from one particle or cell to another
        return t == 'units' or not re.search('min spacing|max Mach|density|error', title)

    def tolerance(self, t, title):
        """Units change by powers of two: all is equal to rounding, and rounding is the same but for sines of phases. Else sums
        run in another order: particles follow rounding exponentially (a thousandfold in some ten steps), so early rows count; cells
        are solved to fv.tol_pressure = 1e-2 of a step's divergence, by sweeps that know left from right. A file of triangles is
        read to 7 digits, which are others in other units."""
        if t == 'units':
            digits = self.know['dim'] == 3 and re.search('solid|floating', self.know['family'])
            return 1e-4 if self.base.program == 'coupled' or digits else 1e-6
        if self.base.program == 'sph':
            return 1e-5
        return 0.05 if re.search(r'force|moment|\[Pa\]', title) else 0.02

    def compare(self, twin):
        t, base, other = twin.name, self.base, self.runs[twin.name]
        n = min(base.rows, other.rows)
        if t == 'units' and base.rows != other.rows:
            return self.bad(t, '%d steps become %d' % (base.rows, other.rows))
        if t != 'units':
            n = min(n, 24 if self.know['refined'] else 12)  # births and deaths act from row 4 on
        for row in range(n):
            if abs(base.t[row] - other.t[row] / self.factor('[s]', twin)) > 1e-6 * base.t[row]:
                if t == 'units':
                    return self.bad(t, 'step %d ends at another time' % (row + 1))
                n = row
                break
        for title in list(base.columns)[2:]:
            if self.compared(title, t):
                self.compare_column(twin, other, title, n)

    def compare_column(self, twin, other, title, n):
        t, values = twin.name, self.base.columns[title]
        name, turned, moved = self.answer(title, twin)
        if name not in other.columns:
            return self.bad(t, 'no column ' + name)
        # a sudden start is an impulse, rho U L over the step, of which the tolerance of the pressure leaves noise for some steps
        sudden = self.base.program == 'fv' and t not in ('units', 'ranks') and re.search(r'force|moment|\[Pa\]', title)
        rows = range(7 if sudden else 0, n)
        off = [abs(values[k] - turned * (other.columns[name][k] - moved) / self.factor(title, twin)) for k in rows]
        big = max([self.scale(title)] + [abs(values[k]) for k in rows])
        if off and max(off) > self.tolerance(t, title) * big:
            self.bad(t, '%s: off by %.2g of %.3g in row %d of %d' % (title, max(off), big, rows[off.index(max(off))] + 1, self.base.rows))

    def compare_drift(self, twin):
        """What the summary says of the whole run does not depend on the origin and the axes either; paths part, energies hardly."""
        a, b = (run.summary.get('energy') for run in (self.base, self.runs[twin.name]))
        if self.base.program != 'sph' or twin.name == 'refined' or a is None or b is None:
            return
        if abs(a - b) > 0.02 + 0.2 * max(abs(a), abs(b)):
            self.bad(twin.name, 'drift.energy %.3g becomes %.3g' % (a, b))

    def compare_carried(self, twin):
        """A carried flow has the same energy in its own frame, to the scheme's error: a percent or two where a wave has 12 cells."""
        know, base, energy = self.know, self.base, 'kinetic energy [J]'
        if energy not in base.columns or (know['error'] == 0 and base.program != 'sph'):
            return
        mass = base.last('mass [kg]') if 'mass [kg]' in base.columns else know['mass']
        own = self.runs[twin.name].last(energy)
        for x in 'xyz'[:int(know['dim'])]:
            momentum = 'momentum %s [kg m/s]' % x
            P, dV = base.last(momentum) if momentum in base.columns else mass * know['V' + x], know['d' + x]
            own -= P * dV + 0.5 * mass * dV * dV
        if abs(own - base.last(energy)) > 0.05 * mass * know['speed'] ** 2:
            self.bad(twin.name, 'kinetic energy %.4g J becomes %.4g J in its own frame' % (base.last(energy), own))

    def ended(self, run):
        """How one run ended; 152: it used up its processor time."""
        if run.code in (124, 137, 152):
            self.bad('ends', run.name + ' hangs')
        elif run.code == 2 and not run.refusal:
            self.bad('refuses', run.name + ' without file, line and key')
        elif run.code == 3 and not run.reason:
            self.bad('ends', run.name + ' diverged without a reason')
        elif run.code == 3 and self.know['standard']:
            self.bad('default', '%s stops: %s' % (run.name, run.reason))
        elif run.code not in (0, 1, 2, 3):
            self.bad('ends', '%s with exit code %d' % (run.name, run.code))
        if run.code < 2 and not run.present:
            self.bad('ends', run.name + ' without summary.json')
        if run.code < 2 and run.sick:
            self.bad('numbers', '%s: %s' % (run.name, run.sick))

    def laws(self):
        know, base = self.know, self.base
        # Births, removals and guards at edges of levels keep mass on average: 0.1 %, and some particles about to cross.
        slack = 1e-3 + 8 / base.first('particles [-]') if know['refined'] else 0
        self.energy(know, base, slack)
        self.masses(know, base, slack)
        # Pairs push each other: sums cancel to rounding; where shifts carry velocities along (delta, standard) nearly.
        whole = know['mass'] * know['speed']
        for x in 'xyz'[:int(know['dim'])] if know['free_of_walls'] and base.program == 'sph' and know['gravity'] == 0 else '':
            title = 'momentum %s [kg m/s]' % x
            start, end = base.first(title), base.last(title)
            if abs(end - start) > (1e-8 if know['standard'] else 0.01) * whole + slack * abs(start) + (0.01 * whole if slack else 0):
                self.bad('momentum', 'changes from %.3g to %.3g kg m/s (mass x speed %.3g)' % (start, end, whole))
                break
        # Particles settle on walls within some thousandths of c, and say so where they are too few; cells are at rest to the
        # solver's tolerance.
        if know['still'] and 'the flow there is noise' not in base.warned:
            mach, fastest = base.last('max Mach [-]'), base.last('largest velocity [m/s]')
            if base.program == 'sph' and mach > 5e-3:
                self.bad('rest', '|u| = %.2g c0 at the end' % mach)
            if base.program == 'fv' and fastest > 1e-6 * know['speed']:
                self.bad('rest', '|u| = %.2g of %.2g m/s at the end' % (fastest, know['speed']))
        self.errors(know, base)

    def energy(self, know, base, slack):
        energy, sph = base.columns.get('kinetic energy [J]', []), base.program == 'sph'
        # Sound takes up to Mach^2 = 1 % of the energy and gives it back; cells lose some, their projection is good to 1e-3.
        most = energy and energy[0] * (1 + slack + (0.03 if sph else 1e-3)) + 1e-6 * know['mass'] * know['speed'] ** 2
        if know['unforced'] and not know['still'] and know['gravity'] == 0 and base.program != 'coupled':
            row = next((k for k in range(1, base.rows) if energy[k] > most), None)
            if row:
                self.bad('energy', 'grows unforced: %.4g J, then %.4g J in row %d of %d' % (energy[0], energy[row], row + 1, base.rows))
        if know['closed'] and know['gravity'] > 0 and sph and know['unforced'] and base.summary.get('energy', 0) > 0.03:
            self.bad('energy', 'grows by %.6g in a closed tank' % base.summary['energy'])

    def masses(self, know, base, slack):
        """Masses are moved between particles, never made."""
        if know['closed'] and base.program == 'sph':
            gone = base.summary.get('particles_lost', 0)
            lost = gone / base.first('particles [-]')
            drift = base.last('mass [kg]') / base.first('mass [kg]') - 1 + lost
            if abs(drift) > 1e-9 + slack + 0.1 * lost:  # densities differ by some percent
                self.bad('mass', 'drifts by %.6g' % drift)
            if lost > 0 and 'left the region' not in base.warned:
                self.bad('mass', 'particles are lost without a word')
            if lost > 0 and not know['open_above']:
                self.bad('mass', '%d particles lost' % gone)
        volume = base.columns.get('volume [m^dim]', [0])
        if volume[0] > 0 and abs(volume[-1] / volume[0] - 1) > 0.01:
            self.bad('mass', 'volume %.4g becomes %.4g' % (volume[0], volume[-1]))

    def errors(self, know, base):
        """A uniform stream is its own solution (particles: 1 % by sound; their number changes by whole rows).
        Half as many cells a wave as the coarsest case of the table in README.md: ten times its error."""
        if know['error'] > 0 and base.summary.get('velocity_l2', 0) > know['error'] and not base.warned:
            self.bad('error', 'of %.6g without a word' % base.summary['velocity_l2'])
        stream, fastest = know['stream'], base.last('largest velocity [m/s]')
        if stream > 0 and base.program == 'sph':
            a_mass = [e / m for e, m in zip(base.columns['kinetic energy [J]'], base.columns['mass [kg]'])]
            row = next((k for k, e in enumerate(a_mass) if abs(e / a_mass[0] - 1) > 0.02), None)
            if row:
                off = a_mass[row] / a_mass[0] - 1
                self.bad('error', 'uniform stream: energy a mass changes by %.2g in row %d of %d' % (off, row + 1, base.rows))
        if stream > 0 and base.program == 'fv' and abs(fastest / stream - 1) > 1e-4:
            self.bad('error', 'uniform stream of %.4g m/s becomes %.4g m/s' % (stream, fastest))

    def judge(self):
        base = self.base
        for run in self.runs.values():
            self.ended(run)
        if base.code < 2 and base.rows > 0:
            self.laws()
        for twin in self.twins:
            run = self.runs[twin.name]
            if run.code == base.code and base.code < 2:
                if twin.name == 'carried':
                    self.compare_carried(twin)
                else:
                    self.compare(twin)
                    self.compare_drift(twin)
            elif twin.name == 'ranks' and 'ranks cannot share' in run.refusal + base.refusal:
                continue  # fewer cells than ghosts
            elif run.code != base.code and not (run.code > 100 or base.code > 100):
                self.bad(twin.name, 'exit code %d becomes %d %s%s' % (base.code, run.code, run.refusal, run.reason))


def verdict(directory):
    """The violations, and why the scene was refused (empty: it was not)."""
    judge = Judge(directory)
    judge.judge()
    return judge.violations, judge.base.refusal if judge.base.code == 2 else ''
