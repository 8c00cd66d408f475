# SPDX-License-Identifier: GPL-3.0-or-later
"""In place of `xatlas.parametrize`: change the import, and the same call gives fewer charts.

    from ricciflow import xatlas
    vmapping, indices, uvs = xatlas.parametrize(positions, indices)
"""

from typing import Union

import numpy
from numpy.typing import ArrayLike, NDArray

from . import flatten

__all__ = ["parametrize"]


def parametrize(
    positions: ArrayLike,
    indices: ArrayLike,
    normals: Union[ArrayLike, None] = None,
    uvs: Union[ArrayLike, None] = None,
) -> "tuple[NDArray[numpy.uint32], NDArray[numpy.uint32], NDArray[numpy.float32]]":
    """New vertices of a mesh, so that each has one place in the texture: for each of them the vertex
    that it was (N,) uint32, the faces in their order (F, 3) uint32, and texture coordinates in [0, 1]
    (N, 2) float32. Vertices without a face are left out. `normals` and `uvs`, hints for xatlas, are
    not used."""
    del normals, uvs
    result = flatten(positions, indices)
    points, corners = result.indexed()
    vmapping = numpy.empty(len(points), dtype=numpy.uint32)
    vmapping[corners] = result.faces
    return vmapping, corners.astype(numpy.uint32), points.astype(numpy.float32)
