# All programs of the run at its last time: water without the air, particles in their size, bodies,
# walls. Lines above: dim, up, the corners low and high of the domain (m), the walls within it as
# polylines, the fields to colour by, whether the water has a surface, whether solids are opaque (a
# tank of triangles would hide what is in it).
# --png and --movie write view.png and view.avi beside it.
# A script of a filter is run among our names, with all of numpy's: none of ours may be one of them,
# and max, sum, ... are others then.
from vtkmodules.util.numpy_support import vtk_to_numpy
import numpy as np

# The run's folder. ParaView's window does not tell a script its file: what it was started with does
# on Linux; else the current folder, or the one that the run wrote to.
places = [os.path.dirname(os.path.abspath(__file__))] if '__file__' in globals() else []
if os.path.exists('/proc/self/cmdline'):
    with open('/proc/self/cmdline') as file:
        words = [w.split('=', 1)[-1] for w in file.read().split('\0')]
    places += [os.path.dirname(os.path.abspath(w)) for w in words if w.endswith('.py')]
places = [p for p in places + [os.getcwd(), written] if glob.glob(os.path.join(p, '*-case.cfg'))]
if not places:
    raise RuntimeError('no run here: start paraview in the folder of view.py')
here = places[0]

view = GetActiveViewOrCreate('RenderView')
if '--png' in sys.argv or '--movie' in sys.argv:
    view.ViewSize = [1200, 800]
LoadPalette(paletteName='WhiteBackground')
text, sources, shows = {}, {}, []
for path in sorted(glob.glob(os.path.join(here, '*-case.cfg'))):
    name = os.path.basename(path)[:-9]
    data = os.path.join(here, name + '.xdmf')
    if os.path.exists(data):
        with open(path) as file:
            text[name] = file.read()
        sources[name] = XDMFReader(FileNames=[data], guiName=name)
times = [t for s in sources.values() for t in s.TimestepValues]
last = float(np.max(times)) if times else 0.0
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
GetAnimationScene().AnimationTime = last
view.ViewTime = last
across = float(np.linalg.norm(np.subtract(high, low)))

# Cells hold means; a picture wants values at points: here at the centres of cells, and at the rim
# of a block on a line with the next ones. Cells without numbers (air, what a partner or a body covers)
# take those of their neighbours, for the water is cut at level_set = 0, the rest at shown = 0.5.
centres = '''
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkStructuredGrid

def part(v, axis, first, end):
    return v[(slice(None),) * axis + (slice(first, end),)]

def rim(v, axes, inner, end):
    for a in axes:
        first, last = end(v, a, 0, 1), end(v, a, -1, -2)
        v = np.concatenate([first, inner(v, a), last], a)
    return v

def end_of(v, a, i, j):
    return v.take([i], a)

def line_to(v, a, i, j):  # half a cell beyond
    one, two = v.take([i], a), v.take([j if v.shape[a] > 1 else i], a)
    return np.where(np.isfinite(two), 1.5 * one - 0.5 * two, one)

def middles(v, a):
    return (part(v, a, 1, None) + part(v, a, 0, -1)) / 2

def shifted(v, a, k):  # those k cells on, NaN beyond the rim
    q = np.full(v.shape, np.nan)
    if k > 0:
        part(q, a, 0, -k)[...] = part(v, a, k, None)
    else:
        part(q, a, -k, None)[...] = part(v, a, 0, k)
    return q

def mean_of(guesses):
    total, count = np.zeros(guesses[0].shape), np.zeros(guesses[0].shape)
    for g in guesses:
        total += np.where(np.isfinite(g), g, 0)
        count += np.isfinite(g)
    return total / np.where(count > 0, count, np.nan)

def filled(v, axes):  # along lines of cells, then round corners
    lines, round_corners = [], [v]
    for a in axes:
        for k in (-1, 1):
            one, two = shifted(v, a, k), shifted(v, a, 2 * k)
            lines.append(np.where(np.isfinite(two), 2 * one - two, one))
        round_corners = [q for r in round_corners for q in (r, shifted(r, a, 1), shifted(r, a, -1))]
    for guess in (mean_of(lines), mean_of(round_corners)):
        v = np.where(np.isfinite(v), v, guess)
    return v

def vertices(grid, n):
    if grid.IsA('vtkPointSet'):
        return vtk_to_numpy(grid.GetPoints().GetData()).astype(float).reshape(n[::-1] + [3])
    step = [1, n[0], n[0] * n[1]]
    edges = [[grid.GetPoint(i * step[a])[a] for i in range(n[a])] for a in range(3)]
    return np.stack(np.meshgrid(*edges[::-1], indexing='ij')[::-1], 3)

def fields_of(grid, cells):
    data = grid.GetCellData()
    arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
    return {a.GetName(): vtk_to_numpy(a).astype(float).reshape(cells + [-1]) for a in arrays}

def shown_of(fields, cells, axes):
    shown = np.ones(cells + [1])
    if 'forced' in fields:
        shown *= fields['forced'] < 0.5
    # Air, and what other blocks cover, have no numbers. Blocks meet between cells that take from each
    # other and have none either: one more layer closes the gap, and holds the surface.
    for v in fields.values():
        shown *= np.isfinite(filled(v, axes)).all(3, keepdims=True)
    return shown

def leave_out(fields, x, axes):  # boxes that are cut out hold no air: water is drawn up to their sides
    for a in axes:
        x = middles(x, a)
    for low, high in BOXES:
        within = np.ones(x.shape[:3], bool)
        for k in range(len(axes)):
            within &= (x[..., k] > low[k]) & (x[..., k] < high[k])
        for name in fields:
            if name != 'forced':
                fields[name][within] = np.nan

def at_centres(grid, k):
    n = [1, 1, 1]
    grid.GetDimensions(n)
    axes = [a for a in range(3) if n[2 - a] > 1]
    cells = [i - 1 or 1 for i in n[::-1]]
    x = vertices(grid, n)
    fields = fields_of(grid, cells)
    leave_out(fields, x, axes)
    x = rim(x, axes, middles, end_of)
    if len(axes) == 2:  # later blocks are drawn over earlier ones
        x[..., 2] += LIFT * k
    to, points = vtkStructuredGrid(), vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(x.reshape(-1, 3)), deep=True))
    to.SetDimensions(x.shape[2], x.shape[1], x.shape[0])
    to.SetPoints(points)
    fields['shown'] = shown_of(fields, cells, axes)
    for name, v in fields.items():
        v = filled(filled(v, axes), axes)  # of one layer beyond what is shown, too
        v = rim(v, axes, lambda w, a: w, end_of if name == 'shown' else line_to)
        one = numpy_to_vtk(np.ascontiguousarray(v.reshape(-1, v.shape[-1])), deep=True)
        one.SetName(name)
        to.GetPointData().AddArray(one)
    return to

for k, block in enumerate(leaves(self.GetInputDataObject(0, 0))):
    self.GetOutputDataObject(0).SetBlock(k, at_centres(block, k))
'''
# Closed lines as polygons
inside = '''
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

points, polygons = vtkPoints(), vtkCellArray()
for line in leaves(self.GetInputDataObject(0, 0)):
    x = [line.GetPoint(i) for i in range(line.GetNumberOfPoints())]
    turn = 0  # built-in sum is another function here
    for p, q in zip(x, x[1:] + x[:1]):
        turn += p[0] * q[1] - q[0] * p[1]
    if turn > 0:  # a tank: what is inside is water
        continue
    polygons.InsertNextCell(len(x))
    for p in x:
        polygons.InsertCellPoint(points.InsertNextPoint(p))
to = self.GetOutputDataObject(0)
to.SetPoints(points)
to.SetPolys(polygons)
'''
# Sides of blocks that are walls, as lines: they move with their blocks
walled = '''
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

points, lines = vtkPoints(), vtkCellArray()
for sides, block in zip(SIDES, leaves(self.GetInputDataObject(0, 0))):
    n = [1, 1, 1]
    block.GetDimensions(n)
    n = [m for m in n if m > 1]
    at = np.arange(n[0] * n[1]).reshape(n[1], n[0])
    ends = {'i_min': at[:, 0], 'i_max': at[:, -1], 'j_min': at[0], 'j_max': at[-1]}
    for side in sides:
        lines.InsertNextCell(len(ends[side]))
        for i in ends[side]:
            lines.InsertCellPoint(points.InsertNextPoint(block.GetPoint(int(i))))
to = self.GetOutputDataObject(0)
to.SetPoints(points)
to.SetLines(lines)
'''
# The pieces of a dataset
pieces = '''
def leaves(data):
    if not data.IsA('vtkCompositeDataSet'):
        return [data]
    found, at = [], data.NewIterator()
    at.InitTraversal()
    while not at.IsDoneWithTraversal():
        found.append(at.GetCurrentDataObject())
        at.GoToNextItem()
    return found
'''
exec(pieces)


def scripted(source, kind, script):
    part = ProgrammableFilter(Input=source)
    known = part.GetProperty('OutputDataSetType').GetAvailable()
    part.OutputDataSetType = [k for k in known if k.lower() == kind.lower()][0]
    part.Script = pieces + script
    part.UpdatePipeline(last)
    return part


def cut(source, field, value, below, name):
    part = Clip(Input=source, ClipType='Scalar')
    RenameSource(name, part)
    part.Scalars, part.Value, part.Invert = ['POINTS', field], value, below
    return part


# In the plane that looks at x and the height: from the front, x to the right.
side = [0, 0, 1] if up[1] > 0.5 else [0, -1, 0]


def cut_open(source, name):  # what fills a closed space, through its bodies or in the middle
    if surface or dim == 2:
        return source
    a, b = np.array(low, float), np.array(high, float)
    for path in glob.glob(os.path.join(here, 'sph*_walls.xdmf')):
        bodies = XDMFReader(FileNames=[path])
        bodies.UpdatePipeline(last)
        bounds = bodies.GetDataInformation().GetBounds()
        a, b = np.array(bounds[::2]), np.array(bounds[1::2])
        Delete(bodies)
    part = Clip(Input=source, ClipType='Plane')
    RenameSource(name + ', cut open', part)
    part.ClipType.Origin, part.ClipType.Normal, part.Invert = list((a + b) / 2), side, 1
    part.UpdatePipeline(last)
    return part


def boxes_of(case):  # corners of boxes that are cut out of the cells
    found = []
    for group in re.findall(r'^blocked: \((.*?)^\);', case, re.M | re.S):
        ends = [re.findall(k + r' = \(([^)]*)\)', group) for k in ('min', 'max')]
        found += [[[float(v) for v in c.split(',')] for c in pair] for pair in zip(*ends)]
    for group in re.findall(r'^bodies: \((.*?)^\);', case, re.M | re.S) if list(text) == ['fv'] else []:  # they are boxes, too
        for body in re.split(r'^  (?:, )?\{$', group, flags=re.M)[1:]:
            given = re.search(r'^  (?:%s) = \((.*)\);' % ('box|points' if dim == 2 else 'box'), body, re.M)
            moved = re.search(r'^  translate = \((.*)\);', body, re.M)
            off = [float(v) for v in moved.group(1).split(',')] if moved else [0.0] * 3
            plain = given and not re.search(r'^  (?:scale|rotate) = ', body, re.M)
            points = re.findall(r'\(([^()]*)\)', given.group(1)) if plain else []
            x = list(zip(*([float(v) for v in p.split(',')] + [0.0] for p in points)))[:3]
            if x:
                found.append([[float(f(v)) + o for v, o in zip(x, off)] for f in (np.min, np.max)])
    return found


def show_cells(source, name):
    boxes = repr(boxes_of(text[name]))
    part = scripted(source, 'vtkMultiBlockDataSet', centres.replace('LIFT', repr(1e-5 * across)).replace('BOXES', boxes))
    RenameSource('values at points', part)
    part = cut(part, 'shown', 0.5, 0, name + ', its own cells')
    part.UpdatePipeline(last)
    if 'level_set' in part.PointData.keys():
        part = cut(part, 'level_set', 0.0, 1, name + ', water')
        part.UpdatePipeline(last)
    part = cut_open(part, name)
    shown = Show(part, view)
    shown.SetRepresentationType('Surface')
    shown.Ambient, shown.Diffuse = (1.0, 0.0) if dim == 2 else (0.35, 0.75)  # as bright as particles
    shows.append((part, shown))


def having(source, field, value):
    part = Threshold(Input=source)
    part.Scalars = ['POINTS', field]
    if hasattr(part, 'LowerThreshold'):
        part.LowerThreshold, part.UpperThreshold = value - 0.5, value + 0.5
    else:
        part.ThresholdRange = [value - 0.5, value + 0.5]
    part.UpdatePipeline(last)
    return part


def show_particles(source, case, name):
    dx = re.search(r'^ *dx = ([-+.0-9e]+)', case, re.M)
    if 'guard' in source.PointData.keys():  # where another level flows: no more water
        source = having(source, 'guard', 0)
    refined = 'level' in source.PointData.keys()
    levels = int(source.PointData['level'].GetRange()[1]) if refined else 0
    if dim == 3 and 'vorticity' in source.PointData.keys():  # fv has its z component alone
        source = Calculator(Input=source, Function='vorticity_Z', ResultArrayName='vorticity')
        source.UpdatePipeline(last)
    for level in range(levels + 1):
        part = cut_open(having(source, 'level', level) if levels else source, name)
        shown = Show(part, view)
        if dx:  # discs that leave no holes in a square lattice
            shown.SetRepresentationType('Point Gaussian')
            shown.ShaderPreset = 'Plain circle' if dim == 2 else 'Sphere'
            shown.GaussianRadius = (0.72 if dim == 2 else 0.6) * float(dx.group(1)) / 2**level
        if dim == 2:  # over the cells
            shown.Position = [0, 0, (1 + 0.1 * level) * 1e-3 * across]
        shows.append((part, shown))


def show_solid(name, source, colour, opacity=1.0, kind='Surface'):
    RenameSource(name, source)
    shown = Show(source, view)
    shown.SetRepresentationType(kind)
    shown.ColorArrayName = ['POINTS', '']
    shown.AmbientColor = shown.DiffuseColor = colour
    shown.Opacity, shown.LineWidth = opacity, 2.0
    if dim == 2:
        shown.Ambient, shown.Diffuse, shown.Position = 1.0, 0.0, [0, 0, 2e-3 * across]


def box(least, most):
    return Box(XLength=most[0] - least[0], YLength=most[1] - least[1], ZLength=most[2] - least[2],
               Center=[(a + b) / 2 for a, b in zip(least, most)])


def show_walls():
    grey, dark = [0.6, 0.6, 0.6], [0.2, 0.2, 0.2]
    show_solid('domain', box(low, high), dark, 1.0, 'Outline')
    for line in walls:
        show_solid('wall', PolyLineSource(Points=line), dark)
    for path in glob.glob(os.path.join(here, 'sph*_walls.xdmf')):
        name = os.path.basename(path)[:-5]
        solid = XDMFReader(FileNames=[path], guiName=name)
        solid.UpdatePipeline(last)
        show_solid(name, solid, dark if dim == 2 else grey, 1.0 if opaque or dim == 2 else 0.3)
        if dim == 2:
            show_solid('bodies', Triangulate(Input=scripted(solid, 'vtkPolyData', inside)), grey)
    for name, case in text.items():
        blocks = re.search(r'^blocks: \((.*?)^\);', case, re.M | re.S)
        if blocks and dim == 2 and name in sources:
            kinds = r'^  ([ij]_m[a-z]*) = "(?:wall|slip)"'
            sides = [re.findall(kinds, b, re.M) for b in re.split(r'^  (?:, )?\{$', blocks.group(1), flags=re.M)[1:]]
            script = walled.replace('SIDES', repr(sides))
            show_solid(name + ', walls of blocks', scripted(sources[name], 'vtkPolyData', script), dark)
        for least, most in boxes_of(case):
            show_solid('blocked', box(least, most), grey)


def values(source, field):  # all numbers at the last time; of a vector its length
    parts = []
    for leaf in leaves(servermanager.Fetch(source)):
        array = leaf.GetPointData().GetArray(field)
        if array:
            v = vtk_to_numpy(array)
            x = vtk_to_numpy(leaf.GetPoints().GetData())
            v = v if v.ndim == 1 else np.sqrt((v.astype(float)**2).sum(1))
            parts.append((x[np.isfinite(v)], v[np.isfinite(v)]))
    return parts


def found_now(field):
    return [p for source, shown in shows for p in values(source, field) if len(p[1]) > 0]


def ends_of(found):
    return [np.percentile(v, [0.5, 99.5]) for x, v in found]


def colour(field):
    ends = []
    for t in times if '--movie' in sys.argv else []:  # one scale over the whole film
        for source, shown in shows:
            source.UpdatePipeline(t)
        ends += ends_of(found_now(field))
    for source, shown in shows:
        source.UpdatePipeline(last)
    found = found_now(field)
    ends += ends_of(found)
    least, most = float(np.min(ends)), float(np.max(ends))
    least = 0.0 if field == 'velocity' else least
    signed = field == 'vorticity'
    if signed:
        most = float(np.max(np.abs(ends)))
        least = -most
    table = GetColorTransferFunction(field)
    table.ApplyPreset('Cool to Warm' if signed else 'Plasma (matplotlib)', True)
    for source, shown in shows:
        if field in source.PointData.keys():
            ColorBy(shown, ('POINTS', field))
    if most > least:
        table.RescaleTransferFunction(least, most)
    bar = GetScalarBar(table, view)
    unit = {'velocity': 'm/s', 'vorticity': '1/s', 'pressure': 'Pa'}[field]
    along = ' z' if signed and dim == 3 else ''
    bar.Title, bar.ComponentTitle = '%s%s (%s)' % (field, along, unit), ''
    bar.RangeLabelFormat = '%-#.3g'
    bar.WindowLocation, bar.Position, bar.ScalarBarLength = 'Any Location', [0.88, 0.25], 0.5
    if hasattr(bar, 'DrawBackground'):
        bar.DrawBackground, bar.BackgroundColor = 1, [1, 1, 1, 0.8]
    bar.Visibility = 1
    return found, least, most


# The part of the domain to look at: all of it, or where the field differs from its middle by more
# than a twentieth of its range, if that is but a small part.
def corners(found, least, most):
    of = np.concatenate([v for x, v in found])
    differs = np.abs(of - np.median(of)) > 0.05 * (most - least)
    x = np.concatenate([x for x, v in found])[differs]
    a, b = np.array(low, float), np.array(high, float)
    if len(x) > 0:
        first, end = np.percentile(x, [1, 99], 0)
        share = (end - first)[:dim] / (b - a)[:dim]
        if share.max() < 0.4 and share.prod() < 0.2**dim:
            margin = 0.7 * (end - first).max()
            return np.maximum(a, first - margin), np.minimum(b, end + margin)
    return a, b


def ticks(a, b, apart):  # whole numbers of a step of 1, 2 or 5 times a power of ten
    step = 10.0**np.floor(np.log10(apart))
    step *= [f for f in (1, 2, 5, 10) if f * step >= 0.999 * apart][0]
    return list(np.arange(np.ceil(a / step - 1e-6), np.floor(b / step + 1e-6) + 1) * step + 0.0)


def look(a, b):
    centre, wide = (a + b) / 2, b - a
    view.InteractionMode = '2D' if dim == 2 else '3D'
    if dim == 2:
        axes.UseCustomBounds = 1
        axes.CustomBounds = [a[0], b[0], a[1], b[1]] + 2 * [3e-3 * across]
        if '--png' in sys.argv or '--movie' in sys.argv:  # a flat tank in a flat picture
            view.ViewSize = [1200, 2 * int(np.clip(578 * wide[1] / wide[0], 200, 450))]
        shape = view.ViewSize[0] / view.ViewSize[1]
        high_enough = float(np.max([1.3 * wide[1], 1.35 * wide[0] / shape]))
        centre[0] += 0.06 * shape * high_enough  # the colours stand on the right
        view.CameraFocalPoint = [centre[0], centre[1], 0]
        view.CameraPosition = [centre[0], centre[1], 2 * across]
        view.CameraParallelScale = 0.5 * high_enough
        pixel = high_enough / view.ViewSize[1]
        axes.XAxisUseCustomLabels = axes.YAxisUseCustomLabels = 1
        axes.XAxisLabels, axes.YAxisLabels = ticks(a[0], b[0], 60 * pixel), ticks(a[1], b[1], 30 * pixel)
    else:
        along = np.abs(np.cross(side, up))
        view.CameraFocalPoint = [0, 0, 0]
        view.CameraPosition = list(2 * np.array(side) - 0.8 * along + 1.2 * np.array(up))
        view.CameraViewUp = up
        ResetCamera(view)
        view.GetActiveCamera().Zoom(0.9)


for name, reader in sources.items():
    reader.UpdatePipeline(last)
    if name.startswith('sph'):
        show_particles(reader, text[name], name)
    else:
        show_cells(reader, name)
show_walls()
axes = view.AxesGrid
axes.Visibility = 1
if dim == 2:
    view.OrientationAxesVisibility, axes.AxesToLabel = 0, 3  # least x, least y
axes.XTitle, axes.YTitle, axes.ZTitle = 'x (m)', 'y (m)' if dim == 3 else 'y (m)    ', 'z (m)'
Render(view)  # the first one sets the camera
for field in [f for f in fields if [1 for p, shown in shows if f in p.PointData.keys()]][:1]:
    look(*corners(*colour(field)))
if times:
    clock = AnnotateTimeFilter(Input=list(sources.values())[0])
    new = '{' in clock.Format
    clock.Format = os.path.basename(here) + (', t = {time:.4g} s' if new else ', t = %.4g s')
    Show(clock, view).WindowLocation = 'Upper Center'
if shows:
    # (a plane that cuts would show its handles)
    SetActiveSource(shows[0][0] if surface or dim == 2 else list(sources.values())[0])
Render(view)
# In batch: pvbatch view.py --png --movie (without a display: xvfb-run -a pvbatch ...)
if '--png' in sys.argv:
    SaveScreenshot(os.path.join(here, 'view.png'), view)
if '--movie' in sys.argv and times:
    SaveAnimation(os.path.join(here, 'view.avi'), view, FrameRate=int(np.clip(len(times) // 5, 4, 25)))
