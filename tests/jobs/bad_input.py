"""Faulty case files and command lines: each ends with exit code 2, with the words that help, before any work, and leaves no
folder behind. Edits are those of sed, words a pattern of grep. SPDX-License-Identifier: BSD-3-Clause"""
import math
import os
import re
import shutil
import subprocess

import lib
from lib import bad, build as b, changed, root, run, start, write

lib.scratch('bad input ü')  # a space and an accent on purpose
passed = 0


def edit(base, change, to='case.cfg'):
    with open(to, 'wb') as out:
        subprocess.run(['sed', change, base], stdout=out, check=True)


def told(words):
    """Whether a line of out.txt has them; in them, as in those of grep, \\| and the like are signs, | and the like letters."""
    words = re.sub(r'(?<=[^[\\])\^', r'\^', words)
    return lib.says(re.sub(r'\\?[(){}+?|]', lambda m: m[0][1:] or '\\' + m[0], words))


def holds(well, what):
    """One more that is as wanted, or a fault."""
    global passed
    if well:
        passed += 1
    else:
        bad(what, 'out.txt')


def called(program, *args):
    """The exit code of sph or fv, from the process that starts them, or of another command."""
    if program in ('sph', 'fv'):
        return start(program, *args)
    return run(b + '/coupler' if program == 'coupler' else program, *args)


def says(words, *command):
    """Exit code 2, the words (each alternative of |) in the output, nothing written."""
    code = called(*command)
    left = [path for path in ('out', 'result') if os.path.exists(path)]
    holds(code == 2 and told(words) and not left, 'exit code %d, wanted 2 and the words: %s\n      %s' % (code, words, ' '.join(command)))
    for path in left:
        shutil.rmtree(path)


def faulty(base, change, words, program, *args):
    """The same of BASE.cfg, edited."""
    edit(base + '.cfg', change)
    says(words, program, 'case.cfg', '-o', 'result', *args)


def tells(base, change, *all_words):
    """--check of BASE.cfg, edited, accepts it with these words."""
    edit(base + '.cfg', change)
    code = start('sph', 'case.cfg', '--check')
    for words in all_words:
        holds(code == 0 and told(words), 'exit code %d of --check, wanted the words: %s (%s, %s)' % (code, words, base, change))


def stl(name, low, high, without='', sense=1):
    lib.box_stl(name, low.split(), high.split(), without, sense)


write('sph.cfg', '''format = 1;
time:    { end = 0.01; };
fluid:   { rho = 1.0; nu = 0.005; };
domain:  { dim = 2; min = (0, 0); max = (1, 1); periodic = (true, true); };
initial: { field = "taylor_green"; U = 1.0; L = 1.0; };
sph:     { dx = 0.02; };
output:  { every = 0.01; };
''')
edit('sph.cfg', 's/^sph:.*/fv: { cells = (16, 16); };/', 'fv.cfg')
edit('sph.cfg', r's/^sph:.*/sph: { dx = 0.02; box = ((0.2, 0.2), (0.8, 0.8)); };\nfv: { cells = (16, 16); };\ncoupling: { steps = 32; };/',
     'coupled.cfg')

# the command line
says('no case', 'sph')
says('nowhere', 'sph', 'nowhere', '-o', 'result')
says('nowhere.cfg', 'fv', 'nowhere.cfg', '-o', 'result')
says('did you mean .*--restart', 'sph', 'sph.cfg', '--restrat', '-o', 'result')
says('frobnicate', 'coupler', 'coupled.cfg', '--frobnicate')
says('-p', 'sph', 'sph.cfg', '-o', 'result', '-p')
says('sph.dx', 'sph', 'sph.cfg', '-o', 'result', '-p', 'sph.dx')
says('command line: .*sph.dy: .*did you mean .*dx', 'sph', 'sph.cfg', '-o', 'result', '-p', 'sph.dy=0.1')
says('command line: .*sph.dx', 'sph', 'sph.cfg', '-o', 'result', '-p', 'sph.dx=thick')
says('command line: .*fv.cells', 'fv', 'fv.cfg', '-o', 'result', '-p', 'fv.cells=(0,16)')
says('restart', 'sph', 'sph.cfg', '-o', 'result', '--restart')
says('coupled job', 'sph', 'coupled.cfg', '-o', 'result')
says('coupled job', 'fv', 'coupled.cfg', '-o', 'result')
says('no group .*fv', 'fv', 'sph.cfg', '-o', 'result')
says('no group .*sph', 'sph', 'fv.cfg', '-o', 'result')

# what libconfig reads as a syntax error
faulty('sph', 's/dx = 0.02/dx = 0.02 m/', 'case.cfg:6: .*plain', 'sph')
faulty('sph', 's/dx = 0.02/dx = 0,02/', 'case.cfg:6: .*decimal', 'sph')
faulty('sph', 's/true, true/yes, yes/', 'case.cfg:4: .*true', 'sph')
faulty('sph', 's/min = (0, 0)/min = [0, 0.5]/', 'case.cfg:4: .*( )', 'sph')
faulty('sph', 's/dx = 0.02;/dx = 0.02; dx = 0.03;/', 'case.cfg:6: .*dx', 'sph')
faulty('sph', 's/dx = 0.02; };/dx = 0.02;/', 'not closed', 'sph')
faulty('sph', 's/^format.*/@include "nothing.cfg"/', 'nothing.cfg', 'sph')
faulty('sph', 's/every = 0.01/series = 3000000000/', 'case.cfg:7: .*3000000000', 'sph')
faulty('sph', 's/time:  /time /', 'case.cfg:2: .*takes : or =', 'sph')
faulty('sph', 's/"taylor_green"/taylor_green/', 'case.cfg:5: .*text stands in quotes', 'sph')
faulty('sph', 's/"taylor_green"/“taylor_green”/', 'case.cfg:5: .*quotes are straight ones', 'sph')
faulty('sph', 's:dx = 0.02:dx = 1/50:', 'case.cfg:6: .*an expression stands in quotes', 'sph')
faulty('sph', 's/"taylor_green"/"taylor_green/', 'case.cfg:5: .*quote .*not closed', 'sph')
faulty('sph', r's/^sph:.*/walls: ( { side = "y_min"; }, );\nsph: { dx = 0.02; };/', 'case.cfg:6: .*none after the last', 'sph')
faulty('sph', r's/^sph:.*/walls: ( { side = "y_min"; } { side = "y_max"; } );\nsph: { dx = 0.02; };/', 'case.cfg:6: .*comma is missing', 'sph')
faulty('sph', r's/^sph:.*/walls: { { side = "y_min"; } };\nsph: { dx = 0.02; };/', 'case.cfg:6: .*list in ( )', 'sph')
faulty('sph', r's/^sph:.*/walls: { side = "y_min"; };\nsph: { dx = 0.02; };/', 'case.cfg:6: walls: expected a list', 'sph')
faulty('sph', 's/dx = 0.02/dx = 0.0.2/', 'case.cfg:6: .*one point', 'sph')
faulty('sph', 's/min = (0, 0)/min = (0 0)/', 'case.cfg:4: .*comma is missing between two numbers', 'sph')
faulty('sph', 's/min = (0, 0)/min = (0, 0/', 'case.cfg:4: .*more ( than it closes', 'sph')
faulty('sph', 's/dx = 0.02/dx = 0.02; apr.levels = 1/', 'case.cfg:6: .*within a group', 'sph')
faulty('sph', 's/dx = 0.02/dx 0.02/', 'case.cfg:6: .*the line .sph:', 'sph')
# what stands in quotes is neither a comment nor a fault
faulty('sph', r's/^sph:.*/bodies: ( { outline = "a.svg#b"; free = yes; } );\nsph: { dx = 0.02; };/', 'case.cfg:6: .*truth values are true and false', 'sph')
faulty('sph', r's/^sph:.*/bodies: ( { outline = "a, [b.c 1 2 = d"; free = true } { radius = 1; } );\nsph: { dx = 0.02; };/', 'case.cfg:6: .*comma is missing between two elements', 'sph')
write('binary.cfg', '\0\1\2')
says('binary.cfg: is not text', 'sph', 'binary.cfg', '-o', 'result')
with open('wide.cfg', 'wb') as wide:
    wide.write(b'\377\376f\0')
says('wide.cfg: .*UTF-16.*save it as UTF-8', 'sph', 'wide.cfg', '-o', 'result')
write('part.inc', '\ufeff' + next(line for line in open('sph.cfg') if line.startswith('fluid')))
faulty('sph', 's/^fluid.*/@include "part.inc"/', 'part.inc:1: .*mark of UTF-8', 'sph')

# keys
faulty('sph', 's/dx = 0.02/Dx = 0.02/', 'sph.Dx: .*did you mean .*dx', 'sph')
faulty('sph', 's/dx = 0.02/cells = (50, 50)/', '^1 fault', 'sph')
faulty('sph', 's/dx = 0.02/cells = (50, 50)/', 'case.cfg:6: sph.cells: .*did you mean .dx', 'sph')
faulty('sph', 's/nu = 0.005/mu = 0.005/', 'case.cfg:3: fluid.mu: .*.nu. = mu/rho', 'sph')
faulty('sph', 's/end = 0.01/endTime = 0.01/', '^1 fault', 'sph')
faulty('sph', 's/dx = 0.02/dx = 20/', '^1 fault', 'sph')
faulty('sph', 's/end = 0.01/end = 0.01; nu = 0.1/', 'time.nu: .*known in group .fluid', 'sph')
faulty('sph', 's/dx = 0.02/dx = 0.02; shceme = "riemann"/', 'case.cfg:6: sph.shceme: .*did you mean .*scheme', 'sph')
faulty('sph', 's/^output:/outptu:/', 'outptu: .*did you mean .*output', 'sph')
faulty('sph', 's/dx = 0.02; //', 'sph.dx: ', 'sph')
faulty('sph', 's/dx = 0.02/dx = "thick"/', 'case.cfg:6: sph.dx: ', 'sph')
faulty('sph', 's/dx = 0.02/dx = -0.02/', 'case.cfg:6: sph.dx: ', 'sph')
faulty('sph', 's/dx = 0.02/dx = 0.02; scheme = "upwind"/', 'case.cfg:6: sph.scheme: .*riemann_ale', 'sph')
faulty('sph', 's/dim = 2/dim = 4/', 'case.cfg:4: domain.dim: ', 'sph')
faulty('sph', 's/max = (1, 1)/max = (1, 1, 1, 1)/', 'case.cfg:4: domain.max: ', 'sph')
faulty('sph', 's/max = (1, 1)/max = (0, 1)/', 'case.cfg:4: domain.max: ', 'sph')
faulty('sph', 's/end = 0.01/end = -1/', 'case.cfg:2: time.end: ', 'sph')
faulty('sph', 's/nu = 0.005/nu = -0.005/', 'case.cfg:3: fluid.nu: ', 'sph')
faulty('sph', 's/dx = 0.02/dx = 0.03/', 'case.cfg:6: sph.dx: .*take dx = "1/34" (0.02941 m) or dx = "1/33" (0.0303 m)', 'sph')
faulty('sph', 's/dx = 0.02/dx = 0.03/; s/"taylor_green"/"rest"/; s/max = (1, 1)/max = (1.6, 0.6)/', 'sph.dx: .*take dx = "1.6/56" (0.02857 m) or dx = "1.6/48"', 'sph')
faulty('sph', 's/dx = 0.02/dx = 0.03/; s/"taylor_green"/"rest"/; s/max = (1, 1)/max = (1.57, 0.997)/', 'sph.dx: .*none near it fits all axes: round the corners', 'sph')
faulty('sph', 's/nu = 0.005/zeta = 0.005/', 'fluid.zeta: unknown key; there are rho, nu, gravity', 'sph')
faulty('sph', 's/dx = 0.02/dx = 0.5/', 'case.cfg:6: sph.dx: ', 'sph')
faulty('sph', 's/dx = 0.02/dx = 0.02; box = ((0.2, 0.2), (0.35, 0.8))/', 'sph.box: ', 'sph')
rough = r's/(true, true)/(true, false)/; s/"taylor_green"/"rest"/; s/^sph/walls: ( { side = "y_min"; friction = 0.01; } );\n&/; s/^fv/walls: ( { side = "y_min"; friction = 0.01; } );\n&/'
faulty('sph', rough + '; s/friction = 0.01/friction = -0.01/', 'walls.friction: -0.01', 'sph')
faulty('sph', rough + '; s/friction/kind = "no_slip"; friction/', r'walls.\[0\].friction: .*bed friction is a slip wall', 'sph')
faulty('sph', rough + '; s/dx = 0.02/dx = 0.02; walls = "ghosts"/', r'walls.\[0\].friction: mirrored ghosts', 'sph')
faulty('fv', rough + '; s/fv: {/fv: { integrator = "newton";/', r'walls.\[0\].friction: is not used: newton has no bed friction', 'fv')
faulty('fv', 's/cells = (16, 16)/cells = (16, 2)/', 'fv.cells: ', 'fv')
faulty('fv', 's/cells = (16, 16)/cells = (16, 16); graded = (0.5, 8)/', 'case.cfg:6: fv.graded: y is periodic', 'fv')
faulty('fv', 's/cells = (16, 16)/cells = (16, 16); graded = (0.9, 6)/; s/(true, true)/(true, false)/', 'fv.graded: layers grow by', 'fv')
faulty('fv', 's/cells = (16, 16)/cells = (16, 16); graded = (0.5, 12)/; s/(true, true)/(true, false)/', 'fv.graded: no heights', 'fv')
faulty('fv', 's/cells = (16, 16)/cells = (16, 16); graded = (0.5, 6.5)/; s/(true, true)/(true, false)/', 'fv.graded: 6.5 is not a number', 'fv')
faulty('fv', 's/cells = (16, 16)/cells = (16, 16); cfl = 7/', 'case.cfg:6: fv.cfl: ', 'fv')
faulty('fv', 's/cells = (16, 16)/cells = (16, 16); cfl = 1.25/', 'case.cfg:6: fv.cfl: 1.25: rk3 is stable up to 1.2', 'fv')
faulty('fv', 's/cells = (16, 16)/cells = (16, 16); cfl = 0.8; integrator = "bdf2"/', 'fv.cfl: 0.8: bdf2 is stable up to 0.7', 'fv')
faulty('fv', 's/cells = (16, 16)/cells = (16, 16); integrator = "bdf2"/; s/nu = 0.005/nu = 0.0/', 'fv.integrator: bdf2 has no stable step without viscosity', 'fv')
faulty('fv', 's/cells = (16, 16)/cells = (16, 16); integrator = "euler"/', 'case.cfg:6: fv.integrator: .*rk3', 'fv')
faulty('coupled', 's/steps = 32/steps = -1/', 'coupling.steps: ', 'coupler', '--check')
faulty('coupled', 's/steps = 32/steps = 32; mapping = "nearest"/', 'coupling.mapping: .*mls', 'coupler', '--check')
says('4 faults', 'sph', 'sph.cfg', '-o', 'result', '-p', 'sph.dx=-1', '-p', 'sph.cfll=1', '-p', 'time.end=-3', '-p', 'sph.scheme=none')

# words of other codes
for change, words in (('nu = 0.005/sigma = 0.07', 'fluid.sigma: unknown key; there is no surface tension'),
                      ('nu = 0.005/turbulence = "k"', 'fluid.turbulence: unknown key; there are no turbulence models'),
                      ('end = 0.01/end = 0.01; dt = 1e-4', "case.cfg:2: time.dt: .*did you mean `end': the programs choose their steps"),
                      ('end = 0.01/start = 0.0; end = 0.01', "time.start: .*`end': a run starts at t = 0"),
                      ('dx = 0.02/dx = 0.02; kernel = "cubic"', "sph.kernel: unknown key; the kernel is Wendland's C2; R_dx is"),
                      ('^sph:.*/&\\ncoupling: { dt = 0.1; };', "coupling.dt: .*`steps'"),
                      ('^sph:.*/&\\nbodies: ( { disc = (0.5, 0.5, 0.1); } );', "bodies.disc: .*`radius'"),
                      ('^sph:.*/&\\nbodies: ( { file = "hull.stl"; } );', "bodies.file: .*`mesh' (STL, OBJ, PLY), `outline' in 2D"),
                      ('^sph:.*/&\\nbodies: ( { fixed = true; } );', "bodies.fixed: .*`free': without it a body is fixed"),
                      ('^sph:.*/&\\nwaves: { amplitude = 0.1; };', "waves.amplitude: .*`height' from trough to crest"),
                      ('^sph:.*/&\\nwaves: { kind = "jonswap"; };', "waves.kind: .*did you mean `sea'"),
                      ('^sph:.*/&\\nwaves: { kind = "airy"; };', "waves.kind: .*did you mean `regular'"),
                      ('^sph:.*/&\\nbodies: ( { motion = ( { kind = "sine"; frequency = 1; } ); } );', "motion.kind: .*`harmonic'"),
                      ('^sph:.*/&\\nbodies: ( { motion = ( { kind = "harmonic"; frequency = 1; } ); } );', "frequency: .*`period' = 1/frequency"),
                      ('^sph:.*/&\\nwalls: ( { side = "x_max"; kind = "periodic"; } );', 'walls.kind: .*; a period is domain.periodic'),
                      ('^sph:.*/&\\nwalls: ( { points = "bed.csv"; } );', 'walls.points: .*; a file is read by outline'),
                      ('^sph:.*/let: { H = "2*n"; n = 3; };\\nsph: { dx = "H"; };', "case.cfg:6: let.H: `n' in .* is not known; let.n stands below: put it above"),
                      ('^domain.*/', 'domain: the case must have this group, as domain: { min = (0, 0); max = (2, 1); };'),
                      ('^sph:.*/&\\nwalls: ( { side = "z_min"; } );', r'walls.\[0\].side: z_min in a case of 2 dimensions'),
                      ('^sph:.*/&\\nwalls: ( { side = "x_min"; } );', r'walls.\[0\].side: x_min is periodic: leave the wall out')):
    faulty('sph', 's%' + change.replace('/', '%', 1) + '%', words, 'sph')
faulty('fv', 's/cells = (16, 16)/nx = 16/', "fv.nx: .*`cells' = (nx, ny)", 'fv')
says('elements of a list are walls.*, with a point', 'sph', 'sph.cfg', '-o', 'result', '-p', 'walls[0].kind=slip')
holds(start('sph', 'sph.cfg', '--check', '-p', 'sph.dx = 0.025') == 0 and told('dx 0.025 m'), 'blanks around the sign = of -p')
for option, words in (('-n', 'a:b:c'), 'expected whole numbers'), (('-n', '2:2'), 'needs SPH:COUPLER:FV'), (('-n', '0:1:1'), 'needs a rank'), \
        (('--timeout', 'soon'), 'soon: expected whole seconds'), (('-np', '2'), 'did you mean -n?'), (('--check=pictures',), 'did you mean --check=picture?'):
    code = run(root + '/cases/run', 'coupled.cfg', '--check', *option)
    holds(code == 2 and told(words), 'cases/run %s, wanted the words: %s' % (' '.join(option), words))

# fv: keys that a run does not use, scenes that contradict themselves
write('basin.cfg', '''format = 1;
time:    { end = 0.1; };
fluid:   { rho = 1.0; nu = 0.01; };
domain:  { dim = 2; min = (0, 0); max = (1, 1); };
walls:   ( { side = "x_min"; kind = "no_slip"; }, { side = "x_max"; kind = "no_slip"; },
           { side = "y_min"; kind = "no_slip"; }, { side = "y_max"; kind = "no_slip"; } );
fv:      { cells = (16, 16); };
''')
write('block.cfg', '''format = 1;
time:    { end = 0.1; };
fluid:   { rho = 1.0; nu = 0.01; };
domain:  { dim = 2; min = (0, 0); max = (1, 1); };
blocks:  ( { name = "a"; cells = (16, 16); i_min = "wall"; i_max = "wall"; j_min = "wall"; j_max = "wall"; } );
fv:      { };
''')
write('tank.cfg', '''format = 1;
time:    { end = 0.1; };
fluid:   { gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (1, 1); };
shapes:  ( { form = "box"; box = ((0, 0), (0.5, 0.5)); } );
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
fv:      { cells = (16, 16); };
''')
for sound in 'basin', 'block', 'tank':  # or the faults below could come from something else
    holds(start('fv', sound + '.cfg', '--check') == 0, sound + '.cfg is refused')
# openings of few cells are told, pockets and shafts that end at a wall are none
shafts = changed(lib.TANK, domain='max = (1, 1);', shapes='{ box = ((0, 0), (1, 0.5)); }', sph='', bodies='{ name = "b"; box = ((0.3, 0.3), (0.7, 1)); }').replace('sph: {', 'fv: { cells = (20, 40);')
write('shafts.cfg', shafts)
holds(start('fv', 'shafts.cfg', '--check') == 0 and not told('contracts too little'), 'shafts beside a box are taken for openings')
write('shafts.cfg', shafts.replace('0.3, 0.3)', '0.3, 0.2)'))
holds(start('fv', 'shafts.cfg', '--check') == 0 and told('8 cells along y .* contracts too little'), 'an opening of 8 cells is not told')
write('shafts.cfg', shafts.replace('(0.7, 1)', '(0.7, 0.9)').replace('0.3, 0.3)', '0.3, 0.4)').replace('(20, 40)', '(60, 40)'))  # the air above it is none
holds(start('fv', 'shafts.cfg', '--check') == 0 and not told('contracts too little'), 'the air over a box is taken for an opening')
# between two given levels water at rest gathers speed slowly in both programs
levels = changed(lib.TANK, domain='max = (2, 1);', walls='{ side = "x_min"; kind = "inflow"; level = 0.52; }, { side = "x_max"; kind = "outflow"; level = 0.48; }, { side = "y_min"; }', sph='dx = 0.05;')
write('levels.cfg', levels)
tells('levels', 's/^$//', 'between the levels of x_min and x_max, 0.52 and 0.48 m, water at rest gains 0.039 m/s in a second')
tells('levels', 's/level = 0.48/discharge = 0.1/')
holds(not told('between the levels'), 'a given discharge is taken for a level')
write('levels.cfg', levels.replace('sph: {', 'fv: { cells = (40, 20); };\nlet: {').replace('let: { dx = 0.05; };', ''))
holds(start('fv', 'levels.cfg', '--check') == 0 and told('between the levels of x_min and x_max'), 'fv: between two levels')
# where inlets and outlets under a surface cannot be: what does instead
jet = changed(lib.TANK, fluid='', walls='{ side = "y_min"; }, { side = "x_max"; kind = "outflow"; }', shapes='{ box = ((0.4, 0.5), (0.6, 1)); velocity = (0, -3); }')
write('jet.cfg', jet)
faulty('jet', 's/^$//', r'walls.\[1\].kind: .*Water leaves by a side that the case does not name', 'sph')
write('jet.cfg', changed(jet, fluid='gravity = (0, -9.81);', walls='{ side = "y_min"; kind = "inflow"; velocity = (0, 3); }'))
faulty('jet', 's/^$//', r'walls.\[0\].kind: gravity crosses this side.*; a jet is a shape of water with a velocity', 'sph')
# outputs shorter than steps: accepted, with a word
tells('sph', 's/every = 0.01/every = 1e-5/', 'output.every = 1e-05 s is far below a step of .* take .* s or more')
tells('sph', 's/dx = 0.02/dx = 0.02; c0 = 1500/', r'sph.c0 = 1500 m/s takes 1.5e.02 times the steps of 10 m/s')
tells('sph', 's/dx = 0.02/dx = 0.02; R_dx = 1.6/', r'sph.R_dx = 1.6: particles have too few neighbours')
tells('sph', 's/every = 0.01/checkpoint = 1e-5/', 'output.checkpoint = 1e-05 s is far below')
# water that stands against a side without a wall: accepted, with a word; behind a line: without
beside = 'water stands against the side x_min, which is open'
edit('tank.cfg', 's/{ side = "x_min"; }, //; s/{ side = "y_max"; }/{ side = "x_min"; }/; s/^fv.*/sph: { dx = 0.05; };/', 'open.cfg')
for wall, leaks in ('{ side = "x_min"; }', False), ('{ points = ((-0.1, 1.1), (0, 0.9), (0, 0)); }', False), ('{ side = "y_max"; }', True):
    edit('open.cfg', 's/{ side = "x_min"; }/%s/' % wall)
    holds(start('sph', 'case.cfg', '--check') == 0 and told(beside) == leaks, 'water beside x_min, ' + wall)
# lengths in cm: accepted, with a word
edit('tank.cfg', 's/gravity = (0, -9.81)/gravity = (0, -981)/')
holds(start('fv', 'case.cfg', '--check') == 0 and told('fluid.gravity: 981 m/s^2 looks like cm/s^2') and told('run time'), 'gravity in cm/s^2')
# steps of a third of a basin's period: accepted, with a word; of a twentieth: without
for cfl in 20, 2:
    edit('tank.cfg', 's/cells = (16, 16)/& ; integrator = "newton"; cfl = %d/' % cfl)
    quiet = start('fv', 'case.cfg', '--check', '-p', 'time.end=9') == 0 and not told('layers that grow')
    holds(quiet and told('longest wave has a period of .* fv.cfl below') == (cfl > 10), "newton's long steps of a basin, fv.cfl %d" % cfl)
# what a shape has beyond a period is cut off: accepted, with a word, or without where the shape is drawn twice
for second in '', ', { box = ((0.8, 0), (1.5, 0.5)); }':
    edit('tank.cfg', r's/max = (1, 1)/&; periodic = (true, false)/; s/{ side = "x_m[a-z]*"; }, //g; s/((0, 0), (0.5, 0.5)); }/((-0.2, 0), (0.5, 0.5)); }%s/' % second)
    cut = start('fv', 'case.cfg', '--check') == 0 and told('shape 1 reaches 0.2 m beyond the periodic side x_min and is cut off')
    holds(cut == (not second) and told('run time'), 'a box beyond a period, drawn %s' % ('twice' if second else 'once'))
# the picture of blocks has their names and what their sides are
drawn = start('fv', 'block.cfg', '--check=picture', '-o', 'drawn') == 0 and told('run time')
picture = open('drawn/fv-scene.svg').read() if drawn else ''
holds('>a<' in picture and 'no-slip wall' in picture, 'block.cfg is not drawn, or without its forecast')


faulty('basin', 's/cells = (16, 16)/cells = (40000, 40000)/', 'fv.cells: 1.6e.09 cells are too many for 1 rank: at most 1e9 each', 'fv')


# boxes that are cut out
def box(words, change):
    """Basin with a box."""
    faulty('basin', r's/^fv:/blocked: ( { name = "b"; min = (0.25, 0); max = (0.5, 0.5); } );\n&/; ' + change, words, 'fv')


edit('basin.cfg', r's/^fv:/blocked: ( { name = "b"; min = (0.25, 0.3125); max = (0.5, 0.6875); } );\n&/')
holds(start('fv', 'case.cfg', '--check') == 0 and told('box "b": 4 cells along x between it and what is next: under water a jet'), 'a narrow gap')
edit('basin.cfg', r's/^fv:/blocked: ( { name = "b"; min = (0, 0); max = (0.25, 0.25); } );\n&/')
holds(start('fv', 'case.cfg', '--check') == 0 and not told('a jet out of'), 'a wide gap')


box(r'blocked.\[0\].max: box "b": from 0.5 to 0.5 m along x: give max above min', 's/min = (0.25, 0)/min = (0.5, 0)/')
box(r'blocked.\[0\].min: box "b": it lies outside the domain along y', 's/min = (0.25, 0); max = (0.5, 0.5)/min = (0.25, -1); max = (0.5, -0.5)/')
box(r'blocked.\[0\].min: box "b": from -0.25 to 0.25 m along x it reaches over a periodic side: give its parts as two boxes, 0 to 0.25 m and 0.75 to 1 m', 's/min = (0.25, 0); max = (0.5, 0.5)/min = (-0.25, 0); max = (0.25, 0.5)/; s/max = (1, 1);/& periodic = (true, false);/; s/{ side = "x_min"; kind = "no_slip"; }, { side = "x_max"; kind = "no_slip"; },//')
box('box "b": only 2 cells along x are left', 's/min = (0.25, 0)/min = (0.125, 0)/')
box('box "b": only 2 cells along y are left', 's/max = (0.5, 0.5)/max = (0.5, 0.9)/')
box('box "b": only 3 cells along x are left between it and what is next: at least 4 between no-slip', 's/min = (0.25, 0)/min = (0.1875, 0)/; s/"b";/"b"; kind = "no_slip";/')
box('blocked: the boxes cut the domain into separate parts', 's/max = (0.5, 0.5)/max = (0.5, 1)/')
box('blocked: nothing is left', 's/min = (0.25, 0)/min = (0, 0)/; s/max = (0.5, 0.5)/max = (1, 1)/')
box(r'blocked.\[0\].kind: box "b": without viscosity', 's/nu = 0.01/nu = 0.0/; s/no_slip/slip/g; s/"b";/"b"; kind = "no_slip";/')
box(r'blocked.\[0\].min: box "b": it stands on the wall y_min, which moves', 's/"y_min";/"y_min"; velocity = (1, 0);/')
box(r'blocked.\[0\].min: box "b": it stands on the side y_min, which is no wall', 's/"y_min"; kind = "no_slip";/"y_min"; kind = "outflow";/')
box(r'probes.\[0\].at: probe "p" lies in the box "b"', r's/^walls:/probes: ( { name = "p"; at = (0.3, 0.2); } );\n&/')
box('blocked: not with newton', 's/16);/16); integrator = "newton";/')
box('initial.field: it has no boxes', r's/^walls:/initial: { field = "two_modes"; U = 1.0; L = 1.0; };\n&/')
faulty('block', r's/^fv:/blocked: ( { name = "b"; min = (0.25, 0); max = (0.5, 0.5); } );\n&/', 'blocked: not with blocks', 'fv')
faulty('tank', 's/max = (1, 1)/max = (1000, 1)/; s/(0.5, 0.5)/(500, 0.5)/', 'fv.cells: cells 1000 times as long as high', 'fv')
faulty('tank', 's/{ side = "x_max"; }/{ side = "x_max"; kind = "wall"; }/', "walls.kind: `wall' is not known: .*; did you mean `no_slip'", 'fv')
faulty('tank', 's/{ side = "x_max"; }/{ side = "right"; }/', "walls.side: `right' is not known: .*; did you mean `x_max'", 'fv')
faulty('tank', 's/-9.81/9.81/', 'water touches the side y_min with nothing but air below it (gravity is along +y)', 'fv')
faulty('tank', 's/{ side = "x_max"; }/{ side = "x_max"; kind = "inflow"; pressure = 5; }/', r'walls.\[1\].pressure: is not used: .*an opening of given pressure is an outflow', 'fv')
faulty('tank', 's/{ side = "x_max"; }/{ side = "x_max"; kind = "outflow"; level = 1.5; }/', r'walls.\[1\].level: 1.5 m is above the domain, whose heights are 0 to 1 m: raise domain.max', 'fv')
faulty('tank', 's/{ side = "x_min"; }, { side = "x_max"; }/{ side = "x_min"; kind = "inflow"; level = -0.5; }, { side = "x_max"; kind = "outflow"; }/', r'walls.\[0\].level: -0.5 m is no higher than .*: nothing flows in; a higher level, or', 'fv')
faulty('tank', 's/{ side = "x_max"; }/{ side = "x_max"; kind = "inflow"; velocity = (1, 0); }/; s/{ side = "x_min"; }/{ side = "x_min"; kind = "outflow"; }/', r'walls.\[1\]: .*points out of the domain: with a free surface that is kind = "outflow" with a discharge', 'fv')
faulty('tank', 's/{ side = "x_max"; }/{ side = "x_max"; kind = "outflow"; carried = true; level = 0.4; }/', r'walls.\[1\].level: is not used: a convective outflow', 'fv')
holds(told('1 fault; nothing was started'), 'a convective outflow of given level: one fault for one mistake')
faulty('basin', r's/nu = 0.01/& ; gravity = (0, -9.81)/; s/^fv:/initial: { field = "standing_wave"; L = 1.0; level = 0.7; amplitude = 0.2; };\n&/', 'initial.amplitude: .*k a = 1.26', 'fv')
faulty('basin', 's/nu = 0.01/nu = 0.01; central = 1.0/', 'case.cfg:3: fluid.central: is not used', 'fv')
faulty('basin', r's/^fv:/initial: { amplitude = 0.1; };\n&/', 'initial.amplitude: is not used', 'fv')
faulty('basin', r's/^fv:/initial: { L = 2.0; };\n&/', 'initial.L: is not used', 'fv')
faulty('basin', r's/^fv:/initial: { velocity = (1, 0); };\n&/', 'initial.velocity: is not used', 'fv')
faulty('basin', r's/^fv:/initial: { level = 2.0; };\n&/', 'initial.level: is not used', 'fv')
faulty('basin', r's/^fv:/bodies: ( { points = ((0.4, 0.4), (0.4, 0.6), (0.6, 0.6)); } );\n&/', 'bodies.*: is not used', 'fv')
faulty('basin', r's/^fv:/shapes: ( { box = ((0, 0), (0.5, 0.5)); velocity = (1, 0); } );\n&/; s/16);/16); surface = "no";/', 'shapes.*: is not used', 'fv')
faulty('basin', r's/^fv:/coupling: { steps = 8; };\n&/', 'coupling.steps: is not used', 'fv')
faulty('basin', r's/^fv:/output: { snapshots = false; fields = "velocity"; };\n&/', 'output.fields: is not used', 'fv')
faulty('basin', r's/^fv:/output: { fields = "velocity zone"; };\n&/', 'output.fields: zone: ', 'fv')
faulty('basin', 's/"x_min"; kind = "no_slip";/& profile = "parabolic";/', r'case.cfg:5: walls.\[0\].profile: is not used', 'fv')
faulty('basin', 's/"x_min"; kind = "no_slip";/& pressure = 1.0;/', r'walls.\[0\].pressure: is not used', 'fv')
faulty('basin', 's/"x_min"; kind = "no_slip";/"x_min"; kind = "slip"; velocity = (0, 1);/', r'walls.\[0\].velocity: is not used', 'fv')
faulty('basin', 's/"x_min"; kind = "no_slip";/"x_min"; kind = "inflow"; velocity = (-1, 0);/; s/"x_max"; kind = "no_slip"/"x_max"; kind = "outflow"/', r'inflows point out of the domain: 1 m\^2/s more', 'fv')
faulty('block', 's/i_min = "wall"/i_min = "inflow"; velocity = (-1, 0)/; s/i_max = "wall"/i_max = "outflow"/', r'inflows point out of the domain: 1 m\^2/s more', 'fv')
faulty('basin', 's/16);/16); tol_newton = 1e-8;/', 'fv.tol_newton: is not used', 'fv')
faulty('basin', 's/16);/16); integrator = "newton"; upwind = 0.5;/', 'fv.upwind: is not used', 'fv')
faulty('basin', 's/16);/16); dual_time = true;/', 'fv.dual_time: is not used: it needs fv.integrator = "newton"', 'fv')
faulty('basin', 's/16);/16); integrator = "newton"; steady = true; dual_time = true;/', 'fv.dual_time: is not used: fv.steady marches in pseudo time alone', 'fv')
faulty('basin', 's/16);/16); integrator = "newton"; pseudo_cfl = 0.3;/', 'fv.pseudo_cfl: is not used: there are no pseudo steps without fv.dual_time', 'fv')
faulty('basin', 's/16);/16); integrator = "newton"; tol_pressure = 1e-3;/', 'fv.tol_pressure: is not used', 'fv')
faulty('basin', 's/nu = 0.01/nu = 0.0/', r'case.cfg:5: walls.\[0\]: .*a wall exerts no friction', 'fv')
faulty('block', 's/nu = 0.01/nu = 0.0/', r'blocks.\[0\].i_min: .*a wall exerts no friction', 'fv')
faulty('block', r's/i_max = "wall"; //; s/^blocks/walls: ( { side = "x_max"; kind = "absorbing"; } );\n&/', 'wall 1: "absorbing" is not for this solver', 'fv')
faulty('basin', 's/nu = 0.01/nu = 0.0/; s/no_slip/slip/g; s/16);/16); tol_viscous = 1e-5;/', 'fv.tol_viscous: is not used', 'fv')
faulty('basin', 's/16);/16); force = (1.0, 0.0, 0.0);/', 'fv.force: is not used', 'fv')
faulty('basin', 's/max = (1, 1)/max = (1, 1, 1)/', 'domain.max: .*component', 'fv')
faulty('block', 's/fv:      {/& cells = (16, 16);/', 'fv.cells: is not used', 'fv')
faulty('block', 's/16);/16); kind = "annulus";/', 'blocks.kind: unknown key; did you mean .mapping', 'fv')
faulty('block', 's/max = (1, 1)/max = (4, 4)/; s/^blocks.*/blocks: ( { name = "far"; cells = (16, 16); }, { mapping = "annulus"; centre = (2, 2); cells = (8, 32); i_min = "wall"; j_min = "joined"; j_max = "joined"; } );/', 'orphan cells.*far has min (0, 0) and max (1, 1)', 'fv')
faulty('block', 's/16);/16); arc = (0, 90);/', r'blocks.\[0\].arc: is not used', 'fv')
faulty('block', 's/16);/16); focus = (0.5, 0.5);/', r'blocks.\[0\].focus: is not used', 'fv')
faulty('block', 's/16);/16); spin = (0, 0, 1);/', r'blocks.\[0\].spin: is not used', 'fv')
faulty('basin', 's/"x_min"; kind = "no_slip";/"x_min"; kind = "inflow"; velocity = (1, 0);/', r'an inflow without an outflow: 1 m\|inflow into a closed box', 'fv')
faulty('block', 's/i_min = "wall"/i_min = "inflow"; velocity = (1, 0); lid = "j_max"/', r'an inflow without an outflow: 1 m\|inflow into a closed box', 'fv')
faulty('basin', 's/"x_min"; kind = "no_slip";/"x_min"; kind = "inflow"; velocity = (0, 1);/; s/"x_max"; kind = "no_slip"/"x_max"; kind = "outflow"/', 'an inflow of 0 m/s along x lets nothing in', 'fv')
faulty('basin', 's/"x_min"; kind = "no_slip";/& velocity = (1, 0);/', 'would pump fluid through', 'fv')
faulty('block', 's/16);/16); velocity = (1, 0);/', 'would pump fluid through itself', 'fv')
faulty('basin', r's/nu = 0.01/& ; gravity = (1, 0)/; s/x_m\([a-z]*\)"; kind = "no_slip"/x_m\1"; kind = "outflow"/g', 'two outflows at different heights', 'fv')
faulty('block', r's/nu = 0.01/& ; gravity = (1, 0)/; s/i_m\([a-z]*\) = "wall"/i_m\1 = "outflow"/g', 'two outflows at different heights', 'fv')
# but not the parts of one that two blocks have
edit('block.cfg', r's/nu = 0.01/& ; gravity = (0, -1)/; s/"wall"/"slip"/g; s/i_min = "slip"/i_min = "inflow"; velocity = (1, 0)/; s/i_max = "slip"/i_max = "outflow"/; s/^\(blocks.*\)j_max = "slip"; } );/\1j_max = "joined"; max = (1, 0.5); },/; /^blocks/{h;s/blocks:  (/         /;s/"a"/"b"/;s/max = (1, 0.5)/min = (0, 0.5)/;s/j_m\([a-z]*\) = "slip"; j_max = "joined"/j_min = "joined"; j_max = "slip"/;s/},$/} );/;H;g}')
holds(start('fv', 'case.cfg', '--check') == 0 and told('512 cells'), 'an outflow of two blocks')
faulty('block', 's/min = (0, 0)/min = (0.1, 0)/', 'reaches out of the domain', 'fv')
faulty('basin', r's/^fv:/probes: ( { name = "p"; at = (2, 0.5); } );\n&/', 'outside the domain', 'fv')
faulty('block', r's/^fv:/probes: ( { name = "p"; at = (2, 0.5); } );\n&/', r'no block has computed cells\|outside the domain', 'fv')
faulty('basin', r's/^fv:/initial: { field = "poiseuille"; };\n&/', 'a channel along x', 'fv')
faulty('basin', r's/^fv:/initial: { field = "patch"; };\n&/', 'is for sph', 'fv')
faulty('basin', 's/16);/16); extrema = (0.1, 0.0, 0.1);/', 'fv.extrema: .*none may be 0', 'fv')
faulty('basin', 's/(16, 16)/(2, 1)/', '1 cells along y: at least 4', 'fv')
faulty('block', 's/(16, 16)/(1, 2)/', '2 cells along j: at least 6', 'fv')
faulty('tank', 's/gravity = (0, -9.81)/rho = 2.0/', 'a free surface.* gravity', 'fv')
faulty('tank', 's/box = ((0, 0), (0.5, 0.5))/box = ((0, 0.5), (0.5, 1))/', 'water touches the side y_max', 'fv')
faulty('tank', 's/(0, -9.81)/(9, -4)/; s/max = (1, 1)/&; periodic = (true, false)/; s/{ side = "x_m[a-z]*"; }, //g; s/((0, 0), (0.5, 0.5))/((-1, 0.5), (2, 1))/', 'water touches the side y_max', 'fv')
faulty('basin', r's/^fv:/initial: { field = "uniform"; velocity = (1, 0); };\n&/', 'initial.velocity: uniform: along x both sides are walls', 'fv')
faulty('tank', 's/(0.5, 0.5)/(0.5, 1.5)/', 'its water .* above the domain', 'fv')
faulty('tank', 's/box = ((0, 0), (0.5, 0.5))/box = ((2, 0), (3, 0.5))/', 'lies outside the domain', 'fv')
faulty('tank', 's/form.*}/form = "below"; level = 2.0; }/', 'level,* 2 m.* the domain', 'fv')
faulty('tank', 's/"y_min";/"y_min"; kind = "outflow";/', 'water would fall out of it', 'fv')
faulty('tank', 's/^shapes.*/shapes: ( { box = ((0, 0), (2, 0.001)); } );/', 'shapes: no centre of a cell lies in', 'fv')
faulty('tank', r's/^shapes/initial: { field = "standing_wave"; amplitude = 0.1; L = 2.0; level = 0.5; };\n&/', 'shapes: initial.field has water of its own', 'fv')
faulty('tank', 's/^shapes.*/initial: { field = "standing_wave"; amplitude = 0.6; L = 2.0; level = 0.5; };/', 'the crest of the wave', 'fv')
faulty('tank', 's/^shapes.*/initial: { field = "standing_wave"; amplitude = 0.1; L = 3.0; level = 0.5; };/', 'must stand at crests or troughs', 'fv')
# --- particles: what a run has no use for, and what contradicts itself ---
write('tank.cfg', '''format = 1;
time:    { end = 0.5; };
fluid:   { rho = 1000.0; gravity = (0, -9.81); };
domain:  { dim = 2; min = (0, 0); max = (2, 1); };
initial: { U = 3.0; };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
shapes:  ( { form = "below"; level = 0.5; } );
bodies:  ( { name = "b"; points = ((0.8, 0.2), (0.8, 0.4), (1.2, 0.4), (1.2, 0.2)); } );
probes:  ( { name = "p"; at = (1, 0.1); } );
sph:     { dx = 0.05; c0 = 30.0; };
''')
# water shut in below a slab on two blocks, a body in the floor: accepted, with a word
slab = 'bodies: ( { box = ((0.2, 0), (0.3, 0.2)); }, { box = ((0.6, 0), (0.7, 0.2)); }, { box = ((0.2, 0.2), (0.7, 0.3)); } );'
edit('tank.cfg', 's/^bodies.*/' + slab + '/')
holds(start('sph', 'case.cfg', '-o', 'shut', '-p', 'time.end=1e-3', '-p', 'sph.dx=0.025') == 0 and told('particle(s) of water are shut in .* at (0.* seeps in from outside'), 'water shut in')
edit('tank.cfg', 's/^bodies.*/bodies: ( { radius = 0.2; translate = (0.5, 0); } );/')
holds(start('sph', 'case.cfg', '--check') == 0 and told('body 1 .*: what of it is beyond closed sides or behind lines is left out'), 'half a disc on the floor')
edit('tank.cfg', 's/^bodies.*/bodies: ( { radius = 0.2; translate = (1, 0.15); } );/; s/{ side = "y_min"; } )/{ side = "y_min"; }, { points = ((0.3, 0), (1, 0.1), (2, 0.4)); } )/; s/^probes.*//')
holds(start('sph', 'case.cfg', '--check') == 0 and told('body 1 .*: what of it is beyond closed sides or behind lines is left out'), 'a disc in a bed')
write('channel.cfg', '''format = 1;
time:    { end = 0.01; };
fluid:   { rho = 1.0; nu = 0.01; };
domain:  { dim = 2; min = (0, 0); max = (2, 1); };
initial: { field = "uniform"; velocity = (1, 0); };
walls:   ( { side = "x_min"; kind = "inflow"; velocity = (1, 0); },
           { side = "x_max"; kind = "outflow"; },
           { side = "y_min"; }, { side = "y_max"; } );
sph:     { dx = 0.05; R_dx = 2.0; };
''')
tells('channel', 's/^initial.*//', 'the fluid rests, and an inflow of 1 m/s begins at once: its sound, rho c0 U = 15 Pa')
edit('channel.cfg', 's/^$//')
holds(start('sph', 'case.cfg', '--check') == 0 and not told('the fluid rests'), 'a flow that starts as it enters')
tells('channel', 's/^initial.*//; s/kind = "inflow"; velocity = (1, 0)/kind = "outflow"/', 'walls: nothing moves: all 2 openings are outflows at one pressure')
edit('channel.cfg', 's/^initial.*//; s/kind = "inflow"; velocity = (1, 0)/kind = "outflow"; pressure = 1.0/')
holds(start('sph', 'case.cfg', '--check') == 0 and not told('nothing moves'), 'outflows at two pressures')
LEVELS = '''format = 1;
time: { end = 1; };
fluid: { gravity = (0, -10); };
domain: { max = (2, 0.8); };
walls: ( { side = "x_min"; kind = "outflow"; level = 0.4; }, { side = "x_max"; kind = "outflow"; level = 0.4; }, { side = "y_min"; }, { side = "y_max"; } );
shapes: ( { form = "below"; level = 0.4; } );
fv: { cells = (40, 16); };
'''
for old, new in ('', ''), ('level = 0.4; }, { side = "y_min"', 'level = 0.3; }, { side = "y_min"'), ('( { form', '( { box = ((0.8, 0.3), (1, 0.5)); }, { form'):
    write('level.cfg', LEVELS.replace(old, new))
    holds(start('fv', 'level.cfg', '--check') == 0 and told('nothing moves: all 2 openings are outflows at one level') == (old == ''), 'outflows at one level: ' + new)
# keys without use
faulty('tank', 's/U = 3.0/U = 3.0; velocity = (1, 0)/', 'case.cfg:5: initial.velocity: is not used: ', 'sph')
faulty('tank', 's/U = 3.0/U = 3.0; L = 2.0/', 'case.cfg:5: initial.L: is not used: ', 'sph')
faulty('tank', 's/U = 3.0/U = 3.0; amplitude = 0.1/', 'case.cfg:5: initial.amplitude: is not used: ', 'sph')
faulty('tank', 's/c0 = 30.0/c0 = 30.0; delta = 0.1/', 'case.cfg:10: sph.delta: is not used: ', 'sph')
faulty('tank', 's/c0 = 30.0/c0 = 30.0; scheme = "delta"; limiter = "minmod"/', 'sph.limiter: is not used: ', 'sph')
faulty('tank', 's/c0 = 30.0/c0 = 30.0; alpha = 0.1/', 'sph.alpha: is not used: ', 'sph')
faulty('tank', 's/c0 = 30.0/c0 = 30.0; background = true/', 'sph.background: is not used: ', 'sph')
faulty('tank', 's/c0 = 30.0/c0 = 30.0; viscosity = "morris"/', 'sph.viscosity: is not used: ', 'sph')
faulty('tank', 's/c0 = 30.0/c0 = 30.0; low_dissipation = false; dissipation = 0.3/', 'sph.dissipation: is not used: ', 'sph')
faulty('tank', 's/c0 = 30.0/c0 = 30.0; outer = "sides"/', 'sph.outer: is not used: ', 'sph')
faulty('sph', 's/dx = 0.02/dx = 0.02; noise = 0.0; packing = 9/', 'case.cfg:6: sph.packing: is not used: ', 'sph')
faulty('sph', 's/dx = 0.02/dx = 0.02; walls = "ghosts"/', 'case.cfg:6: sph.walls: is not used: ', 'sph')
faulty('sph', 's/every = 0.01/every = 0.01; }; coupling: { steps = 9/', 'coupling.steps: is not used: ', 'sph')
faulty('sph', 's/every = 0.01/every = 0.01; }; coupling: { buffer = 0.1/', 'coupling.buffer: is not used: ', 'sph')
faulty('sph', 's/every = 0.01/fields = "velocity presure"/', 'case.cfg:7: output.fields: .*presure.*pressure', 'sph')
faulty('sph', 's/L = 1.0/L = 1.0; level = 0.5/', 'initial.level: is not used: ', 'sph')
faulty('tank', 's/"x_min"/"x_min"; velocity = (0, 1)/', r'case.cfg:6: walls.\[0\].velocity: is not used: ', 'sph')
faulty('tank', 's/"x_min"/"x_min"; pressure = 10.0/', r'walls.\[0\].pressure: is not used: ', 'sph')
faulty('tank', 's/"x_min"/"x_min"; profile = "parabolic"/', r'walls.\[0\].profile: is not used: ', 'sph')
faulty('tank', 's/"x_min"/"x_min"; kind = "no_slip"/', r'walls.\[0\].kind: is not used: .*fluid.nu', 'sph')
faulty('tank', 's/"x_min"/"x_min"; closed = true/', r'walls.\[0\].closed: is not used: ', 'sph')
faulty('tank', 's/level = 0.5/level = 0.5; radius = 0.3/', r'case.cfg:7: shapes.\[0\].radius: is not used: ', 'sph')
faulty('tank', 's/level = 0.5/level = 0.5; box = ((0, 0), (1, 1))/', r'shapes.\[0\].box: is not used: ', 'sph')
faulty('channel', 's/"outflow"/"outflow"; carried = true/', r'walls.\[1\].carried: is not used: ', 'sph')
faulty('channel', 's/"outflow"/"outflow"; velocity = (1, 0)/', r'walls.\[1\].velocity: is not used: ', 'sph')
faulty('channel', 's/kind = "inflow"/kind = "inflow"; pressure = 3.0/', r'walls.\[0\].pressure: is not used: ', 'sph')
faulty('channel', 's/kind = "inflow"; velocity = (1, 0)/kind = "inflow"/', r'case.cfg:6: walls.\[0\].velocity: an inflow of 0 m/s along x lets nothing in', 'sph')
faulty('channel', 's/kind = "inflow"; velocity = (1, 0)/kind = "inflow"; velocity = (-1, 0)/', r'walls.\[0\].velocity: an inflow of -1 m/s along x lets nothing in', 'sph')
write('beyond.cfg', changed(lib.TANK, domain='max = (1, 0.8); periodic = (true, false);', walls='{ side = "y_min"; }', shapes='{ box = ((0, 0), (1, 0.5)); }',
                            bodies='{ box = ((0.01, 0.1), (0.21, 0.3)); }, { box = ((0.8, 0.1), (1, 0.3)); }'))
faulty('beyond', 's/^format/&/', 'a gap of 0.01 m between .* across the period at', 'sph')
write('rest.cfg', changed(lib.TANK, fluid='', shapes='{ box = ((0, 0), (0.5, 0.5)); }', bodies='{ box = ((0.8, 0), (0.9, 0.2)); }'))
faulty('rest', 's/end = 0.4/end = 0.2/', 'fluid.gravity: a free surface, and nothing that moves the fluid', 'sph')
faulty('tank', 's/"b"/"b"; motion = ( { kind = "harmonic"; axis = "rz"; amplitude = 20; period = 1; } )/', r'leaves the domain across .*it turns about the origin, by angles in rad: give its centre', 'sph')
tells('tank', 's/"b"/"b"; motion = ( { kind = "harmonic"; axis = "rz"; amplitude = 0.02; period = 1; } )/', 'warning: body 1 .* turns about the origin, which lies outside of it: give its centre')
tells('tank', 's/"b"/"b"; centre = (0, 0); motion = ( { kind = "harmonic"; axis = "rz"; amplitude = 0.02; period = 1; } )/')
holds(not told('about the origin'), 'a body that is told to turn about the origin is warned of')
# gauges with the name of another column, criteria of what is not there
faulty('tank', 's/name = "p"/name = "t"/', r'probes.\[0\].*: t: series.csv has a column of this name', 'sph', '--check')
faulty('tank', r's/^sph:/accept: ( { what = "p"; tolerance = 1.0; } );\n&/', r'accept.\[0\].what: p is a gauge, .*give a reference', 'sph', '--check')
write('ref.csv', 't,p\n5,1\n6,2\n')
write('even.csv', 't,p\n0,1\n6,1\n')
faulty('tank', r's/^sph:/accept: ( { what = "p"; reference = "ref.csv"; tolerance = 1.0; } );\n&/', r'accept.\[0\].reference: its rows are those of 5 to 6 s', 'sph', '--check')
faulty('tank', r's/^sph:/accept: ( { what = "p"; reference = "even.csv"; from = 9; tolerance = 1.0; } );\n&/', r'accept.\[0\].reference: .* between accept.from and accept.until, 9 to', 'sph', '--check')
faulty('tank', r's/^sph:/accept: ( { what = "p"; reference = "even.csv"; tolerance = 1.0; } );\n&/', r'accept.\[0\].measure: rms is taken over the range', 'sph', '--check')
faulty('tank', r's/^sph:/accept: ( { what = "body.c.mass"; tolerance = 1.0; } );\n&/', r'accept.\[0\].what: summary.json will have no body.c.mass: no body', 'sph', '--check')
faulty('tank', r's/^sph:/accept: ( { what = "error.velocty_l2"; tolerance = 1.0; } );\n&/', r'accept.\[0\].what: no program reports error.velocty_l2: did you mean error.velocity_l2', 'sph', '--check')
faulty('tank', r's/^sph:/accept: ( { what = "maximum_mach"; tolerance = 1.0; } );\n&/', r'accept.\[0\].what: summary.json has no maximum_mach: did you mean max_mach', 'sph', '--check')
faulty('tank', r's/^sph:/accept: ( { what = "buoyancy"; tolerance = 1.0; } );\n&/', r'accept.\[0\].what: summary.json has no buoyancy; a column of series.csv needs a reference', 'sph', '--check')
faulty('tank', r's/^sph:/accept: ( { what = "error.x"; tolerance = 1.0; } );\n&/', r'accept.\[0\].what: no program reports error.x', 'sph', '--check')
faulty('tank', r's/^sph:/output: { every = 1e-9; };\n&/', r'output.every: 1e-09 s makes .* snapshots', 'sph', '--check')
faulty('tank', r's/^sph:/accept: ( { what = "discharge.p.volume"; tolerance = 1.0; } );\n&/', r'accept.\[0\].what: .* no gauge of kind discharge', 'sph', '--check')
# lines
faulty('tank', 's/(1.2, 0.4), (1.2, 0.2)/(1.2, 0.2), (1.2, 0.4)/', r'case.cfg:8: bodies.\[0\].points: at (1, 0.3) m: crosses', 'sph')
faulty('tank', 's/(1.2, 0.4),/(1.2, 0.4), (1.2, 0.4),/', r'bodies.\[0\].points: at (1.2, 0.4) m: .*twice', 'sph')
faulty('tank', 's/(0.8, 0.4), (1.2, 0.4), (1.2, 0.2)/(1, 0.2), (1.2, 0.2)/', r'bodies.\[0\].points: .*no area', 'sph')
faulty('tank', 's/(0.8, 0.2), (0.8, 0.4), (1.2, 0.4), (1.2, 0.2)/(0.8, 0.2), (0.8, 0.201), (0.801, 0.201), (0.801, 0.2)/', r'bodies.\[0\]: b is .* m in size, less than sph.dx', 'sph')
faulty('tank', 's/(1.2, 0.2))/(1.2, 0.2), (1.2, 0.3))/', r'bodies.\[0\].points: .*runs back', 'sph')
faulty('tank', 's/points = ((0.8, 0.2), .*; }/points = ((0.8, 0.2), (0.9, 0.4)); }/', 'three points', 'sph')
# bodies and walls
faulty('tank', 's/(0.8, 0.4), (1.2, 0.4)/(0.8, 1.4), (1.2, 1.4)/', r'case.cfg:8: bodies.\[0\]: .*leaves the domain across y', 'sph')
faulty('tank', r's/"b".*/"b"; box = ((2.1, 0.2), (2.5, 0.4)); } );/', r'bodies.\[0\]: .*leaves the domain across x', 'sph')
faulty('tank', 's/"b"/"b"; velocity = (2, 0)/', r'bodies.\[0\]: .*leaves the domain across x at (.*t = 0.4', 'sph')
faulty('tank', 's/"b"/"b"; centre = (1.5, 0.3); spin = 3.0/', r'bodies.\[0\]: .*leaves the domain across y', 'sph')
faulty('sph', r's/^sph:/bodies: ( { points = ((0.9, 0.2), (0.9, 0.4), (1.1, 0.4), (1.1, 0.2)); } );\nsph:/', r'bodies.\[0\]: .*periodic side x', 'sph')
faulty('sph', r's/^sph:/walls: ( { points = ((-0.1, 0.1), (1.1, 0.5)); } );\nsph:/', r'walls.\[0\]: wall 1 ends on the periodic side x at (0, 0.133333) m, and nothing goes on from (1, 0.133333) m', 'sph')
faulty('coupled', r's/^sph:/bodies: ( { velocity = (30, 0); points = ((0.45, 0.45), (0.45, 0.55), (0.55, 0.55), (0.55, 0.45)); } );\nsph:/; s/dx = 0.02/dx = 0.01; c0 = 100.0/', r'bodies.\[0\]: .*leaves the free zone', 'sph', '--check')
faulty('tank', 's/^bodies:  (/bodies: ( { name = "c"; points = ((1.1, 0.3), (1.1, 0.45), (1.4, 0.45), (1.4, 0.3)); },/', 'overlaps with body 1 (c)', 'sph')
faulty('tank', 's/^bodies:  (/bodies: ( { name = "c"; points = ((1.22, 0.2), (1.22, 0.4), (1.4, 0.4), (1.4, 0.2)); },/', 'bodies: a gap of 0.02 m between .* close it', 'sph')
faulty('tank', 's/(1.2, 0.4), (1.2, 0.2)/(1.98, 0.4), (1.98, 0.2)/', 'a gap of 0.02 m', 'sph')
faulty('tank', 's/^walls:   (/walls: ( { points = ((1, 0), (1, 0.3)); },/', 'body 1 (b) cuts wall 1', 'sph')
faulty('tank', 's/"b"/"b"; velocity = (20, 0)/; s/end = 0.5/end = 0.01/', 'half the speed of sound.*raise sph.c0', 'sph')
faulty('channel', 's/"y_min"; }/"y_min"; kind = "no_slip"; velocity = (0, 1); }/', r'walls.\[2\].velocity: 1 m.s across the wall', 'sph')
write('motion.txt', '0 0 0 0\n0.2 0 0 0\n0.2 0.1 0 0\n')
faulty('tank', 's/"b"/"b"; motion = "motion.txt"/', r'motion.txt: the time of line 3 does not rise.*increasing times', 'sph')
write('motion.txt', 't x y angle\n0 0 0 0\n0.2 0 0 0 0 0 0\n')
faulty('tank', 's/"b"/"b"; motion = "motion.txt"/', r'motion.txt: line 3 has 7 numbers: expected rows of t, x, y, angle', 'sph')
write('motion.txt', '0 0 0 0\n0.2 nan 0 0\n1 0 0 0\n')
faulty('tank', 's/"b"/"b"; motion = "motion.txt"/', r'bodies.\[0\].motion: row 2 .*not a number', 'sph')
write('motion.txt', '0 0 0 0\n0.2 0.1 0 0\n')
faulty('tank', 's/"b"/"b"; motion = "motion.txt"/', r'bodies.\[0\].motion: .*0 to 0.2 s, the run goes from 0 to 0.5', 'sph')
write('motion.txt', '0 0 0 0\n0.2 0 0 0\n0.201 0.4 0 0\n1 0.4 0 0\n')
faulty('tank', 's/"b"/"b"; motion = "motion.txt"/', r'bodies.\[0\].motion: jumps at t = 0.2 s, row 3', 'sph')
write('motion.txt', '0 0.2 0.1 0\n0.2 0.21 0.1 0\n1 0.25 0.1 0\n')
tells('tank', 's/"b"/"b"; motion = "motion.txt"/', r'body 1 (b): its motion begins (0.2, 0.1, 0) m and 0 rad from the place')
tells('tank', 's/"b"/"b"; motion = ( { kind = "polynomial"; axis = "x"; coefficients = (0, 0.1); from = 3; } )/', r'motion.\[0\].from: 3 s is not before the end of the run')
faulty('tank', 's/"b"/"b"; rotate = (0, 90, 0)/', r'bodies.\[0\].rotate: out of the plane', 'sph')
faulty('tank', 's/side = "y_min";/points = ((0, 0), (2, 0)); rotate = (5, 0, 0);/', r'walls.\[2\].rotate: out of the plane', 'sph')
faulty('tank', 's/form = "below"; level = 0.5/form = "polygon"; points = ((0, 0), (2, 0), (2, 0.5)); rotate = (30, 0, 0)/', r'shapes.\[0\].rotate: out of the plane', 'sph')
faulty('tank', 's/"b"/"b"; motion = "nothing.txt"/', r'case.cfg:8: bodies.\[0\].motion: .*no such file', 'sph')
# a discharge that is faster than the water falls, and one whose rows end early: accepted, with a word
inlet = 's/side = "x_min"; }/side = "x_min"; kind = "inflow"; %s; }/; s/ c0 = 30.0;//; s/^bodies.*//; s/^probes.*//'
tells('tank', inlet % 'discharge = 3', 'expected speed 6 m/s: the discharge over the water at its side; c0 is 10 times that')
write('flow.csv', '0 0\n0.2 0.1\n')
tells('tank', inlet % 'discharge_file = "flow.csv"', 'flow.csv has t = 0 to 0.2 s, the run goes from 0 to 0.5 s')
# moved by forces: tank's body with "b" replaced
free = '"b"; free = true'
faulty('tank', 's/"b"/"b"; density = 500.0/', r'bodies.\[0\].density: is not used: .*free = true', 'sph')
faulty('tank', 's/"b"/"b"; lock = "x"/', r'bodies.\[0\].lock: is not used: .*free = true', 'sph')
faulty('tank', 's/"b"/' + free + '/', r'bodies.\[0\].mass: .*density, or mass, centre and inertia', 'sph')
faulty('tank', 's/"b"/' + free + '; mass = 3.0/', r'bodies.\[0\].mass: with mass goes inertia', 'sph')
faulty('tank', 's/"b"/' + free + '; mass = 3.0; inertia = -1.0/', r'bodies.\[0\].mass: with mass goes inertia, a number above 0', 'sph')
faulty('tank', 's/"b"/' + free + '; mass = 40.0; inertia = 1.0/', r'bodies.\[0\].mass: its mass centre is not given and, .* outside of the body', 'sph')
faulty('tank', 's/"b"/' + free + '; mass = 40.0; inertia = 1.0; centre = (1000, 300)/', r'bodies.\[0\].centre: its mass centre, .* outside of the body', 'sph')
for inertia in '1e-6', '1e6':
    faulty('tank', 's/"b"/' + free + '; mass = 40.0; inertia = %s; centre = (1, 0.3)/' % inertia, r'bodies.\[0\].inertia: .* a radius of gyration', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; lines = ( { from = (1, 0.9); to = (1, 0.3); stiffness = 3.0; } )/', r'lines.\[0\]: goes from a place outside of the body to one in it', 'sph')
tells('tank', 's/"b"/' + free + '; density = 500.0; release = 9.0/', r'bodies.\[0\].release: 9 s is not before the end of the run')
tells('tank', 's/"b"/' + free + '; density = 500.0; load = (1.5e5, 0); contact = { gap = 4.0; }/', r'bodies.\[0\].load: .* times what the weight of the body')
tells('tank', 's/"b"/' + free + '; density = 0.5/', r'bodies.\[0\]: of 0.04 kg over 0.08 m^2 .* times as many as the fluid', 'dt about .* (body)')
faulty('tank', 's/"b"/' + free + '; mass = 3.0; density = 500.0/', r'bodies.\[0\].density: density or mass, not both', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; inertia = 1.0/', r'bodies.\[0\].inertia: is not used', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; centre = (1, 0.3)/', r'bodies.\[0\].centre: is not used', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; lock = "x ry"/', r'bodies.\[0\].lock: expected words of x y rz', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; lock = "x, y rz"/', r'bodies.\[0\].lock: all degrees are locked', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; lock = "x"; hinge = { at = (1, 0.5); }/', r'bodies.\[0\].lock: is not used: a hinge', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; slider = { axis = (0, 0); }/', r'bodies.\[0\].slider.axis: expected a direction', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; slider = { axis = (0, 1); }; lock = "y"/', 'slider: .*remove x, y, z from lock', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; slider = { axis = (0, 1); }; hinge = { at = (1, 0.5); }/', 'a hinge or a slider', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; hinge = { stiffness = 3.0; }/', r'bodies.\[0\].hinge.at: must be given', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; hinge = { at = (1, 0.5); stiffnes = 3.0; }/', r'bodies.\[0\].hinge.stiffnes: .*did you mean .stiffness', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; hinge = { at = (1, 0.5); stiffness = 1e9; }/', r'bodies.\[0\].hinge: stiffness 1e+09 is too large .* at most', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; lines = ( { from = (1, 0.4); to = (1, 0.9); stiffness = 1e9; } )/', r'bodies.\[0\].lines.\[0\]: stiffness 1e+09 is too large .* at most', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; lines = ( { from = (1, 0.4); to = (1, 0.9); damping = 1e9; } )/', r'lines.\[0\]: damping 1e+09 is too large .* at most', 'sph')
light = ' }, { name = "c"; box = ((1.5, 0.7), (1.6, 0.8)); free = true; density = 500.0; } );/'
faulty('tank', 's/"b"/' + free + '; density = 500.0; lines = ( { from = (1, 0.3); to = (1.55, 0.75); body = "c"; stiffness = 1e5; } )/; /^bodies/s/ } );$/' + light, r'lines.\[0\]: stiffness 100000 is too large .* at most 1.*e+04', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; lines = ( { from = (1, 0.4); to = (1, 0.9); } )/', r'lines.\[0\]: without stiffness and damping', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; lines = ( { from = (1, 0.4); to = (1, 0.4); stiffness = 3.0; } )/', r'lines.\[0\]: from and to are one place', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; lines = ( { from = (1, 0.4); to = (1, 0.9); stiffness = 3.0; body = "c"; } )/', r'lines.\[0\]: body .c. is none of this case', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; motion = ( { kind = "harmonic"; axis = "y"; amplitude = 0.01; period = 0.2; } )/', r'bodies.\[0\].motion.\[0\]: forces move y, too: add it to lock', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; release = -1.0/', 'bodies.release: -1 is not allowed', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0/; s/c0 = 30.0/c0 = 30.0; walls = "ghosts"/', 'sph.walls: ', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; hinge = { at = (1.7, 0.3); }/; s/(0.8, 0.2), (0.8, 0.4), (1.2, 0.4), (1.2, 0.2)/(1.59, 0.2), (1.59, 0.4), (1.99, 0.4), (1.99, 0.2)/', r'bodies.\[0\]: .*starts in contact with wall .*move it away', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; hinge = { at = (1, 0.3); }/; s/^bodies:  (/bodies: ( { name = "c"; points = ((1.21, 0.2), (1.21, 0.4), (1.4, 0.4), (1.4, 0.2)); },/', 'starts in contact with body 1 (c)', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0; hinge = { at = (1, 0.3); }/; s/^bodies:  (/bodies: ( { name = "c"; velocity = (0.1, 0); points = ((1.21, 0.2), (1.21, 0.4), (1.4, 0.4), (1.4, 0.2)); },/', 'starts in contact with body 1 (c)', 'sph')
# of two free bodies the one on a hinge, whichever comes first
faulty('tank', 's/"b"/' + free + '; density = 500.0; hinge = { at = (1, 0.3); }/; /^bodies/s/ } );$/ }, { name = "c"; free = true; density = 500.0; points = ((1.21, 0.2), (1.21, 0.4), (1.4, 0.4), (1.4, 0.2)); } );/', r'bodies.\[0\]: body 1 (b) starts in contact with body 2 (c)', 'sph')
faulty('tank', 's/"b"/' + free + '; density = 500.0/; s/^walls:   (/walls: ( { points = ((1, 0), (1, 0.3)); },/', 'body 1 (b) cuts wall 1', 'sph')
faulty('tank', 's/"b"/"b"; motion = ( { kind = "harmonic"; axis = "x"; amplitude = 0.1; } )/', r'motion.\[0\]: a harmonic term needs an amplitude and a period', 'sph')
faulty('tank', 's/"b"/"b"; motion = ( { kind = "polynomial"; axis = "x"; } )/', r'motion.\[0\]: a polynomial term needs coefficients', 'sph')
faulty('tank', 's/"b"/"b"; motion = ( { kind = "harmonic"; axis = "z"; amplitude = 0.1; period = 1.0; } )/', r'motion.\[0\]: axis z in a case of 2 dimensions', 'sph')
faulty('tank', 's/"b"/"b"; motion = ( { kind = "harmonic"; axis = "w"; amplitude = 0.1; period = 1.0; } )/', 'motion.axis: .*one of x|y|z|rx|ry|rz', 'sph')
faulty('tank', 's/"b"/"b"; motion = ( { kind = "harmonic"; amplitude = 0.1; period = 1.0; coefficients = (1, 2); } )/', r'motion.\[0\].coefficients: is not used', 'sph')
faulty('tank', 's/"b"/"b"; motion = ( { kind = "polynomial"; coefficients = (0, 0.1); from = 0.2; until = 0.1; } )/', r'motion.\[0\]: it ends at 0.1 s', 'sph')
faulty('tank', 's/"b"/"b"; motion = ( { kind = "polynomial"; coefficients = (0, 9); } )/; s/end = 0.5/end = 0.01/; s/c0 = 30.0/c0 = 10.0/', 'half the speed of sound', 'sph')
faulty('tank', 's/"b"/"b"; motion = ( { axis = "y"; } )/', r'bodies.\[0\].motion: .* needs the name of the file', 'sph')
faulty('tank', 's/"b"/"b"; spin = (1, 0, 0)/', r'bodies.\[0\].spin: in 2 dimensions a number', 'sph')
write('motion.txt', '0 0 0 0\n0.1 0.001 0 0\n0.2 0.002 0 0\n0.205 0.1 0 0\n0.3 0.101 0 0\n1 0.11 0 0\n')
faulty('tank', 's/"b"/"b"; motion = "motion.txt"/; s/c0 = 30.0;//', r'bodies.\[0\].motion: jumps at t = 0.2 s, row 4: 0.098 m in 0.005 s', 'sph')
write('motion.txt', '0 0 0 0\n0.1 0.4 0 0\n1 0.4 0 0\n')
faulty('tank', 's/"b"/"b"; motion = "motion.txt"/', r'bodies.\[0\].motion: jumps .*a tenth of the speed of sound', 'sph')
# water, gauges
faulty('tank', 's/level = 0.5/level = 1.5/', r'case.cfg:7: shapes.\[0\]: level 1.5 m is not in the domain', 'sph')
faulty('tank', 's/form = "below"; level = 0.5/box = ((0, 0), (1, 1.2))/', r'shapes.\[0\]: .*above the domain', 'sph')
faulty('tank', 's/form = "below"; level = 0.5/form = "disc"; centre = (5, 5); radius = 0.5/', r'shapes.\[0\]: lies outside', 'sph')
faulty('tank', 's/level = 0.5/level = 0.5; hole = true/', r'shapes.\[0\]: a hole', 'sph')
faulty('tank', r's/bodies:  (\(.*\) );/bodies: (\1, { name = "b"; points = ((0.2, 0.2), (0.2, 0.4), (0.4, 0.4), (0.4, 0.2)); } );/', r'bodies.\[1\].name: bodies 1 and 2 are both called `b', 'sph')
faulty('tank', 's/name = "p"/name = "p,q"/', 'probes.name: a name heads columns', 'sph')
faulty('tank', 's/form = "below"; level = 0.5/form = "disc"; centre = (1, 0.5); radius = 0.001/', 'shapes: no place of a particle lies in', 'sph')
faulty('tank', 's/level = 0.5; }/level = 0.5; }, { hole = true; box = ((0, 0), (2, 1)); }/', 'shapes: no place of a particle lies in', 'sph')
faulty('tank', 's/gravity = (0, -9.81)/nu = 0.0/; /^bodies/d', 'fluid.gravity: .*nothing that moves', 'sph')
faulty('tank', 's/at = (1, 0.1)/at = (1, -0.1)/', r'case.cfg:9: probes.\[0\].at: p: y = -0.1 m is outside', 'sph')
faulty('tank', 's/at = (1, 0.1)/at = (1, 0.3)/', r'probes.\[0\].at: p is inside body b', 'sph')
faulty('tank', 's/at = (1, 0.1); }/at = (1, 0.1); }, { name = "p"; at = (1.5, 0.1); }/', r'probes.\[1\].name: p is the name of gauge 1 already: give this one another', 'sph')
faulty('tank', 's/gravity = (0, -9.81)/gravity = (0, 0, -9.81)/', 'fluid.gravity: .*as in (0, -9.81)', 'sph')
faulty('tank', 's/max = (2, 1)/max = (2, 1, 3)/', 'domain.max: z component 3', 'sph')
faulty('tank', 's/U = 3.0/U = 0.0/', 'case.cfg:5: initial.U: 0 m', 'sph')
faulty('tank', 's/(0, -9.81)/(0, -9.81); central = 1.0/; s/max = (2, 1)/max = (2, 1); periodic = (true, false)/; s/^walls.*/walls: ( { side = "y_min"; } );/', 'fluid.central: .*periodic', 'sph')
faulty('tank', 's/at = (1, 0.1)/at = (1.9, 0.9)/; s/^walls.*/walls: ( { closed = true; points = ((0, 0), (1.5, 0), (1.5, 1), (0, 1)); } );/', r'probes.\[0\].at: p is behind wall 1', 'sph')
faulty('tank', 's/^walls:   (/walls: ( { points = ((0.8, 0), (1, 0.4), (1.2, 0)); },/', r'probes.\[0\].at: p is behind wall 1', 'sph')
faulty('tank', 's/^walls:   (/walls: ( { points = ((3, 0), (4, 0.3)); },/', r'walls.\[0\].points: is not used: .*outside', 'sph')
# open sides
faulty('channel', 's/{ side = "x_max"; kind = "outflow"; }/{ side = "x_max"; }/', r'walls.\[0\].kind: inflow into a closed box', 'sph')
faulty('channel', r's/^sph:/shapes: ( { box = ((0, 0), (2, 0.5)); } );\nsph:/', r'walls.\[0\].kind: inlets and outlets under a free surface need gravity', 'sph')
faulty('channel', 's/nu = 0.01/nu = 0.01; gravity = (0, -9.81)/', r'walls.\[1\].pressure: .*9.81 Pa more', 'sph')
faulty('channel', 's/"inflow"; velocity = (1, 0)/"outflow"/; s/nu = 0.01/gravity = (1, 0)/', 'fluid.gravity: .*open ends x_min and x_max.*differ by 2 Pa', 'sph')
faulty('channel', 's/max = (2, 1)/max = (0.4, 1)/', 'sph.dx: .*leave nothing of .* domain larger, or sph.dx finer', 'sph')
faulty('channel', 's/{ side = "y_max"; }/{ side = "y_min"; }/', r'walls.\[3\].side: y_min is wall 3 already: leave one out', 'sph')
faulty('channel', 's/, { side = "y_max"; }//', 'domain: .*up to its side y_max', 'sph')
faulty('sph', 's/nu = 0.005/gravity = (1, 0)/', 'fluid.gravity: 1 m.s^2 along the periodic x', 'sph')
# water around a line or a body, up to sides that hold nothing
island = 's/^walls.*/walls: ( { closed = true; points = ((0.5, 0.2), (0.5, 0.8), (1.5, 0.8), (1.5, 0.2)); } );/; /^bodies/d'
faulty('tank', island, r'case.cfg:6: walls.\[0\].points: clockwise, .*counter-clockwise', 'sph')
faulty('tank', island + '; /^shapes/d', r'walls.\[0\].points: clockwise', 'sph')
faulty('tank', '/^walls/d; /^shapes/d', 'domain: .*up to its side x_min', 'sph')
faulty('tank', 's/^shapes.*/shapes: ( { points = ((0, 0), (2, 0), (2, 0.4)); } );/', r'shapes.\[0\].box: a box, the default form', 'sph', '--check')
# the box of the particles
faulty('coupled', 's/(0.2, 0.2), (0.8, 0.8)/(0.21, 0.2), (0.8, 0.8)/', 'sph.box: x from 0.21 .*as 0.2', 'sph', '--check')
faulty('coupled', 's/(0.2, 0.2), (0.8, 0.8)/(0.4, 0.4), (0.6, 0.6)/', 'sph.box: .*leave nothing .*larger', 'sph', '--check')
faulty('coupled', 's/(0.2, 0.2), (0.8, 0.8)/(0.8, 0.2), (0.2, 0.8)/', 'sph.box: along x its first corner, at 0.8 m, is not below', 'sph', '--check')
faulty('coupled', '/^fv:/s/cells = ([^)]*);//', 'fv.cells: none are given', 'fv', '--check')
faulty('sph', 's/dx = 0.02/dx = 0.02; box_velocity = (0.1, 0)/', 'case.cfg:6: sph.box_velocity: no box has both sides open', 'sph')
faulty('coupled', 's/box = .*));/free = ((-3.0, 0.4), (-2.6, 0.6));/', 'sph.free: x from -3.* is not inside the domain', 'sph', '--check')
edit('tank.cfg', r's/^sph:.*/sph: { dx = 0.02; R_dx = 2.0; c0 = 30.0; box = ((0.5, 0.2), (1.5, 1)); };\nfv: { cells = (16, 16); };/; /^bodies/d', 'part.cfg')
faulty('part', 's/{ side = "x_max"; },*//', 'walls: with a free surface each side .*x_max is neither', 'fv', '--check')
faulty('part', '/^fv:/d; s/^walls.*/walls: ( { side = "y_min"; } );/; s/U = 3.0/field = "rest"; U = 3.0/; s/box = ((0.5, 0.2)/outer = "exact"; box = ((0.5, 0)/', 'sph.box: ends at x = 0.5 m under a free surface', 'sph', '--check')
faulty('part', '/^fv:/d; s/(0.5, 0.2), (1.5, 1)/(0, 0), (2, 0.8)/', 'sph.box: must hold the free surface: .*y_max', 'sph', '--check')
faulty('tank', 's/^sph:.*/sph: { dx = 0.02; R_dx = 2.0; box = ((0.5, 0), (1.5, 1)); };/; /^bodies/d; /^shapes/d; s/^walls.*/walls: ( { side = "y_min"; } );/', 'sph.outer: no exact solution', 'sph')
for outer in 'exact', 'sides':  # (exact ended in a heap that was written beyond its end)
    faulty('part', 's/box = ((0.5, 0.2)/outer = "%s"; box = ((0.5, 0)/' % outer, "sph.outer: %s, but around the particles of a coupled job is fv's flow" % outer, 'sph', '--check')
for program in 'sph', 'fv':  # in one job the same words are printed once
    faulty('part', 's/at = (1, 0.1)/at = (1, 0.1); kind = "level"/; /^shapes/d', r'probes.\[0\].kind: p: there is no free surface', program, '--check')
faulty('part', 's/0.02; R/0.03; R/; s/((0.5, 0.2)/((0.5, 0)/', r'sph.dx: 0.03 m: y from 0 to 1 m is no whole number of dx.*take dx = "1/34" .* or dx = "1/33"', 'sph', '--check')
faulty('part', '/^fv:/d; s/((0.5, 0.2)/((0.5, 0)/', r'walls.\[0\].side: is not used: sph.box does not reach this side, and there is no group fv', 'sph', '--check')
# rows of particles
faulty('tank', 's/max = (2, 1)/max = (2.01, 1)/', 'case.cfg:10: sph.dx: .*take dx = "2.01/41" (0.04902 m) or dx = "2.01/40" (0.05025 m)', 'sph')

# the launcher
says('no case', root + '/cases/run', 'nowhere')
says('unknown option', root + '/cases/run', 'taylor_green', '--fast')
says('SPH:COUPLER:FV', root + '/cases/run', os.path.abspath('coupled.cfg'), '-n', '3')
says('a rank at least', root + '/cases/run', os.path.abspath('coupled.cfg'), '-n', '2:0:1')
says('a rank at least', root + '/cases/run', os.path.abspath('sph.cfg'), '-n', '0')
write('empty.cfg', 'format = 1;\n')
says('neither', root + '/cases/run', os.path.abspath('empty.cfg'))
os.mkdir('folder')
says('folder is a folder without a case.cfg', root + '/cases/run', 'folder')

# meshes: files of boxes, some of them broken
stl('solid.stl', '0.3 0.3 0.2', '0.7 0.7 0.6')
stl('inside_out.stl', '0.3 0.3 0.2', '0.7 0.7 0.6', '', -1)
stl('open.stl', '0.3 0.3 0.2', '0.7 0.7 0.6', 'zp')
stl('none.stl', '0.3 0.3 0.2', '0.7 0.7 0.6', 'xm xp ym yp zm zp')
stl('mm.stl', '300 300 200', '700 700 600')
stl('far.stl', '5230456 300 200', '5230457 301 201')
stl('not_finite.stl', '0.3 0.3 0.2', 'nan 0.7 0.6')
stl('sheet_metal.stl', '0.3 0.3 0.2', '0.7 0.7 0.204')
stl('plate.stl', '0.5 0.3 0.2', '0.5 0.7 0.6', 'xp ym yp zm zp')
stl('crumb.stl', '0.3 0.3 0.2', '0.32 0.32 0.22')
for name, second in ('overlap', ('0.4 0.35 0.45', '0.8 0.7 0.7')), ('shell', ('0.35 0.35 0.35', '0.55 0.55 0.45', '', -1)):
    stl('part.stl', '0.3 0.3 0.3', '0.6 0.6 0.5')
    first = open('part.stl').read()
    stl('part.stl', *second)
    write(name + '.stl', first + open('part.stl').read())
for k, (low, high) in enumerate((('0.2 0.3 0.2', '0.4 0.7 0.6'), ('0.41 0.31 0.21', '0.8 0.7 0.6'), ('0.7 0.6 0.5', '0.9 0.9 0.9'))):
    stl('part.stl', low, high)
    with open('three.stl', 'w' if k == 0 else 'a') as three:
        three.write(open('part.stl').read())


def rim(k, up):
    return 'vertex %.7g %.7g %.7g' % (0.5 + 0.2 * math.cos(math.pi * k / 100), 0.5 + 0.2 * math.sin(math.pi * k / 100), 0.3 + 0.02 * up)


def facets(*corners):
    return ''.join('facet normal 0 0 0\nouter loop\n%s\n%s\n%s\nendloop\nendfacet\n' % three for three in corners)


write('drum.stl', 'solid drum\n' + ''.join(facets((rim(k, 0), rim(k + 1, 0), rim(k + 1, 1)), (rim(k, 0), rim(k + 1, 1), rim(k, 1)))
                                           for k in range(200)) + 'endsolid drum\n')  # without lids: short edges alone
write('empty.stl', '')
write('mesh.cfg', '''format = 1;
time:    { end = 0.01; };
fluid:   { rho = 1000.0; gravity = (0, 0, -9.81); };
domain:  { dim = 3; min = (0, 0, 0); max = (1, 1, 1); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; }, { side = "z_min"; },
           { mesh = "solid.stl"; } );
shapes:  ( { form = "below"; level = 0.8; } );
sph:     { dx = 0.05; R_dx = 2.5; };
''')
start('sph', 'mesh.cfg', '--check')
if told('built without a reader'):
    print('note: this build has no reader of meshes: their faults are not looked at')
else:
    tells('mesh', 's/^$//', 'mesh solid: 12 triangles, closed, volume 0.064 m^3, fluid outside')
    tells('mesh', 's/solid.stl/inside_out.stl/', 'mesh inside_out: 1 of its 1 part(s) inside out in the file: turned', 'fluid outside')
    tells('mesh', 's/solid.stl/three.stl/', 'mesh three: 36 triangles in 3 parts', 'triangles pierce others, the first at', 'face others across less than 2 dx')
    tells('mesh', 's/dx = 0.05/dx = 0.1/; s/solid.stl/drum.stl/', 'edges of 0.0.* finer than the particles')
    tells('mesh', 's/{ mesh = "solid.stl"; }/{ side = "z_max"; }/; s/shapes:/bodies: ( { mesh = "solid.stl"; thin = true; } ); shapes:/',
          'mesh body is closed and has thin = true: .*Leave thin out')
    # a gauge that the file's 7 digits put behind a body's face is on it, however fine the particles
    tells('mesh', r'/^ *{ mesh/d; s/,$/);/; s/dx = 0.05/dx = 0.01/; s/^sph/bodies: ( { mesh = "solid.stl"; } );\nprobes: ( { name = "p"; at = (0.69999995, 0.5, 0.4); } );\n&/', 'mesh body')
    tells('mesh', 's/solid.stl"/&; weld = 0.01/', 'weld = 0.01 m is more than sph.dx.100')
    faulty('mesh', 's/solid.stl/nothing.stl/', r'case.cfg:6: walls.\[5\].mesh: nothing.stl: there is no such file', 'sph')
    faulty('mesh', 's/solid.stl/empty.stl/', r'walls.\[5\].mesh: empty.stl: .*nothing in it', 'sph')
    faulty('mesh', 's/solid.stl/none.stl/', r'walls.\[5\].mesh: none.stl: ', 'sph')
    faulty('mesh', 's/solid.stl/mesh.cfg/', 'mesh.cfg: expected a file of STL, OBJ or PLY', 'sph')
    faulty('mesh', 's/solid.stl/not_finite.stl/', 'not_finite.stl: .*not finite', 'sph')
    faulty('mesh', 's/solid.stl/far.stl/', 'far.stl: its coordinates reach 5.23.*e+06 .*Shift it to the origin', 'sph')
    faulty('mesh', 's/solid.stl/mm.stl/', 'mm.stl lies outside the domain: .*scale = 0.001', 'sph')
    faulty('mesh', 's/solid.stl/crumb.stl/', 'crumb.stl is 0.02 m in size, less than sph.dx', 'sph')
    faulty('mesh', 's/solid.stl/sheet_metal.stl/', 'sheet_metal.stl is 0.004 m thick at triangle .*thin = true', 'sph')
    faulty('mesh', 's/solid.stl/overlap.stl/', 'overlap.stl is .* thick at triangle .*pierce each other, .*unite them', 'sph')
    faulty('mesh', 's/solid.stl/shell.stl/', 'shell.stl is 0.05 m thick at triangle .*leave out its inner surface', 'sph')
    faulty('mesh', r's/^shapes/bodies: ( { mesh = "open.stl"; } );\n&/; s/,$/);/; /solid.stl/d', r'bodies.\[0\].mesh: open.stl: a body must be closed, and 4 edges .*part 1 at triangle', 'sph')
    faulty('mesh', 's/form = "below"; level = 0.8/form = "mesh"; mesh = "open.stl"/', r'shapes.\[0\].mesh: open.stl: a shape must be closed', 'sph')
    faulty('mesh', 's/form = "below"; level = 0.8/form = "mesh"/', 'shape 1: its mesh must be given', 'sph')
    faulty('mesh', 's/solid.stl"/&; points = ((0, 0), (1, 1))/', 'wall 6: give one of side, points and mesh', 'sph')
    faulty('mesh', 's/"solid.stl"/"open.stl"; kind = "no_slip"; velocity = (1, 0, 0)/; s/rho = 1000.0/& ; nu = 1e-3/', r'walls.\[5\].velocity: .*across the wall', 'sph')
    faulty('mesh', 's/mesh = "solid.stl"/side = "z_max"; scale = 2.0/', r'walls.\[5\].scale: is not used', 'sph')
    faulty('mesh', 's/mesh = "solid.stl"/side = "z_max"; thin = true/', r'walls.\[5\].thin: is not used', 'sph')
    faulty('mesh', r's/mesh = "solid.stl"/side = "z_max"/; s/^sph/initial: { seed = ((0.5, 0.5, 0.1)); };\n&/', 'initial.seed: is not used', 'sph')
    faulty('mesh', 's/sph: .*/sph: { dx = 0.05; walls = "ghosts"; };/', 'sph.walls: mirrored ghosts need plane sides', 'sph')
    faulty('mesh', r's/^sph/probes: ( { name = "p"; at = (0.5, 0.5, 0.4); } );\n&/', r'probes.\[0\].at: p is behind the surface solid.stl', 'sph')
    faulty('mesh', 's/sph: .*/fv: { cells = (16, 16, 16); };/', r'walls.\[5\].mesh: surfaces of triangles are for sph in 3D', 'fv')
    faulty('sph', r's/^sph:/walls: ( { mesh = "solid.stl"; } );\n&/', r'walls.\[0\].mesh: a surface of triangles bounds a fluid of 3 dimensions', 'sph')
    faulty('mesh', 's/mesh = "solid.stl"/points = ((0, 0), (1, 1))/', 'walls and bodies of points need 2 dimensions: in space give a mesh', 'sph')
    faulty('mesh', 's/{ side = "y_max"; }, //; s/^shapes.*//', 'domain: the fluid fills it up to its side y_max, which is open', 'sph')
    faulty('mesh', r's/{ side = "x_min"; }, { side = "x_max"; }/{ side = "x_min"; kind = "inflow"; velocity = (1, 0, 0); }, { side = "x_max"; kind = "outflow"; }/; s/{ mesh.*/{ side = "z_max"; } );/; /^shapes/d; s/ gravity.*/ };/; s/^sph/bodies: ( { name = "b"; mesh = "solid.stl"; } );\n&/', r'bodies.\[0\]: b leaves the free zone of the particles across x', 'sph')
    faulty('mesh', r's/{ side = "x_min"; }, { side = "x_max"; }/{ side = "x_min"; kind = "inflow"; velocity = (1, 0, 0); }, { side = "x_max"; kind = "outflow"; }/; s/{ mesh.*/{ side = "z_max"; }, { mesh = "open.stl"; thin = true; } );/; /^shapes/d; s/ gravity.*/ };/', r'walls.\[6\].thin: open reaches into the zone of an open side', 'sph')
    faulty('mesh', r's/{ mesh.*/{ side = "z_max"; } );/; s/^sph/bodies: ( { name = "a"; free = true; density = 2000; mesh = "solid.stl"; }, { name = "b"; free = true; density = 2000; mesh = "solid.stl"; translate = (0, 0, 0.35); } );\n&/', r'bodies.\[1\]: b reaches 0.0[0-9]* m into a', 'sph')
    # what only filling finds
    for change in 's/solid.stl/plate.stl/', r's/^sph/initial: { seed = ((0.5, 0.5, 0.9)); };\n&/':
        edit('mesh.cfg', change)
        code = start('sph', 'case.cfg', '-o', 'filled', '--force')
        holds(code == 2 and told(r'thin = true\|initial.seed (0.5, 0.5, 0.9) m: no fluid is there'), 'filling accepts ' + change)
    # and what is none: the plate as a thin wall, in the picture
    edit('mesh.cfg', 's/solid.stl"/plate.stl"; thin = true/')
    drawn = start('sph', 'case.cfg', '--check=picture', '-o', 'seen') == 0
    holds(drawn and 'section at y' in open('seen/sph-scene.svg').read(), 'the scene with a plate is not drawn')

# the place and the time of a group's focus
write('group.cfg', '''format = 1;
time:    { end = 10.0; };
fluid:   { gravity = (0, -9.81); };
domain:  { max = (10, 1.2); };
waves:   { kind = "focused"; height = 0.1; period = 1.4; at = (6, 8); };
walls:   ( { side = "x_min"; kind = "wave"; }, { side = "x_max"; kind = "beach"; }, { side = "y_min"; } );
shapes:  ( { form = "below"; level = 0.6; } );
sph:     { dx = 0.05; };
''')
tells('group', 's/^$//', 'its focus: 6 m along its direction, t = 8 s')
holds(not told('waves.at'), 'a focus within the run is warned of')
tells('group', 's/at = (6, 8)/at = (6, 0)/', 'warning: waves.at: the focus, t = 0 s, is not within the run, from t = 2.8 s')
tells('group', 's/at = (6, 8)/at = (60, 8)/', 'warning: waves.at: the focus, 60 m along waves.direction, is not in the domain, which reaches from')
# waves run in from the side that makes them, unless they are given a direction
tells('group', 's/"x_min"/"x_m"/; s/"x_max"/"x_min"/; s/"x_m"/"x_max"/; s/at = (6, 8)/at = (-6, 8)/', 'x_max: wave zone over')
holds(not told('waves.at'), 'waves of x_max do not run towards x_min')
faulty('group', 's/at = (6, 8)/at = (6, 8); direction = 180/', 'waves.direction: 180 degrees: the waves run out through x_min', 'sph')

# regions of refinement
write('apr.cfg', '''format = 1;
time:    { end = 1.0; };
fluid:   { nu = 0.005; gravity = (0, -9.81); };
domain:  { min = (0, 0); max = (2, 1); };
walls:   ( { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; } );
shapes:  ( { form = "box"; box = ((0, 0), (1, 0.6)); } );
sph:     { dx = 0.02; };
apr:     { levels = 2; regions = (
  { level = 1; min = (0.2, -0.1); max = (1.2, 0.6); },
  { level = 2; min = (0.5, -0.1); max = (0.9, 0.3); } ); };
''')
tells('apr', 's/{ side = "y_min"; } )/{ side = "y_min"; }, { side = "y_max"; } )/; s/^shapes.*//', 'warning: apr: under weight, without air, fluid at rest is stirred')
tells('apr', 's/dx = 0.02;/& scheme = "riemann_ale";/', 'warning: apr: under weight, with sph.scheme = "riemann_ale", water at rest is stirred .*: take "riemann"')
tells('apr', 's/^$//', 'level 2')
holds(not told('is stirred'), 'levels under air')
edit('apr.cfg', 's/domain:.*/domain: { min = (0, 0); max = (2, 1); periodic = (false, true); };/; s/"x_min"/"x_min"; kind = "inflow"; velocity = (1, 0)/; '
     's/"x_max"/"x_max"; kind = "outflow"/; s/, { side = "y_min"; }//; /^shapes/d; s/, gravity.*/;/; s/gravity[^;]*;//', 'apr_open.cfg')
holds(start('sph', 'apr.cfg', '--check') == 0, 'regions in order are refused')
holds(start('sph', 'apr_open.cfg', '--check', '-p', 'apr.regions=({ min = (0.6, 0.3); max = (1.2, 0.7); })', '-p', 'apr.levels=1') == 0,
      'regions in order between open sides are refused')
faulty('apr', 's/levels = 2/levels = 2; method = "graded"/', 'case.cfg:3: .*gravity: graded particles have no gravity', 'sph')
faulty('apr', 's/levels = 2/levels = 2; method = "graded"/; s/, gravity = (0, -9.81)//', 'apr.regions: graded needs one box', 'sph')
faulty('apr', 's/levels = 2/levels = 2; method = "weights"/; s/{ side = "y_min"; }/{ points = ((2, 0), (0, 0)); }/', 'walls: particles of mixed sizes need plane sides', 'sph')
faulty('apr', 's/levels = 2/levels = 2; method = "coalescence"/; s/dx = 0.02;/dx = 0.02; scheme = "delta";/', 'sph.scheme: particles of mixed sizes need riemann', 'sph')
faulty('apr', 's/levels = 2/levels = 2; method = "weights"/; s/"y_min"/"y_min"; kind = "no_slip"/', 'walls: particles of mixed sizes need slip walls', 'sph')
faulty('apr', 's/levels = 2/levels = 1/', 'case.cfg:10: .*level: 2 is above apr.levels = 1', 'sph')
faulty('apr', 's/levels = 2/levels = 3/', 'case.cfg:8: apr.levels: 3, but no region', 'sph')
faulty('apr', 's/max = (0.9, 0.3)/max = (0.4, 0.3)/', 'case.cfg:10: .*max: 0.4 m is not larger than min, 0.5 m', 'sph')
faulty('apr', 's/max = (0.9, 0.3)/max = (0.6, 0.3)/', 'case.cfg:10: .*max: x from 0.5 to 0.6 m: guards R = 0.04 m deep .*at least 0.12 m', 'sph')
faulty('apr', 's/max = (0.9, 0.3)/max = (1.1, 0.3)/', 'case.cfg:10: .*min: level 2 comes to 0.1 m from the edge of level 1 .*0.12 m', 'sph')
faulty('apr', 's/max = (0.9, 0.3)/max = (1.4, 0.3)/', 'case.cfg:10: .*min: level 2 comes .*outside of it', 'sph')
faulty('apr', 's/min = (0.2, -0.1); max = (1.2/min = (2.2, -0.1); max = (3.2/', 'case.cfg:9: .*min: the region, x from 2.2 to 3.2 m, lies outside', 'sph')
faulty('apr', 's/max = (1.2, 0.6);/max = (1.2, 0.6); radius = 0.1;/', 'case.cfg:9: .*radius: is not used: only a sphere', 'sph')
faulty('apr', 's/max = (1.2, 0.6);/max = (1.2, 0.6); along = "x";/', 'case.cfg:9: .*along: is not used: nothing is followed', 'sph')
faulty('apr', 's/max = (1.2, 0.6);/max = (1.2, 0.6); follow = "hull";/', 'case.cfg:9: .*follow: no body has the name `hull', 'sph')
faulty('apr', 's/max = (1.2, 0.6);/max = (1.2, 0.6); follow = "peak"; along = "w";/', 'case.cfg:9: .*along: `w. is not a list of axes', 'sph')
faulty('apr', 's/{ level = 1; .*/{ shape = "sphere"; level = 1; centre = (0.4, 0.3); },/', r'case.cfg:9: apr.regions.\[0\].radius: region 1: a sphere needs a radius', 'sph')
faulty('apr', 's/{ level = 1; .*/{ shape = "body"; level = 1; body = "hull"; offset = 0.3; },/', 'case.cfg:9: .*body: no body has the name `hull', 'sph')
faulty('apr', 's/{ level = 1; .*/{ shape = "wall"; level = 1; wall = 2; offset = 0.3; },/', 'case.cfg:9: .*wall: wall 2 is a side of the domain', 'sph')
faulty('apr', 's/max = (0.9, 0.3);/max = (0.9, 0.3); velocity = (60, 0);/', 'case.cfg:10: .*velocity: 60 m/s: the region moves .* dx of level 2 in a step', 'sph')
faulty('apr', 's/max = (0.9, 0.3);/max = (0.9, 0.3); velocity = (3, 0);/', 'case.cfg:10: .*velocity: the region has left .* along x at t = ', 'sph')
faulty('apr', 's/max = (0.9, 0.3);/max = (0.9, 0.3); motion = ({ kind = "harmonic"; axis = "rz"; amplitude = 1; period = 1; });/', 'case.cfg:10: .*motion: term 1: a region does not turn', 'sph')
faulty('apr', 's/max = (0.9, 0.3);/max = (0.9, 0.3); motion = "nothing.txt";/', 'case.cfg:10: .*motion: term 1: .*nothing.txt: no such file', 'sph')
faulty('apr', 's/max = (0.9, 0.3);/max = (0.9, 0.3); motion = ({ kind = "harmonic"; axis = "z"; amplitude = 0.1; period = 1; });/', 'case.cfg:10: .*motion: term 1: axis z in a case of 2 dim', 'sph')
faulty('apr', 's/max = (0.9, 0.3);/max = (0.9, 0.3); motion = ({ kind = "harmonic"; axis = "x"; period = 1; });/', 'case.cfg:10: .*motion: term 1: a harmonic term needs an amplitude', 'sph')
faulty('apr', 's/max = (0.9, 0.3);/max = (0.9, 0.3); motion = ({ kind = "polynomial"; axis = "x"; coefficients = (0, 0.1); amplitude = 1; });/', 'case.cfg:10: .*motion.*amplitude: is not used: only a harmonic', 'sph')
faulty('apr', 's/max = (0.9, 0.3);/max = (0.9, 0.3, 0.2);/', 'case.cfg:10: .*max: z component 0.2 in a case of 2 dim', 'sph')
faulty('apr', 's/max = (0.9, 0.3);/max = (0.9, 0.3); velocity = (0, 0, 1);/', 'case.cfg:10: .*velocity: z component 1 in a case of 2 dim', 'sph')
faulty('apr', 's/levels = 2;/levels = 2; around = 4;/', 'case.cfg:8: apr.around: is not used', 'sph')
faulty('apr', 's/levels = 2;/levels = 2; particles = 1e5;/', 'case.cfg:8: apr.particles: is not used', 'sph')
faulty('apr', 's/levels = 2;/levels = 2; particles = 1000; criteria = ( { kind = "surface"; distance = 1; } );/', 'apr.particles: level 0 and the regions .* could refine nothing within 1000', 'sph')
faulty('apr', 's/levels = 2;/levels = 2; criteria = ({ kind = "vorticity"; });/', r'case.cfg:8: apr.criteria.\[0\].above: criterion 1 needs .above', 'sph')
faulty('apr', 's/levels = 2;/levels = 2; criteria = ({ kind = "surface"; above = 0.1; });/', 'case.cfg:8: .*above: is not used: this kind has a bound `distance', 'sph')
faulty('apr', 's/levels = 2;/levels = 2; margin = 1.0;/', 'case.cfg:8: apr.margin: 1 is not allowed', 'sph')
faulty('apr', '9,10d; s/levels = 2;.*/levels = 2; };/', 'case.cfg:8: apr: neither regions nor criteria', 'sph')
faulty('apr_open', 's/(0.9, 0.3)/(1.5, 0.3)/; s/(1.2, 0.6)/(1.8, 0.6)/; s/-0.1/0.1/g', 'case.cfg:.*apr.regions: level 1 reaches into the open side x_max', 'sph')
says('apr.regions: level 1 reaches into the open side x_min at', 'sph', root + '/cases/taylor_green/case.cfg', '--check', '-p', 'apr.regions=({ min = (0.25, 0.4); max = (0.6, 0.6); })')
says('apr.local_steps: levels of a coupled job step together', 'sph', root + '/cases/taylor_green/case.cfg', '--check', '-p', 'apr.regions=({ min = (0.36, 0.36); max = (0.64, 0.64); })', '-p', 'apr.local_steps=true')
edit(root + '/cases/half_cylinder_fv/case.cfg', '/^accept/,$d; s/j_min = "joined"; j_max = "joined";//', 'ring.cfg')
says(r'blocks.\[1\].j_min: .*the ends of a full ring lie on each other', 'fv', 'ring.cfg', '--check')
edit(root + '/cases/half_cylinder_fv/case.cfg', '/^accept/,$d; s/j_min = "joined"; j_max = "joined";/j_min = "periodic"; j_max = "periodic";/', 'ring.cfg')
says(r'blocks.\[1\].j_min: .*the ends of a full ring lie on each other', 'fv', 'ring.cfg', '--check')

# folders and files of others, where root can become another user
other = 'setpriv', '--reuid=65534', '--clear-groups'
os.chmod('.', 0o755)
if os.getuid() == 0 and shutil.which('setpriv') and run(*other, 'test', '-r', 'sph.cfg') == 0:
    shutil.copy('sph.cfg', 'mine.cfg')
    os.chmod('mine.cfg', 0o600)
    says('result/deep, or write in it: Permission denied', 'env', 'OMPI_MCA_orte_tmpdir_base=/tmp', *other, b + '/sph', 'sph.cfg', '-o', 'result/deep')
    says('mine.cfg cannot be read: no permission', *other, root + '/cases/run', 'mine.cfg')

# what is no fault: numbers and brackets in comments of every kind
noted = 'format = 1; // doi 12345678901 {\n/* { 12345678901 " */\n# 12345678901 { "\n'
edit('sph.cfg', '1d', 'rest.cfg')
write('noted.cfg', noted + open('rest.cfg').read())
holds(start('sph', 'noted.cfg', '--check') == 0, 'noted.cfg is refused')
write('noted.cfg', noted + open('rest.cfg').read().replace('dx = 0.02; };', 'dx = 0.02;'))
holds(start('sph', 'noted.cfg', '--check') == 2 and told('noted.cfg:.*group .sph., opened at line 8, is not closed'), 'noted.cfg, not closed')
# what is no fault: a mark of UTF-8, ends of lines of other systems, tabs, all on one line
sound = open('sph.cfg').read()
with open('marked.cfg', 'w', newline='') as marked:
    marked.write('\ufeff' + sound.replace('\n', '\r\n').replace(' ', '\t'))
write('line.cfg', sound.replace('\n', ' '))
for name in 'marked', 'line':
    holds(start('sph', name + '.cfg', '--check') == 0, name + '.cfg is refused')

# nothing is overwritten
holds(start('sph', 'sph.cfg', '-o', 'kept') == 0, 'the sound case does not run')
before = {path: os.stat('kept/' + path) for path in os.listdir('kept')}
says('already', 'sph', 'sph.cfg', '-o', 'kept')
after = {path: os.stat('kept/' + path) for path in os.listdir('kept')}
holds({p: (s.st_size, s.st_mtime_ns) for p, s in before.items()} == {p: (s.st_size, s.st_mtime_ns) for p, s in after.items()},
      'a refused run touched its folder')

# What a series is to be compared with is known once the columns are: before the first step.
write('ref.csv', 't,E\n0,1\n1,2\n')
code = start('fv', 'fv.cfg', '-p', 'accept=({what="kinetic enrgy";reference="ref.csv";column="E";tolerance=1.0;})', '-o', 'accepted')
holds(code == 2 and told('accept.*no column kinetic enrgy: did you mean kinetic energy?'), 'accept.what that no series has')
# the columns of a program, too
edit('tank.cfg', 's/name = "p"/name = "mass"/')
holds(start('sph', 'case.cfg', '-o', 'alike') == 2 and told(r'probes.\[0\].name: mass: series.csv has a column of this name'),
      'a gauge with the name of another column')
# a coupled job: what all three programs find is printed once; -o is one folder; ranks of a solver alone are one number
write('three.cfg', '''format = 1;
time:    { end = 1.0; };
fluid:   { rho = -1.0; nu = 0.01; };
domain:  { dim = 2; min = (0, 0); max = (1, 1); periodic = (true, true); };
initial: { field = "taylor_green"; U = 1.0; L = 1.0; };
sph:     { dx = 0.0125; box = ((0.15, 0.15), (0.85, 0.85)); };
fv:      { cells = (32, 32); };
frame:   { a = 1; };
''')
for how in ('-n', '1:1:1'), ('--check',):
    code = run(root + '/cases/run', 'three.cfg', *how, '-o', 'three')
    for words in 'fluid.rho: -1 is not allowed', 'frame: unknown group':
        holds(code == 2 and open('out.txt').read().count(words) == 1, 'a fault of three programs, ' + ' '.join(how))
edit('three.cfg', 's/rho = -1.0/rho = 1.0/; /^frame/d', 'split.cfg')
programs = [['-np', '1', b + '/' + program, 'split.cfg', '-o', to] for program, to in (('sph', 'one'), ('coupler', 'two'), ('fv', 'two'))]
code = run(*lib.mpi, *programs[0], ':', *programs[1], ':', *programs[2], most=60)
holds(code == 2 and told('sph writes into one, coupler into two: give all programs the same -o'), 'two folders')
code = run(root + '/cases/run', 'poiseuille_sph', '-n', '1:1:1')
holds(code == 2 and told('is for sph alone, which takes one number, as -n 1'), 'three numbers for one program')
lib.end('%d as wanted, %d not' % (passed, lib.failed))
