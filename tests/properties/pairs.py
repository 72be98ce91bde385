#!/usr/bin/env python3
"""Two treatments within one support: random scenes of each pair against laws.

A scene is water at rest, or a uniform stream, in which two treatments (a side, a line, a body, a period, an
opening, a surface, an edge of refinement, a side of the SPH box ...) stand a random few dx apart. What must
hold is known without any other code: Archimedes' force, rho g h, the level, nothing lost or put back, rest.

usage: pairs.py [--build DIR] [--seed S] [-n N] [--pair NAME] [--most N] [--keep DIR] [-j JOBS] [PAIR:SEED ...] | --table | --write SEED DIR
Exit code 1: a law is broken; each is a line with the command that repeats it. SPDX-License-Identifier: BSD-3-Clause
"""
import argparse
import concurrent.futures
import csv
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile

from pairs_draw import PAIRS, draw
from pairs_scene import G

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

# ------------------------------------------------------------------ running and judging

def command(s, build, case, out):
    p = lambda name: [os.path.join(build, name), case, "-o", out]
    if s.program != "coupled":
        return p(s.program)
    mpi = "mpirun --quiet --allow-run-as-root --bind-to none --oversubscribe --mca mpi_yield_when_idle 1 " \
          "--mca btl_vader_single_copy_mechanism none"
    return mpi.split() + ["-np", "1"] + p("sph") + [":", "-np", "1"] + p("coupler") + [":", "-np", "1"] + p("fv")


def late(rows, title, share=0.35):
    """Mean of a column over the last part of a run, by the beginning of its title; None: no such column."""
    name = next((c for c in rows[0] if c.startswith(title)), None)
    if name is None:
        return None
    values = [float(r[name]) for r in rows]
    values = values[-max(1, int(share * len(values))):]
    return sum(values) / len(values)


def late_pressure(s, rows):
    """After the kinetic energy has fallen below 1 % of what the fall released: within 5 % of rho g h, two times
    sqrt(h/g) later, in means of a half of that time."""
    far, unit_t = s.laws["falls"][0] * s.unit, s.laws["falls"][1] * math.sqrt(s.unit)
    released = 1000 * G * far * s.depth * s.hi[0] * s.unit ** 2
    t = [float(r["t [s]"]) for r in rows]
    K, p = late_column(rows, "kinetic energy"), late_column(rows, "p [Pa]")
    rest = max([a for a, k in zip(t, K) if k > 0.01 * released], default=0.0)
    start, want, worst = rest + 2.0 * unit_t, 1000 * G * s.depth * s.unit, 0.0
    while start + 0.5 * unit_t <= t[-1]:
        part = [b for a, b in zip(t, p) if start <= a <= start + 0.5 * unit_t]
        off = sum(part) / len(part) / want - 1.0
        worst = off if abs(off) > abs(worst) else worst
        start += 0.5 * unit_t
    return ["water at rest again: pressure %+.1f %%" % (100 * worst)] if abs(worst) > 0.05 else []


def late_column(rows, title):
    name = next(c for c in rows[0] if c.startswith(title))
    return [float(r[name] or 0.0) for r in rows]


def judge(s, out):
    """Names of what is broken, with figures."""
    part = "sph-" if s.program == "coupled" else ""
    summary = json.load(open(os.path.join(out, part + "summary.json")))
    rows = list(csv.DictReader(open(os.path.join(out, part + "series.csv"))))
    bad = []
    unit, laws = s.unit, s.laws
    back, lost = (summary.get("particles_" + k, 0) for k in ("returned", "lost"))
    if back or lost:
        bad.append("put back %d, lost %d" % (back, lost))
    up = [0.0] * s.dim
    up[s.up] = 1.0
    up = s.vector(up)
    for name, volume, pa in laws.get("solids", []):
        weight = 1000 * G * volume * unit ** s.dim
        force = [late(rows, "%s force %s" % (name, "xyz"[a])) for a in range(s.dim)]
        if None in force:
            bad.append("no force of %s in the series" % name)
            continue
        lift = sum(a * b for a, b in zip(force, up))
        if abs(lift - weight) > 0.03 * weight:
            bad.append("lift of %s %.4g N for %.4g (%+.1f %%)" % (name, lift, weight, 100 * (lift / weight - 1)))
        most = max(abs(f - lift * u) for f, u in zip(force, up))
        if most > 0.03 * max(weight, max(pa[:-1]) * unit ** s.dim):
            bad.append("sideways force of %s %.4g N, p A %.4g" % (name, most, max(pa[:-1]) * unit ** s.dim))
    for name, wanted, scale in laws.get("pushed", []):
        force = [late(rows, "%s force %s" % (name, "xyz"[a])) for a in range(s.dim)]
        off = [(f - w * unit ** s.dim) / (scale * unit ** s.dim) for f, w in zip(force, s.vector(wanted))]
        if max(map(abs, off)) > 0.03:
            bad.append("force of %s (%s) %% of its largest part off" % (name, ", ".join("%+.1f" % (100 * x) for x in off)))
    for name, weight in laws.get("rests", []):
        off = late(rows, name + " contact") / (weight * unit ** s.dim) - 1
        if abs(off) > 0.03:
            bad.append("contact of %s %+.1f %%" % (name, 100 * off))
    for name, volume, pa in laws.get("stays", []):
        moved = [late(rows, "%s %s" % (name, "xyz"[a]), 0.01) for a in range(s.dim)]
        start = [float(rows[0][next(c for c in rows[0] if c.startswith("%s %s" % (name, "xyz"[a])))]) for a in range(s.dim)]
        far = max(abs(a - b) for a, b in zip(moved, start)) / (s.dx * unit)
        if far > 1.0:  # half a per cent of its weight, all the time
            bad.append("a body as heavy as water has moved by %.2f dx" % far)
    for name, reach in laws.get("turns", []):
        angles = [float(r["%s angle [rad]" % name]) for r in rows]
        far = max(map(abs, angles)) * reach / s.dx
        if far > 1.0:
            bad.append("a body that nothing turns has turned by %.2f dx at its corners" % far)
    if "falls" in laws:
        bad += late_pressure(s, rows)
    for k, depth in enumerate(laws.get("gauges", [])):
        p, want, scale = late(rows, "p%d" % k), 1000 * G * depth * unit, 1000 * G * s.depth * unit
        if p is None or not abs(p - want) <= 0.02 * scale:
            bad.append("pressure %s Pa for %.5g" % (p and "%.5g (%+.1f %% of the largest)" % (p, 100 * (p - want) / scale), want))
    if "gauges" in laws and any(p[0] == "level" for p in s.probes):
        h, want = late(rows, "level"), s.height(s.level)
        if h is None or not abs(h - want) <= 0.1 * s.dx * unit + 0.2 * s.dx * unit * (s.program != "sph"):
            bad.append("level %s dx off" % (h and "%.2f" % ((h - want) / (s.dx * unit))))
    mach = summary.get("max_mach_late")
    moved = "falls" in laws or "driven" in laws  # and may make waves
    if "stream" not in laws and not moved and mach is not None and mach > 2e-3:
        bad.append("it does not rest: Mach %.2g late" % mach)
    if "stream" in laws:
        e = [c for c in rows[0] if c.startswith("kinetic energy")]
        if e:
            kept = float(rows[-1][e[0]]) / float(rows[0][e[0]])
            if abs(kept - 1) > 2 * laws["stream"]:
                bad.append("energy of a uniform stream %.4f of that at the start" % kept)
    return bad


def one(args):
    pair, seed, options = args
    s = draw(seed, pair)
    work = tempfile.mkdtemp(prefix="pairs.")
    case, out = os.path.join(work, "case.cfg"), os.path.join(work, "out")
    write(s, case)
    try:
        run = subprocess.run(command(s, options.build, case, out), stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                             timeout=options.limit, text=True, env=dict(os.environ, OMP_NUM_THREADS="1"))
        code, said = run.returncode, run.stdout
    except subprocess.TimeoutExpired:
        code, said = 99, "not done in %d s" % options.limit
    lines = [l for l in said.splitlines() if l.strip()]
    if code == 2:
        verdict, why = "refused", [next((l for l in lines if "error" in l or "remedy" not in l), "?")]
    elif code != 0:
        first = next((l for l in lines if "error" in l or "diverged" in l or "stopped" in l), lines[-1] if lines else "?")
        verdict, why = "failed", ["exit code %d: %s" % (code, first)]
    else:
        try:
            why = judge(s, out)
        except (OSError, KeyError, ValueError, StopIteration) as e:
            why = ["no figures: %r" % e]
        verdict = "failed" if why else "passed"
    if verdict == "failed" and options.keep:
        shutil.copytree(work, os.path.join(options.keep, str(seed)), dirs_exist_ok=True)
    shutil.rmtree(work)
    return seed, s.name, verdict, why, pair


def write(s, case):
    with open(case, "w") as f:
        f.write(s.text())
    for name, mesh in s.meshes.items():
        with open(os.path.join(os.path.dirname(case), name), "w") as f:
            f.write(mesh["text"])


def main():
    p = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    p.add_argument("scenes", nargs="*", metavar="PAIR:SEED", help="these scenes alone")
    p.add_argument("--build", default=os.path.join(ROOT, "build"))
    p.add_argument("--seed", type=int, default=1)
    p.add_argument("-n", type=int, default=100)
    p.add_argument("-j", type=int, default=2)
    p.add_argument("--pair")
    p.add_argument("--keep")
    p.add_argument("--limit", type=float, default=120)
    p.add_argument("--most", type=int, default=0, help="scenes that may break a law")
    p.add_argument("--verbose", action="store_true")
    p.add_argument("--table", action="store_true")
    p.add_argument("--write", nargs=2, metavar=("SEED", "DIR"))
    o = p.parse_args()
    if o.table:
        print("| pair | treatments |\n|---|---|")
        for name, what, _, _ in PAIRS:
            print("| `%s` | %s |" % (name, what))
        return 0
    if o.write:
        os.makedirs(o.write[1], exist_ok=True)
        write(draw(int(o.write[0]), o.pair), os.path.join(o.write[1], "case.cfg"))
        return 0
    scenes = [(o.pair, k) for k in range(o.seed, o.seed + o.n)]
    if o.scenes:
        wrong = [scene for scene in o.scenes if not scene.partition(":")[2].isdigit()]
        if wrong:
            p.error("%s: give scenes as PAIR:SEED" % wrong[0])
        scenes = [(pair, int(k)) for pair, _, k in (scene.partition(":") for scene in o.scenes)]
    count = {"passed": 0, "refused": 0, "failed": 0}
    with concurrent.futures.ThreadPoolExecutor(o.j) as pool:
        for seed, name, verdict, why, pair in pool.map(one, ((pair, k, o) for pair, k in scenes)):
            count[verdict] += 1
            if verdict == "failed" or o.verbose:
                again = "tests/properties/pairs.py " + ("%s:%d" % (pair, seed) if pair else "-n 1 --seed %d" % seed)
                print("%s  %s: %s  [%s]" % (verdict.upper() if verdict == "failed" else verdict, name,
                                            "; ".join(why) or "all laws hold", again), flush=True)
    print("pairs: %(passed)d passed, %(refused)d refused, %(failed)d failed" % count)
    return count["failed"] > o.most


if __name__ == "__main__":
    sys.exit(main())
