# SPDX-License-Identifier: GPL-3.0-or-later
"""The former name of ricciflow, for this version only."""

import warnings

from ricciflow import *  # noqa: F401,F403
from ricciflow import __all__, __version__  # noqa: F401

try:
    from ricciflow.pymeshlab import Mesh, MeshSet  # noqa: F401
    __all__ = [*__all__, "Mesh", "MeshSet"]
except ImportError:  # PyMeshLab is not installed
    pass

warnings.warn("pymeshlab_ricci is called ricciflow now: import ricciflow, and ricciflow.pymeshlab "
              "for the methods of MeshSet. The next version has the new name only.",
              DeprecationWarning, stacklevel=2)
