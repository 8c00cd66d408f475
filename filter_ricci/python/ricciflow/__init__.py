# SPDX-License-Identifier: GPL-3.0-or-later
"""Conformal parametrization of triangle meshes by the discrete Ricci flow, in PyMeshLab.

    from pymeshlab_ricci import flatten, uniformize

    result = flatten("scan.ply")                  # or (vertices, faces), or a MeshSet
    result.uv                                     # texture coordinates: faces x corners x 2
    result.charts, result.qc_area_mean            # what came out of it
    result.save("scan.obj")

Importing this module also makes both filters methods of pymeshlab.MeshSet. On the command line:
python -m pymeshlab_ricci IN OUT.
"""

from importlib.metadata import PackageNotFoundError, version

from pymeshlab import Mesh, MeshSet

from ._filters import EUCLIDEAN, HYPERBOLIC
from ._parametrize import (Flattening, Layer, Parametrization, Refused, Uniformization, flatten,
                           uniformize)

try:
    __version__ = version("pymeshlab-ricci")
except PackageNotFoundError:
    __version__ = "unknown"

__all__ = ["EUCLIDEAN", "HYPERBOLIC", "Flattening", "Layer", "Mesh", "MeshSet", "Parametrization",
           "Refused", "Uniformization", "flatten", "uniformize"]
