"""Outflows under a free surface that are given no level, in both programs: over a dry bed water falls out, as if the domain went on;
where water stands outside it stands as high as inside at the start, whatever stands elsewhere; to a level
below the critical depth of what leaves it leaves critically. fv closes the air above by itself.
The case that a run writes down is that case. SPDX-License-Identifier: BSD-3-Clause"""
import re

import lib
from lib import alone, bad, below, close, column, number, last, near, refused_by, says, start, told, varied

lib.scratch()
dam = '{ form = "box"; box = ((0, 0), (0.5, 0.4)); }'
pool = '{ form = "box"; box = ((0, 0), (0.3, 0.4)); }, { form = "box"; box = ((0.3, 0), (1, 0.15)); }'
dry = '''format = 1;
time:    { end = 0.7; };
fluid:   { gravity = (0, -9.81); };
domain:  { max = (1, 0.6); };
walls:   ( { side = "x_max"; kind = "outflow"; }, { side = "x_min"; }, { side = "y_min"; } );
shapes:  ( %s );
probes:  ( { name = "q"; kind = "discharge"; at = (0.9, 0); to = (0.9, 0.5); } );
fv:      { cells = (50, 24); };
output:  { snapshots = false; series = 2; };
''' % dam
of_sph = 'fv:      { cells = (50, 24); };', 'sph:     { dx = 0.02; };'
# blocks have sides with kinds of their own, and walls are none
of_blocks = 'fv:      { cells = (50, 24); };', '''fv:      { };
blocks:  ( { name = "a"; max = (0.6, 0.6); cells = (30, 24); i_min = "slip"; i_max = "joined"; j_min = "slip"; j_max = "slip"; },
           { name = "b"; min = (0.6, 0); max = (1, 0.6); cells = (20, 24); i_min = "joined"; i_max = "outflow"; j_min = "slip";
             j_max = "slip"; } );'''
dry_sph, dry_blocks = varied(dry, *of_sph), re.sub('walls: .*\n', '', varied(dry, *of_blocks))


def go(program, folder, case, keys='', *args, warned=False):
    """A run on one rank; but where it is looked for, no warning but of what these scenes cannot avoid is told."""
    alone(program, folder, case, keys, *args)
    if not warned and says('^warning(?!.*(passages|hold|restored elsewhere))', folder + '.txt'):
        bad(folder + ' warns', folder + '.txt')


# A dam over a dry bed: beyond the front's arrival the flow is faster than waves, which know nothing of the end.
go('fv', 'long', varied(dry, 'max = (1,', 'max = (4,', ' kind = "outflow";', '', '(50, 24)', '(200, 24)'))
for program, folder, case in ('fv', 'dry_fv', dry), ('sph', 'dry_sph', dry_sph), ('fv', 'dry_blocks', dry_blocks):
    go(program, folder, case)
    told(folder, 'x_max: nothing stands there at the start')
    # m^2 past the gauge; 5 %: half a row of particles in a tongue of ten
    close(folder + ': what passed, without the end', number(folder, 'forward'), number('long', 'forward'), 0.05)
close('left in the domain, in fv and in sph', last('dry_fv/series.csv', 'volume ['), last('dry_sph/series.csv', 'mass') / 1000, 0.05)
near('sph: water that fell out and is not told', number('dry_sph', 'budget'), 0, 1e-9)
below('sph: particles that fell out and count as lost', number('dry_sph', 'particles_lost'), 0)
# what goes over a side without a wall has left, too
go('sph', 'bare', varied(dry_sph, '{ side = "x_min"; }, ', '', '((0, 0)', '((0.1, 0)'), warned=True)
below('particles that go over the bare side, at least', 10, number('bare', 'particles_lost'))
near('water over a bare side that is told as missing', number('bare', 'budget'), 0, 1e-9)
# with levels, whose guards leave beside what they stand for
go('sph', 'levels', dry_sph, 'sph.dx=0.04 apr.regions=({min=(0.6,-1);max=(2,0.3);})', warned=True)
near('levels: water that fell out and is not told', number('levels', 'budget'), 0, 0.02)
# restart bit for bit, with what has fallen
go('sph', 'parts', dry_sph, 'time.end=0.5 output.checkpoint=0.5')
go('sph', 'parts', dry_sph, 'output.checkpoint=0.5', '--restart')
near('through x_max after a restart', last('parts/series.csv', 'through x_max'), last('dry_sph/series.csv', 'through x_max'), 0)

# A channel at rest that fills behind its outlet: 0.3 m before it 1.19 (sph) and 1.16 (fv) times the critical depth for many
# transits while two transits' mean velocity ruled there, now 1.08 and 1.06
brink = '''format = 1;
time:    { end = 4; };
fluid:   { gravity = (0, -9.81); };
domain:  { max = (2, 0.3); };
walls:   ( { side = "x_min"; kind = "inflow"; discharge = 0.126; }, { side = "x_max"; kind = "outflow"; level = 0.06; }, { side = "y_min"; } );
shapes:  ( { form = "below"; level = 0.14; } );
probes:  ( { name = "end"; kind = "level"; at = (1.7, 0); }, { name = "flow"; kind = "discharge"; at = (1.4, 0); to = (1.4, 0.3); } );
fv:      { cells = (80, 24); };
output:  { snapshots = false; };
'''
for program, case in ('fv', brink), ('sph', varied(brink, 'fv:      { cells = (80, 24); };', 'sph:     { dx = 0.02; };')):
    alone(program, 'brink_' + program, case)
    late = [[v for t, v in zip(column('brink_%s/series.csv' % program, 't'), column('brink_%s/series.csv' % program, what)) if t > 2.5]
            for what in ('end', 'flow')]
    depth, q = (sum(v) / len(v) for v in late)
    below('brink of %s: level over critical depth' % program, depth / (q**2 / 9.81)**(1 / 3), 1.1)

# A dam over a pool: outside stands the pool, not the dam. Nothing comes in, and in the end the pool's level is left.
wet = varied(dry, dam, pool, 'end = 0.7', 'end = 3')
wet_fv = varied(wet, '(50, 24)', '(75, 36)')
for program, case in ('fv', wet_fv), ('sph', varied(wet, *of_sph)):
    go(program, 'pool_' + program, case)
    told('pool_' + program, 'x_max: water 0.15 m high outside, as inside')
volume = column('pool_fv/series.csv', 'volume [')
close('fv: m^2 of the pool after the dam', volume[-1], 0.15, 0.1)
close('sph: kg of the pool after the dam', last('pool_sph/series.csv', 'mass'), 150, 0.1)
below('fv: m^2 of water, some that comes in through the outflow', max(volume), 1.005 * volume[0])
start('fv', lib.scene(varied(dry_blocks, dam, pool), 'pool_blocks'), '--check', log='pool_blocks.txt')
told('pool_blocks', 'x_max: water 0.15 m high outside')
# newton knows one level alone
refused_by('fv', wet_fv, 'fv: .*{', r'\g<0> integrator = "newton";', r'walls.\[0\].*newton')
for shapes in dam, pool:
    refused_by('fv', varied(dry_blocks, dam, shapes), 'fv: .*{', r'\g<0> integrator = "newton";', r'blocks.\[1\].i_max.*newton')

# The air above is closed, and said to be; when water comes there, that is told
told('pool_fv', 'y_max, which has no wall, is closed by one that slips')
go('fv', 'low', varied(dry, '(1, 0.6)', '(1, 0.45)', '(50, 24)', '(50, 18)', ' kind = "outflow";', ''), 'probes=()', warned=True)
told('low', '^warning: .*water reaches the side y_max, which the case leaves open')
# What a run writes down of its case is that case
for program, folder in ('fv', 'pool_fv'), ('sph', 'dry_sph'):
    go(program, folder + '_again', '%s/%s-case.cfg' % (folder, program), 'time.end=0.01', warned=True)
    once, again = (re.sub(r'time:(.|\n)*?};', '', open('%s/%s-case.cfg' % (of, program)).read()) for of in (folder, folder + '_again'))
    if once != again:
        bad('%s: its own case becomes another' % folder)
lib.end('%d faults' % lib.failed)
