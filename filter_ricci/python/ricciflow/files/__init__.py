# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of meshes, read whole and written again with other texture coordinates, with numpy alone.

    mesh = files.read('in.glb')
    mesh.save('out.glb', uv)      # uv (F, 3, 2) of mesh.faces

All that is in the file stays in it; see MeshFile.save.
"""

from pathlib import Path

from . import _obj, _ply
from ._pictures import Picture
from ._shared import FileError, MeshFile, Part, Refined, remarks

_READERS = {'.obj': _obj.ObjFile, '.ply': _ply.PlyFile}


def read(path):
    """The mesh of a file, by its ending: OBJ, PLY, GLB, glTF, STL, OFF, 3MF.

    Raises: FileError, which says what is wrong with the file.
    """
    path = Path(path)
    reader = _READERS.get(path.suffix.lower())
    if reader is None:
        raise FileError(f'{path.name}: {path.suffix or "no ending"} is not read here; '
                        f'{", ".join(_READERS)} are')
    try:
        return reader(path)
    except FileNotFoundError:
        raise FileError(f'{path} does not exist') from None
    except OSError as error:
        raise FileError(f'{path} cannot be read: {error.strerror}') from error
