"""Walls, bodies and shapes from files of corners (key outline), a box and a disc: the same run as with the points themselves, in sph
and fv; what cannot be read is told with file and line. SPDX-License-Identifier: BSD-3-Clause"""
import re

import lib
from lib import alone, close, number, last, refused_by, varied, write

lib.scratch()
write('ship.svg', '''<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 120"><path id="hull" d="m 60,40 h 80 l -20,40 h -40 z"/>
<polygon id="pool" points="0,120 200,120 200,0 0,0"/></svg>
''')
write('bed.csv', '# a slope\nx,y\n0.5,0\n2.0,0.25\n2.0,0\n')
write('wrong.csv', 'x,y\n0,0\n1,zero\n')
wall = '{ points = ((0.5, 0), (2, 0.25), (2, 0)); }'
hull = 'points = ((0.6, 0.6), (1.0, 0.6), (0.9, 0.4), (0.7, 0.4));'
pool = 'points = ((2, 0.6), (0, 0.6), (0, -0.6), (2, -0.6));'
points = '''format = 1;
time:    { end = 0.1; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; max = (2, 1.2); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, %s );
bodies:  ( { name = "hull"; %s free = true; density = 300; } );
shapes:  ( { form = "polygon"; %s } );
sph:     { dx = 0.04; };
output:  { snapshots = false; series = 1; };
''' % (wall, hull, pool)
files = varied(points, wall, '{ outline = "bed.csv"; }', hull, 'outline = "ship.svg#hull"; scale = 0.005; translate = (0.3, 0.2);',
               pool, 'outline = "ship.svg#pool"; scale = 0.01; rotate = (0, 0, 180); translate = (2.0, 0.6);')


def same(one, other, *titles, most=1e-6):
    for title in titles:
        close('%s and %s: %s' % (one, other, title), *(last(folder + '/series.csv', title) for folder in (one, other)), most)


alone('sph', 'files', files)
alone('sph', 'points', points)
# points, too, are put in their place
alone('sph', 'placed', varied(points, wall, '{ points = ((0, -0.05), (0.025, -0.2), (0, -0.2)); scale = 10; rotate = (0, 0, 90); }',
                              hull, 'points = ((-0.2, 0.1), (0.2, 0.1), (0.1, -0.1), (-0.1, -0.1)); translate = (0.8, 0.5);',
                              pool, 'points = ((1, 0), (-1, 0), (-1, -1.2), (1, -1.2)); translate = (1, 0.6);'))
same('placed', 'points', 'hull y', 'hull force y', 'mass', 'kinetic energy')
same('files', 'points', 'hull y', 'hull force y', 'mass', 'kinetic energy')
for folder, case in ('fv_files', files), ('fv_points', points):
    case = re.sub(r'"y_min"; }, {.*} \);\nbodies:.*', '"y_min"; }, { side = "y_max"; } );', case)
    alone('fv', folder, varied(case, 'sph:     { dx = 0.04; };', 'fv: { cells = (20, 12); };'))
same('fv_files', 'fv_points', 'volume', most=1e-9)
# a box, turned, and a disc, as their points are
box = 'points = ((0.8, 0.5), (1.1, 0.5), (1.1, 0.3), (0.8, 0.3));'
square = varied(points, wall, '{ side = "y_max"; }', hull, box, '0.6), (0, 0.6)', '0.4), (0, 0.4)')
alone('sph', 'square', square)
alone('sph', 'box', varied(square, box, 'box = ((-0.5, -1.1), (-0.3, -0.8)); rotate = (0, 0, 90); translate = (0, 0.8);'))
same('box', 'square', 'hull y', 'hull force y', 'kinetic energy')
# a disc in water at rest: Archimedes (3 %)
alone('sph', 'disc', varied(square, box + ' free = true; density = 300;', 'radius = 0.1; translate = (1, 0.2);', 'end = 0.1', 'end = 0.5',
                          'dx = 0.04', 'dx = 0.025'))
close('N/m that a disc bears', number('disc', 'average_y'), 308.19, 0.03)
for old, new, words in (
        ('bed.csv', 'none.csv', r'faulty.cfg:[0-9]*: walls.\[3\].outline: .*none.csv cannot be read'),
        ('bed.csv', 'wrong.csv', r'walls.\[3\].outline: .*wrong.csv: line 3 is no row of x, y'),
        ('ship.svg#hull', 'ship.svg#keel', r'bodies.\[0\].outline: .*ship.svg: it has no path, polygon or polyline of the id keel'),
        ('outline = "bed.csv";', r'\g<0> points = ((0, 0), (1, 1));', r'walls.\[3\].outline: points are given, too'),
        ('side = "x_min";', 'side = "x_min"; scale = 2.0;', r'walls.\[0\].scale.*a side of the domain has its place'),
        ('form = "polygon"', 'form = "box"', 'faulty.cfg:[0-9]*: shapes')):
    refused_by('sph', files, old, new, words)
lib.end('%d faults' % lib.failed)
