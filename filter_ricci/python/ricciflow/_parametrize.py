# SPDX-License-Identifier: GPL-3.0-or-later
"""The filters as functions from meshes to results."""

import html
import inspect
import itertools
import math
import os
import tempfile
import typing

import numpy
import pymeshlab

from ._drawing import charts
from ._filters import DESCRIPTIONS, apply, checked, documentation, signature
from ._plugin import teller, watched
from ._results import EUCLIDEAN_RESULTS, HYPERBOLIC_RESULTS


class Refused(pymeshlab.PyMeshLabException):
    """The mesh is refused; the text says why. It is unchanged, but for what
    flatten() and uniformize() were given with it: `selected` stays as the selection of its vertices,
    `curvature` as their quality."""


FORMATS = (".ply", ".obj", ".glb", ".gltf")  # that save() writes


class Layer(typing.NamedTuple):
    """A new layer: vertices (V, 3) float64, and what joins them."""

    vertices: numpy.ndarray
    faces: numpy.ndarray
    edges: numpy.ndarray


def kind_of(layer):
    """What a new layer is, in one word: of 'Universal cover a.ply' it is 'cover'."""
    first = layer.label().split()[0].lower()
    return {"universal": "cover", "canonical": "polygon"}.get(first, first)


class Parametrization:
    """A mesh and its texture coordinates. It can be pickled and copied, but for images of textures.

    vertices : (V, 3) float64
    faces : (F, 3) int32, indices of vertices
    uv : (F, 3, 2) float64, texture coordinates of each corner of each face, as floats have them
    quality : (V,) float64, quasi-conformal distortion sigma1/sigma2 at the vertices; 1: angles kept
    log_radius : (V,) float64, logarithms of the radii of the flow's circles, up to a constant
    target_curvature : (V,) float64, the Gaussian curvature that the flow reached, in radians
    layers : those that were asked for, each with vertices, faces and edges, by what they are: flat,
        sphere, disk, cover, axes, polygon
    mesh_set : the MeshSet that holds the mesh, and the new layers
    results : what the filter returned, a dictionary; each result is an attribute too
    """

    def __init__(self, mesh_set, results, before=(), has_new_texture=False):
        mesh = mesh_set.current_mesh()
        self.results = results
        self.vertices = mesh.vertex_matrix()
        self.faces = mesh.face_matrix()
        self.uv = mesh.wedge_tex_coord_matrix().reshape(-1, 3, 2)
        self.quality = mesh.vertex_scalar_array()
        self.log_radius = mesh.vertex_custom_scalar_attribute_array("ricci_u")
        self.target_curvature = mesh.vertex_custom_scalar_attribute_array("ricci_target_curvature")
        self._label = mesh.label()
        self._layers = {
            kind_of(layer): Layer(layer.vertex_matrix(), layer.face_matrix(), layer.edge_matrix())
            for layer in mesh_set if layer.id() not in (mesh.id(), *before)}
        self._mesh_set = mesh_set
        self._has_new_texture = has_new_texture

    def __repr__(self):
        keys = ("genus", "boundary_loops", "charts", "cones", "qc_area_mean", "flipped_faces")
        shown = "".join(f", {key}={self.results[key]:.6g}" for key in keys if key in self.results)
        return f"<{type(self).__name__} faces={len(self.faces)}{shown}>"

    def _repr_html_(self):
        points, corners = self.indexed()
        return f"{charts(points, corners)}<br><code>{html.escape(repr(self))}</code>"

    def __getstate__(self):
        return {**self.__dict__, "_mesh_set": None}

    @property
    def layers(self):
        return dict(self._layers)

    @property
    def mesh_set(self):
        if self._mesh_set is None:  # after pickling
            new = pymeshlab.MeshSet()
            for kind, layer in self._layers.items():
                new.add_mesh(pymeshlab.Mesh(*layer), f"{kind.capitalize()} {self._label}")
            mesh = pymeshlab.Mesh(
                self.vertices, self.faces, v_scalar_array=self.quality,
                w_tex_coords_matrix=numpy.ascontiguousarray(self.uv.reshape(-1, 2)))
            mesh.add_vertex_custom_scalar_attribute(self.log_radius, "ricci_u")
            mesh.add_vertex_custom_scalar_attribute(self.target_curvature, "ricci_target_curvature")
            new.add_mesh(mesh, self._label)
            self._mesh_set = new
        return self._mesh_set

    def indexed(self):
        """Texture vertices (T, 2) and their indices at the corners of the faces (F, 3), as OBJ
        files have them: corners of one vertex share a texture vertex where they agree."""
        # Texture coordinates are floats: the bits of both are one number, and sort as fast as one.
        uv = numpy.ascontiguousarray(self.uv.reshape(-1, 2), dtype=numpy.float32) + numpy.float32(0)
        bits = uv.view(numpy.uint64).reshape(-1)
        places, index = numpy.unique(bits, return_inverse=True)
        vertex = self.faces.reshape(-1).astype(numpy.int64)
        unique, index = numpy.unique(vertex * len(places) + index.reshape(-1), return_inverse=True)
        points = places[unique % len(places)].view(numpy.float32).reshape(-1, 2)
        return points.astype(numpy.float64), index.reshape(-1, 3)

    def save(self, path):
        """Writes the mesh with its texture coordinates: to a PLY file with the quality too; to OBJ with
        triangles, because PyMeshLab 2025.7 writes polygons without texture coordinates; to GLB and
        glTF by trimesh, with the texture that carry_texture has drawn."""
        path = os.fspath(path)
        ending = os.path.splitext(path)[1].lower()
        if ending not in FORMATS:
            raise ValueError(f"{path}: a file with texture coordinates ends in {' or '.join(FORMATS)}")
        if not os.path.isdir(os.path.dirname(os.path.abspath(path))):
            raise FileNotFoundError(f"{path} cannot be written: there is no such folder")
        if ending in (".glb", ".gltf"):
            self._save_gltf(path)
            return
        keep = {"save_vertex_quality": True} if ending == ".ply" else {"save_polygonal": False}
        if not all(os.path.splitext(name)[1] for name in self.mesh_set.current_mesh().textures()):
            keep["save_textures"] = False  # images of glTF have no name that says how to write them
        try:
            self.mesh_set.save_current_mesh(path, save_wedge_texcoord=True, **keep)
        except pymeshlab.PyMeshLabException as problem:
            raise OSError(" ".join(str(problem).split())) from None

    def _save_gltf(self, path):
        try:
            import trimesh
        except ImportError:
            raise ImportError(f"{path} is written by trimesh: pip install trimesh") from None
        points, corners = self.indexed()
        vertices = numpy.empty((len(points), 3))
        vertices[corners] = self.vertices[self.faces]
        visual = trimesh.visual.TextureVisuals(uv=points, material=trimesh.visual.material.PBRMaterial())
        if self._has_new_texture:  # an old one does not fit
            from PIL import Image
            with tempfile.TemporaryDirectory() as folder:
                picture = os.path.join(folder, "texture.png")
                for image in self.mesh_set.current_mesh().textures().values():
                    image.save(picture)
                    with Image.open(picture) as opened:
                        visual.material.baseColorTexture = opened.copy()
        mesh = trimesh.Trimesh(vertices, corners, visual=visual, process=False)
        embed = {"embed_buffers": True} if path.lower().endswith(".gltf") else {}
        with open(path, "wb") as target:
            data = mesh.export(file_type=os.path.splitext(path)[1][1:].lower(), **embed)
            target.write(data["model.gltf"] if embed else data)


def _result(key, text):
    def get(self):
        if key in self.results:
            return self.results[key]
        raise AttributeError(f"This run has no {key}: {text}")
    return property(get, doc=text)


class Flattening(Parametrization):
    __doc__ = Parametrization.__doc__


class Uniformization(Parametrization):
    __doc__ = Parametrization.__doc__

    @property
    def disk(self):
        """(F, 3) complex128: the corners of the faces in the Poincaré disk of their chart, |z| < 1."""
        per_row = math.ceil(math.sqrt(self.charts))
        corners = per_row * self.uv
        corners = 2.0 * (corners - numpy.floor(corners.mean(axis=1, keepdims=True))) - 1.0
        return corners[..., 0] + 1j * corners[..., 1]

    @property
    def layers(self):
        return {kind: layer._replace(vertices=2.0 * layer.vertices - [1.0, 1.0, 0.0])
                for kind, layer in self._layers.items()}


def _matrices(key, text):
    def get(self):
        re_a, im_a, re_b, im_b = numpy.reshape(_result(key, text).fget(self), (-1, 4)).T
        a, b = re_a + 1j * im_a, re_b + 1j * im_b
        return numpy.array([[a, b], [b.conj(), a.conj()]]).transpose(2, 0, 1)
    return property(get, doc=f"{text}; here (n, 2, 2) complex128, the matrices of the isometries")


for _class, _keys in ((Flattening, EUCLIDEAN_RESULTS),
                      (Uniformization, {**EUCLIDEAN_RESULTS, **HYPERBOLIC_RESULTS})):
    for _key, (_kind, _text) in _keys.items():
        _make = _matrices if _key in ("generators", "generators_low") else _result
        setattr(_class, _key, _make(_key, _text))


def _arrays(vertices, faces):
    """Checked vertices and faces: PyMeshLab does not check them."""
    try:
        vertices = numpy.ascontiguousarray(vertices, dtype=numpy.float64)
        given = numpy.asarray(faces)
        faces = numpy.ascontiguousarray(given, dtype=numpy.int32)
    except (TypeError, ValueError) as problem:
        raise type(problem)(f"vertices and faces must be arrays of numbers: {problem}") from None
    for name, array in (("vertices", vertices), ("faces", faces)):
        if array.ndim != 2 or array.shape[1] != 3 or not len(array):
            raise ValueError(f"{name} must have the shape (N, 3), not {array.shape}")
    if (given != faces).any():
        raise ValueError("faces must hold whole numbers, the indices of vertices")
    if not (faces.min() >= 0 and faces.max() < len(vertices)):
        raise ValueError(f"faces must hold indices from 0 to {len(vertices) - 1}")
    return vertices, faces


def load(path):
    """A new MeshSet with the mesh in a file, of several meshes with all of them as one."""
    path = os.fspath(path)
    if not os.path.isfile(path):
        raise FileNotFoundError(f"There is no file {path}")
    new = pymeshlab.MeshSet()
    together = path.lower().endswith((".glb", ".gltf"))
    try:
        new.load_new_mesh(path, **({"load_in_a_single_layer": True} if together else {}))
        if new.mesh_number() > 1:
            new.generate_by_merging_visible_meshes()
    except pymeshlab.PyMeshLabException as problem:
        pymeshlab.MeshSet().create_cube()  # as in apply()
        raise OSError(" ".join(str(problem).split())) from None
    return new


def _mesh_set(mesh, faces):
    """The MeshSet that is given, or a new one with the mesh."""
    if faces is None:
        if isinstance(mesh, pymeshlab.MeshSet):
            return mesh
        if isinstance(mesh, (str, os.PathLike)):
            return load(mesh)
        if hasattr(mesh, "to_geometry"):  # a scene of trimesh
            mesh = mesh.to_geometry()
    new = pymeshlab.MeshSet()
    if faces is not None:
        mesh = (mesh, faces)
    elif hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        mesh = (mesh.vertices, mesh.faces)
    if isinstance(mesh, pymeshlab.Mesh):
        new.add_mesh(mesh)
    elif isinstance(mesh, (tuple, list)) and len(mesh) == 2:
        vertices, faces = _arrays(*mesh)
        new.add_mesh(pymeshlab.Mesh(vertex_matrix=vertices, face_matrix=faces))
    else:
        raise TypeError("A mesh is a path, vertices and faces, an object that has them, or a Mesh or "
                        f"MeshSet of PyMeshLab, not {type(mesh).__name__}")
    return new


def _require_faces(mesh_set):
    """The host has words of its own for these, which name no remedy."""
    if not mesh_set.mesh_number():
        raise ValueError("The MeshSet holds no mesh: load one first")
    if not mesh_set.current_mesh().face_number():
        raise Refused("The mesh is a point cloud: it has vertices but no faces. Reconstruct a surface "
                      "first.")


def _numbers(name, values):
    """An array of the given numbers or truth values."""
    array = numpy.asarray(sorted(values) if isinstance(values, (set, frozenset)) else values)
    if array.dtype.kind not in "biuf":
        raise TypeError(f"{name} must hold numbers, not {values!r:.80}")
    return array


def _per_vertex(mesh_set, name, values):
    """The name of a new attribute with the values: PyMeshLab cannot change those that are there."""
    mesh = mesh_set.current_mesh()
    if values.shape != (mesh.vertex_number(),):
        raise ValueError(f"{name} must have a value for each of {mesh.vertex_number()} vertices, "
                         f"not the shape {values.shape}")
    for number in itertools.count():
        attribute = f"ricci_{name}{number or ''}"
        try:
            mesh.vertex_custom_scalar_attribute_array(attribute)
        except pymeshlab.PyMeshLabException:
            mesh.add_vertex_custom_scalar_attribute(values, attribute)
            return attribute


def _mask(mesh_set, selected):
    """Indices of vertices, or a truth value for each, as numbers 0 and 1."""
    selected = _numbers("selected", selected)
    if selected.dtype == bool:
        return selected.astype(numpy.float64)
    mask = numpy.zeros(mesh_set.current_mesh().vertex_number())
    indices = selected.astype(numpy.int64)
    if (indices != selected).any() or ((indices < 0) | (indices >= len(mask))).any():
        raise ValueError(f"selected must hold indices of vertices, from 0 to {len(mask) - 1}, or a "
                         "truth value for each vertex")
    mask[indices] = 1.0
    return mask


def _solve(function, mesh, faces, selected, curvature, progress, parameters):
    kind, description = _KINDS[function]
    parameters = checked(function, description, parameters)
    mesh_set = _mesh_set(mesh, faces)
    _require_faces(mesh_set)
    before = [layer.id() for layer in mesh_set]
    if selected is not None:
        attribute = _per_vertex(mesh_set, "selected", _mask(mesh_set, selected))
        apply(mesh_set, "compute_selection_by_condition_per_vertex",
              condselect=f"({attribute} > 0.5)")
        parameters.setdefault("target_curvature", "Cones at selected vertices")
    if curvature is not None:
        attribute = _per_vertex(mesh_set, "curvature",
                                _numbers("curvature", curvature).astype(numpy.float64))
        apply(mesh_set, "compute_scalar_by_function_per_vertex", q=attribute)
        parameters.setdefault("target_curvature", "From vertex quality")
    try:
        with teller(progress) as tell:
            results = watched(
                lambda: apply(mesh_set, description["python_name"], **parameters), tell)
    except pymeshlab.PyMeshLabException as refusal:
        text = str(refusal).split("Details: ")[-1].strip()
        raise (ValueError if text.startswith("The value ") else Refused)(text) from None
    return kind(mesh_set, results, before, bool(parameters.get("carry_texture")))


_KINDS = {"flatten": (Flattening, DESCRIPTIONS[0]), "uniformize": (Uniformization, DESCRIPTIONS[1])}


def flatten(mesh, faces=None, *, selected=None, curvature=None, progress=None, **parameters):
    return _solve("flatten", mesh, faces, selected, curvature, progress, parameters)


def uniformize(mesh, faces=None, *, selected=None, curvature=None, progress=None, **parameters):
    return _solve("uniformize", mesh, faces, selected, curvature, progress, parameters)


_INPUT = """

mesh : a path; vertices and then faces, or both as a pair; an object that has them, such as one of
    trimesh; a pymeshlab.Mesh; or a MeshSet, whose current mesh gets the texture coordinates
faces : indices of vertices, three of each face, where `mesh` is the vertices
selected : indices of vertices, or a truth value for each: the cones, or the corners of a rectangle;
    target_curvature then is 'Cones at selected vertices', unless it is given
curvature : target curvature of each vertex, in radians; target_curvature then is 'From vertex
    quality', unless it is given
progress : True for a bar (of tqdm, where it is installed), or a function that is called with the
    share of the work that is done and the name of the step; what it raises ends the run, as Ctrl-C
    does, and the mesh stays as it is
"""
_own = [inspect.Parameter("mesh", inspect.Parameter.POSITIONAL_OR_KEYWORD),
        inspect.Parameter("faces", inspect.Parameter.POSITIONAL_OR_KEYWORD, default=None),
        *(inspect.Parameter(_name, inspect.Parameter.KEYWORD_ONLY, default=None)
          for _name in ("selected", "curvature", "progress"))]
for _function, _description, _what in zip(
        (flatten, uniformize), DESCRIPTIONS,
        ("Conformal map of a mesh into the Euclidean plane. A Flattening; throws Refused.",
         "Hyperbolic metric of a mesh, in the Poincaré disk. A Uniformization; throws Refused.")):
    _function.__doc__ = f"{_what}{_INPUT}{documentation(_description)}\n"
    _function.__signature__ = signature(_description, *_own)
