"""A run's folder as arrays with units: series, summary, snapshots of all its programs.
SPDX-License-Identifier: BSD-3-Clause"""
import csv
import glob
import json
import os
import re

import h5py
import numpy as np

from . import casefile


class Array(np.ndarray):
    """A numpy array that knows its unit: a.units."""

    def __new__(cls, values, units='-'):
        to = np.asarray(values).view(cls)
        to.units = units
        return to

    def __array_finalize__(self, of):
        self.units = getattr(of, 'units', '-')


class Series(dict):
    """Columns of a series.csv by their names without the unit, in the file's order."""

    def __init__(self, path):
        super().__init__()
        with open(path) as f:
            rows = list(csv.reader(f))
        numbers = np.array([[float(v) if v else np.nan for v in r] for r in rows[1:] if len(r) == len(rows[0])], float)
        numbers = numbers.reshape(-1, len(rows[0]))
        for k, title in enumerate(rows[0]):
            m = re.match(r'\s*(.*?)\s*(?:\[(.*)\])?\s*$', title)
            self[m.group(1)] = Array(numbers[:, k], m.group(2) or '-')

    def frame(self):
        """A pandas DataFrame over t; columns as in the file."""
        import pandas
        data = pandas.DataFrame({'%s [%s]' % (k, v.units): np.asarray(v) for k, v in self.items()})
        return data.set_index(data.columns[0])


class Part:
    """What one program wrote of one time. Fields by name: of particles one value each, of cells one array a block;
    part.x: positions (n, dim) of particles, or the vertices of each block, (nk + 1,) nj + 1, ni + 1, dim."""

    def __init__(self, program, path):
        self.program, self.path = program, path
        with h5py.File(path, 'r') as f:
            self.attributes = {k: v.decode() if isinstance(v, bytes) else v for k, v in f.attrs.items() if k != 'case'}
            self.time = float(f.attrs['time'])
            self.names = sorted(f)
            self.bodies = [f['outline_%d' % k][...].astype(float) for k in range(1, 1 + self._count('outline_'))]
            self.meshes = {n[9:]: f[n][...].astype(float) for n in self.names if n.startswith('vertices_')}
        self.particles = 'position' in self.names
        self.blocks = int(self.attributes.get('blocks', 0))

    def _count(self, begin):
        return sum(n.startswith(begin) for n in self.names)

    def _get(self, name):
        with h5py.File(self.path, 'r') as f:
            d = f[name]
            units = d.attrs.get('units', b'-')
            return Array(d[...], units.decode() if isinstance(units, bytes) else str(units))

    @property
    def fields(self):
        if self.particles:
            other = ('position', 'outline_', 'vertices_')
        else:
            other = ('x_', 'vertices', 'rows')
        names = [re.sub(r'_1$', '', n) if self.blocks else n for n in self.names if not n.startswith(other)]
        return [n for n in names if not (self.blocks and re.search(r'_\d+$', n))]

    def __contains__(self, name):
        return name in self.fields

    def __getitem__(self, name):
        if name not in self:
            raise KeyError('%s has no field %s, only: %s' % (os.path.basename(self.path), name, ', '.join(self.fields)))
        if self.blocks:
            return [self._get('%s_%d' % (name, k)) for k in range(1, self.blocks + 1)]
        return self._get(name) if self.particles else [self._get(name)]

    @property
    def x(self):
        if self.particles:
            return self._get('position')
        if self.blocks:
            return [self._get('x_%d' % k) for k in range(1, self.blocks + 1)]
        return [self.program.vertices(self)]

    def dataset(self):
        """An xarray Dataset: of particles over `particle`, of the cells of one block over k, j, i."""
        import xarray
        if not self.particles and len(self.x) > 1:
            raise ValueError('several blocks are no one dataset; part[field] lists them')
        to = xarray.Dataset(attrs={'time': self.time})
        for name in self.fields:
            v = self[name] if self.particles else self[name][0]
            axes = ['particle'] if self.particles else list('kji'[3 - self.program.dim:])
            axes += ['component'] if v.ndim > len(axes) else []
            to[name] = (axes, np.asarray(v), {'units': v.units})
        x = self.x if self.particles else centres(self.x[0])
        for a in range(x.shape[-1]):
            axes = ['particle'] if self.particles else list('kji'[3 - self.program.dim:])
            to = to.assign_coords({'xyz'[a]: (axes, np.asarray(x[..., a]), {'units': 'm'})})
        return to


def centres(x):
    """Centres of cells from their vertices."""
    for a in range(x.ndim - 1):
        n = x.shape[a]
        x = (x.take(range(1, n), a) + x.take(range(n - 1), a)) / 2
    return x


class Program:
    """One program of a run: its case as it ran it, its series, summary and snapshots."""

    def __init__(self, run, name):
        self.run, self.name = run, name
        self.case = casefile.load(os.path.join(run.dir, name + '-case.cfg'))
        domain = self.case.get('domain', {})  # its lower corner is the origin unless it is given
        domain.setdefault('min', [0.0] * len(domain.get('max', [0, 0])))
        self.dim = int(self.case['domain'].get('dim', 2))
        self.files = sorted(glob.glob(os.path.join(glob.escape(run.dir), name + '_[0-9]*.h5')))
        self._times = None

    def _beside(self, what):  # a job's programs have files of their own
        own = os.path.join(self.run.dir, '%s-%s' % (self.name, what))
        return own if os.path.exists(own) else os.path.join(self.run.dir, what)

    @property
    def series(self):
        return Series(self._beside('series.csv'))

    @property
    def summary(self):
        with open(self._beside('summary.json')) as f:
            return json.load(f)

    @property
    def times(self):
        if self._times is None:
            self._times = []
            for path in self.files:
                with h5py.File(path, 'r') as f:
                    self._times.append(float(f.attrs['time']))
        return self._times

    def __len__(self):
        return len(self.files)

    def __getitem__(self, n):
        return Part(self, self.files[n])

    def near(self, t):
        """The snapshot nearest to a time."""
        return self[int(np.argmin(np.abs(np.array(self.times) - t)))] if self.files else None

    def vertices(self, part):  # of the one block of cells
        with h5py.File(self.files[0], 'r') as f:
            if 'vertices' in f:
                return Array(f['vertices'][...], 'm')
            a = f.attrs
            shape = f['velocity' if 'velocity' in f else part.fields[0]].shape[:3]
            edges = [np.linspace(a[c + 'min'], a[c + 'max'], n + 1) for c, n in zip('xyz', shape[::-1])]
            if 'rows' in f:
                edges[1] = f['rows'][...].ravel()
        return Array(np.stack(np.meshgrid(*edges[::-1], indexing='ij')[::-1], 3), 'm')

    def triangles(self):
        """Meshes of walls and bodies in 3D: name -> (vertices or None where they move, corners (n, 3))."""
        path = os.path.join(self.run.dir, self.name + '_walls.h5')
        if not os.path.exists(path):
            return {}
        with h5py.File(path, 'r') as f:
            return {n[10:]: (f['vertices_' + n[10:]][...] if 'vertices_' + n[10:] in f else None,
                             f[n][...].reshape(-1, 3).astype(int)) for n in f if n.startswith('triangles_')}

    def boxes(self):
        """Corners, (2, 3), of the boxes that are cut out of cells: of the group blocked, and bodies where fv runs alone."""
        def three(x):
            return (list(x) + [0.0] * 3)[:3]

        found = [np.array([three(b['min']), three(b['max'])], float) for b in self.case.get('blocked', [])]
        for b in self.case.get('bodies', []) if list(self.run.programs) == ['fv'] else []:
            corners = b.get('box') or (b.get('points') if self.dim == 2 else None)
            if corners:
                x = np.array([three(p) for p in corners], float) * b.get('scale', 1.0)
                turn = np.radians(three(b.get('rotate', []))[2])  # boxes turn by right angles about z alone
                x[:, :2] = x[:, :2] @ np.round([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]], 12)
                found.append(np.array([x.min(0), x.max(0)]) + three(b.get('translate', [])))
        return found


class Snapshot(dict):
    """The parts of all programs at one time, by program."""

    def __init__(self, time, parts):
        super().__init__(parts)
        self.time = time


class Run:
    """All that a run left in its folder. run.programs: by name; run.series and run.summary: of the job."""

    def __init__(self, folder):
        self.dir = os.fspath(folder).rstrip('/') or '/'
        cases = sorted(glob.glob(os.path.join(glob.escape(self.dir), '*-case.cfg')))
        if not cases:
            raise FileNotFoundError('%s: no run here (no file PROGRAM-case.cfg)' % self.dir)
        self.programs = {}
        for path in cases:
            name = os.path.basename(path)[:-len('-case.cfg')]
            if name != 'coupler':
                self.programs[name] = Program(self, name)
        first = next(iter(self.programs.values()))
        self.dim, self.case = first.dim, first.case

    @property
    def series(self):
        return Series(os.path.join(self.dir, 'series.csv'))

    @property
    def summary(self):
        with open(os.path.join(self.dir, 'summary.json')) as f:
            return json.load(f)

    @property
    def times(self):
        found = {}
        for p in self.programs.values():
            for t in p.times:
                found.setdefault('%.9g' % t, t)
        return sorted(found.values())

    @property
    def fields(self):
        """Names of the fields that can be drawn."""
        return sorted({f for p in self.programs.values() if p.files for f in p[-1].fields})

    def __getitem__(self, name):
        return self.programs[name]

    def column(self, name):
        """Times and values of a column, of the job or of any of its programs ("P1", "sph.particles")."""
        program, _, own = name.partition('.')
        if own and program in self.programs:
            places = [self.programs[program].series]
            name = own
        else:
            places = [self.series] if os.path.exists(os.path.join(self.dir, 'series.csv')) else []
            places += [p.series for p in self.programs.values()]
        for s in places:
            if name in s:
                return next(iter(s.values())), s[name]
        known = sorted({k for s in places for k in s})
        raise KeyError('%s: no column %s, only: %s' % (self.dir, name, ', '.join(known)))

    def at(self, n=-1, time=None):
        """A snapshot, by number (-1: the last) or by the nearest time."""
        times = self.times
        if not times:
            raise LookupError('%s holds no snapshots' % self.dir)
        t = times[n] if time is None else times[int(np.argmin(np.abs(np.array(times) - time)))]
        return Snapshot(t, {k: p.near(t) for k, p in self.programs.items() if p.files})


def read(folder):
    """The run of a folder."""
    return Run(folder)


def value_of(summary, name):
    """A number of the summary by its path, "error.velocity_l2"; names may hold points and spaces themselves."""
    if name in summary:
        return summary[name]
    for k, v in summary.items():
        if isinstance(v, dict) and name.startswith(k + '.'):
            found = value_of(v, name[len(k) + 1:])
            if found is not None:
                return found
    return None


def criteria(run):
    """(name, measured, allowed) of what the case itself wants."""
    summary = run.summary
    for row in run.case.get('accept', []):
        name = row['what']
        if row.get('reference'):
            name = 'compare.%s_%s' % (name.replace(' ', '_'), row.get('measure', 'rms'))
        value = next((v for v in (value_of(summary, n) for n in (name, 'error.' + name)) if v is not None), None)
        program, _, own = name.partition('.')
        if value is None and program in run.programs:
            value = value_of(run[program].summary, own)
        yield name, value, row.get('tolerance')
