# partner.py - coupler/python/cpl.py beside mock_any's programs: every call once, values against mock_any's field.
# usage: partner.py DIR   SPDX-License-Identifier: BSD-3-Clause
import sys
from array import array

import cpl

assert cpl._load().cpl_version() == cpl.VERSION
job = cpl.Job("py")
assert not job.alone and job.comm.size == 1
job.zone("py.box", (0, 0), (1, 2))
job.meet(sys.argv[1])
assert job.find_zone("py.box") == ([0, 0, 0], [1, 2, 0])
try:
    job.find_zone("nowhere")
    sys.exit("no error of a zone that is not there")
except cpl.Error as e:
    assert e.args[0] == -2 and "nowhere" in e.args[1]
points = job.points("mine", 2, 0.15, period=(0, 0))
cells = job.grid("cells", (0, 0), (0.25, 0.25), (4, 4))
t_ = job.field(points, "T", "K", 1, cpl.GET, cpl.MLS)
g_ = job.field(points, "G", "K", 2, cpl.GET, cpl.CUBIC)
out = job.field(cells, "P", "K", 1, cpl.PUT)
spare = job.field(points, "Q", "K", 1, cpl.PUT | cpl.OPTIONAL)
job.ready(0.0, 0.25)


def f(x, y, t, a=0):  # mock_any's field
    return (1 + a) * (1 + x + 2 * y) * (1 + t + t * t) + a


at = [(0.2 + 0.1 * i, 0.3 + 0.05 * i) for i in range(6)]
x = array("d", [c for p in at for c in (*p, 0.0)])
job.move(points, x, range(6), [1.0] * 6)
windows = 0
while (w := job.window()):
    t0, t1, action = w
    centres = [((i + 0.5) / 4, (j + 0.5) / 4) for j in range(4) for i in range(4)]
    job.put(out, t0, [f(u, v, t0) for u, v in centres], [(1 + 2 * t0) * f(u, v, 0) for u, v in centres], [f(u, v, 0) for u, v in centres])
    job.put(spare, t0, [0.0] * 6)
    try:
        job.put(out, t0, [1.0, 2.0])
        sys.exit("no error of a list that is too short")
    except cpl.Error as e:
        assert "2 numbers, expected 16" in e.args[1]
    got, mask = job.get(t_, t1)
    assert list(mask) == [1] * 6 and max(abs(v - f(*p, t1)) for v, p in zip(got, at)) < 1e-11
    job.patch(g_, (0, 0), (1, 1), cpl.END)
    v = job.evaluate(g_, t1, x)
    assert max(abs(v[2 * i + a] - f(*at[i], t1, a)) for i in range(6) for a in range(2)) < 1e-11
    job.tell("worst", 0.0)
    if action & cpl.SAVE:
        job.saved("none.h5")
    windows += 1
    job.advance(t1)
assert windows == 2
sys.exit(job.close(job.code))
