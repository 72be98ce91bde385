"""Snapshots as meshes for other tools: VTKHDF files (ParaView, PyVista, VTK) and meshio. Particles are points, cells quadrilaterals or
hexahedra, all blocks in one mesh. SPDX-License-Identifier: BSD-3-Clause"""
import json
import os

import h5py
import numpy as np

VERTEX, QUAD, HEXAHEDRON = 1, 9, 12  # of VTK
NAMES = {VERTEX: 'vertex', QUAD: 'quad', HEXAHEDRON: 'hexahedron'}


def _corners(shape):
    """Numbers of the corners of each cell of a block of vertices (nj, ni) or (nk, nj, ni), in VTK's order."""
    number = np.arange(np.prod(shape)).reshape(shape)
    lower, upper = number[..., :-1, :], number[..., 1:, :]
    faces = np.stack([lower[..., :-1], lower[..., 1:], upper[..., 1:], upper[..., :-1]], -1)
    if len(shape) == 3:
        faces = np.concatenate([faces[:-1], faces[1:]], -1)
    return faces.reshape(-1, faces.shape[-1])


def _three(values):
    """Vectors of the plane with a third component."""
    return np.pad(values, ((0, 0), (0, 3 - values.shape[1])))


def mesh(part):
    """points (n, 3) in m, type of the cells, their corners (cells, corners), and fields by name, a row a point or cell."""
    if part.particles:
        points, dim = [np.asarray(part.x)], 1
        corners = [np.arange(len(points[0]))[:, None]]
        kind = VERTEX
    else:
        x = [np.asarray(b) for b in part.x]
        dim = x[0].ndim - 1
        kind = HEXAHEDRON if dim == 3 else QUAD
        before = np.cumsum([0] + [b[..., 0].size for b in x])
        points = [b.reshape(-1, b.shape[-1]) for b in x]
        corners = [_corners(b.shape[:-1]) + n for b, n in zip(x, before)]
    fields = {}
    for name in part.fields:
        blocks = [np.asarray(v) for v in ([part[name]] if part.particles else part[name])]
        values = np.concatenate([v.reshape(int(np.prod(v.shape[:dim])), -1) for v in blocks])
        fields[name] = values[:, 0] if values.shape[1] == 1 else _three(values) if values.shape[1] == 2 else values
    return _three(np.concatenate(points).astype(float)), kind, np.concatenate(corners), fields


def to_meshio(part):
    """A meshio.Mesh of what one program wrote of one time, run.at(-1)["sph"] for example."""
    import meshio
    points, kind, corners, fields = mesh(part)
    data = {'point_data': fields} if kind == VERTEX else {'cell_data': {name: [v] for name, v in fields.items()}}
    return meshio.Mesh(points, [(NAMES[kind], corners)], **data)


def write(part, path):
    """A file of VTKHDF 1.0 (UnstructuredGrid); its field time has the time in s."""
    points, kind, corners, fields = mesh(part)
    with h5py.File(path, 'w') as f:
        to = f.create_group('VTKHDF')
        to.attrs['Version'] = (1, 0)
        to.attrs.create('Type', b'UnstructuredGrid', dtype='S16')
        for name, n in ('Points', len(points)), ('Cells', len(corners)), ('ConnectivityIds', corners.size):
            to['NumberOf' + name] = np.array([n])
        to['Points'], to['Connectivity'] = points, corners.ravel()
        to['Offsets'] = np.arange(len(corners) + 1) * corners.shape[1]
        to['Types'] = np.full(len(corners), kind, np.uint8)
        for name, values in fields.items():
            to[('PointData/' if kind == VERTEX else 'CellData/') + name] = values
        to['FieldData/time'] = np.array([part.time])


def vtkhdf(run, folder=None):
    """Writes each snapshot of each program, PROGRAM_000003.hdf, and PROGRAM.hdf.series, which has their times; returns the names
    of the latter. folder: where to, by default that of the run."""
    folder = folder or run.dir
    os.makedirs(folder, exist_ok=True)
    lists = []
    for name, program in run.programs.items():
        files = []
        for path, time in zip(program.files, program.times):
            files.append({'name': os.path.basename(path)[:-3] + '.hdf', 'time': time})
            write(program[len(files) - 1], os.path.join(folder, files[-1]['name']))
        lists.append(os.path.join(folder, name + '.hdf.series'))
        with open(lists[-1], 'w') as f:
            json.dump({'file-series-version': '1.0', 'files': files}, f, indent=1)
    return lists
