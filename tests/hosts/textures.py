# SPDX-License-Identifier: GPL-3.0-or-later
"""Textured meshes for the host tests, and PNG files. Standard library only."""

import math
import os
import struct
import tempfile
import unittest
import zlib

import meshes

# Channels of the colour types of PNG files.
_CHANNELS = {0: 1, 2: 3, 4: 2, 6: 4}


class Image:
    """Rows from the top, of texels, of 1 to 4 samples."""

    def __init__(self, rows, depth=8):
        self.rows, self.depth = rows, depth
        self.height, self.width, self.channels = len(rows), len(rows[0]), len(rows[0][0])
        self.top = (1 << depth) - 1


def write_png(path, image):
    kind = {channels: kind for kind, channels in _CHANNELS.items()}[image.channels]
    form = "B" if image.depth == 8 else "H"
    data = b"".join(
        b"\0" + struct.pack(f">{image.width * image.channels}{form}", *(s for t in row for s in t))
        for row in image.rows)

    def chunk(name, content):
        return (struct.pack(">I", len(content)) + name + content
                + struct.pack(">I", zlib.crc32(name + content)))

    header = struct.pack(">IIBBBBB", image.width, image.height, image.depth, kind, 0, 0, 0)
    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
                  + chunk(b"IDAT", zlib.compress(data, 1)) + chunk(b"IEND", b""))


def read_png(path):
    with open(path, "rb") as source:
        content = source.read()
    at, data = 8, b""
    while at < len(content):
        length, name = struct.unpack(">I4s", content[at:at + 8])
        if name == b"IHDR":
            width, height, depth, kind = struct.unpack(">IIBB", content[at + 8:at + 18])
        elif name == b"IDAT":
            data += content[at + 8:at + 8 + length]
        at += 12 + length
    channels = _CHANNELS[kind]
    step, length = channels * depth // 8, width * channels * depth // 8
    data, before, rows = zlib.decompress(data), bytearray(length), []
    for y in range(height):
        start = y * (length + 1)
        line = _unfiltered(data[start], bytearray(data[start + 1:start + 1 + length]), before, step)
        samples = struct.unpack(f">{width * channels}{'B' if depth == 8 else 'H'}", line)
        rows.append([samples[i:i + channels] for i in range(0, len(samples), channels)])
        before = line
    return Image(rows, depth)


def _unfiltered(kind, line, above, step):
    for i in range(len(line)):
        left = line[i - step] if i >= step else 0
        corner = above[i - step] if i >= step else 0
        if kind == 1:
            line[i] = (line[i] + left) & 255
        elif kind == 2:
            line[i] = (line[i] + above[i]) & 255
        elif kind == 3:
            line[i] = (line[i] + (left + above[i]) // 2) & 255
        elif kind == 4:
            guess = left + above[i] - corner
            _, best = min((abs(guess - left), left), (abs(guess - above[i]), above[i]),
                          (abs(guess - corner), corner), key=lambda pair: pair[0])
            line[i] = (line[i] + best) & 255
    return line


def shattered(faces):
    """Wedges of an atlas of a cell for each two faces, in another order, without space between them."""
    cells = math.ceil(math.sqrt((len(faces) + 1) // 2))
    step = next(s for s in range(7, len(faces) + 9) if math.gcd(s, len(faces)) == 1)
    wedges = [None] * len(faces)
    for i in range(len(faces)):
        x, y = i // 2 % cells / cells, i // 2 // cells / cells
        a, b = (x, y), (x + 1 / cells, y)
        c, d = (x + 1 / cells, y + 1 / cells), (x, y + 1 / cells)
        wedges[i * step % len(faces)] = (a, b, c) if i % 2 == 0 else (a, c, d)
    return wedges


def barycentric(triangle, point):
    (a, b), (c, d), (e, f) = triangle
    area = (c - a) * (f - b) - (e - a) * (d - b)
    p, q = point
    second = ((p - a) * (f - b) - (e - a) * (q - b)) / area
    third = ((c - a) * (q - b) - (p - a) * (d - b)) / area
    return (1 - second - third, second, third)


def texels_in(wedge, image_width, image_height):
    """The texels whose middle lies in a face's texture triangle, and where in it."""
    corners = [(u * image_width, (1 - v) * image_height) for u, v in wedge]
    xs, ys = [x for x, _ in corners], [y for _, y in corners]
    for y in range(max(0, math.floor(min(ys))), min(image_height, math.ceil(max(ys)))):
        for x in range(max(0, math.floor(min(xs))), min(image_width, math.ceil(max(xs)))):
            weights = barycentric(corners, (x + 0.5, y + 0.5))
            if min(weights) >= 0:
                yield x, y, weights


def colour(point):
    """A function of the place in space, between 0 and 1, of each of three channels."""
    x, y, z = point
    return (0.5 + 0.4 * math.sin(x + 0.3), 0.5 + 0.4 * math.sin(y - z), 0.5 + 0.4 * math.cos(y))


GRADIENT = 0.4 * math.sqrt(2)


def place(mesh, face, weights):
    return tuple(sum(w * mesh.vertices[v][k] for w, v in zip(weights, face)) for k in range(3))


def painted(mesh, wedges, size, depth=8, alpha=None, faces=None):
    """That function drawn for wedges; black between them."""
    top = (1 << depth) - 1
    more = () if alpha is None else (round(alpha * top),)
    rows = [[(0, 0, 0) + more] * size for _ in range(size)]
    for f in range(len(mesh.faces)) if faces is None else faces:
        for x, y, weights in texels_in(wedges[f], size, size):
            rows[y][x] = tuple(
                round(c * top) for c in colour(place(mesh, mesh.faces[f], weights))) + more
    return Image(rows, depth)


def largest_difference(mesh, wedges, image):
    """Of an image from that function, where the wedges show it, and how many texels they show."""
    worst, count = 0.0, 0
    for face, wedge in zip(mesh.faces, wedges):
        for x, y, weights in texels_in(wedge, image.width, image.height):
            count += 1
            for found, wanted in zip(image.rows[y][x], colour(place(mesh, face, weights))):
                worst = max(worst, abs(found / image.top - wanted))
    return worst, count


def write_ply(path, mesh, wedges=None, names=(), numbers=None, colours=None, coordinates=None):
    """Binary, with texture coordinates, names of textures, their numbers; of vertices their colours and
    coordinates."""
    header = ["ply", "format binary_little_endian 1.0"]
    header += [f"comment TextureFile {name}" for name in names]
    header += [f"element vertex {len(mesh.vertices)}", *(f"property float {axis}" for axis in "xyz")]
    if colours is not None:
        header += [f"property uchar {c}" for c in ("red", "green", "blue", "alpha")]
    if coordinates is not None:
        header += ["property float texture_u", "property float texture_v"]
    header += [f"element face {len(mesh.faces)}", "property list uchar int vertex_indices"]
    if wedges is not None:
        header.append("property list uchar float texcoord")
    if numbers is not None:
        header.append("property int texnumber")
    with open(path, "wb") as out:
        out.write(("\n".join(header + ["end_header"]) + "\n").encode())
        for i, p in enumerate(mesh.vertices):
            out.write(struct.pack("<3f", *p))
            if colours is not None:
                out.write(struct.pack("<4B", *colours[i]))
            if coordinates is not None:
                out.write(struct.pack("<2f", *coordinates[i]))
        for i, face in enumerate(mesh.faces):
            out.write(struct.pack("<B3i", 3, *face))
            if wedges is not None:
                out.write(struct.pack("<B6f", 6, *(c for uv in wedges[i] for c in uv)))
            if numbers is not None:
                out.write(struct.pack("<i", numbers[i]))


class TexturedTorus(unittest.TestCase):
    """A torus with an atlas of single triangles, and a folder."""

    OLD, NEW = 256, 300
    # Of the largest difference. A cell of 22 x 22 is an edge of at most 0.6 long: a texel beside the
    # triangle is at most 2.5 texels from one inside, and mixing takes another one.
    BOUND = 3.5 * 0.6 / (OLD / 22) * GRADIENT

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.mesh = meshes.torus()
        self.wedges = shattered(self.mesh.faces)

    def path(self, *names):
        return os.path.join(self.folder, *names)
