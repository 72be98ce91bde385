/* run_view.c - view.py beside a run's output: a script for ParaView that shows all programs of the
 * run at its last time: water without the air, particles in their size, bodies.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>

#include "run.h"
#include "run_files.h"

static const char begin[] =
    "# paraview --script=view.py: all programs of the run at its last time\n"
    "import glob, os, re\n"
    "from paraview.simple import *\n"
    "here = os.path.dirname(os.path.abspath(__file__)) if '__file__' in globals() else "
    "os.getcwd()\n";
static const char rest[] =
    "view = GetActiveViewOrCreate('RenderView')\n"
    "sources, shows, times = {}, [], []\n"
    "for case in sorted(glob.glob(os.path.join(here, '*-case.cfg'))):\n"
    "    name = os.path.basename(case)[:-9]\n"
    "    path = os.path.join(here, name + '.xdmf')\n"
    "    if os.path.exists(path):\n"
    "        sources[name] = XDMFReader(FileNames=[path], guiName=name)\n"
    "        times += list(sources[name].TimestepValues)\n"
    "GetAnimationScene().UpdateAnimationUsingDataTimeSteps()\n"
    "last = max(times) if times else 0.0\n"
    "GetAnimationScene().AnimationTime = last\n"
    "view.ViewTime = last\n"
    "\n"
    "def between(source, where, field, low, high):  # what has a field within these bounds\n"
    "    part = Threshold(Input=source)\n"
    "    part.Scalars = [where, field]\n"
    "    if hasattr(part, 'LowerThreshold'):\n"
    "        part.LowerThreshold, part.UpperThreshold = low, high\n"
    "    else:\n"
    "        part.ThresholdRange = [low, high]\n"
    "    part.UpdatePipeline(last)\n"
    "    return part\n"
    "\n"
    "for name, source in sources.items():\n"
    "    source.UpdatePipeline(last)\n"
    "    if not name.startswith('sph'):\n"
    "        if 'level_set' in source.CellData.keys():  # the water\n"
    "            source = between(source, 'CELLS', 'level_set', -1e30, 0)\n"
    "        if len(sources) > 1 and 'forced' in source.CellData.keys():  # not where sph is\n"
    "            source = between(source, 'CELLS', 'forced', -0.5, 0.5)\n"
    "        shown = Show(source, view)\n"
    "        shown.SetRepresentationType('Surface')\n"
    "        if dim == 2:  # as bright as particles\n"
    "            shown.Ambient, shown.Diffuse = 1.0, 0.0\n"
    "        shows.append((source.CellData, 'CELLS', shown))\n"
    "        continue\n"
    "    text = open(os.path.join(here, name + '-case.cfg')).read()\n"
    "    dx = re.search(r'^ *dx = ([-+.0-9e]+)', text, re.M)\n"
    "    refined = 'level' in source.PointData.keys()\n"
    "    levels = source.PointData['level'].GetRange()[1] if refined else 0\n"
    "    for level in range(int(levels) + 1):\n"
    "        part = source\n"
    "        if levels:\n"
    "            part = between(source, 'POINTS', 'level', level - 0.5, level + 0.5)\n"
    "        shown = Show(part, view)\n"
    "        if dx:\n"
    "            shown.SetRepresentationType('Point Gaussian')\n"
    "            shown.ShaderPreset = 'Plain circle' if dim == 2 else 'Sphere'\n"
    "            shown.GaussianRadius = 0.6 * float(dx.group(1)) / 2**level\n"
    "        shows.append((part.PointData, 'POINTS', shown))\n"
    "for field in fields:\n"
    "    has = [d[field].GetRange(-1 if d[field].GetNumberOfComponents() > 1 else 0)\n"
    "           for d, where, shown in shows if field in d.keys()]\n"
    "    if not has:\n"
    "        continue\n"
    "    low, high = min(r[0] for r in has), max(r[1] for r in has)\n"
    "    if low < 0 < high and field == 'vorticity':  # walls have most of it\n"
    "        high = max(-low, high) / 3\n"
    "        low = -high\n"
    "    for data, where, shown in shows:\n"
    "        if field in data.keys():\n"
    "            ColorBy(shown, (where, field))\n"
    "            shown.SetScalarBarVisibility(view, True)\n"
    "    if high > low:\n"
    "        GetColorTransferFunction(field).RescaleTransferFunction(low, high)\n"
    "    break\n"
    "for path in glob.glob(os.path.join(here, 'sph*_walls.xdmf')):\n"
    "    walls = XDMFReader(FileNames=[path], guiName=os.path.basename(path)[:-5])\n"
    "    shown = Show(walls, view)\n"
    "    shown.Opacity = 0.3 if dim == 3 else 1.0\n"
    "view.InteractionMode = '2D' if dim == 2 else '3D'\n"
    "if dim == 3:\n"
    "    view.CameraFocalPoint = [0, 0, 0]\n"
    "    view.CameraPosition = [-1 + 2 * up[0], -2 + 4 * up[1], 0.3 + 0.7 * up[2]]\n"
    "    view.CameraViewUp = up\n"
    "ResetCamera(view)\n"
    "Render(view)\n";

void files_view(const struct run *r)
{
    char path[1100];
    snprintf(path, sizeof path, "%s/view.py", r->dir);
    FILE *f = r->rank == 0 ? fopen(path, "w") : NULL;
    if (!f)
        return;
    const double *g = r->scene.fluid.gravity, all = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    fputs(begin, f);
    fprintf(f, "dim, up = %d, [%g, %g, %g]\n", r->scene.domain.dim, all > 0.0 ? -g[0] / all : 0.0,
            all > 0.0 ? -g[1] / all : 0.0, all > 0.0 ? -g[2] / all : 1.0);
    fprintf(f, "fields = ('%s', '%s', 'pressure')\n", all > 0.0 ? "velocity" : "vorticity",
            all > 0.0 ? "vorticity" : "velocity");
    fputs(rest, f);
    fclose(f);
}
