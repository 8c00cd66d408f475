# SPDX-License-Identifier: GPL-3.0-or-later
"""PyMeshLab for the tests: the filters by the plugin, or, with RICCI_ROAD=arrays, by the library on the
arrays of its meshes."""

import os
import sys
import warnings

import common

try:
    import numpy
    import pymeshlab
except ImportError as problem:
    common.skip(f"PyMeshLab cannot be imported here: {problem}")

BY_ARRAYS = os.environ.get("RICCI_ROAD") == "arrays"
_PLUGIN = os.path.join(common.BUILD, "pymeshlab-2025.7", "libfilter_ricci.so")
if BY_ARRAYS:
    sys.path.insert(0, os.path.join(common.BUILD, "python"))
    if not os.path.isdir(sys.path[0]):
        common.skip("the Python package is not built")
    import ricciflow.pymeshlab
    ricciflow.pymeshlab.USES_PLUGIN = False
    warnings.simplefilter("ignore", ricciflow.RicciWarning)
elif os.path.exists(_PLUGIN):
    pymeshlab.load_plugin(_PLUGIN)
else:
    common.skip("the plugin for PyMeshLab is not built")

# After any filter has failed, stock filters too, PyMeshLab 2025.7 writes into the log of that
# MeshSet even when the MeshSet is gone: so every MeshSet lives as long as the program.
_alive = []


def _new_set():
    _alive.append(pymeshlab.MeshSet(verbose=False))
    return _alive[-1]


def mesh_set(mesh):
    """A MeshSet that holds the mesh, or nothing."""
    documents = _new_set()
    if mesh is not None:
        arrays = {"vertex_matrix": numpy.array(mesh.vertices, dtype=float).reshape(-1, 3),
                  "face_matrix": numpy.array(mesh.faces, dtype=numpy.int32).reshape(-1, 3)}
        if mesh.quality is not None:
            arrays["v_scalar_array"] = numpy.array(mesh.quality, dtype=float)
        documents.add_mesh(pymeshlab.Mesh(**arrays))
    return documents


_folders = {}  # of a MeshSet from a file, where the plugin writes what has a relative name


def load(path):
    documents = _new_set()
    documents.load_new_mesh(path)
    _folders[id(documents)] = os.path.dirname(path)
    return documents


def select(documents, condition):
    documents.compute_selection_by_condition_per_vertex(condselect=condition)


def run(documents, our_filter=common, **values):
    if BY_ARRAYS:
        for key in ("report", "carry_texture"):
            if values.get(key):
                values[key] = os.path.join(_folders.get(id(documents), ""), values[key])
        returned = getattr(documents, our_filter.PYTHON_NAME)(**values)
    else:
        returned = documents.apply_filter(our_filter.PYTHON_NAME, **values)
    return {key: common.vector(value.tolist()) if isinstance(value, numpy.ndarray) else value
            for key, value in returned.items()}
