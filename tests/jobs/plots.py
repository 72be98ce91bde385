# What cases/estran reads and draws of four runs: plots.py ROOT POOL CUBE JOB TANK. SPDX-License-Identifier: BSD-3-Clause
import json
import os
import subprocess
import sys
from types import SimpleNamespace

import h5py
import numpy as np

sys.path.insert(0, os.path.join(sys.argv[1], 'cases'))
import estran
from estran import casefile, curves, drawing, film as films, grids, page as pages, vtk
from PIL import Image

pool, cube, job, tank = (estran.read(d) for d in sys.argv[2:])


def near(a, b, tolerance):
    assert abs(a - b) <= tolerance, (a, b, tolerance)


# case files: groups, lists, texts in pieces, comments
found = casefile.parse('a = 1; b: { c = (1.5, "x" "y"); /* no */ d = true; }; # e = 1;\n f = ( { g = -2L; }, { } ); //')
assert found == {'a': 1, 'b': {'c': [1.5, 'xy'], 'd': True}, 'f': [{'g': -2}, {}]}, found
assert pool.case['bodies'][0]['name'] == 'box' and pool.case['domain']['max'][0] == 2

# series: names, units; the mass of the snapshot is that of the series
assert pool.series['kinetic energy'].units == 'J/m' and pool.series['t'].units == 's'
part = pool.at()['sph']
near(part.time, 0.1, 1e-12)
near(1000 * np.asarray(part['volume'], float).sum(), pool.series['mass'][-1], 0.01 * pool.series['mass'][-1])
assert len(part['pressure']) == pool.series['particles'][-1] and part['pressure'].units == 'Pa'
near(pool.column('P')[1][-1], 1000 * 9.81 * 0.4, 0.05 * 3924)
assert len(part.bodies) == 1 and np.allclose(np.ptp(part.bodies[0], axis=0), [0.3, 0.4])
# a body is filled with grey, a tank, which runs the other way round its water, is not
assert not drawing.holds_water(part.bodies[0]) and drawing.holds_water(part.bodies[0][::-1])
faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])  # normals out
assert drawing.holds_water(np.eye(4, 3), faces[:, ::-1]) != drawing.holds_water(np.eye(4, 3), faces)
try:
    pool.column('Q')
    raise AssertionError('a column that is not there')
except KeyError as fault:
    assert 'only:' in str(fault)

# a time beyond the run is told, not only drawn as the last snapshot
late = subprocess.run([os.path.join(sys.argv[1], 'cases/plot'), sys.argv[2], 'pressure', '-t', '99'], capture_output=True, text=True, check=True)
assert 'no snapshot at t = 99: there are those of t = 0 to 0.1' in late.stderr, late.stderr

# a job: both programs in one object, at the same times, the snapshots hold the case's vortices
assert sorted(job.programs) == ['fv', 'sph'] and job.column('sph.particles')[1][-1] > 3000
snapshot = job.at(0)
for name, x, v in (('sph', snapshot['sph'].x, snapshot['sph']['velocity']),
                   ('fv', estran.reading.centres(snapshot['fv'].x[0]), snapshot['fv']['velocity'][0])):
    x, k = np.asarray(x, float), 2 * np.pi
    known = np.isfinite(v[..., 0])
    exact = np.sin(k * x[..., 0]) * np.cos(k * x[..., 1])
    assert known.any() and abs(np.asarray(v[..., 0]) - exact)[known].max() < 0.02, name

# cells to points: what is linear stays so, also where cells have no numbers
i, j = np.meshgrid(np.arange(6.0), np.arange(5.0))
plane = 1 + 2 * i - 3 * j
holed = plane.copy()
holed[2:, 3:] = np.nan
to = grids.filled(holed)
assert np.allclose(to[2, 3:], plane[2, 3:]) and np.allclose(to[2:, 3], plane[2:, 3]) and np.isnan(to[3:, 4:]).all()
rim = grids.with_rim(plane)
near(rim[0, 0], 1 - 1 + 1.5, 1e-12)
near(rim[-1, -1], 1 + 2 * 5.5 - 3 * 4.5, 1e-12)
fine = grids.refined(rim, 4)
near(fine[2, 2], (rim[0, 0] + rim[0, 1] + rim[1, 0] + rim[1, 1]) / 4, 1e-12)

# a sphere by nets: its area, radius and values; a cut through triangles: the circle
g = np.linspace(-1, 1, 41)
x = np.stack(np.meshgrid(g, g, g, indexing='ij')[::-1], 3)
faces, values = grids.nets(x, np.linalg.norm(x, axis=3) - 0.7, x[..., 0])
area = sum(np.linalg.norm(np.cross(faces[:, a] - faces[:, 0], faces[:, a + 1] - faces[:, 0]), axis=1).sum() / 2 for a in (1, 2))
near(area, 4 * np.pi * 0.49, 0.03 * 4 * np.pi * 0.49)
near(np.linalg.norm(faces, axis=2).mean(), 0.7, 0.01)
assert abs(values - faces[:, :, 0].mean(1)).max() < 0.01
corners = np.arange(4 * len(faces)).reshape(-1, 4)
triangles = np.concatenate([corners[:, :3], corners[:, [0, 2, 3]]])
chains = grids.loops(grids.cut(faces.reshape(-1, 3), triangles, 2, 0.1234), 1)
assert len(chains) == 1, len(chains)
length = np.linalg.norm(np.diff(chains[0], axis=0), axis=1).sum()
near(length, 2 * np.pi * np.sqrt(0.49 - 0.1234**2), 0.02 * length)

# the water of the cube: its volume under the surface drawn, and nothing in the block
where = drawing.View(cube, 'y=0.3')
(at, value, show, phi), = drawing.cells(cube.at()['fv'], 'pressure', where)
fine = [grids.refined(q, 8) for q in (at, value, show, phi)]
wet = (fine[3] < 0) & (fine[2] >= 0.5)
area = np.gradient(fine[0][..., 0], axis=1) * np.gradient(fine[0][..., 1], axis=0)
near((area * wet).sum() / area.sum(), 0.53 - 0.25 * 0.25, 0.01)
depth = 0.53 - fine[0][..., 1]
assert abs(fine[1] - 9810 * depth)[wet & (depth > 0.1)].max() < 100
assert len(drawing.outlines(cube['fv'], cube.at()['fv'], where)[1]) == 1
assert not drawing.outlines(cube['fv'], cube.at()['fv'], drawing.View(cube, 'y=0.7'))[1]


def picture(path):
    return np.asarray(Image.open(path).convert('RGB'), int)


# pictures: water, air and body where they are; more pressure is another colour; the same picture twice
p = picture(estran.plot(pool, 'pressure', window=(0, 2, 0, 1)))
high, wide = p.shape[:2]
dark = np.argwhere((p < 80).all(2).sum(0) > 0.3 * high).ravel()  # walls left and right
columns = np.linspace(dark.min(), dark.max(), 201)[[20, 65, 130]].astype(int)
inner = np.argwhere((p[:, columns[0]] != 255).any(1)).ravel()


def pixel(x, y):  # of a place in m, from the walls: 2 m apart, the bed at the bottom
    scale = (dark.max() - dark.min()) / 2
    bed = np.argwhere((p[:, columns[0]] < 80).all(1)).max()
    return p[int(bed - y * scale), int(dark.min() + x * scale)]


assert (pixel(0.65, 0.6) == pixel(0.65, 0.4)).all() and np.ptp(pixel(0.65, 0.5)) == 0, 'the body is grey'
assert (pixel(1.2, 0.8) == 255).all(), 'air is white'
assert abs(pixel(0.25, 0.1) - pixel(0.25, 0.4)).max() > 60, 'pressure grows with depth'
# bodies of fv alone are boxes of its cells, which pictures showed as air
fv_alone = SimpleNamespace(name='fv', dim=2, run=SimpleNamespace(programs={'fv': None}), case={'blocked': [{'min': [0, 0], 'max': [1, 2]}], 'bodies': [
    {'box': [[1, 0.2], [1.5, 0]]}, {'points': [[0, 0], [0, 1], [2, 1], [2, 0]], 'scale': 0.5, 'rotate': [0, 0, 90], 'translate': [2.5, 0, 0]}]})
assert [b.tolist() for b in estran.reading.Program.boxes(fv_alone)] == [[[0, 0, 0], [1, 2, 0]], [[1, 0, 0], [1.5, 0.2, 0]], [[2, 0, 0], [2.5, 1, 0]]]
lines, bodies = drawing.outlines(tank.programs['fv'], tank.at()['fv'], drawing.View(tank, None))
assert len(lines) == 4 and not bodies, 'a tank of cells has its four walls'
near(max(line[:, 0].max() for line in lines), 0.5 + 0.1, 1e-9)  # where it has moved to
film = Image.open(estran.movie(pool, 'velocity', to='film.apng'))
assert film.n_frames == len(pool.times) == 3, film.n_frames
film.seek(2)  # all in the colours of the first's palette
snapshots = [pool.at(k) for k in range(3)]
pictures = list(films.frames(pool, 'velocity', drawing.limits(pool, 'velocity', snapshots),
                             drawing.window_of(pool, drawing.View(pool, None), snapshots), None, 800))
off = abs(np.asarray(film.convert('RGB'), int) - pictures[2]).max(2)
assert np.percentile(off, 99) < 16, 'colours of the film'
for run, how in ((job, {}), (cube, {}), (cube, {'plane': 'space'})):
    for field in ('velocity', 'vorticity'):
        q = picture(estran.plot(run, field, **how))
        assert len(np.unique(q.reshape(-1, 3), axis=0)) > 60, (run.dir, field, how)

# the page names the criteria; a reference in other units
page = open(estran.report(pool)).read()
assert 'particles_lost' in page and '>met' in page and page.count('<img') == 4 and '>Gauges<' in page and 'Not accepted' not in page
off = SimpleNamespace(summary={'not_accepted': 'not sound'})
assert 'Not accepted: not sound' in pages.faults(SimpleNamespace(programs={'sph': off, 'fv': pool['sph']}, summary={}))
with open('reference.csv', 'w') as f:
    f.write('# depth\nt,p\n0,4\n1,4\n')
pool.case['accept'] = [{'what': 'P', 'reference': 'reference.csv', 'column': 'p', 'unit': [0.1, 1000]}]
t, v = curves.references(pool, '.')['P']
assert list(t) == [0, 0.1] and list(v) == [4000, 4000]
assert os.path.exists(estran.compare(pool, folder='.'))

# meshes for other tools: cells fill the domain with their corners in VTK's order, particles are points, files hold the same
for run, size in ((job, 1.0), (cube, 1.0)):
    points, kind, corners, fields = vtk.mesh(run.at(0)['fv'])
    x = points[corners]
    near(np.prod((x[:, 6 if kind == vtk.HEXAHEDRON else 2] - x[:, 0])[:, :run.dim], axis=1).sum(), size, 1e-6)
    assert np.allclose(x[:, 1] - x[:, 0], x[:, 2] - x[:, 3]) and all(len(v) == len(corners) for v in fields.values())
points, kind, corners, fields = vtk.mesh(part)
assert kind == vtk.VERTEX and len(points) == len(corners) == len(fields['pressure']) and fields['velocity'].shape[1] == 3
for path in estran.vtkhdf(job, 'meshes'):
    files = json.load(open(path))['files']
    assert [entry['time'] for entry in files] == job.programs[os.path.basename(path).split('.')[0]].times
    with h5py.File(os.path.join('meshes', files[-1]['name'])) as f:
        f = f['VTKHDF']
        assert f['Offsets'][-1] == len(f['Connectivity']) and f['Connectivity'][...].max() == f['NumberOfPoints'][0] - 1
for module, what in (('meshio', lambda: estran.to_meshio(part).points), ('pandas', lambda: pool.series.frame()['P [Pa]']), ('xarray', lambda: part.dataset()['pressure'])):
    try:
        __import__(module)
    except ImportError:
        continue
    assert len(what()) > 1
print('plots: as they should be')
