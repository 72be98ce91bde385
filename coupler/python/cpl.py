"""cpl - coupler/cpl.h for Python: a partner of a coupled job in a few lines.

Needs mpi4py and libcpl.so (environment variable ESTRAN_LIB: its path, else the loader finds it). One class, Job, with the
calls of cpl.h by their names; errors are exceptions. Arrays are anything that holds doubles in a row: array('d'), numpy
arrays, lists. What comes back is an array('d'). SPDX-License-Identifier: BSD-3-Clause"""
import ctypes as C
import os
from array import array

from mpi4py import MPI

VERSION, NAME, TERMS = 3, 64, 4  # of the cpl.h that this file was written for
RUN, OUTPUT, SAVE, STOP = 1, 2, 4, 8
PUT, GET, OPTIONAL = 1, 2, 4
SHEPARD, MLS, NEAREST, SUM, CONSERVATIVE = 0, 1, 2, 3, 16
LINEAR, CUBIC = 0, 1
START, END, BETWEEN = 0, 1, 2

Comm = C.c_int if MPI._sizeof(MPI.Comm) == C.sizeof(C.c_int) else C.c_void_p


class Grid(C.Structure):
    """struct cpl_grid"""
    _fields_ = [("dim", C.c_int), ("origin", C.c_double * 3), ("spacing", C.c_double * 3), ("cells", C.c_int * 3),
                ("periodic", C.c_int * 3), ("lo", C.c_int * 3), ("hi", C.c_int * 3)]


class Error(Exception):
    """A call failed: args are its code (cpl_error) and the library's sentence."""


def _load():
    lib = C.CDLL(os.environ.get("ESTRAN_LIB", "libcpl.so.%d" % VERSION))
    lib.cpl_strerror.restype = C.c_char_p
    lib.cpl_waited.restype = lib.cpl_heard.restype = C.c_double
    lib.cpl_window_number.restype = C.c_int64
    return lib


def _doubles(v, n, what):
    """A C array over v; its length is checked, since the library cannot."""
    if v is None:
        return None
    a = v if isinstance(v, array) and v.typecode == "d" else array("d", memoryview(v).cast("B").cast("d") if
                                                                  hasattr(v, "__array_interface__") else v)
    if n is not None and len(a) != n:
        raise Error(-2, "%s: %d numbers, expected %d" % (what, len(a), n))
    return (C.c_double * len(a)).from_buffer(a) if len(a) else (C.c_double * 1)()


def _three(v):
    return (C.c_double * 3)(*(list(v) + [0.0, 0.0])[:3])


class Job:
    """A solver's place in a job. comm: the ranks of this solver; alone: no other program is there, and no call may follow."""

    def __init__(self, name, deadline=30.0, world=MPI.COMM_WORLD):
        self.lib, self.c, mine = _load(), C.c_void_p(), Comm()
        self.ncomp, self.count, self.of = {}, {}, {}
        w = Comm.from_address(MPI._addressof(world))
        code = self.lib.cpl_open_as(VERSION, w, name.encode(), C.c_double(deadline), C.byref(self.c), C.byref(mine))
        if code:
            raise Error(code, "the job was refused")
        self.comm, self.alone = MPI.Intracomm(), not self.c
        Comm.from_address(MPI._addressof(self.comm)).value = mine.value

    def _must(self, code):
        if code:
            raise Error(code, self.lib.cpl_strerror(self.c).decode())

    def meet(self, folder, case_hash=0, restart_window=-1, faults=0):
        self._must(self.lib.cpl_meet(self.c, C.c_uint64(case_hash), C.c_int64(restart_window), faults, folder.encode()))

    def zone(self, name, lo, hi):
        self._must(self.lib.cpl_zone(self.c, name.encode(), _three(lo), _three(hi)))

    def find_zone(self, name):
        lo, hi = (C.c_double * 3)(), (C.c_double * 3)()
        self._must(self.lib.cpl_find_zone(self.c, name.encode(), lo, hi))
        return list(lo), list(hi)

    def grid(self, name, origin, spacing, cells, periodic=(0, 0, 0), lo=(0, 0, 0), hi=None):
        """A block lo <= i < hi of a uniform grid; all of it by default."""
        g, n = Grid(dim=len(cells)), C.c_int()
        for a in range(g.dim):
            g.origin[a], g.spacing[a], g.cells[a], g.periodic[a] = origin[a], spacing[a], cells[a], periodic[a]
            g.lo[a], g.hi[a] = lo[a], (hi or cells)[a]
        self._must(self.lib.cpl_grid(self.c, name.encode(), C.byref(g), C.byref(n)))
        self.count[n.value] = 1
        for a in range(g.dim):
            self.count[n.value] *= g.hi[a] - g.lo[a]
        return n.value

    def points(self, name, dim, support=0.0, period=None):
        n = C.c_int()
        self._must(self.lib.cpl_points(self.c, name.encode(), dim, C.c_double(support), C.byref(n)))
        if period:
            self._must(self.lib.cpl_period(self.c, n, _three(period)))
        return n.value

    def field(self, at, name, unit, ncomp, direction, how=0):
        n = C.c_int()
        self._must(self.lib.cpl_field(self.c, at, name.encode(), unit.encode(), ncomp, direction, how, C.byref(n)))
        self.ncomp[n.value], self.of[n.value] = ncomp, at
        return n.value

    def ready(self, t=0.0, dt_wish=float("inf")):
        self._must(self.lib.cpl_ready(self.c, C.c_double(t), C.c_double(dt_wish)))

    def window(self):
        """(t0, t1, action), or None at the end: then self.code is the job's."""
        t0, t1, action, code = C.c_double(), C.c_double(), C.c_int(), C.c_int()
        self._must(self.lib.cpl_window(self.c, C.byref(t0), C.byref(t1), C.byref(action), C.byref(code)))
        self.code = code.value
        return None if action.value & STOP else (t0.value, t1.value, action.value)

    def move(self, at, x, ids, volume=None):
        n = len(ids)
        i = (C.c_int64 * max(n, 1))(*ids)
        self._must(self.lib.cpl_move(self.c, at, C.c_long(n), _doubles(x, 3 * n, "places"), i,
                                     _doubles(volume, n, "volumes")))
        self.count[at] = n

    def put(self, field, t, *terms):
        """Values, and coefficients of (t' - t), (t' - t)^2, (t' - t)^3 where there are some."""
        n = self.count.get(self.of[field], 0)
        of = [_doubles(v, n * self.ncomp[field], "values") for v in terms]
        pointers = (C.POINTER(C.c_double) * len(of))(*[C.cast(v, C.POINTER(C.c_double)) for v in of])
        self._must(self.lib.cpl_put_course(self.c, field, C.c_double(t), C.c_long(n), len(of), pointers))

    def get(self, field, t, when=END):
        """(values, mask) at the points of the field's set."""
        n = self.count.get(self.of[field], 0)
        v, mask = array("d", bytes(8 * n * self.ncomp[field])), bytearray(n)
        m = (C.c_ubyte * max(n, 1))()
        self._must(self.lib.cpl_get_at(self.c, field, when, C.c_double(t), C.c_long(n), _doubles(v, None, ""), m))
        mask[:] = bytes(m)[:n]
        return v, mask

    def patch(self, field, lo, hi, when=START):
        self._must(self.lib.cpl_patch_get_at(self.c, field, when, _three(lo), _three(hi)))

    def evaluate(self, field, t, x):
        """Values of the patch at the places x (3 numbers each)."""
        n = len(x) // 3
        v = array("d", bytes(8 * n * self.ncomp[field]))
        self.lib.cpl_patch_eval(self.c, field, C.c_double(t), C.c_long(n), _doubles(x, 3 * n, "places"),
                                _doubles(v, None, ""), None)
        return v

    def tell(self, key, value):
        self._must(self.lib.cpl_tell(self.c, key.encode(), C.c_double(value)))

    def saved(self, file):
        self._must(self.lib.cpl_saved(self.c, file.encode()))

    def advance(self, t1, stop=False):
        self._must(self.lib.cpl_advance(self.c, C.c_double(t1), int(stop)))

    def fail(self, reason, code=3):
        self.lib.cpl_fail(self.c, code, reason.encode())

    def close(self, code=0):
        """The exit code of the job."""
        return self.lib.cpl_close(C.byref(self.c), code)
