# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run is given: a mesh from a file, from arrays or from an object, as the library takes it."""

import importlib.util
import os
import sys

import numpy

from ._errors import Refused

# Of the formats that PyMeshLab or trimesh read, those that hold faces.
OTHER_ENDINGS = tuple(".3ds .asc .bre .ctm .dae .fbx .ptx .qobj .vmi .wrl .x3d .x3dv".split())


def mesh_endings():
    """Those of the files that can be read here."""
    from . import files
    has_other = any(importlib.util.find_spec(name) for name in ("pymeshlab", "trimesh"))
    return sorted({*files.READS, *(OTHER_ENDINGS if has_other else ())})


class Given:
    """A mesh with all that a run may read of it, by the names of ricci_c.h, and where it is from."""

    def __init__(self, vertices, faces, name="", **arrays):
        self.arrays = {"vertices": vertices, "faces": faces, **arrays}
        self.name = name
        self.pictures = []  # each with a name, and read() for its array
        self.file = None  # files.MeshFile, which writes what it has read
        self.messages = []

    @property
    def vertices(self):
        return self.arrays["vertices"]

    @property
    def faces(self):
        return self.arrays["faces"]

    @property
    def is_split(self):
        """Whether its file repeats vertices along edges, as the format has it."""
        return self.file is not None and self.file.split

    def read_pictures(self, are_drawn):
        """Pairs of names and arrays; without arrays where the run draws nothing. One that cannot be
        read is a Refused."""
        from .files import FileError
        try:
            return [(picture.name, _without_alpha(picture.read()) if are_drawn else None)
                    for picture in self.pictures]
        except FileError as problem:
            raise Refused(str(problem)) from None


def _without_alpha(picture):
    """Of a picture that is opaque."""
    is_opaque = picture.shape[2] == 4 and (picture[..., 3] == numpy.iinfo(picture.dtype).max).all()
    return picture[..., :3] if is_opaque else picture


def checked_arrays(vertices, faces):
    """Vertices (V, 3) float64 and faces (F, 3) int32. Anything else is a TypeError or a
    ValueError."""
    try:
        vertices = numpy.ascontiguousarray(vertices, dtype=numpy.float64)
        given = numpy.asarray(faces)
        with numpy.errstate(invalid="ignore"):
            faces = numpy.ascontiguousarray(given, dtype=numpy.int32)
    except (TypeError, ValueError) as problem:
        raise type(problem)(f"vertices and faces must be arrays of numbers: {problem}") from None
    for name, array in (("vertices", vertices), ("faces", faces)):
        if array.ndim != 2 or array.shape[1] != 3 or not len(array):
            if not array.size:
                raise ValueError(f"The mesh has no {name}")
            raise ValueError(f"{name} must have the shape (N, 3), not {array.shape}")
    if (given != faces).any():
        raise ValueError("faces must hold whole numbers, the indices of vertices")
    if not (faces.min() >= 0 and faces.max() < len(vertices)):
        raise ValueError(f"faces must hold indices from 0 to {len(vertices) - 1}")
    return vertices, faces


def numbers(name, values):
    """An array of the given numbers or truth values."""
    array = numpy.asarray(sorted(values) if isinstance(values, (set, frozenset)) else values)
    if array.dtype.kind not in "biuf":
        raise TypeError(f"{name} must hold numbers, not {values!r:.80}")
    return array


def mask(name, selected, count, elements):
    """(count,) bool, from indices or from a truth value for each element."""
    selected = numbers(name, selected)
    if selected.dtype == bool and selected.shape == (count,):
        return selected
    indices = selected.astype(numpy.int64)
    if (selected.dtype == bool or (indices != selected).any() or
            ((indices < 0) | (indices >= count)).any()):
        raise ValueError(f"{name} must hold indices of {elements}, from 0 to {count - 1}, or a truth "
                         f"value for each of the {elements}")
    chosen = numpy.zeros(count, dtype=bool)
    chosen[indices] = True
    return chosen


def side_mask(name, edges, faces, count):
    """(F, 3) bool: the sides of faces that are among the edges, pairs of vertices."""
    edges = numbers(name, edges)
    if edges.dtype == bool and edges.shape == faces.shape:
        return edges
    if edges.ndim != 2 or edges.shape[1] != 2 or edges.dtype.kind not in "iu":
        raise ValueError(f"{name} must hold pairs of vertices, (N, 2), or a truth value for each "
                         f"side of each face, {faces.shape}: side k from corner k to the next one")

    def numbered(pairs):
        pairs = numpy.sort(pairs.astype(numpy.int64), axis=-1)
        return pairs[..., 0] * count + pairs[..., 1]
    sides = numbered(numpy.stack([faces, numpy.roll(faces, -1, axis=1)], axis=-1))
    wanted = numbered(edges)
    missing = ~numpy.isin(wanted, sides)
    if missing.any():
        raise ValueError(f"{name}: no face has the side {edges[missing.argmax()].tolist()}")
    return numpy.isin(sides, wanted)


def per_vertex(name, values, count):
    values = numbers(name, values).astype(numpy.float64)
    if values.shape != (count,):
        raise ValueError(f"{name} must have a value for each of {count} vertices, not the shape "
                         f"{values.shape}")
    return values


def per_corner(values, count):
    values = numbers("uv", values).astype(numpy.float64)
    if values.shape != (count, 3, 2):
        raise ValueError(f"uv must have two numbers for each corner of each face, ({count}, 3, 2), not "
                         f"the shape {values.shape}")
    return values


def from_path(path):
    """The mesh of a file, all that it holds as one."""
    path = os.fspath(path)
    if not os.path.isfile(path):
        raise FileNotFoundError(f"There is no file {path}")
    from . import files
    if path.lower().endswith(files.READS):
        try:
            return _of_file(files.read(path))
        except files.FileError as problem:
            raise OSError(str(problem)) from None
    if not os.path.splitext(path)[1]:
        raise OSError(f"{path} has no ending that tells its format, such as .obj or .ply: give it one.")
    if importlib.util.find_spec("pymeshlab") is not None:
        from . import pymeshlab as host
        documents = host.load(path)  # which its mesh does not keep alive
        return host.given(documents.current_mesh())
    if importlib.util.find_spec("trimesh") is not None:
        return _by_trimesh(path)
    raise OSError(f"{path}: files that end in {', '.join(files.READS)} are read; others with PyMeshLab "
                  "or trimesh (pip install pymeshlab)")


def _as_bytes(colours):
    return None if colours is None else (255.0 * numpy.clip(colours, 0.0, 1.0) + 0.5).astype(numpy.uint8)


def _of_file(mesh):
    """What a run may read of a MeshFile."""
    vertex_colours, face_colours = mesh.vertex_colours, mesh.face_colours
    if face_colours is None:
        face_colours = mesh.material_colours
        if face_colours is not None and vertex_colours is not None:
            product = mesh.by_vertex(mesh.corner_colours())
            vertex_colours = vertex_colours if product is None else product
    uv = None if mesh.uv is None else numpy.nan_to_num(mesh.uv)
    new = Given(mesh.vertices, mesh.faces, mesh.path.name, faux=mesh.diagonals, uv=uv,
                picture_of_face=mesh.uv_picture, vertex_colors=_as_bytes(vertex_colours),
                face_colors=_as_bytes(face_colours))
    new.pictures, new.file, new.messages = mesh.pictures, mesh, list(mesh.messages)
    return new


def _by_trimesh(path):
    import trimesh
    try:
        mesh = trimesh.load(path, force="mesh", process=False)
        return Given(*checked_arrays(mesh.vertices, mesh.faces), os.path.basename(path))
    except Exception as problem:  # its readers raise anything
        raise OSError(f"{path} cannot be read by trimesh: {problem}") from None


class _Image:
    """A picture of Pillow's, as files have theirs."""

    def __init__(self, image):
        self.name, self.image = "picture of the material", image

    def read(self):
        return numpy.asarray(self.image.convert("RGBA"))


def _of_object(mesh):
    """A mesh with the colours or the picture that trimesh keeps in `visual`."""
    new = Given(*checked_arrays(mesh.vertices, mesh.faces))
    visual = getattr(mesh, "visual", None)
    kind = getattr(visual, "kind", None)
    if kind in ("vertex", "face"):
        new.arrays[f"{kind}_colors"] = numpy.array(getattr(visual, f"{kind}_colors"), numpy.uint8)
    elif kind == "texture" and visual.uv is not None:
        material = visual.material
        image = getattr(material, "baseColorTexture", None) or getattr(material, "image", None)
        new.arrays["uv"] = per_corner(numpy.asarray(visual.uv)[new.faces][..., :2], len(new.faces))
        if image is not None:
            new.pictures = [_Image(image)]
    return new


# What a mesh has that lacks an array which others have.
_ABSENT = {"faux": False, "uv": 0.0, "picture_of_face": -1, "vertex_colors": 255, "face_colors": 255}


def are_several(mesh):
    """Whether it is a list of meshes, not vertices and faces."""
    def is_mesh(item):
        return (isinstance(item, (str, os.PathLike, Given)) or hasattr(item, "vertices") or
                hasattr(item, "to_geometry") or host_of(item) is not None or isinstance(item, (tuple, list)) and len(item) == 2 and numpy.ndim(item[0]) == 2)
    return isinstance(mesh, list) and len(mesh) > 0 and all(is_mesh(item) for item in mesh)


def given_one(item, number, count):
    """One of several meshes."""
    host = host_of(item)
    try:
        if host is not None:
            return host.given(item.current_mesh() if hasattr(item, "current_mesh") else item)
        return given(item, None)
    except (TypeError, ValueError) as problem:
        raise type(problem)(f"Mesh {number} of {count}: {problem}") from None


def together(meshes, parameters):
    """One mesh of several. What one of them lacks and the run needs is a Refused."""
    def names(has):
        return ", ".join(mesh.name or f"mesh {i}" for i, mesh in enumerate(meshes, 1) if has(mesh.arrays.get))
    bare = names(lambda get: get("uv") is None)
    if bare and (parameters.get("charts") == "As they are, only packed" or
                 parameters.get("seams") == "Existing texture seams"):
        raise Refused(f"The charts or seams are to be those of the meshes, but these have no texture "
                      f"coordinates: {bare}.")
    by_faces = names(lambda get: get("face_colors") is not None and get("vertex_colors") is None)
    by_vertices = names(lambda get: get("vertex_colors") is not None)
    if parameters.get("carry_texture") and by_faces and by_vertices:
        raise Refused("One texture cannot show colours of vertices and colours of faces: some meshes have the "
                      f"one ({by_vertices}), others the other ({by_faces}). Bake them apart.")
    def joined(name):
        present = next(mesh.arrays[name] for mesh in meshes if mesh.arrays.get(name) is not None)
        kind, shape = present.dtype, present.shape[1:]
        parts, pictures = [], 0
        for mesh in meshes:
            values = mesh.arrays.get(name)
            if values is None:
                count = len(mesh.vertices if name == "vertex_colors" else mesh.faces)
                values = numpy.full((count, *shape), _ABSENT[name], kind)
            if name == "picture_of_face":
                values = numpy.where(values < 0, values, values + pictures)
            pictures += len(mesh.pictures)
            parts.append(values)
        return numpy.concatenate(parts)
    first = numpy.cumsum([0] + [len(mesh.vertices) for mesh in meshes])
    whole = Given(numpy.concatenate([mesh.vertices for mesh in meshes]),
                  numpy.concatenate([mesh.faces + numpy.int32(start)
                                     for mesh, start in zip(meshes, first)]),
                  f"{len(meshes)} meshes",
                  part=numpy.repeat(numpy.arange(len(meshes)), [len(mesh.vertices) for mesh in meshes]))
    for mesh in meshes:
        if mesh.pictures and mesh.arrays.get("picture_of_face") is None:  # the first one, unless it is said
            mesh.arrays["picture_of_face"] = numpy.zeros(len(mesh.faces), numpy.int32)
    for name in _ABSENT:
        if any(mesh.arrays.get(name) is not None for mesh in meshes):
            whole.arrays[name] = joined(name)
    whole.pictures = [picture for mesh in meshes for picture in mesh.pictures]
    whole.messages = [message for mesh in meshes for message in mesh.messages]
    return whole


def host_of(mesh):
    """The module for PyMeshLab if the mesh is one of PyMeshLab's, which then has been imported."""
    host = sys.modules.get("pymeshlab")
    if host is None or not isinstance(mesh, (getattr(host, "MeshSet", ()), getattr(host, "Mesh", ()))):
        return None
    from . import pymeshlab as ours
    return ours


def given(mesh, faces):
    """From anything that is not PyMeshLab's."""
    if faces is None:
        if isinstance(mesh, Given):
            return mesh
        if isinstance(mesh, (str, os.PathLike)):
            return from_path(mesh)
        files = sys.modules.get(f"{__package__}.files")
        if files is not None and isinstance(mesh, files.MeshFile):
            return _of_file(mesh)
        if hasattr(mesh, "to_geometry"):  # a scene of trimesh
            mesh = mesh.to_geometry()
        if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
            return _of_object(mesh)
        if not isinstance(mesh, (tuple, list)) or len(mesh) != 2:
            raise TypeError("A mesh is a path, vertices and faces, an object that has them, or a Mesh or "
                            f"MeshSet of PyMeshLab, not {type(mesh).__name__}")
        mesh, faces = mesh
    return Given(*checked_arrays(mesh, faces))
