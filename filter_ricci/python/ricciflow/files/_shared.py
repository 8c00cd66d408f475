# SPDX-License-Identifier: GPL-3.0-or-later
"""What the formats share: the mesh that a file holds and what is written of it, and files that are replaced
whole or not at all."""

import os
import secrets
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np

from ._polygons import triangulate
from ._text import whole


class FileError(ValueError):
    """A file cannot be read or written; the sentence names it and what is wrong."""


@dataclass
class Part:
    """A mesh of a file with a space of its own: one of glTF or 3MF; of other formats the whole file."""
    name: str
    faces: slice  # its triangles in MeshFile.faces
    vertices: slice  # its vertices in MeshFile.vertices
    matrices: list = field(default_factory=lambda: [np.eye(4)])  # (4, 4) of each place it is shown at

    @property
    def scale(self):
        """Units of the scene in one unit of the part, the largest of its places; counts for texels."""
        return max((float(np.cbrt(abs(_volume(m)))) for m in self.matrices), default=1.0) or 1.0

    @property
    def mirrored(self):
        """Whether it is shown by mirroring places only. Its vertices are then given with -x and its
        triangles turned over, so that they and their map look as what is seen."""
        return bool(self.matrices) and all(_volume(m) < 0 for m in self.matrices)


def _volume(matrix):
    """The signed volume that a matrix makes of a unit cube."""
    a, b, c = matrix[:3, :3]
    return np.cross(a, b) @ c


@dataclass
class Refined:
    """Triangles that take the place of those of the file (common refinement).

    faces (N, 3) index vertices (W, 3), of which those of the file come first; origin (N,) is the triangle
    of the file in which each lies; weights (N, 3, 3) are the barycentric coordinates in it of each corner,
    which say where the new vertices are.
    """
    vertices: np.ndarray
    faces: np.ndarray
    origin: np.ndarray
    weights: np.ndarray

    def __post_init__(self):
        self.faces, self.origin = np.asarray(self.faces), np.asarray(self.origin)
        self.weights = np.asarray(self.weights, np.float64)


class MeshFile:
    """A mesh as its file holds it. `save` writes the file again with other texture coordinates.

    Texture coordinates have their origin at the lower left corner of the picture. Colours are red,
    green, blue, alpha in [0, 1], as a screen shows them (sRGB).
    """

    split = False
    """Whether the format cannot share vertices between faces, or splits them for other reasons."""
    linear = False
    """Whether the format multiplies colours in linear light."""
    uv = None
    """(F, 3, 2) float64, NaN where a face has none; None: no face has any."""
    uv_picture = None
    """(F,) index in `pictures`, -1: none; None: no face has any."""
    vertex_colours = face_colours = material_colours = None
    """(V, 4), (F, 4) and (F, 4) float32, or None."""

    def __init__(self, path):
        self.path = Path(path)
        self.vertices = np.zeros((0, 3))  # (V, 3) float64
        self.faces = np.zeros((0, 3), np.int32)  # (F, 3) triangles, in the order of the file
        self._polygons = None  # starts, corners, polygon of MeshFile.starts and so on; None: all triangles
        self.diagonals = np.zeros((0, 3), bool)  # (F, 3) side k, from corner k to k + 1, is inside a polygon
        self.pictures = []  # Picture, read when it is asked for
        self.parts = []
        self.messages = []

    @property
    def all_triangles(self):
        """Whether every polygon of the file is a triangle."""
        return self._polygons is None

    @cached_property
    def starts(self):
        """(P + 1,) the first corner of each polygon of the file."""
        return np.arange(0, 3 * len(self.faces) + 1, 3) if self._polygons is None else self._polygons[0]

    @cached_property
    def corners(self):
        """(F, 3) the corner of the file, counted over all its polygons, at each corner of `faces`."""
        return np.arange(self.faces.size).reshape(-1, 3) if self._polygons is None else self._polygons[1]

    @cached_property
    def polygon(self):
        """(F,) the polygon of the file that each triangle is of."""
        return np.arange(len(self.faces)) if self._polygons is None else self._polygons[2]

    # What the readers of the formats call

    def set_polygons(self, corner_vertices, starts=None):
        """Triangulates (C,) vertices at corners; `starts` (P + 1,) are the first of each polygon.

        Triangles come as (F, 3) without `starts`.
        """
        corner_vertices = np.ascontiguousarray(whole(corner_vertices, np.int32))
        count = len(self.vertices)
        flat = corner_vertices.ravel()
        if len(flat) and flat.view(np.uint32).max() >= count:  # below 0 are beyond, too
            bad = (flat < 0) | (flat >= count)
            corner = int(bad.argmax())
            face = corner // 3 + 1 if starts is None else int(np.searchsorted(starts, corner, 'right'))
            raise FileError(f'{self.path.name}: {counted(int(bad.sum()), "corner")} of faces, first of face '
                            f'{face}, name a vertex beyond the {count} of the file')
        if starts is None or (np.diff(starts) == 3).all():
            self.faces = corner_vertices.reshape(-1, 3)
            self.diagonals = np.broadcast_to(np.False_, self.faces.shape)
        else:
            few = np.diff(starts) < 3
            if few.any():
                self.messages.append(
                    f'{counted(int(few.sum()), "face")} with less than 3 corners, first face '
                    f'{int(few.argmax()) + 1}: not mapped')
            corners, polygon, self.diagonals = triangulate(self.vertices, corner_vertices, starts)
            self._polygons = starts, corners, polygon
            self.faces = corner_vertices[corners]
        self.parts = self.parts or [Part(self.path.stem, slice(0, len(self.faces)),
                                         slice(0, len(self.vertices)))]
        self.messages += remarks(self.vertices, self.faces)

    # What a run needs besides

    def sized_vertices(self):
        """(V, 3) vertices, each part of the size that it has in the scene, for texels by its area."""
        if all(part.scale == 1 for part in self.parts):
            return self.vertices
        sized = self.vertices.copy()
        for part in self.parts:
            sized[part.vertices] *= part.scale
        return sized

    @np.errstate(all='ignore')
    def corner_colours(self):
        """(F, 3, 4) float32, or None: what faces without a picture show."""
        factors = []
        if self.material_colours is not None:
            factors.append(self.material_colours[:, None])
        if self.vertex_colours is not None:
            factors.append(self.vertex_colours[self.faces])
        elif self.face_colours is not None:
            factors.append(self.face_colours[:, None])
        if not factors:
            return None
        if self.linear:
            factors = [srgb_to_linear(f) for f in factors]
        result = np.ones((len(self.faces), 3, 4), np.float32)
        for factor in factors:
            result *= factor
        return linear_to_srgb(result) if self.linear else result

    def by_vertex(self, colours):
        """(V, 4) for colours (F, 3, 4) at corners, 1 where no face is; None if those of a vertex differ."""
        of_vertex = np.ones((len(self.vertices), 4), np.float32)
        of_vertex[self.faces] = colours
        return of_vertex if np.array_equal(of_vertex[self.faces], colours) else None

    def corner_normals(self):
        """(F, 3, 3) float32, or None where the file has no normals."""
        return None

    # Writing

    @np.errstate(all='ignore')
    def save(self, path, uv, texture=None, *, refined=None, uv_set=None):
        """Writes the file to `path` with other texture coordinates; all else in it stays.

        A path with another ending gets the mesh in that format. The file is replaced whole or not at
        all; it may be the one that was read.

        Args:
            path: ends with .obj, .ply, .glb, .gltf or .3mf.
            uv: (F, 3, 2), of `faces`, or of the triangles of `refined`.
            texture: path of a picture that exists and that the mesh shows from now on.
            refined: Refined, or a tuple of its members, whose triangles take the place of the file's.
            uv_set: of glTF, the number n of TEXCOORD_n; by itself 0 where there was none or with
                `texture`, else 1.

        Returns: list of sentences about what the written file does not hold as the one that was read.
        """
        path = Path(path)
        if refined is not None and not isinstance(refined, Refined):
            refined = Refined(*refined)
        uv = np.asarray(uv, np.float64)
        faces = self.faces if refined is None else refined.faces
        if uv.shape != (len(faces), 3, 2):
            raise ValueError(f'uv must have the shape ({len(faces)}, 3, 2), not {uv.shape}')
        if not np.isfinite(uv).all():
            raise ValueError('uv has values that are not finite numbers')
        uv = uv + 0.0  # no -0
        if texture is not None and not Path(texture).is_file():
            raise FileError(f'the texture {texture} is not a file')
        if self._same_format(path):
            return self._patch(path, uv, texture, refined, uv_set)
        plain, uv, messages = placed(self, uv, refined, texture is not None)
        target = self._converted(path, plain)
        if plain.colours is not None and not target.holds(plain):
            messages.append('colours of faces: not written in this format')
        large = int((np.diff(self.starts) > 3).sum()) if refined is None and target.all_triangles else 0
        if large:
            messages.append(f'{counted(large, "face")} with more than 3 corners: written as triangles')
        return messages + target._patch(path, uv, texture, None, uv_set)

    def holds(self, plain):
        """Whether the format can have the colours of a PlainMesh."""
        return plain.vertex_colours is not None

    def _same_format(self, path):
        return path.suffix.lower() == self.path.suffix.lower()

    def _patch(self, path, uv, texture, refined, uv_set):
        raise NotImplementedError

    def _converted(self, path, plain):
        raise NotImplementedError  # set by the package, which knows all formats


class PlainMesh(MeshFile):
    """Arrays that are to be a file; vertices (V, 3), faces (F, 3)."""

    colours = normals = None  # (F, 3, 4) and (F, 3, 3)

    def __init__(self, path, vertices=None, faces=None):
        super().__init__(path)
        if vertices is not None:
            self.vertices = np.asarray(vertices, np.float64)
            self.set_polygons(np.asarray(faces))

    def _same_format(self, path):
        return False

    def corner_colours(self):
        return self.colours

    def corner_normals(self):
        return self.normals


def _with_area(polygons):
    """MeshFile._polygons without those of less than 3 corners, which no triangle is of."""
    if polygons is None:
        return None
    starts, corners, polygon = polygons
    count = np.diff(starts)
    kept = count >= 3
    after = np.concatenate([[0], np.cumsum(count[kept])])
    number = np.cumsum(kept) - 1
    shift = after[number[polygon]] - starts[polygon]
    return after, corners + shift[:, None], number[polygon]


def placed(mesh, uv, refined, shows_picture):
    """The mesh as it lies in its scene, as PlainMesh; its uv; and sentences about what it does not have."""
    plain, messages = PlainMesh(mesh.path), []
    colours, normals = None if shows_picture else mesh.corner_colours(), mesh.corner_normals()
    if mesh.pictures and not shows_picture:
        messages.append(f'{counted(len(mesh.pictures), "picture")} of the materials: not written in another '
                        'format')
    if mesh.pictures and shows_picture and mesh.material_colours is not None and (mesh.material_colours != 1).any():
        messages.append('tints of the materials, which multiply the old pictures: not written in another format')
    vertices, faces, origin = mesh.vertices, mesh.faces, np.arange(len(mesh.faces))
    if refined is not None:
        faces, points, _ = _numbered(mesh, refined)
        vertices, origin = np.concatenate([vertices, points]), refined.origin
        weights = refined.weights.reshape(-1, 3)

        def at_corners(values):
            if values is None:
                return None
            of_origin = values[origin][:, None].repeat(3, 1).reshape(-1, 3, values.shape[-1])
            return mixed(of_origin, weights).reshape(-1, 3, values.shape[-1])
        colours, normals = at_corners(colours), at_corners(normals)
    stays = all(len(p.matrices) == 1 and (p.matrices[0] == np.eye(4)).all() for p in mesh.parts)
    if refined is None and stays:
        plain.vertices, plain.faces, plain._polygons = vertices, faces, _with_area(mesh._polygons)
        plain.diagonals, plain.colours, plain.normals = mesh.diagonals, colours, normals
    else:
        lists = [], [], [], [], []
        count = 0
        for part in mesh.parts:
            mine = np.flatnonzero((origin >= part.faces.start) & (origin < part.faces.stop))
            used, index = np.unique(faces[mine], return_inverse=True)
            for matrix in part.matrices:
                turn = matrix[:3, :3] * ([-1, 1, 1] if part.mirrored else [1, 1, 1])
                order = [0, 1, 2] if _volume(turn) >= 0 else [0, 2, 1]
                lists[0].append(vertices[used] @ turn.T + matrix[:3, 3])
                lists[1].append(index.reshape(-1, 3)[:, order] + count)
                lists[2].append(uv[mine][:, order])
                if colours is not None:
                    lists[3].append(colours[mine][:, order])
                if normals is not None:
                    adjugate = np.stack([np.cross(turn[k - 2], turn[k - 1]) for k in range(3)])
                    lists[4].append((normals[mine] @ adjugate.T)[:, order])
                count += len(used)
        plain.vertices, plain.faces, uv = (np.concatenate(a) if a else b for a, b in zip(
            lists, (np.zeros((0, 3)), np.zeros((0, 3), int), np.zeros((0, 3, 2)))))
        plain.faces = plain.faces.astype(np.int32)
        plain.diagonals = np.broadcast_to(np.False_, plain.faces.shape)
        plain.colours, plain.normals = (np.concatenate(a) if a else None for a in lists[3:])
    if plain.colours is not None:
        plain.vertex_colours = plain.by_vertex(plain.colours)
    return plain, uv, messages


def counted(count, noun):
    """3 faces, 1 face."""
    return f'{count} {noun}' + ('' if count == 1 else 's')


def remarks(vertices, faces):
    """Sentences about vertices and faces that a map cannot be true to, for files and arrays alike."""
    messages = []
    with np.errstate(all='ignore'):
        finite = np.isfinite(vertices.sum())  # of all, if it is
    if not finite:
        finite = np.isfinite(vertices).all(1)
    if not np.all(finite):
        used = int((~finite)[faces].any(1).sum())
        messages.append(f'{counted(int((~finite).sum()), "vertex").replace("vertexs", "vertices")} with '
                        f'coordinates that are not finite numbers, first vertex {int(finite.argmin())}, '
                        f'used by {counted(used, "face")}')
    twice = faces[:, 0] == faces[:, 1]
    for k in (0, 1):
        twice |= faces[:, k] == faces[:, 2]
    if twice.any():
        messages.append(f'{counted(int(twice.sum()), "face")} with a vertex twice, first face '
                        f'{int(twice.argmax())}: kept, without area')
    return messages


def srgb_to_linear(colour):
    """Of the colours, not of alpha."""
    c = np.array(colour, np.float32)
    rgb = c[..., :3]
    c[..., :3] = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    return c


def linear_to_srgb(colour):
    """Of the colours, not of alpha."""
    c = np.array(colour, np.float32)
    rgb = c[..., :3] = np.clip(c[..., :3], 0, 1)
    c[..., :3] = np.where(rgb <= 0.0031308, rgb * 12.92, 1.055 * rgb ** (1 / 2.4) - 0.055)
    return c


@dataclass
class Rewritten:
    """Texture coordinates by the corners of a file, for polygons that stay; triangles for the others.

    A polygon does not stay where a seam or a refinement divides it, and nothing else is divided.
    """
    corner_uv: np.ndarray  # (C, 2)
    torn: np.ndarray  # (P,) bool
    first: np.ndarray  # (P + 1,) in `order`, the triangles of each polygon
    order: np.ndarray  # triangles by polygon
    uv: np.ndarray  # (N, 3, 2)
    vertices: np.ndarray  # (N, 3) numbers >= V are new vertices
    origin: np.ndarray  # (N,) triangle of the file
    weights: np.ndarray  # (N, 3, 3) in it
    points: np.ndarray  # (W, 3) the new vertices
    samples: np.ndarray  # (W, 2) a triangle and its corner where each new vertex is

    def triangles(self, p):
        """Of polygon p, which does not stay."""
        return self.order[self.first[p]:self.first[p + 1]]


def rewritten(mesh, uv, refined):
    """Which polygons of the file stay, and the coordinates of all."""
    count, whole = len(mesh.starts) - 1, np.eye(3)
    torn = np.zeros(count, bool)
    if refined is None:
        origin, polygon = np.arange(len(mesh.faces)), mesh.polygon
        weights = np.broadcast_to(whole, (len(origin), 3, 3))
        vertices, points, samples = mesh.faces, np.zeros((0, 3)), np.zeros((0, 2), np.int64)
        order = origin
    else:
        origin, weights = refined.origin, refined.weights
        polygon = mesh.polygon[origin]
        torn[polygon[(weights != whole).any((1, 2))]] = True
        torn |= np.bincount(polygon, minlength=count) != np.bincount(mesh.polygon, minlength=count)
        vertices, points, samples = _numbered(mesh, refined)
        order = np.argsort(polygon, kind='stable')
    if mesh.all_triangles and refined is None:
        corner_uv, first = uv.reshape(-1, 2), np.arange(count + 1)
    else:
        first = np.searchsorted(polygon[order], np.arange(count + 1))
        corner_uv = np.zeros((int(mesh.starts[-1]), 2))
        stays = ~torn[polygon]
        corner_uv[mesh.corners[origin[stays]]] = uv[stays]
        differs = (corner_uv[mesh.corners[origin]] != uv).any((1, 2)) & stays
        torn[polygon[differs]] = True
    return Rewritten(corner_uv, torn, first, order, uv, vertices, origin, weights, points, samples)


def _numbered(mesh, refined):
    """Corners of a refinement by vertices of the file where they are these; where the others are, which are
    new, and a triangle and corner of the refinement there."""
    at_corner = refined.weights == 1
    old = at_corner.any(2)
    number = np.take_along_axis(mesh.faces[refined.origin], at_corner.argmax(2), 1).astype(np.int64)
    _, where, index = np.unique(refined.faces[~old], return_index=True, return_inverse=True)
    number[~old] = len(mesh.vertices) + index.ravel()
    samples = np.argwhere(~old)[where].reshape(-1, 2)
    t, k = samples.T
    points = mixed(mesh.vertices[mesh.faces[refined.origin[t]]], refined.weights[t, k])
    return number, points, samples


def mixed(values, weights):
    """sum of weights (n, 3) times values (n, 3, ...); exact where a weight is 1, whole numbers rounded."""
    shape = weights.shape + (1,) * (values.ndim - 2)
    result = (values.astype(np.float64) * weights.reshape(shape)).sum(1)
    one = weights == 1
    exact = one.any(1)
    result[exact] = values[exact, one[exact].argmax(1)]
    return (np.rint(result) if values.dtype.kind in 'iu' else result).astype(values.dtype)


def distinct(pairs):
    """Rows of (n, 2) float64 that differ, and the number of each row's."""
    _, where, index = np.unique(np.ascontiguousarray(pairs).view(np.complex128), return_index=True,
                                return_inverse=True)
    return pairs[where], index.ravel()


def write_file(path, content):
    """Replaces the file whole, or leaves it as it was."""
    path = Path(os.path.realpath(path))
    temporary = path.with_name(f'.{path.name}.{secrets.token_hex(4)}')
    try:
        with open(temporary, 'xb') as file:
            file.write(content)
        if path.exists():
            os.chmod(temporary, path.stat().st_mode & 0o777)
        os.replace(temporary, path)
    except OSError as error:
        raise FileError(f'{path} cannot be written: {error.strerror}') from error
    finally:
        if temporary.exists():
            temporary.unlink()


def beside(folder, name):
    """The file that a mesh in `folder` calls `name`: there, or with its last part there; or None."""
    name = name.strip().strip('"').replace('\\', '/')
    if not name or '\0' in name:
        return None
    for candidate in (Path(folder) / name, Path(folder) / name.rsplit('/', 1)[-1]):
        try:
            if candidate.is_file():
                return candidate
        except OSError:
            pass
    return None


def copy_beside(files, source, target):
    """Copies files that a mesh in folder `source` names to its new folder; says what it could not."""
    messages = []
    if Path(source).resolve() == Path(target).resolve():
        return messages
    for name, file in files:
        goal = Path(target) / (name if not Path(name).is_absolute() and '..' not in Path(name).parts
                               else Path(name).name)
        content = file.read_bytes()
        if not goal.exists():
            goal.parent.mkdir(parents=True, exist_ok=True)
            write_file(goal, content)
        elif goal.read_bytes() != content:
            messages.append(f'{goal} is another file than that of the mesh and was not replaced')
    return messages


def relative(file, folder):
    """How a mesh in `folder` names a file."""
    try:
        return Path(os.path.relpath(file, folder)).as_posix()
    except ValueError:  # another drive
        return Path(file).resolve().as_posix()
