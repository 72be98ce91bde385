"""stl.py - a box as a text STL file. usage: stl.py "X Y Z" "X Y Z" [LEFT_OUT [SENSE]]: the names of faces that are left out, of xm xp
ym yp zm zp; -1: normals in. SPDX-License-Identifier: BSD-3-Clause"""
import sys

FACES = {'xm': (0, 1, 3, 2), 'xp': (4, 6, 7, 5), 'ym': (0, 4, 5, 1), 'yp': (2, 3, 7, 6), 'zm': (0, 2, 6, 4), 'zp': (1, 5, 7, 3)}  # bits x y z


def solid(vertices, triangles):
    """The text of such a file; coordinates are texts."""
    facets = ('facet normal 0 0 0\nouter loop\n%sendloop\nendfacet\n' % ''.join('vertex %s %s %s\n' % tuple(vertices[k]) for k in corners)
              for corners in triangles)
    return 'solid s\n%sendsolid s\n' % ''.join(facets)


def box(low, high, without='', sense=1):
    corners = [[(low, high)[k >> (2 - a) & 1][a] for a in range(3)] for k in range(8)]
    triangles = [(face[0], *face[k:k + 2][::sense]) for name, face in FACES.items() if name not in without for k in (1, 2)]
    return solid(corners, triangles)


if __name__ == '__main__':
    print(box(sys.argv[1].split(), sys.argv[2].split(), ''.join(sys.argv[3:4]), int((sys.argv + ['1'] * 5)[4])), end='')
