# SPDX-License-Identifier: GPL-3.0-or-later
"""Small meshes for the host tests, and PLY files. Standard library only."""

import math
import struct


class Mesh:
    def __init__(self, vertices, faces, quality=None):
        self.vertices = vertices
        self.faces = faces
        self.quality = quality
        self.wedges = None  # per face: three (u, v)


def grid(columns, rows, point, wrap_columns=False, wrap_rows=False):
    """Triangulated parameter grid; point(s, t) maps [0,1]^2 into space."""
    across = columns if wrap_columns else columns + 1
    along = rows if wrap_rows else rows + 1
    vertices = [point(i / columns, j / rows) for i in range(across) for j in range(along)]

    def at(i, j):
        return (i % across) * along + j % along

    faces = []
    for i in range(columns):
        for j in range(rows):
            a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
            faces += [(a, b, c), (a, c, d)] if (i + j) % 2 else [(a, b, d), (b, c, d)]
    return Mesh(vertices, faces)


def torus(columns=30, rows=16, big=2.0, small=1.0):
    def point(s, t):
        a, b = 2 * math.pi * s, 2 * math.pi * t
        r = big + small * math.cos(b)
        return (r * math.cos(a), r * math.sin(a), small * math.sin(b))

    return grid(columns, rows, point, True, True)


def annulus(columns=32, rows=6):
    """A waisted tube, open at both ends."""

    def point(s, t):
        a, z = 2 * math.pi * s, 2 * t - 1
        r = 1 + 0.3 * z * z
        return (r * math.cos(a), r * math.sin(a), z)

    return grid(columns, rows, point, True)


def screw(columns=60, rows=4):
    """A strip round an axis, one and a half turns: flat, it covers a part of the plane twice."""

    def point(s, t):
        angle, radius = 3 * math.pi * s, 1 + t
        return (radius * math.cos(angle), radius * math.sin(angle), 0.3 * angle)

    return grid(columns, rows, point)


def hill(size=14):
    """A disk: a bump over a square."""
    return grid(size, size, lambda s, t: (s, t, 0.3 * math.sin(math.pi * s) * math.sin(math.pi * t)))


def sphere(columns=16, rows=10):
    """Closed, genus 0: circles of latitude between two poles."""
    vertices = [(0.0, 0.0, 1.0)]
    for j in range(1, rows):
        for i in range(columns):
            a, b = 2 * math.pi * i / columns, math.pi * j / rows
            vertices.append((math.sin(b) * math.cos(a), math.sin(b) * math.sin(a), math.cos(b)))
    vertices.append((0.0, 0.0, -1.0))
    south = len(vertices) - 1
    faces = []
    for i in range(columns):
        n = (i + 1) % columns
        faces.append((0, 1 + i, 1 + n))
        for j in range(rows - 2):
            a, b = 1 + j * columns + i, 1 + j * columns + n
            faces += [(a, a + columns, b + columns), (a, b + columns, b)]
        last = 1 + (rows - 2) * columns
        faces.append((last + i, south, last + n))
    return Mesh(vertices, faces)


def double_torus(parts=2):
    """A slab with two holes, of unit cubes divided into parts^3: genus 2."""
    solid = {(i, j, k) for i in range(5 * parts) for j in range(3 * parts) for k in range(parts)
             if (i // parts, j // parts) not in ((1, 1), (3, 1))}
    index, faces = {}, []

    def vertex(*point):
        return index.setdefault(point, len(index))

    for cube in sorted(solid):
        for axis in range(3):
            for side in (0, 1):
                neighbour = list(cube)
                neighbour[axis] += 2 * side - 1
                if tuple(neighbour) in solid:
                    continue
                corners = []
                for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    point = list(cube)
                    point[axis] += side
                    point[(axis + 1) % 3] += s
                    point[(axis + 2) % 3] += t
                    corners.append(vertex(*point))
                a, b, c, d = corners if side else reversed(corners)
                faces += [(a, b, c), (a, c, d)]
    vertices = [tuple(x / parts for x in point) for point in index]
    return Mesh(vertices, faces)


def swirled(mesh, angle=2 * math.pi, radius=0.4):
    """Turned round its middle in the x y plane, by `angle` there and less and less outwards: faces grow
    long and edges flip, so that straight ones in their place turn faces round."""
    count = len(mesh.vertices)
    middle = [sum(p[k] for p in mesh.vertices) / count for k in range(2)]
    vertices = []
    for x, y, z in mesh.vertices:
        x, y = x - middle[0], y - middle[1]
        a = angle * math.exp(-(x * x + y * y) / radius ** 2)
        vertices.append((x * math.cos(a) - y * math.sin(a), x * math.sin(a) + y * math.cos(a), z))
    return Mesh(vertices, mesh.faces)


def line():
    """Faces without an area: the only triangles that the filters refuse."""
    return Mesh([(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)], [(0, 1, 2), (1, 2, 3)])


def moebius(columns=24, rows=3):
    def point(i, j):
        a = 2 * math.pi * i / columns
        w = (j / rows - 0.5) * 0.8
        r = 2 + w * math.cos(a / 2)
        return (r * math.cos(a), r * math.sin(a), w * math.sin(a / 2))

    vertices = [point(i, j) for i in range(columns) for j in range(rows + 1)]

    def at(i, j):
        return (i % columns) * (rows + 1) + (j if i < columns else rows - j)

    faces = []
    for i in range(columns):
        for j in range(rows):
            a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
            faces += [(a, b, c), (a, c, d)]
    return Mesh(vertices, faces)


def point_cloud():
    return Mesh([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)], [])


def with_fin(mesh):
    """A third face on the first edge: not a manifold."""
    a, b = mesh.faces[0][0], mesh.faces[0][1]
    vertices = mesh.vertices + [(9.0, 9.0, 9.0)]
    return Mesh(vertices, mesh.faces + [(a, b, len(vertices) - 1)])


def doubled(mesh):
    """Every face twice, the second time reversed."""
    return Mesh(mesh.vertices, mesh.faces + [(a, c, b) for a, b, c in mesh.faces])


def bow_tie():
    """Two disks that share one vertex only."""
    a, b = hill(4), hill(4)
    last = len(a.vertices) - 1
    vertices = a.vertices + [(x + 1.0, y + 1.0, z) for x, y, z in b.vertices[1:]]
    faces = a.faces + [tuple(last if v == 0 else last + v for v in f) for f in b.faces]
    return Mesh(vertices, faces)


def with_flipped_faces(mesh, every=3):
    faces = [f[::-1] if i % every == 0 else f for i, f in enumerate(mesh.faces)]
    return Mesh(mesh.vertices, faces)


def plane(size=8):
    """A disk whose coordinates, and those of its midpoints, are exact in single precision."""
    return grid(size, size, lambda s, t: (s, t, 0.0))


def plate(size, thickness):
    """Closed, genus 0: two square sheets that a strip joins along their border."""
    sheet = plane(size)
    count = len(sheet.vertices)
    vertices = sheet.vertices + [(x, y, -thickness) for x, y, _ in sheet.vertices]
    faces = sheet.faces + [(a + count, c + count, b + count) for a, b, c in sheet.faces]
    sides = {(f[k], f[(k + 1) % 3]) for f in sheet.faces for k in range(3)}
    for a, b in sorted(sides):
        if (b, a) not in sides:
            faces += [(b, a, a + count), (b, a + count, b + count)]
    return Mesh(vertices, faces)


def with_zero_area_face(mesh):
    """A face without area fills the slit between an edge and its own midpoint."""
    a, b, c = mesh.faces[len(mesh.faces) // 2]
    vertices = list(mesh.vertices)
    vertices.append(tuple((p + q) / 2 for p, q in zip(vertices[a], vertices[b])))
    m = len(vertices) - 1
    others = [face for face in mesh.faces if face != (a, b, c)]
    return Mesh(vertices, [(a, m, c), (m, b, c), (a, b, m)] + others)


def with_zero_length_edge(mesh):
    vertices = list(mesh.vertices)
    vertices[mesh.faces[0][1]] = vertices[mesh.faces[0][0]]
    return Mesh(vertices, mesh.faces)


def with_unreferenced_vertex(mesh):
    return Mesh(mesh.vertices + [(5.0, 5.0, 5.0)], mesh.faces)


def with_nan(mesh):
    return Mesh([(math.nan, 0.0, 0.0)] + mesh.vertices[1:], mesh.faces)


def with_quality(mesh, values):
    return Mesh(mesh.vertices, mesh.faces, values)


CUTS = ("cut_nonmanifold_edges", "split_vertices", "duplicate_faces", "one_sided_components",
        "degenerate_faces")


def any_triangles():
    """Meshes that are not oriented manifolds: name, mesh, results that are not 0 of CUTS, components."""
    band, sheet = moebius(), plane(4)
    return (("fin", with_fin(torus()), {"cut_nonmanifold_edges": 1, "split_vertices": 2}, 2),
            ("bow tie", bow_tie(), {"split_vertices": 1}, 2),
            ("Moebius band", band, {"one_sided_components": 1}, 1),
            ("doubled", doubled(sheet), {"cut_nonmanifold_edges": 3 * 16 + 2 * 4,  # all edges
                                         "duplicate_faces": len(sheet.faces),
                                         "split_vertices": len(sheet.vertices)}, 2))


def write_ply(path, mesh):
    """Binary, in single precision, as MeshLab's own."""
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(mesh.vertices)}"]
    header += [f"property float {axis}" for axis in "xyz"]
    if mesh.quality is not None:
        header.append("property float quality")
    header += [f"element face {len(mesh.faces)}", "property list uchar int vertex_indices", "end_header"]
    with open(path, "wb") as out:
        out.write(("\n".join(header) + "\n").encode())
        for i, p in enumerate(mesh.vertices):
            values = tuple(p) + (() if mesh.quality is None else (mesh.quality[i],))
            out.write(struct.pack(f"<{len(values)}f", *values))
        for face in mesh.faces:
            out.write(struct.pack(f"<B{len(face)}i", len(face), *face))


def name_texture(path, image):
    """Makes the host load an image with a PLY file, to be seen once there are coordinates for it."""
    with open(path, "rb") as source:
        content = source.read()
    with open(path, "wb") as out:
        out.write(content.replace(b"\nelement", f"\ncomment TextureFile {image}\nelement".encode(), 1))


_FORMATS = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I",
            "float": "f", "double": "d"}


def read_ply(path):
    """Little-endian binary PLY with positions, quality and wedge texture coordinates."""
    with open(path, "rb") as source:
        elements = []
        line = b""
        while line != b"end_header":
            line = source.readline().strip()
            words = line.decode().split()
            if words[:1] == ["element"]:
                elements.append((words[1], int(words[2]), []))
            elif words[:1] == ["property"]:
                elements[-1][2].append(words[1:])
        rows = {name: [_read_row(source, properties) for _ in range(count)]
                for name, count, properties in elements}
    mesh = Mesh([(v["x"], v["y"], v["z"]) for v in rows["vertex"]],
                [f["vertex_indices"] for f in rows["face"]])
    if rows["vertex"] and "quality" in rows["vertex"][0]:
        mesh.quality = [v["quality"] for v in rows["vertex"]]
    if rows["face"] and "texcoord" in rows["face"][0]:
        mesh.wedges = [[f["texcoord"][2 * k:2 * k + 2] for k in range(3)] for f in rows["face"]]
    return mesh


def _read_row(source, properties):
    row = {}
    for words in properties:
        if words[0] == "list":
            count, = struct.unpack("<" + _FORMATS[words[1]], source.read(struct.calcsize(_FORMATS[words[1]])))
            form = f"<{count}{_FORMATS[words[2]]}"
            row[words[3]] = struct.unpack(form, source.read(struct.calcsize(form)))
        else:
            form = "<" + _FORMATS[words[0]]
            row[words[1]], = struct.unpack(form, source.read(struct.calcsize(form)))
    return row


def uv_area(wedge):
    (a, b), (c, d), (e, f) = wedge
    return 0.5 * ((c - a) * (f - b) - (e - a) * (d - b))


def distortion(corners, wedge):
    """Quasi-conformal distortion sigma1/sigma2 of the map from a triangle in space to its UVs."""
    p, q, r = corners
    e1, e2 = [b - a for a, b in zip(p, q)], [b - a for a, b in zip(p, r)]
    x1 = math.sqrt(sum(c * c for c in e1))
    x2 = sum(a * b for a, b in zip(e1, e2)) / x1
    y2 = math.sqrt(max(sum(c * c for c in e2) - x2 * x2, 0.0))
    f1 = [b - a for a, b in zip(wedge[0], wedge[1])]
    f2 = [b - a for a, b in zip(wedge[0], wedge[2])]
    columns = [[f / x1 for f in f1]]
    columns.append([(b - x2 * a) / y2 for a, b in zip(columns[0], f2)])
    (a, c), (b, d) = columns
    sums, differences = math.hypot(a + d, c - b), math.hypot(a - d, c + b)
    return (sums + differences) / abs(sums - differences)
