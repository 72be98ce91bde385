#!/usr/bin/python3
"""hull.py - writes hull.obj: half of a made-up fore ship, wall-sided, with a breakwater across its deck.
The half breadth is B sqrt(1 - (1 - x/D)^2) from the stem to the breakwater, an ellipse, then B; in the file y is
upwards from the water line, and z = 0 the plane of symmetry, with a face.
SPDX-License-Identifier: BSD-3-Clause
"""
import math

B, D, THICK, L = 0.55, 0.548, 0.15, 1.2  # m: half breadth, stem to breakwater, its thickness, stem to stern
KEEL, DECK, TOP = -0.375, 0.15, 0.9  # m: of the hull, its deck, the breakwater
N = 8  # stations from stem to breakwater, closer towards the stem

points, triangles = {}, []


def face(*corners):
    """A convex polygon, anticlockwise from outside; triangles without area, at the stem, are left out."""
    k = [points.setdefault(tuple(round(v, 6) for v in c), len(points) + 1) for c in corners]
    triangles.extend(t for t in zip([k[0]] * (len(k) - 2), k[1:], k[2:]) if len(set(t)) == 3)


def panels(a, b, low, high):
    """Between stations a and b = (x, half breadth): the plane of symmetry and the side."""
    face((a[0], 0, low), (b[0], 0, low), (b[0], 0, high), (a[0], 0, high))
    face((*b, low), (*a, low), (*a, high), (*b, high))


def across(s, low, high, ahead):
    """At station s, over half the breadth, seen from ahead or from behind."""
    corners = [(s[0], 0, low), (s[0], 0, high), (*s, high), (*s, low)]
    face(*(corners if ahead else corners[::-1]))


x = [D * (1 - math.cos(0.5 * math.pi * k / N)) for k in range(N + 1)] + [D + THICK, L]
stations = [(s, B * math.sqrt(max(0.0, 1 - (1 - s / D) ** 2)) if s < D else B) for s in x]
for k, (a, b) in enumerate(zip(stations, stations[1:])):
    roof = TOP if k == N else DECK
    panels(a, b, KEEL, DECK)
    if k == N:
        panels(a, b, DECK, TOP)
        across(a, DECK, TOP, True)
        across(b, DECK, TOP, False)
    face((a[0], 0, KEEL), (*a, KEEL), (*b, KEEL), (b[0], 0, KEEL))
    face((a[0], 0, roof), (b[0], 0, roof), (*b, roof), (*a, roof))
across(stations[-1], KEEL, DECK, False)

with open("hull.obj", "w") as f:
    f.write("# half of a made-up fore ship with a breakwater, by hull.py\n")
    f.writelines("v %g %g %g\n" % (a, c, b) for a, b, c in points)  # a reflection: triangles turn round
    f.writelines("f %d %d %d\n" % t[::-1] for t in triangles)
