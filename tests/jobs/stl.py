"""stl.py - a box as a text STL file. usage: stl.py "X Y Z" "X Y Z" [LEFT_OUT [SENSE]]: the names of faces that are left out, of xm xp
ym yp zm zp; -1: normals in. SPDX-License-Identifier: BSD-3-Clause"""
import sys

FACES = {'xm': (0, 1, 3, 2), 'xp': (4, 6, 7, 5), 'ym': (0, 4, 5, 1), 'yp': (2, 3, 7, 6), 'zm': (0, 2, 6, 4), 'zp': (1, 5, 7, 3)}  # bits x y z


def box(low, high, without='', sense=1):
    corners = ['vertex %s %s %s' % tuple((low, high)[k >> (2 - a) & 1][a] for a in range(3)) for k in range(8)]
    text = 'solid box\n'
    for face in (f for name, f in FACES.items() if name not in without):
        for a, b, c in (face[0], face[1], face[2]), (face[0], face[2], face[3]):
            three = (a, b, c) if sense > 0 else (a, c, b)
            text += 'facet normal 0 0 0\nouter loop\n%s\n%s\n%s\nendloop\nendfacet\n' % tuple(corners[k] for k in three)
    return text + 'endsolid box\n'


if __name__ == '__main__':
    print(box(sys.argv[1].split(), sys.argv[2].split(), ''.join(sys.argv[3:4]), int((sys.argv + ['1'] * 5)[4])), end='')
