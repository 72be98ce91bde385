"""properties_draw.py - from a seed a random scene, its twins and what must hold between them: DIR/base.cfg, twins DIR/LAW.cfg, and
DIR/plan with
    run NAME PROGRAM RANKS             what to run
    twin LAW axes signs L U rho shift  columns of the twin against those of the base
    know KEY VALUE                     what the laws of the base alone need to know
usage: properties_draw.py SEED DIR. SPDX-License-Identifier: BSD-3-Clause"""
import copy
import math
import os
import sys

import properties_fv
import properties_sph
from properties_scene import Motion, Random, Scene, moved, scaled, stl, text


def mesh_text(ending, vertices, triangles):
    number = ' %.17g %.17g %.17g\n'
    if ending == 'obj':
        return ''.join('v' + number % tuple(x) for x in vertices) + ''.join('f %d %d %d\n' % (i + 1, j + 1, k + 1) for i, j, k in triangles)
    return stl.solid([['%.17g' % c for c in x] for x in vertices], triangles)


class Twins:
    """The base and two of the twins that it has, written."""

    def __init__(self, scene, folder):
        self.base, self.r, self.folder, self.plan = scene, scene.r, folder, ''

    def write(self, name, scene, case):
        case = copy.deepcopy(case)
        for k, body in enumerate(case['bodies']):
            if 'mesh' in body:
                ending, body['mesh'] = body['mesh'], '%s.b%d.%s' % (name, k, body['mesh'])
                with open(os.path.join(self.folder, body['mesh']), 'w') as out:
                    out.write(mesh_text(ending, body['vertices'], body['triangles']))
        with open(os.path.join(self.folder, name + '.cfg'), 'w') as out:
            out.write('# %s\n%s' % (scene.family, text(case)))
        self.plan += 'run %s %s %d\n' % (name, scene.program, scene.ranks)

    def twin(self, law, case, motion=Motion(), by=(1.0, 1.0, 1.0), scene=None):
        self.write(law, scene or self.base, case)
        numbers = [*motion.axis, *motion.sign, *by, *motion.t]
        self.plan += 'twin %s %s\n' % (law, ' '.join('%.17g' % x for x in numbers))

    def know(self, **facts):
        for key, value in facts.items():
            self.plan += 'know %s %s\n' % (key, value if isinstance(value, str) else '%.17g' % value)

    def know_base(self):
        s = self.base
        self.know(**{key: getattr(s, key) for key in 'family speed length rho dim mass error standard closed open_above unforced '
                     'free_of_walls still'.split()}, refined=bool(s.regions or s.criterion),
                  stream=max(abs(s.V[0]), abs(s.V[1])) if s.stream else 0.0, gravity=math.sqrt(sum(g * g for g in s.g)))

    def units(self):
        s, r = self.base, self.r
        while True:  # a gravity that the table allows
            l, u = math.ldexp(1.0, r.whole(-10, 10)), math.ldexp(1.0, r.whole(-10, 10))
            if u * u / l <= 1e3 and u * l * max(1.0, s.nu) <= 1e4:
                break
        d = math.ldexp(1.0, r.whole(-10, 10))
        while s.rho * d < 2e-3:
            d *= 2.0
        while s.rho * d > 5e4:
            d *= 0.5
        s = copy.copy(s)
        s.say_U = s.say_U or s.program != 'sph'  # without it sph's come from the scene
        self.twin('units', scaled(s.case(), l, u, d), by=(l, u, d))

    def ranks(self):
        s = copy.copy(self.base)
        s.ranks = self.r.whole(2, 4) if s.ranks == 1 else 1
        self.twin('ranks', s.case(), scene=s)

    def move(self, law, motion):
        self.twin(law, moved(self.base.case(), motion), motion)

    def mirror(self):
        self.move('mirror', Motion(sign=(-1, 1, 1)))

    def turn(self):
        if self.base.cycles:
            return self.move('turn', Motion((1, 2, 0)))
        if self.base.turns_half:
            return self.move('turn', Motion(sign=(-1, -1, 1)))
        half = 0.5 * self.base.L if self.base.field == 'taylor_green' else 0.0  # whose quarter turn is its opposite
        self.move('turn', Motion((1, 0, 2), (1, -1, 1), (half, 0.0, 0.0)))  # x to y, y to -x

    def shift(self):
        s = self.base
        h = s.dx if s.shifts else s.L
        self.move('shift', Motion(t=[self.r.whole(-20, 20) * h if a < s.dim else 0.0 for a in range(3)]))

    def carried(self):
        """Kinetic energies differ by that of the whole, which the laws take off."""
        s = copy.copy(self.base)
        s.V = [v + s.speed * self.r.uniform(-1.0, 1.0) if a < s.dim else v for a, v in enumerate(s.V)]
        s.field = 'uniform' if s.field == 'rest' else s.field
        s.say_U = True
        self.twin('carried', s.case())
        for a in s.axes:
            self.know(**{'d' + 'xyz'[a]: s.V[a] - self.base.V[a], 'V' + 'xyz'[a]: self.base.V[a]})

    def draw(self):
        s = self.base
        left = [(self.units, True), (self.ranks, s.program != 'coupled'), (self.mirror, s.mirrors),
                (self.turn, s.turns or s.cycles or s.turns_half), (self.shift, s.shifts or s.shifts_by_L), (self.carried, s.carried)]
        done = 0
        while done < 2 and any(has for _, has in left):
            k = self.r.whole(0, 5)
            if left[k][1]:
                left[k][0]()
                left[k] = None, False
                done += 1


def family_of(r):
    families = properties_sph.families + properties_fv.families
    at = r.uniform(0.0, sum(weight for _, weight, _ in families))
    for name, weight, draw in families:
        at -= weight
        if at < 0.0:
            return name, draw


def make(seed, folder):
    r = Random(int(seed) * 0x2545f4914f6cdd1d)
    name, draw = family_of(r)
    s = Scene(r, name)
    draw(s, r)
    if not s.say_U and s.field in ('rest', 'uniform'):
        s.U = 1.0  # the default
    twins = Twins(s, folder)
    twins.write('base', s, s.case())
    twins.know_base()
    twins.draw()
    with open(os.path.join(folder, 'plan'), 'w') as out:
        out.write(twins.plan)


if __name__ == '__main__':
    make(*sys.argv[1:])
