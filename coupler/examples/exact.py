# exact.py - a partner that replaces fv in cases/taylor_green: it knows the flow outside, so what is left is sph's own
# error. usage, in an MPMD job: python3 exact.py DIR [CELLS]   SPDX-License-Identifier: BSD-3-Clause
import sys
from array import array
from math import cos, exp, pi, sin

import cpl

n, nu, rho = int(sys.argv[2]) if len(sys.argv) > 2 else 32, 5e-3, 1.0
h, k, rate = 1.0 / n, 2 * pi, 8 * pi * pi * nu
job = cpl.Job("exact")
job.meet(sys.argv[1])
lo, hi = job.find_zone("sph.free")
cells = job.grid("cells", (0, 0), (h, h), (n, n), (1, 1))
u = job.field(cells, "fv.velocity", "m/s", 2, cpl.PUT)
p = job.field(cells, "fv.pressure", "Pa", 1, cpl.PUT)
gauges = job.points("gauges", 2, 0.06)
v = job.field(gauges, "sph.velocity", "m/s", 2, cpl.GET, cpl.MLS)
at = [(lo[0] + (i + 0.5) * (hi[0] - lo[0]) / 8, lo[1] + (j + 0.5) * (hi[1] - lo[1]) / 8) for j in range(8) for i in range(8)]
mean, mean2 = (sin(pi * h) / (pi * h)) ** 2, sin(2 * pi * h) / (2 * pi * h)  # of a cell over the value at its centre
centres = [((i + 0.5) * h, (j + 0.5) * h) for j in range(n) for i in range(n)] if job.comm.rank == 0 else []
velocity = array("d", [c for x, y in centres for c in (mean * sin(k * x) * cos(k * y), -mean * cos(k * x) * sin(k * y))])
pressure = array("d", [0.25 * rho * mean2 * (cos(2 * k * x) + cos(2 * k * y)) for x, y in centres])


def course(values, rate, t):  # values exp(-rate t) as a cubic in time
    return [array("d", [c * exp(-rate * t) * f for c in values]) for f in (1, -rate, rate ** 2 / 2, -rate ** 3 / 6)]


job.ready()
job.move(gauges, [c for x, y in at for c in (x, y, 0)], range(len(at)))
while (w := job.window()):
    t0, t1, _ = w
    job.put(u, t0, *course(velocity, rate, t0))
    job.put(p, t0, *course(pressure, 2 * rate, t0))
    got, _ = job.get(v, t1)
    exact = [c * exp(-rate * t1) for x, y in at for c in (sin(k * x) * cos(k * y), -cos(k * x) * sin(k * y))]
    error = (sum((a - b) ** 2 for a, b in zip(got, exact)) / sum(b * b for b in exact)) ** 0.5
    job.tell("gauges", error)
    job.advance(t1)
print("exact: velocity of sph at %d gauges is off by %.3g %%" % (len(at), 100 * error))
sys.exit(job.close(job.code))
