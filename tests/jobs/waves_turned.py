"""A tank with a wave zone at one end and a beach at the other, waves on a current, turned so that gravity points along each axis and
against it, in 2D and 3D, both programs: the same levels. Waves of initial.field have gravity along -y alone: one fault says so, and
what to do instead. SPDX-License-Identifier: BSD-3-Clause"""
import lib
from lib import alone, bad, below, column, start, told, write

lib.scratch()


def turned(program, dim, end, cells, along, up, sign, direction):
    """Waves of 0.03 m x 1 m over 0.16 m on 0.2 m/s. They run along an axis; gravity points against another (sign 1) or along it (-1)."""
    def at(*of, sign=sign):
        """A vector of the scene: along, up, across."""
        x = dict(zip((along, up, 3 - along - up), (of[0], sign * of[1], of[2])))
        return '(%s)' % ', '.join('%.9g' % x[axis] for axis in range(dim))

    def sides(axis, first='', last='', sense=1):
        ends = ('min', 'max')[::sense]
        return ', '.join('{ side = "%s_%s"; %s }' % ('xyz'[axis], side, keys) for side, keys in zip(ends, (first, last)))

    low, high = (0, 0.24)[::sign]  # of the coordinate's lower and upper end
    across = ', ' + sides(3 - along - up) if dim == 3 else ''
    return '''format = 1;
time:    { end = %g; };
fluid:   { gravity = %s; };
domain:  { dim = %d; min = %s; max = %s; };
initial: { field = "uniform"; velocity = %s; };
shapes:  ( { form = "below"; level = 0.16; } );
walls:   ( %s, %s%s );
waves:   { height = 0.03; length = 1.0; start = 1; zone = 1.0; current = 0.2; direction = %d; };
probes:  ( { name = "a"; kind = "level"; at = %s; }, { name = "b"; kind = "level"; at = %s; } );
%s
output:  { snapshots = false; series = 5; };
''' % (end, at(0, -9.81, 0), dim, at(0, low, 0), at(3, high, 0.1), at(0.2, 0, 0),
       sides(along, 'kind = "wave";', 'kind = "beach"; beach = 1.0;'), sides(up, sense=sign), across, direction,
       at(1.2, 0.17, 0.05), at(1.8, 0.17, 0.05),
       'sph: { dx = 0.02; };' if program == 'sph' else 'fv: { cells = %s; };' % at(cells, 24, 4, sign=1))


def levels(folder):
    return [z for gauge in ('a ', 'b ') for z in column(folder + '/series.csv', gauge)]


# along, up, sign of up, and the direction of the waves (degrees from the first horizontal axis towards the second)
flat = (0, 1, 1, 0), (0, 1, -1, 0), (1, 0, -1, 0), (1, 0, 1, 0)
solid = (0, 1, 1, 0), (0, 2, -1, 0), (1, 2, 1, 90), (2, 0, -1, 90), (0, 2, 1, 0), (2, 1, 1, 90), (1, 0, 1, 0)
if not lib.long:  # each axis along the waves and upright, upwards and downwards
    flat, solid = flat[:3], solid[:4]
for program, dim, end, cells, ways in ('fv', 2, 1.6, 72, flat), ('sph', 2, 1.6, 0, flat), ('fv', 3, 1.2, 48, solid):
    first = None
    for way in ways:
        folder = '%s%d_%d_%d_%d' % (program, dim, *way[:3])
        alone(program, folder, turned(program, dim, end, cells, *way))
        found = levels(folder)
        first = first or found
        off = max(abs(a - b) for a, b in zip(first, found)) if len(first) == len(found) > 10 else float('nan')
        below('%s: m that levels are off' % folder, off, 3e-5)  # 0.2 % of the amplitude
        print('%s: levels within %.3g m' % (folder, off))
    gauge = first[:len(first) // 2]
    if not max(gauge) - min(gauge) > 0.005:
        bad('%s: waves move the level by %g m' % (program, max(gauge) - min(gauge)))
# One fault for waves of initial.field, in both programs.
for field in 'regular', 'solitary', 'standing_wave', 'stokes':
    for gravity in '0, 0, -9.81', '-9.81, 0, 0', '0, 9.81, 0', '1, -9.81, 0':
        for program, keys in ('fv', 'fv: { cells = (32, 24, 8); };'), ('sph', 'sph: { dx = 0.1; };'):
            write('faulty.cfg', '''format = 1;
time:    { end = 1; };
fluid:   { gravity = (%s); };
domain:  { dim = 3; max = (4, 1.5, 1); periodic = (true, false, true); };
initial: { field = "%s"; L = 4; amplitude = 0.1; level = 1.0; };
walls:   ( { side = "y_min"; }, { side = "y_max"; } );
%s
''' % (gravity, field, keys))
            if start(program, 'faulty.cfg', '--check', log='faulty.txt') != 2:
                bad('%s: accepted: %s under (%s)' % (program, field, gravity))
            told('faulty', 'fluid.gravity: the waves of initial.field have gravity along -y alone: .*walls.kind')
            told('faulty', '^1 fault;')
lib.end('%d faults' % lib.failed)
