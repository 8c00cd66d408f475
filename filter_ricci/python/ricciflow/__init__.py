# SPDX-License-Identifier: GPL-3.0-or-later
"""UV-unwraps triangle meshes: conformal maps by the discrete Ricci flow.

    from ricciflow import flatten, uniformize

    result = flatten("scan.ply")                  # or (vertices, faces), or a MeshSet of PyMeshLab
    result.uv                                     # texture coordinates: faces x corners x 2
    result.charts, result.qc_area_mean            # what came out of it
    result.save("scan.obj")

On the command line: python -m ricciflow IN OUT. With PyMeshLab, `import ricciflow.pymeshlab` makes both
filters methods of MeshSet; where PyMeshLab has been imported before, so does `import ricciflow`.
"""

import sys

from ._errors import RicciWarning, Refused
from ._filters import EUCLIDEAN, HYPERBOLIC
from ._library import VERSION as __version__
from ._parametrize import (Flattening, Layer, Parametrization, Uniformization, flatten, uniformize)

__all__ = ["EUCLIDEAN", "HYPERBOLIC", "Flattening", "Layer", "Parametrization", "Refused",
           "RicciWarning", "Uniformization", "flatten", "uniformize"]

if "pymeshlab" in sys.modules:
    from . import pymeshlab
