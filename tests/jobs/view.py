"""view.py beside a run: what it knows of the scene, and the pieces of it that need no ParaView; the picture of the scene.
SPDX-License-Identifier: BSD-3-Clause"""
import ast
import glob
import io
import os
import re
import sys
import types

import lib
from lib import alone, bad, changed

import numpy as np

lib.scratch()
SLOPE = changed(lib.TANK, time='end = 0.01;', domain='min = (-0.25, 0); max = (2, 1);', initial='U = 1.0;', output='', sph='dx = 0.05;',
                shapes='{ form = "box"; box = ((-0.25, 0), (0.5, 0.5)); }',
                walls='{ side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { points = ((1.0, 0), (2, 0.4)); }')
alone('sph', 'out', SLOPE)
# the scene drawn: labels of things at almost one place stand on lines of their own
alone('sph', 'drawn', changed(SLOPE, probes='{ name = "first"; at = (0.2, 0.1); }, { name = "second"; at = (0.21, 0.1); }, '
                                            '{ name = "third"; at = (0.22, 0.11); }'), '', '--check=picture')
labels = sorted(map(float, re.findall(r'^<text x="[\d.]*" y="([\d.]*)" font-size="12">(?:first|second|third)<', open('drawn/sph-scene.svg').read(), re.M)))
if len(labels) != 3 or min(np.diff(labels)) < 12:
    bad('labels of the picture stand on each other: at %s px' % labels)
# what drives the water along a period tilts neither its level, nor the view
driven = changed(SLOPE, fluid='rho = 1000.0; nu = 1e-3; gravity = (2, -9.81);', domain='min = (-0.25, 0); max = (2, 1); periodic = (true, false);',
                 walls='{ side = "y_min"; kind = "no_slip"; }', shapes='{ form = "below"; level = 0.5; }')
alone('sph', 'driven', driven)
alone('sph', 'even', driven, '', '--check=picture')
water = re.search(r'^<path d="(M.*) Z" stroke="none".*#9ecae1', open('even/sph-scene.svg').read(), re.M)[1]
if len({corner.split()[1] for corner in re.split('[ML]', water) if corner}) != 2:
    bad('the level of driven water is drawn askew: ' + water)
if not re.search(r'^dim, up = 2, \[-0, 1, ', open('driven/view.py').read(), re.M):
    bad('the view of driven water is tilted')

text = open('out/view.py').read()
compile(text, 'view.py', 'exec')
head = {}
exec(text[text.index('dim, up'):text.index('# All programs')], head)
assert head['dim'] == 2 and head['up'] == [0, 1, 0], head['up']
assert head['low'] == [-0.25, 0, 0] and head['high'] == [2, 1, 0], (head['low'], head['high'])
assert head['walls'] == [[1, 0, 0, 2, 0.4, 0]], head['walls']
assert head['fields'][0] == 'velocity' and head['surface'] and head['opaque']

# the folder: from the command line, as ParaView's window hides it; moved, from what the run wrote
script = text[text.index("# The run's folder"):text.index('view = GetActive')]
folder = os.path.abspath('out')
found = {'glob': glob, 'os': os, 'written': '/nowhere', 'open': lambda path: io.StringIO('paraview\0--script=out/view.py')}
if os.path.exists('/proc/self/cmdline'):
    exec(script, found)
    assert found['here'] == folder, found['here']
exec(script, {'glob': glob, 'os': os, 'written': folder})
assert "\nwritten = '" + folder + "'\n" in text

# ParaView runs the scripts of filters among these names with numpy's over them
tree = ast.parse(text)
ours = [n.name for n in tree.body if isinstance(n, ast.FunctionDef)]
outer = [n for n in tree.body if not isinstance(n, ast.FunctionDef)]
ours += [n.id for top in outer for n in ast.walk(top) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)]
assert not set(ours) & set(dir(np)), set(ours) & set(dir(np))
used = {n.id for n in ast.walk(tree) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Load)}
assert not used & {'abs', 'all', 'any', 'divmod', 'max', 'min', 'pow', 'round', 'sum'}, used

for name in ('vtkmodules', 'vtkmodules.util', 'vtkmodules.util.numpy_support', 'vtkmodules.vtkCommonCore',
             'vtkmodules.vtkCommonDataModel'):
    module = types.ModuleType(name)
    module.__getattr__ = lambda what: None
    sys.modules[name] = module
script = text.split("centres = '''")[1].split("'''")[0]
own = {}
exec(script[:script.index('for k, block')], own)

# boxes that are cut out of the cells: those of `blocked`, and bodies where fv runs alone
find = {'re': re, 'np': np, 'dim': 2, 'text': {'fv': ''}}
exec(text[text.index('def boxes_of'):text.index('def show_cells')], find)
case = '''blocked: (
  {
  min = (0, 0, 0);
  max = (0.5, 0.2, 0);
  }
);
bodies: (
  {
  name = "b";
  # points = ();
  box = ((1, 0.2, 0), (1.5, 0, 0));
  # translate = (0, 0, 0);
  }
  , {
  points = ((0, 0), (0, 0.5), (0.25, 0.5), (0.25, 0));
  translate = (2, 0, 0);
  }
);
'''
assert find['boxes_of'](case) == [[[0, 0, 0], [0.5, 0.2, 0]], [[1, 0, 0], [1.5, 0.2, 0]], [[2, 0, 0], [2.25, 0.5, 0]]], find['boxes_of'](case)
find['text']['sph'] = ''
assert len(find['boxes_of'](case)) == 1

# vertices of a skewed plane: centres are means of four, the rim lies on it, corners stay
i, j = np.meshgrid(np.arange(5), np.arange(4))
x = np.stack([i + 0.25 * j, 2.0 * j + 0.1 * i, 0 * i], 2)[None]
points = own['rim'](x, [1, 2], own['middles'], own['end_of'])
assert points.shape == (1, 5, 6, 3)
assert np.allclose(points[0, 1:-1, 1:-1], (x[0, 1:, 1:] + x[0, :-1, 1:] + x[0, 1:, :-1] + x[0, :-1, :-1]) / 4)
for a in (0, -1):
    for b in (0, -1):
        assert np.array_equal(points[0, a, b], x[0, a, b])

# a field that is linear in the indices is so up to the rim
i, j = np.meshgrid(np.arange(4) + 0.5, np.arange(3) + 0.5)
linear = own['rim']((1 + 2 * i - 3 * j)[None, :, :, None], [1, 2], lambda v, a: v, own['line_to'])[0, :, :, 0]
I, J = np.meshgrid([0, 0.5, 1.5, 2.5, 3.5, 4], [0, 0.5, 1.5, 2.5, 3])
assert np.allclose(linear, 1 + 2 * I - 3 * J)

# what is known stays; what lies next to it goes on as it is, or by a line where two cells are known, also round a
# corner; further cells stay unknown
v = np.full((1, 4, 5, 1), np.nan)
v[0, 0, :2, 0] = 3.0, 5.0
filled = own['filled'](v, [1, 2])[0, :, :, 0]
assert list(filled[0, :3]) == [3, 5, 7] and list(filled[1, :3]) == [3, 5, 5], filled
assert np.isnan(filled[2:]).all() and np.isnan(filled[:, 3:]).all()
i, j = np.meshgrid(np.arange(6.0), np.arange(5.0))
plane = (1 + 2 * i - 3 * j)[None, :, :, None]
holed = plane.copy()
holed[0, 2:, 3:] = np.nan
filled = own['filled'](holed, [1, 2])
assert np.allclose(filled[0, 2, 3:], plane[0, 2, 3:]) and np.allclose(filled[0, 2:, 3], plane[0, 2:, 3])

# shown: water and the air next to it; not what is forced, nor what another block covers but for one layer, where
# blocks meet
level = np.array([3.0, 2.0, 1.0, -1.0, -1.0, -1.0, np.nan, np.nan]).reshape(1, 1, 8, 1)
speed = np.array([np.nan, np.nan, np.nan, 1.0, np.nan, 1.0, np.nan, np.nan]).reshape(1, 1, 8, 1)
forced = np.array([0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]).reshape(1, 1, 8, 1)
shown = own['shown_of']({'level_set': level, 'velocity': speed, 'forced': forced}, [1, 1, 8], [2])
assert list(shown.ravel()) == [0, 0, 1, 1, 0, 1, 1, 0], shown.ravel()

# a box that is cut out holds no air
i, j = np.meshgrid(np.arange(5.0), np.arange(4.0))
own['BOXES'] = [[[1, 0, 0], [3, 2, 0]]]
fields = {'level_set': np.ones((1, 3, 4, 1)), 'forced': np.zeros((1, 3, 4, 1))}
own['leave_out'](fields, np.stack([i, j, 0 * i], 2)[None], [1, 2])
assert np.isnan(fields['level_set'][0, :2, 1:3]).all() and np.isfinite(fields['level_set']).sum() == 8
assert not np.isnan(fields['forced']).any()

# ticks: whole numbers of a step within the range, as far apart as asked for, no -0
script = text[text.index('def ticks'):text.index('def look')]
exec(script, {'np': np}, found)
assert np.allclose(found['ticks'](-0.1, 0.8, 0.15), [0, 0.2, 0.4, 0.6, 0.8]) and found['ticks'](-0.5, 7.0, 0.6) == [0, 1, 2, 3, 4, 5, 6, 7]
assert '-0' not in str(found['ticks'](-0.5, 0.5, 1.0)) and found['ticks'](0, 42, 7) == [0, 10, 20, 30, 40]
lib.end('%d faults' % lib.failed)
