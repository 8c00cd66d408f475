# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of meshes, read whole and written again with other texture coordinates, with numpy alone.

    mesh = files.read('in.glb')
    mesh.save('out.glb', uv)      # uv (F, 3, 2) of mesh.faces

All that is in the file stays in it; see MeshFile.save.
"""

from pathlib import Path

import numpy as np

from . import _gltf, _obj, _off, _ply, _stl, _threemf
from ._pictures import Picture, decode as read_picture, write as write_picture
from ._shared import FileError, MeshFile, Part, PlainMesh, Refined, remarks

__all__ = ['FileError', 'MeshFile', 'Part', 'Picture', 'READS', 'Refined', 'WRITES', 'plain', 'read',
           'read_picture', 'remarks', 'write_picture']

_READERS = {'.obj': _obj.ObjFile, '.ply': _ply.PlyFile, '.glb': _gltf.GltfFile, '.gltf': _gltf.GltfFile,
            '.stl': _stl.StlFile, '.off': _off.OffFile, '.3mf': _threemf.ThreeMfFile}
_PLAIN = {'.obj': _obj.plain, '.ply': _ply.plain, '.glb': _gltf.plain, '.gltf': _gltf.plain,
          '.3mf': _threemf.plain}
READS = tuple(_READERS)
"""Endings of files that are read."""
WRITES = tuple(_PLAIN)
"""Endings of files that are written."""


@np.errstate(all='ignore')  # files hold any numbers
def read(path):
    """The mesh of a file, by its ending: OBJ, PLY, GLB, glTF, STL, OFF, 3MF.

    Raises: FileError, which says what is wrong with the file.
    """
    path = Path(path)
    reader = _READERS.get(path.suffix.lower())
    if reader is None:
        raise FileError(
            f'{path.name}: files that end with {path.suffix or "nothing"} are not read without trimesh '
            f'or PyMeshLab; {", ".join(READS)} are')
    try:
        return reader(path)
    except FileNotFoundError:
        raise FileError(f'{path} does not exist') from None
    except OSError as error:
        raise FileError(f'{path} cannot be read: {error.strerror}') from error


def plain(vertices, faces, name='mesh'):
    """A MeshFile of arrays (V, 3) and (F, 3), which any format may be saved from."""
    return PlainMesh(name, vertices, faces)


def _converted(_, path, mesh):
    """A PlainMesh as a file of the path's format, without coordinates, with the same triangles."""
    write = _PLAIN.get(path.suffix.lower())
    if write is None:
        raise FileError(f'{path.name}: files that end with {path.suffix or "nothing"} are not written; '
                        f'{", ".join(WRITES)} are')
    target = _READERS[path.suffix.lower()](path, write(mesh))
    target.messages = []
    if mesh._polygons is not None and path.suffix.lower() == '.obj':
        target._polygons, target.diagonals, target.faces = mesh._polygons, mesh.diagonals, mesh.faces
    return target


MeshFile._converted = _converted  # it knows all formats
