# SPDX-License-Identifier: GPL-3.0-or-later
"""The filters as functions from meshes to results."""

import html
import inspect
import math
import os
import re
import typing
import warnings

import numpy

from . import _library, _loading
from ._errors import Refused, RicciWarning
from ._filters import DESCRIPTIONS, checked, documentation, signature
from ._results import EUCLIDEAN_RESULTS, HYPERBOLIC_RESULTS
from ._watched import teller, watched

class Layer(typing.NamedTuple):
    """A new layer: vertices (V, 3) float64, and what joins them."""

    vertices: numpy.ndarray
    faces: numpy.ndarray
    edges: numpy.ndarray


class Parametrization:
    """A mesh and its texture coordinates. It can be pickled and copied.

    vertices : (V, 3) float64
    faces : (F, 3) int32, indices of vertices
    uv : (F, 3, 2) float64, texture coordinates of each corner of each face, as floats have them
    quality : (V,) float64, quasi-conformal distortion sigma1/sigma2 at the vertices; 1: angles kept
    log_radius : (V,) float64, logarithms of the radii of the flow's circles, up to a constant
    target_curvature : (V,) float64, the Gaussian curvature that the flow reached, in radians
    layers : those that were asked for, each with vertices, faces and edges, by what they are: flat,
        sphere, disk, cover, axes, polygon
    results : what the filter returned, a dictionary; each result is an attribute too
    messages : doubts about the map, a list of sentences; each is a RicciWarning, too
    log : all lines that the run has written
    mesh_set : PyMeshLab's MeshSet that holds the mesh, and the new layers
    """

    def __init__(self, outputs, log, messages, name="", file=None, texture="", mesh_set=None):
        for key in ("vertices", "faces", "uv", "quality", "log_radius", "target_curvature"):
            setattr(self, key, outputs[key])
        self.results = results_of(outputs)
        self.log, self.messages = list(log), list(messages)
        self._layers = layers_of(outputs)
        self._origin = outputs.get("face_of_origin")
        self._name, self._file, self._path, self._texture = name, file, None, texture
        self._mesh_set, self._is_hosted = mesh_set, mesh_set is not None

    def __repr__(self):
        keys = ("genus", "boundary_loops", "charts", "cones", "qc_area_mean", "flipped_faces")
        shown = "".join(f", {key}={self.results[key]:.6g}" for key in keys if key in self.results)
        return f"<{type(self).__name__} faces={len(self.faces)}{shown}>"

    def _repr_html_(self):
        from ._drawing import charts
        points, corners = self.indexed()
        return f"{charts(points, corners)}<br><code>{html.escape(repr(self))}</code>"

    def __getstate__(self):
        # A file is read again where it is needed: what was read may be large.
        path = self._path if self._file is None else str(self._file.path)
        return {**self.__dict__, "_mesh_set": None, "_file": None, "_path": path}

    @property
    def layers(self):
        return {kind: Layer(*(part.get(key, empty.copy()) for key, empty in _NOTHING.items()))
                for kind, part in self._layers.items()}

    @property
    def mesh_set(self):
        if self._mesh_set is None:
            from . import pymeshlab
            self._mesh_set = pymeshlab.mesh_set_of(self, self._layers, self._name)
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
        """Writes the mesh with its texture coordinates, and with the texture that carry_texture has
        drawn. What else was in the file that the mesh is from stays. A mesh of a MeshSet is written by
        PyMeshLab where the path ends in .ply or .obj."""
        from . import files
        path = os.fspath(path)
        if os.path.splitext(path)[1].lower() not in files.WRITES:
            raise ValueError(f"{path}: a file with texture coordinates ends in "
                             f"{' or '.join(files.WRITES)}")
        if not os.path.isdir(os.path.dirname(os.path.abspath(path))):
            raise FileNotFoundError(f"{path} cannot be written: there is no such folder")
        if self._mesh_set is not None and self._is_hosted and path.lower().endswith((".ply", ".obj")):
            from . import pymeshlab
            pymeshlab.save(self._mesh_set, path)
            return
        file = self._file or self._read_again() or files.plain(self.vertices, self.faces)
        refined = None
        if len(self.faces) != len(file.faces):
            refined = (self.vertices, self.faces, self._origin, self._weights(file))
        try:
            said = file.save(path, self.uv, self._texture or None, refined=refined)
        except files.FileError as problem:
            raise OSError(str(problem)) from None
        for sentence in said:
            warnings.warn(sentence, RicciWarning, stacklevel=2)

    def _read_again(self):
        """The file of a copy, if the mesh is still the one that is there."""
        from . import files
        try:
            file = files.read(self._path) if self._path else None
        except files.FileError:
            return None
        same = file is not None and numpy.array_equal(file.vertices, self.vertices[:len(file.vertices)])
        return file if same else None

    def _weights(self, file):
        """(F, 3, 3) barycentric coordinates of the corners in the faces of the file."""
        triangles = file.vertices[file.faces[self._origin]]
        sides = triangles[:, 1:] - triangles[:, :1]
        offsets = self.vertices[self.faces] - triangles[:, :1]
        gram = sides @ sides.transpose(0, 2, 1)
        two = (numpy.linalg.pinv(gram) @ sides @ offsets.transpose(0, 2, 1)).transpose(0, 2, 1)
        weights = numpy.concatenate((1.0 - two.sum(axis=2, keepdims=True), two), axis=2)
        same = self.faces[:, :, None] == file.faces[self._origin][:, None, :]
        return numpy.where(same.any(axis=2, keepdims=True), same, weights)

    def save_layer(self, kind, path):
        """Writes one of `layers` to a PLY file."""
        layer = self.layers[kind]
        vertex = numpy.dtype([(axis, "<f8") for axis in "xyz"])
        face = numpy.dtype([("count", "u1"), ("corners", "<i4", 3)])
        faces = numpy.empty(len(layer.faces), face)
        faces["count"], faces["corners"] = 3, layer.faces
        header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(layer.vertices)}",
                  *(f"property double {axis}" for axis in vertex.names)]
        if len(faces):
            header += [f"element face {len(faces)}", "property list uchar int vertex_indices"]
        if len(layer.edges):
            header += [f"element edge {len(layer.edges)}", "property int vertex1",
                       "property int vertex2"]
        from .files._shared import write_file
        write_file(path, b"".join((
            "\n".join([*header, "end_header", ""]).encode(),
            numpy.ascontiguousarray(layer.vertices, "<f8").tobytes(), faces.tobytes(),
            numpy.ascontiguousarray(layer.edges, "<i4").tobytes())))


_NOTHING = {"vertices": numpy.empty((0, 3)), "faces": numpy.empty((0, 3), numpy.int32),
            "edges": numpy.empty((0, 2), numpy.int32)}


def results_of(outputs):
    """Of the outputs of a run, key -> value: numbers as Python has them, rows as arrays."""
    return {key[len("results."):]: value if value.ndim else value.item()
            for key, value in outputs.items() if key.startswith("results.")}


def layers_of(outputs):
    """Kind of the layer -> what it has, name -> array."""
    layers = {}
    for name, values in outputs.items():
        kind, _, part = name.partition(".")
        if part and kind != "results":
            layers.setdefault(kind, {})[part] = values
    return layers


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
                for kind, layer in super().layers.items()}


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


def with_keywords(given, selected, curvature, uv, selected_edges, selected_faces, diagonals, parameters):
    """Adds what the caller gives beside the mesh, and what that means unless it is said."""
    count, arrays = len(given.vertices), given.arrays
    if selected is not None:
        arrays["selected_vertices"] = _loading.mask("selected", selected, count, "vertices")
        parameters.setdefault("target_curvature", "Cones at selected vertices")
    if curvature is not None:
        arrays["quality"] = _loading.per_vertex("curvature", curvature, count)
        parameters.setdefault("target_curvature", "From vertex quality")
    if uv is not None:
        arrays["uv"] = _loading.per_corner(uv, len(given.faces))
        parameters.setdefault("seams", "Existing texture seams")
    if selected_edges is not None:
        arrays["selected_edges"] = _loading.side_mask("selected_edges", selected_edges, given.faces, count)
        parameters.setdefault("seams", "Selected edges")
    if diagonals is not None:
        arrays["faux"] = _loading.side_mask("diagonals", diagonals, given.faces, count)
    if selected_faces is not None:
        arrays["selected_faces"] = _loading.mask("selected_faces", selected_faces, len(given.faces),
                                                 "faces")
        parameters.setdefault("seams", "Border of selected faces")


def run_arrays(number, given, parameters, progress):
    """Runs a filter on what is given, by the library. Outputs, log, warnings."""
    texture = parameters.get("carry_texture", "")
    pictures = given.read_pictures(bool(texture))
    texts = {"name": given.name, "folder": os.getcwd()}
    with teller(progress) as tell:
        outputs, log, messages = watched(
            lambda listener: _library.run(number, parameters, given.arrays, pictures, texts, listener),
            tell)
    if texture:
        from . import files
        files.write_picture(texture, outputs.pop("picture"))
    return outputs, given.messages + log, given.messages + messages


def of_one(outputs, vertices, faces):
    """The part of the outputs that belongs to one of several meshes: these rows of what the run was given. What
    it has added, such as vertices of a refinement, belongs to the faces that have it."""
    origin = outputs["face_of_origin"]
    chosen = numpy.flatnonzero((origin >= faces.start) & (origin < faces.stop))
    used = numpy.unique(outputs["faces"][chosen])
    rows = numpy.concatenate((numpy.arange(vertices.start, vertices.stop),
                              used[(used < vertices.start) | (used >= vertices.stop)]))
    number = numpy.zeros(len(outputs["vertices"]), numpy.int32)
    number[rows] = numpy.arange(len(rows))
    own = dict(outputs, faces=number[outputs["faces"][chosen]], uv=outputs["uv"][chosen],
               face_of_origin=origin[chosen] - origin.dtype.type(faces.start))
    for key in ("vertices", "quality", "log_radius", "target_curvature"):
        own[key] = outputs[key][rows]
    return own


def _of_its_mesh(number, given, parameters, problem):
    """The refusal of several meshes with the mesh that it is about, in that one's own numbers."""
    def named(i, text):
        return Refused(f"Mesh {i + 1} of {len(given)}{f' ({given[i].name})' * bool(given[i].name)}: {text}")
    ours = {name: value for name, value in parameters.items()
            if name not in ("carry_texture", "report", "time_limit")}
    for i, mesh in enumerate(given):
        try:  # each by itself, as far as its flow
            _library.run(number, ours, mesh.arrays, [], {}, lambda fraction, what: fraction <= 0.0)
        except Refused as own:
            return named(i, own)
        except RuntimeError:  # ended there
            pass
    component = re.match(r"Component with face (\d+)", str(problem))
    if component:
        face = int(component[1])
        for i, mesh in enumerate(given):
            if face < len(mesh.faces):
                return named(i, f"Component with face {face}{str(problem)[component.end():]}")
            face -= len(mesh.faces)
    return problem


def _solve_together(function, meshes, progress, keywords, parameters):
    """One run for several meshes, whose charts share the square."""
    number, kind = _KINDS[function]
    parameters = checked(function, DESCRIPTIONS[number], parameters)
    for name, value in keywords.items():
        if value is not None:
            raise TypeError(f"{name} is for one mesh: of several meshes, each has its own vertices and faces")
    given = [_loading.given_one(mesh, i, len(meshes)) for i, mesh in enumerate(meshes, 1)]
    # Faces that share no vertices, as those of STL, are joined by themselves.
    if any(mesh.is_split and len(mesh.vertices) < 3 * len(mesh.faces) for mesh in given):
        parameters.setdefault("join_vertices", "Always")
    whole = _loading.together(given, parameters)
    try:
        outputs, log, messages = run_arrays(number, whole, parameters, progress)
    except Refused as problem:
        raise _of_its_mesh(number, given, parameters, problem) from None
    for message in messages:
        warnings.warn(message, RicciWarning, stacklevel=3)
    results, vertex, face = [], 0, 0
    for mesh in given:
        end = vertex + len(mesh.vertices), face + len(mesh.faces)
        results.append(kind(of_one(outputs, slice(vertex, end[0]), slice(face, end[1])), log, messages,
                            mesh.name, mesh.file, parameters.get("carry_texture", "")))
        vertex, face = end
    return results


def _solve(function, mesh, faces, progress, keywords, parameters):
    if faces is None and _loading.are_several(mesh):
        return _solve_together(function, mesh, progress, keywords, parameters)
    number, kind = _KINDS[function]
    parameters = checked(function, DESCRIPTIONS[number], parameters)
    host = _loading.host_of(mesh) if faces is None else None
    if host is not None:
        result = kind(**host.solve(number, mesh, progress, keywords, parameters))
    else:
        given = _loading.given(mesh, faces)
        with_keywords(given, **keywords, parameters=parameters)
        if given.is_split:
            parameters.setdefault("join_vertices", "Always")
        outputs, log, messages = run_arrays(number, given, parameters, progress)
        result = kind(outputs, log, messages, given.name, given.file,
                      parameters.get("carry_texture", ""))
    for message in result.messages:
        warnings.warn(message, RicciWarning, stacklevel=3)
    return result


_KINDS = {"flatten": (0, Flattening), "uniformize": (1, Uniformization)}


def flatten(mesh, faces=None, *, selected=None, curvature=None, uv=None, selected_edges=None,
            selected_faces=None, diagonals=None, progress=None, **parameters):
    return _solve("flatten", mesh, faces, progress, dict(
        selected=selected, curvature=curvature, uv=uv, selected_edges=selected_edges,
        selected_faces=selected_faces, diagonals=diagonals), parameters)


def uniformize(mesh, faces=None, *, selected=None, curvature=None, uv=None, selected_edges=None,
               selected_faces=None, diagonals=None, progress=None, **parameters):
    return _solve("uniformize", mesh, faces, progress, dict(
        selected=selected, curvature=curvature, uv=uv, selected_edges=selected_edges,
        selected_faces=selected_faces, diagonals=diagonals), parameters)


_INPUT = """

mesh : a path; vertices and then faces, or both as a pair; an object that has them, such as one of
    trimesh; a pymeshlab.Mesh; or a MeshSet, whose current mesh gets the texture coordinates. A list of
    meshes: their charts share one square at one scale, and a list is returned, one for each mesh, whose
    results, layers and log are those of all together. Vertices of different meshes are never joined
faces : indices of vertices, three of each face, where `mesh` is the vertices
selected : indices of vertices, or a truth value for each: the cones, or the corners of a rectangle;
    target_curvature then is 'Cones at selected vertices', unless it is given
curvature : target curvature of each vertex, in radians; target_curvature then is 'From vertex
    quality', unless it is given
uv : (F, 3, 2), the texture coordinates that the mesh has; seams then is 'Existing texture seams',
    unless it is given
selected_edges : pairs of vertices, or a truth value for each side of each face (F, 3); seams then is
    'Selected edges', unless it is given
selected_faces : indices of faces, or a truth value for each; seams then is 'Border of selected
    faces', unless it is given
diagonals : pairs of vertices, or a truth value for each side of each face (F, 3): sides inside polygons,
    at which the mesh is not cut
progress : True for a bar (of tqdm, where it is installed), or a function that is called with the
    share of the work that is done and the name of the step; what it raises ends the run, as Ctrl-C
    does, and the mesh stays as it is

"""
_own = [inspect.Parameter("mesh", inspect.Parameter.POSITIONAL_OR_KEYWORD),
        inspect.Parameter("faces", inspect.Parameter.POSITIONAL_OR_KEYWORD, default=None),
        *(inspect.Parameter(_name, inspect.Parameter.KEYWORD_ONLY, default=None)
          for _name in ("selected", "curvature", "uv", "selected_edges", "selected_faces",
                        "diagonals", "progress"))]
for _function, _description, _what in zip(
        (flatten, uniformize), DESCRIPTIONS,
        ("UV-unwraps a mesh: a conformal map into the plane. Returns a Flattening; raises Refused.",
         "Hyperbolic metric of a mesh, in the Poincaré disk. Returns a Uniformization; raises "
         "Refused.")):
    _function.__doc__ = f"{_what}{_INPUT}{documentation(_description)}\n"
    _function.__signature__ = signature(_description, *_own)
