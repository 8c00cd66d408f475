# SPDX-License-Identifier: GPL-3.0-or-later
"""PyMeshLab as a host: both filters as methods of MeshSet, and MeshSet and Mesh as meshes for flatten()
and uniformize(). Importing this module imports PyMeshLab and adds the methods.

Where this package has the plugin for the PyMeshLab that is installed (Linux, 2025.7), the filters run in
PyMeshLab. Elsewhere the library runs on the arrays of the mesh, and the mesh gets what comes of it: where
its triangles stay, in place, by way of attributes 'ricci_given...' that PyMeshLab cannot remove again; a
refined mesh, or one of polygons that a program has made, is a new layer in place of the old one, and a
warning says what is lost. `USES_PLUGIN` says which; a program may set it to False.

    import pymeshlab
    import ricciflow.pymeshlab

    ms = pymeshlab.MeshSet()
    ms.load_new_mesh("scan.ply")
    results = ms.compute_texcoord_parametrization_ricci_flow_euclidean_per_wedge()
"""

import ctypes
import inspect
import itertools
import os
import tempfile
import warnings
from importlib.metadata import PackageNotFoundError, version

import numpy
import pymeshlab
from pymeshlab import Mesh, MeshSet

from . import _errors, _loading
from ._errors import RicciWarning
from ._filters import DESCRIPTIONS, EUCLIDEAN, checked, documentation, plain, signature
from ._library import WARNING
from ._loading import Given
from ._parametrize import layers_of, results_of, run_arrays, with_keywords
from ._watched import silent, teller, watched

__all__ = ["Mesh", "MeshSet", "Refused", "USES_PLUGIN"]

PLUGIN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "libfilter_ricci.so")
PLUGIN_VERSION = "2025.7"  # of PyMeshLab

ATTRIBUTES = {"log_radius": "ricci_u", "target_curvature": "ricci_target_curvature"}
LABELS = {"flat": "Flat", "disk": "Disk", "sphere": "Sphere of", "cover": "Universal cover",
          "axes": "Axes", "polygon": "Canonical polygon"}


class Refused(_errors.Refused, pymeshlab.PyMeshLabException):
    """The mesh of a MeshSet is refused; the text says why. It is unchanged, except for what
    flatten() and uniformize() were given with it: `selected` may stay as the selection of its
    vertices, `curvature` as their quality."""


class InvalidValue(ValueError, pymeshlab.PyMeshLabException):
    """A number that a parameter of a method cannot have."""


# The plugin

_LISTENER = ctypes.CFUNCTYPE(ctypes.c_bool, ctypes.c_int, ctypes.c_char_p)


def _load_plugin():
    """Its function that sets the listener of a thread's runs, or None where it does not fit."""
    try:
        fits = version("pymeshlab").split(".")[:2] == PLUGIN_VERSION.split(".")
    except PackageNotFoundError:
        fits = False
    if not fits or not os.path.exists(PLUGIN):
        return None
    try:
        # A program may have loaded a plugin of these names by itself.
        if EUCLIDEAN not in pymeshlab.filter_list():
            pymeshlab.load_plugin(PLUGIN)
        listen = ctypes.CDLL(PLUGIN).filter_ricci_listen
    except (OSError, pymeshlab.PyMeshLabException) as problem:
        warnings.warn(f"PyMeshLab cannot load the plugin {PLUGIN}, so the library runs on the arrays "
                      f"of its meshes: {problem}", RicciWarning, stacklevel=2)
        return None
    listen.restype, listen.argtypes = None, [_LISTENER]
    return listen


_listen = _load_plugin()
USES_PLUGIN = _listen is not None


def apply(mesh_set, filter_name, /, **parameters):
    """apply_filter. After a failure PyMeshLab 2025.7 keeps a pointer to the log of the MeshSet, and
    later loads write there even if the MeshSet is gone. A filter that succeeds clears it."""
    try:
        return mesh_set.apply_filter(filter_name, **parameters)
    except Exception:
        pymeshlab.MeshSet().create_cube()
        raise


def _refusal(problem):
    """A PyMeshLabException of the plugin as what flatten() raises."""
    text = str(problem).split("Details: ")[-1].strip()
    return (InvalidValue if text.startswith("The value ") else Refused)(text)


def _run_plugin(number, mesh_set, parameters, tell):
    """Results, log, and warnings."""
    log, messages = [], []

    def run(listener):
        def receive(percent, text):
            text = text.decode(errors="replace")
            if percent >= 0:
                return listener(percent / 100, text) is not False
            (messages if percent == WARNING else log).append(text)
            return True

        callback = _LISTENER(receive)
        _listen(callback)
        try:
            return apply(mesh_set, DESCRIPTIONS[number]["python_name"], **parameters)
        finally:
            _listen(_LISTENER())

    try:
        results = watched(run, tell)
    except pymeshlab.PyMeshLabException as problem:
        raise _refusal(problem) from None
    return results, log, messages


# Meshes of PyMeshLab as arrays, and back

def load(path):
    """A new MeshSet with the mesh in a file, of several meshes with all of them as one."""
    new = pymeshlab.MeshSet()
    try:
        new.load_new_mesh(path)
        if new.mesh_number() > 1:
            new.generate_by_merging_visible_meshes()
    except pymeshlab.PyMeshLabException as problem:
        pymeshlab.MeshSet().create_cube()  # as in apply()
        raise OSError(" ".join(str(problem).split())) from None
    return new


class _Texture:
    """A picture of a mesh, which PyMeshLab gives to files only."""

    def __init__(self, name, image):
        self.name, self._image = name, image

    def read(self):
        from . import files
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "picture.png")
            self._image.save(path)
            with open(path, "rb") as picture:
                return files.read_picture(picture.read(), self.name)


def given(mesh):
    """What a run may read of a Mesh, except for selected edges and the number of a face's texture, which
    PyMeshLab does not give to programs."""
    if not mesh.is_compact():
        mesh.compact()
    faces = numpy.ascontiguousarray(mesh.face_matrix(), dtype=numpy.int32)
    uv = None
    if mesh.has_wedge_tex_coord():
        uv = mesh.wedge_tex_coord_matrix().reshape(-1, 3, 2)
    elif mesh.has_vertex_tex_coord():
        uv = mesh.vertex_tex_coord_matrix()[faces]

    def bytes_of(has, colours):
        return (255.0 * colours() + 0.5).astype(numpy.uint8) if has() else None
    new = Given(
        numpy.ascontiguousarray(mesh.vertex_matrix()), faces, mesh.label(),
        selected_vertices=mesh.vertex_selection_array(), selected_faces=mesh.face_selection_array(),
        quality=mesh.vertex_scalar_array() if mesh.has_vertex_scalar() else None, uv=uv,
        vertex_colors=bytes_of(mesh.has_vertex_color, mesh.vertex_color_matrix),
        face_colors=bytes_of(mesh.has_face_color, mesh.face_color_matrix),
        matrix=mesh.transform_matrix())
    new.pictures = [_Texture(*texture) for texture in mesh.textures().items()]
    return new


def _of_faces(mesh_set, name, kind, option):
    """The last numbers that a PLY of PyMeshLab has for each face: what it tells files alone."""
    count = mesh_set.current_mesh().face_number()
    rows = numpy.dtype([("count", "u1"), ("corners", "<i4", 3), *kind])
    options = dict.fromkeys(
        ["save_" + what for what in ("textures", "vertex_color", "vertex_normal", "vertex_quality",
                                     "vertex_flag", "vertex_radius", "face_color", "face_quality",
                                     "face_flag", "wedge_texcoord")], False)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "mesh.ply")
        mesh_set.save_current_mesh(path, binary=True, **{**options, option: True})
        with open(path, "rb") as source:
            data = source.read()
    return numpy.frombuffer(data[len(data) - count * rows.itemsize:], rows)[name]


def _selected_edges(mesh_set):
    """(F, 3) bool"""
    flags = _of_faces(mesh_set, "flags", [("flags", "<i4")], "save_face_flag")
    return (flags[:, None] >> numpy.array([15, 16, 17]) & 1).astype(bool)  # bits of vcglib


def _texture_of_face(mesh_set):
    """(F,) int32"""
    wedge = [("numbers", "u1"), ("uv", "<f4", 6), ("texture", "<i4")]
    return _of_faces(mesh_set, "texture", wedge, "save_wedge_texcoord")


def _new_attribute(has, part):
    """A name that no attribute has: PyMeshLab can neither change nor remove those that are there."""
    for number in itertools.count():
        name = f"ricci_given_{part}{number or ''}"
        try:
            has(name)
        except pymeshlab.PyMeshLabException:
            return name


def _vertex_attribute(mesh, values):
    name = _new_attribute(mesh.vertex_custom_scalar_attribute_array, "v")
    mesh.add_vertex_custom_scalar_attribute(numpy.ascontiguousarray(values, dtype=float), name)
    return name


def _face_attribute(mesh, values):
    name = _new_attribute(mesh.face_custom_scalar_attribute_array, "f")
    mesh.add_face_custom_scalar_attribute(numpy.ascontiguousarray(values, dtype=float), name)
    return name


def _set_attribute(mesh_set, name, values):
    mesh = mesh_set.current_mesh()
    try:
        mesh.vertex_custom_scalar_attribute_array(name)
    except pymeshlab.PyMeshLabException:
        mesh.add_vertex_custom_scalar_attribute(numpy.ascontiguousarray(values), name)
    else:
        apply(mesh_set, "compute_new_custom_scalar_attribute_per_vertex", name=name,
              expr=_vertex_attribute(mesh, values))


def _write_in_place(mesh_set, outputs, is_coloured):
    """Texture coordinates, quality, attributes and colours of the current mesh."""
    mesh, uv = mesh_set.current_mesh(), outputs["uv"]
    apply(mesh_set, "compute_texcoord_by_function_per_wedge", onselected=False, **{
        f"{'uv'[c]}{k}": _face_attribute(mesh, uv[:, k, c]) for k in range(3) for c in range(2)})
    apply(mesh_set, "compute_scalar_by_function_per_vertex", onselected=False,
          q=_vertex_attribute(mesh, outputs["quality"]))
    for key, name in ATTRIBUTES.items():
        _set_attribute(mesh_set, name, outputs[key])
    if is_coloured:
        apply(mesh_set, "compute_color_by_function_per_vertex", onselected=False, **{
            axis: _vertex_attribute(mesh, outputs["vertex_colors"][:, k])
            for k, axis in enumerate("xyza")})


def _as_mesh(part):
    """A Mesh of outputs, which may be those of a layer."""
    more = {"v_scalar_array": part.get("quality")}
    for key, names in (("v_color_matrix", ("vertex_colors", "colors")), ("f_color_matrix",
                                                                        ("face_colors",))):
        for name in names:
            if name in part:
                more[key] = part[name] / 255.0
    if "uv" in part:
        more["w_tex_coords_matrix"] = numpy.ascontiguousarray(part["uv"].reshape(-1, 2))
    return Mesh(part["vertices"], part.get("faces", numpy.empty((0, 3), numpy.int32)),
                part.get("edges", numpy.empty((0, 2), numpy.int32)),
                **{key: value for key, value in more.items() if value is not None})


def _replace_current(mesh_set, outputs):
    """A new layer in place of the current one, whose triangles have changed."""
    old = mesh_set.current_mesh()
    new, number, label, matrix = _as_mesh(outputs), old.id(), old.label(), old.transform_matrix()
    for key, name in ATTRIBUTES.items():
        new.add_vertex_custom_scalar_attribute(numpy.ascontiguousarray(outputs[key]), name)
    mesh_set.add_mesh(new)
    made = mesh_set.current_mesh_id()
    apply(mesh_set, "set_matrix", transformmatrix=matrix, freeze=False)
    mesh_set.set_current_mesh(number)
    mesh_set.delete_current_mesh()
    mesh_set.set_current_mesh(made)
    mesh_set.current_mesh().set_label(label)
    apply(mesh_set, "compute_normal_per_face")
    apply(mesh_set, "compute_normal_per_vertex")
    return (f"The new mesh is the layer {made}, in place of the layer {number}: selections, polygons, "
            "textures and attributes of that one are gone, because PyMeshLab gives no program the means "
            "to carry them over.")


def _add_layers(mesh_set, layers, label, texture=""):
    current = mesh_set.current_mesh_id() if mesh_set.mesh_number() else None
    for kind, part in layers.items():
        mesh_set.add_mesh(_as_mesh(part), f"{LABELS[kind]} {label}")
        if "matrix" in part:
            apply(mesh_set, "set_matrix", transformmatrix=part["matrix"], freeze=False)
        if texture and "uv" in part:
            apply(mesh_set, "set_texture_per_mesh", textname=texture)
    if current is not None:
        mesh_set.set_current_mesh(current)


def mesh_set_of(result, layers, name):
    """A new MeshSet with the mesh of a result, the current one, and its layers before it."""
    new = pymeshlab.MeshSet()
    _add_layers(new, layers, name)
    mesh = _as_mesh(vars(result))
    for key, attribute in ATTRIBUTES.items():
        mesh.add_vertex_custom_scalar_attribute(getattr(result, key), attribute)
    new.add_mesh(mesh, name)
    return new


def save(mesh_set, path):
    """The current mesh with its texture coordinates and all else that PyMeshLab writes: to PLY with the
    quality, to OBJ with triangles, because PyMeshLab 2025.7 writes polygons without texture
    coordinates."""
    keep = {"save_polygonal": False}
    if path.lower().endswith(".ply"):
        keep = {"save_vertex_quality": True}
    if not all(os.path.splitext(name)[1] for name in mesh_set.current_mesh().textures()):
        keep["save_textures"] = False  # images of glTF have no name that says how to write them
    try:
        mesh_set.save_current_mesh(path, save_wedge_texcoord=True, **keep)
    except pymeshlab.PyMeshLabException as problem:
        raise OSError(" ".join(str(problem).split())) from None


def _kind_of(layer):
    """What a new layer is, in one word: of 'Universal cover a.ply' it is 'cover'."""
    return next((kind for kind, label in LABELS.items() if layer.label().startswith(label + " ")),
                layer.label())


def _outputs_of(mesh_set, results, before):
    """The outputs of a run of the plugin, by the names of ricci_c.h."""
    mesh = mesh_set.current_mesh()
    outputs = {"vertices": mesh.vertex_matrix(), "faces": mesh.face_matrix(),
               "uv": mesh.wedge_tex_coord_matrix().reshape(-1, 3, 2),
               "quality": mesh.vertex_scalar_array()}
    for key, name in ATTRIBUTES.items():
        outputs[key] = mesh.vertex_custom_scalar_attribute_array(name)
    for layer in mesh_set:
        if layer.id() not in (mesh.id(), *before):
            kind = _kind_of(layer)
            outputs.update({f"{kind}.vertices": layer.vertex_matrix(),
                            f"{kind}.faces": layer.face_matrix(),
                            f"{kind}.edges": layer.edge_matrix()})
    outputs.update((f"results.{key}", numpy.asarray(value)) for key, value in results.items())
    return outputs


# Runs

def _stays(mesh, outputs):
    """Whether the triangles are as they were, and PyMeshLab can write on them: its functions of faces
    read beyond the end of the attribute that the constructor of polygons makes."""
    try:
        mesh.face_custom_scalar_attribute_array("poly_birth_faces")
        return False
    except pymeshlab.PyMeshLabException:
        return len(outputs["faces"]) == mesh.face_number()


def _run_arrays(number, mesh_set, given_mesh, parameters, progress):
    """By the library; the current mesh then is what comes of it."""
    if parameters.get("seams") == "Selected edges" and "selected_edges" not in given_mesh.arrays:
        given_mesh.arrays["selected_edges"] = _selected_edges(mesh_set)
    if parameters.get("carry_texture") and len(given_mesh.pictures) > 1:
        given_mesh.arrays["picture_of_face"] = _texture_of_face(mesh_set)
    try:
        outputs, log, messages = run_arrays(number, given_mesh, parameters, progress)
    except _errors.Refused as problem:
        raise Refused(str(problem)) from None
    except ValueError as problem:
        raise InvalidValue(str(problem)) from None
    mesh, texture = mesh_set.current_mesh(), parameters.get("carry_texture", "")
    label = mesh.label()
    flat = parameters.get("flat_layer") or "Flat" in parameters.get("layers", "")
    if flat and mesh.textures() and not texture:
        messages.append("The flat layer has no texture: PyMeshLab gives no program the means to put that "
                        "of the mesh on it.")
    if _stays(mesh, outputs):
        _write_in_place(mesh_set, outputs, parameters.get("colorize", False))
    else:
        messages.append(_replace_current(mesh_set, outputs))
    if texture:
        apply(mesh_set, "set_texture_per_mesh", textname=texture)
    _add_layers(mesh_set, layers_of(outputs), label, texture)
    return outputs, log, messages


def _check_mesh(mesh_set):
    """The host has words of its own for these, which name no remedy."""
    if not mesh_set.mesh_number():
        raise ValueError("The MeshSet holds no mesh: load one first")
    if not mesh_set.current_mesh().face_number():
        raise Refused("The mesh is a point cloud: it has vertices but no faces. Reconstruct a surface "
                      "first.")


def _select(mesh_set, selected, curvature, parameters):
    """For the plugin, which reads what the mesh has."""
    mesh = mesh_set.current_mesh()
    count = mesh.vertex_number()
    if selected is not None:
        chosen = _vertex_attribute(mesh, _loading.mask("selected", selected, count, "vertices"))
        apply(mesh_set, "compute_selection_by_condition_per_vertex", condselect=f"({chosen} > 0.5)")
        parameters.setdefault("target_curvature", "Cones at selected vertices")
    if curvature is not None:
        values = _vertex_attribute(mesh, _loading.per_vertex("curvature", curvature, count))
        apply(mesh_set, "compute_scalar_by_function_per_vertex", q=values, onselected=False)
        parameters.setdefault("target_curvature", "From vertex quality")


def solve(number, mesh, progress, keywords, parameters):
    """What a result of flatten() or uniformize() of a Mesh or a MeshSet is made of."""
    mesh_set = mesh
    if isinstance(mesh, Mesh):
        mesh_set = MeshSet()
        mesh_set.add_mesh(mesh)
    _check_mesh(mesh_set)
    others = [name for name in ("uv", "selected_edges", "selected_faces", "diagonals")
              if keywords[name] is not None]
    if USES_PLUGIN and not others:
        before = [layer.id() for layer in mesh_set]
        _select(mesh_set, keywords["selected"], keywords["curvature"], parameters)
        with teller(progress) as tell:
            results, log, messages = _run_plugin(number, mesh_set, parameters, tell)
        outputs = _outputs_of(mesh_set, results, before)
    else:
        given_mesh = given(mesh_set.current_mesh())
        with_keywords(given_mesh, **keywords, parameters=parameters)
        outputs, log, messages = _run_arrays(number, mesh_set, given_mesh, parameters, progress)
    return {"outputs": outputs, "log": log, "messages": messages,
            "name": mesh_set.current_mesh().label(), "texture": parameters.get("carry_texture", ""),
            "mesh_set": mesh_set}


def _bind(number, description):
    name = description["python_name"]

    def method(self, **parameters):
        parameters = checked(name, description, parameters)
        _check_mesh(self)
        if USES_PLUGIN:
            results, _, messages = _run_plugin(number, self, parameters, silent)
        else:
            outputs, _, messages = _run_arrays(number, self, given(self.current_mesh()), parameters,
                                               None)
            results = results_of(outputs)
        for message in messages:
            warnings.warn(message, RicciWarning, stacklevel=2)
        return results

    this = inspect.Parameter("self", inspect.Parameter.POSITIONAL_ONLY)
    method.__name__ = name
    method.__qualname__ = f"MeshSet.{name}"
    method.__signature__ = signature(description, this)
    method.__doc__ = (f"MeshLab's filter '{description['name']}' on the current mesh.\n\n"
                      f"{plain(description['info'])}\n\nReturns a dictionary with the results.\n\n"
                      f"{documentation(description)}\n")
    setattr(MeshSet, name, method)


for _number, _description in enumerate(DESCRIPTIONS):
    _bind(_number, _description)
