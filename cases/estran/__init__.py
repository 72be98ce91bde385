"""estran - reads, draws and reports what a run left in its folder.

    import estran                       # with cases/ on PYTHONPATH
    run = estran.read("out/dam_break")  # all programs of a job in one object
    run.series["kinetic energy"]        # an array with .units; run.column("P1") gives times and values
    run.at(-1)["sph"]["pressure"]       # the last snapshot: positions, fields, bodies
    estran.plot(run, "pressure")        # -> out/dam_break/pressure.png
    estran.movie(run, "velocity")       # -> out/dam_break/velocity.mp4, or .apng without ffmpeg
    estran.compare(run)                 # series beside the references of the case
    estran.report(run)                  # -> out/dam_break/report.html
    estran.vtkhdf(run)                  # -> out/dam_break/fv_000000.hdf ..., fv.hdf.series
    estran.to_meshio(run.at(-1)["fv"])  # a meshio.Mesh

Needs numpy and h5py; matplotlib to draw; meshio for to_meshio; pandas and xarray for run.series.frame() and part.dataset().
SPDX-License-Identifier: BSD-3-Clause"""
from .reading import Array, Run, read


def plot(run, field=None, **how):
    """Draws a field of one snapshot over all programs of the run; see estran.drawing.plot."""
    from . import drawing
    return drawing.plot(run, field, **how)


def movie(run, field=None, **how):
    """A film of a field over all snapshots, on one scale; see estran.film.movie."""
    from . import film
    return film.movie(run, field, **how)


def compare(run, **how):
    """Series of the run beside the references that its case names; see estran.curves.compare."""
    from . import curves
    return curves.compare(run, **how)


def report(run, **how):
    """One page of the run: verdict, pictures, series, price; see estran.page.report."""
    from . import page
    return page.report(run, **how)


def vtkhdf(run, folder=None):
    """All snapshots as VTKHDF, for ParaView, PyVista and VTK; see estran.vtk.vtkhdf."""
    from . import vtk
    return vtk.vtkhdf(run, folder)


def to_meshio(part):
    """What one program wrote of one time as a meshio.Mesh; see estran.vtk.to_meshio."""
    from . import vtk
    return vtk.to_meshio(part)
