# SPDX-License-Identifier: GPL-3.0-or-later
"""Small files of meshes for the tests of ricciflow.files and for its fuzzing. Needs numpy."""

import io
import json
import struct
import zipfile
import zlib

import numpy as np

CUBE = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
QUADS = np.array([(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
TRIANGLES = QUADS[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
# An L, in the plane z = 0, from above; corner 3 is concave.
ELL = np.array([(0, 0, 0), (2, 0, 0), (2, 1, 0), (1, 1, 0), (1, 2, 0), (0, 2, 0)], float)


def png(picture):
    """(bytes) of (height, width, 1 to 4) uint8 or uint16, each row with another filter of PNG."""
    height, width, channels = picture.shape
    size = channels * picture.dtype.itemsize
    rows = picture.astype(picture.dtype.newbyteorder(">")).reshape(height, -1).view(np.uint8).astype(int)
    before, body = np.zeros(rows.shape[1], int), b""
    for y, row in enumerate(rows):
        left, corner = np.r_[np.zeros(size, int), row[:-size]], np.r_[np.zeros(size, int), before[:-size]]
        guess = left + before - corner
        distance = np.abs([guess - left, guess - before, guess - corner])
        paeth = np.choose(distance.argmin(0), [left, before, corner])
        kind = y % 5
        by = [0, left, before, (left + before) // 2, paeth][kind]
        body += bytes([kind]) + ((row - by) % 256).astype(np.uint8).tobytes()
        before = row
    colour = {1: 0, 2: 4, 3: 2, 4: 6}[channels]
    head = struct.pack(">IIBBBBB", width, height, 8 * picture.dtype.itemsize, colour, 0, 0, 0)

    def chunk(kind, content):
        return (
            struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content)))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(body)) +
            chunk(b"IEND", b""))


def noise(height, width, channels=3, kind=np.uint8, seed=0):
    most = np.iinfo(kind).max
    return np.random.default_rng(seed).integers(0, most, (height, width, channels), kind, True)


# Every kind of line that a reader may meet; CR LF, since all is to stay.
OBJ = b"""# a cube, and an L
mtllib some.mtl
o cube
v 0 0 0 1 0 0
v 0 0 1 0 1 0
v 0 1 0 0 0 1
\tv 0 1 1 1 1 1
v 1 0 0 1 0 0
v 1 0 1 1 0 0
v 1 1 0 1 0 0
v 1 1 1 1 0 0
vt 0.5 0.5
vt 0.25 0.75 0
vn 0 0 1
vn 1 0 0
g left
usemtl red
s 1
f 1/1/1 2/2/1 4/1/1 3/2/1   # a comment
f 5//2 7//2 8//2 6//2
usemtl picture
f -8 -4 -3 -7
f 3/1 4/2 \\
  8/2 7/1
s off
f 1/1 3/1 7/1
f 1/2 7/2 5/2
f 2 6 8 4
o ell
v 0 0 5 1 1 1
v 2 0 5 1 1 1
v 2 1 5 1 1 1
v 1 1 5 1 1 1
v 1 2 5 1 1 1
v 0 2 5 1 1 1
f -6//1 -5//1 -4//1 -3//1 -2//1 -1//1
l 1/1 2/2 3
p 1
""".replace(b"\n", b"\r\n")
OBJ_TRIANGLES = 2 * 5 + 2 + 4
MTL = (b"newmtl red\nKd 0.8 0.1 0.1\nd 0.5\nmap_Bump bump.png\nnewmtl picture\nKd 1 1 1\n"
       b"map_Kd -s 1 1 1 -o 0.5 0 a b.png\n")


def ply(order, polygons=None, vertices=CUBE, coordinates=None, last=None, origins=None):
    """(bytes) A PLY with properties of all kinds; order None is ascii.

    Coordinates of each polygon, (n, 2), lie before the last property (coordinates) or after it (last);
    True: any. The other properties of a polygon are those of its origin, by itself its own number.
    """
    polygons = list(QUADS) + [QUADS[0][[0, 1, 2]]] if polygons is None else polygons
    if coordinates is True:
        coordinates = [np.arange(2 * len(p)) / 16 for p in polygons]

    def listed(uv):
        return [("u1", np.size(uv)), *[("f4", x) for x in np.ravel(uv)]]
    header = [
        "ply",
        "format " + {None: "ascii", "<": "binary_little_endian", ">": "binary_big_endian"}[order] + " 1.0",
        "comment made here",
        "comment TextureFile a b.png",
        "obj_info an info",
        f"element vertex {len(vertices)}",
        "property float nx",
        "property double x",
        "property float y",
        "property float z",
        "property uchar red",
        "property uchar green",
        "property uchar blue",
        "property list uchar short extra",
        f"element face {len(polygons)}",
        "property float quality",
        "property list uchar int vertex_indices",
    ]
    header += ["property list uchar float texcoord"] * (coordinates is not None) + ["property int texnumber"]
    header += ["property list uchar float texcoord"] * (last is not None)
    header += ["element edge 2", "property int vertex1", "property int vertex2",
               "end_header"]
    rows = []
    for i, p in enumerate(vertices):
        rows.append(
            [
                ("f4", i / 3),
                ("f8", p[0]),
                ("f4", p[1]),
                ("f4", p[2]),
                ("u1", 255),
                ("u1", i),
                ("u1", 3),
                ("u1", i % 3),
                *[("i2", -k) for k in range(i % 3)],
            ])
    for i, polygon in enumerate(polygons):
        number = i if origins is None else origins[i]
        row = [("f4", number / 7), ("u1", len(polygon)), *[("i4", v) for v in polygon]]
        row += (listed(coordinates[i]) if coordinates is not None else []) + [("i4", 0)]
        rows.append(row + (listed(last[i]) if last is not None else []))
    rows += [[("i4", 0), ("i4", 1)], [("i4", 2), ("i4", 3)]]
    if order is None:
        body = "".join(" ".join(f"{v:.9g}" for _, v in row) + "\n" for row in rows).encode()
    else:
        body = b"".join(np.array(v, order + t).tobytes() for row in rows for t, v in row)
    return "\n".join(header).encode() + b"\n" + body


class Gltf:
    """A glTF in the making."""

    TYPES = {np.dtype(t): c for t, c in (("i1", 5120), ("u1", 5121), ("i2", 5122), ("u2", 5123), ("u4", 5125),
                                         ("f4", 5126))}

    def __init__(self, **members):
        self.json = {
            "asset": {"version": "2.0", "extras": {"by": "a test"}},
            "scene": 0,
            "scenes": [{"nodes": []}],
            "nodes": [],
            "meshes": [],
            "bufferViews": [],
            "accessors": [],
            **members,
        }
        self.body = b""

    def view(self, content, **members):
        self.body += bytes(-len(self.body) % 4)
        self.json["bufferViews"].append(
            {"buffer": 0, "byteOffset": len(self.body), "byteLength": len(content), **members})
        self.body += content
        return len(self.json["bufferViews"]) - 1

    def accessor(self, values, padding=0, bounds=False, **members):
        """padding: bytes after each element, which make a stride."""
        values = np.asarray(values)
        values = values.reshape(len(values), -1)
        kind = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}[values.shape[1]]
        raw = np.ascontiguousarray(values).view(np.uint8).reshape(len(values), -1)
        stride = {"byteStride": raw.shape[1] + padding} if padding else {}
        view = self.view(np.pad(raw, ((0, 0), (0, padding))).tobytes(), **stride)
        if bounds:
            members.update(min=values.min(0).tolist(), max=values.max(0).tolist())
        self.json["accessors"].append({"bufferView": view, "componentType": self.TYPES[values.dtype],
                                       "count": len(values), "type": kind, **members})
        return len(self.json["accessors"]) - 1

    def node(self, mesh, **members):
        self.json["nodes"].append({"mesh": mesh, **members})
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)

    def mesh(self, *primitives, **members):
        self.json["meshes"].append({"primitives": list(primitives), **members})
        return len(self.json["meshes"]) - 1

    def glb(self):
        body = self.body + bytes(-len(self.body) % 4)
        text = json.dumps({**self.json, "buffers": [{"byteLength": len(body)}]}).encode()
        text += b" " * (-len(text) % 4)
        return (struct.pack("<4sIII4s", b"glTF", 2, 28 + len(text) + len(body), len(text), b"JSON") + text +
                struct.pack("<I4s", len(body), b"BIN\0") + body)

    def gltf(self, name):
        """(JSON, data) of a glTF whose data lie in a file of that name."""
        return (
            json.dumps({**self.json, "buffers": [{"byteLength": len(self.body), "uri": name}]}).encode(),
            self.body,
        )


def rich():
    """A Gltf of all that a primitive may have, in three meshes."""
    out = Gltf(extensionsUsed=["KHR_texture_transform", "KHR_materials_clearcoat"],
               cameras=[{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])
    random = np.random.default_rng(3)
    n, points = len(CUBE), CUBE.astype("f4")
    normals = random.normal(size=(n, 3))
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    joints = np.zeros((n, 4), "u1")
    weights = np.tile(np.array([1, 0, 0, 0], "f4"), (n, 1))
    image = png(noise(8, 8))
    out.json.update(
        images=[{"bufferView": out.view(image), "mimeType": "image/png", "name": "old"}],
        textures=[{"source": 0}],
        samplers=[{"wrapS": 33071}],
        materials=[
            {
                "name": "cloth",
                "doubleSided": True,
                "alphaMode": "MASK",
                "extras": {"a": 1},
                "normalTexture": {"index": 0, "scale": 0.5},
                "pbrMetallicRoughness": {
                    "roughnessFactor": 0.3,
                    "baseColorFactor": [0.5, 1, 1, 0.75],
                    "baseColorTexture": {"index": 0},
                },
            },
            {
                "name": "plain",
                "pbrMetallicRoughness": {"baseColorFactor": [20 / 255, 200 / 255, 20 / 255, 1]},
            },
        ],
    )
    tangents = np.c_[np.roll(normals, 1, 1), np.ones(n)].astype("f4")
    ball = out.mesh(
        {
            "attributes": {
                "POSITION": out.accessor(points, padding=4, bounds=True),
                "NORMAL": out.accessor(normals.astype("f4")),
                "TANGENT": out.accessor(tangents),
                "TEXCOORD_0": out.accessor(random.integers(0, 65535, (n, 2), "u2"), normalized=True),
                "COLOR_0": out.accessor(random.integers(0, 255, (n, 4), "u1"), normalized=True),
                "JOINTS_0": out.accessor(joints),
                "WEIGHTS_0": out.accessor(weights),
                "_TEMP": out.accessor(random.random(n).astype("f4")),
            },
            "targets": [{"POSITION": out.accessor(random.random((n, 3)).astype("f4"), bounds=True)}],
            "indices": out.accessor(TRIANGLES.ravel().astype("u2")),
            "material": 0,
            "extras": {"b": 2},
        },
        name="ball",
        weights=[0.5],
    )
    strip = out.accessor(np.array([0, 1, 2, 3, 6, 7, 4, 5], "u1"))
    fan = out.accessor(np.array([0, 1, 3, 2, 6, 4], "u4"))
    position = out.accessor(points, bounds=True)
    sparse = out.accessor(points, bounds=True)
    out.json["accessors"][sparse].update(sparse={
        "count": 1, "indices": {"bufferView": out.view(bytes([7])), "componentType": 5121},
        "values": {"bufferView": out.view(np.array([2, 2, 2], "f4").tobytes())}}, max=[2, 2, 2])
    other = out.mesh(
        {"attributes": {"POSITION": out.accessor(points + 1, bounds=True)}, "mode": 1, "material": 1},
        {
            "attributes": {"POSITION": out.accessor((points + 1)[TRIANGLES.ravel()], bounds=True)},
            "material": 1,
        },
        {"attributes": {"POSITION": position}, "indices": strip, "mode": 5},
        {"attributes": {"POSITION": position}, "indices": fan, "mode": 6},
        {"attributes": {"POSITION": sparse}, "indices": out.accessor(TRIANGLES.ravel().astype("u4"))},
        name="strips",
    )
    out.node(ball, name="a", skin=0)
    out.node(other, scale=[2, 2, 2])
    mirrored = out.mesh(
        {"attributes": {"POSITION": position}, "indices": out.accessor(TRIANGLES.ravel().astype("u1"))})
    out.node(mirrored, scale=[-1, 1, 1], translation=[5, 0, 0])
    out.json["nodes"].append({"camera": 0, "name": "bone"})
    out.json["scenes"][0]["nodes"].append(3)
    out.json["skins"] = [
        {"joints": [3], "inverseBindMatrices": out.accessor(np.eye(4, dtype="f4").reshape(1, 16))}]
    times = out.accessor(np.array([0, 1], "f4"), bounds=True)
    out.json["animations"] = [{"samplers": [{"input": times, "output": out.accessor(np.zeros((2, 3), "f4"))}],
                               "channels": [{"sampler": 0, "target": {"node": 3, "path": "translation"}}]}]
    return out


RICH_TRIANGLES = 12 + 12 + 6 + 4 + 12 + 12


def stl(vertices=CUBE, triangles=TRIANGLES):
    rows = np.zeros((len(triangles), 50), np.uint8)
    rows[:, 12:48] = vertices[triangles].astype("<f4").reshape(len(triangles), 9).view(np.uint8)
    return b"a cube".ljust(80) + struct.pack("<I", len(triangles)) + rows.tobytes()


def stl_text(vertices=CUBE, triangles=TRIANGLES):
    return ("solid cube\n" + "".join(
        "facet normal 0 0 0\n outer loop\n" + "".join("  vertex %g %g %g\n" % tuple(p) for p in vertices[t]) +
        " endloop\nendfacet\n" for t in triangles) + "endsolid cube\n").encode()


def off(colours=True):
    head = "COFF" if colours else "OFF"
    rows = [f"{head}\n# a comment\n{len(CUBE)} {len(QUADS)} 0"]
    rows += ["%g %g %g" % tuple(p) + (" 255 0 51 255" if colours else "") for p in CUBE]
    rows += ["4 " + " ".join(map(str, q)) + "  0.2 0.4 0.6" for q in QUADS]
    return ("\n".join(rows) + "\n").encode()


CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
MATERIALS = "http://schemas.microsoft.com/3dmanufacturing/material/2015/02"


def threemf(colours=True):
    """(bytes) A 3MF of a cube, a mirrored one of twice the size, and a picture that belongs to neither."""
    vertices = "".join('<vertex x="%g" y="%g" z="%g"/>\n' % tuple(p) for p in CUBE)
    own = [' pid="1" p1="0" p2="1" p3="0"' if colours and i < 3 else "" for i in range(12)]
    triangles = "".join(
        f'<triangle v1="{a}" v2="{b}" v3="{c}"{p} />\n' for (a, b, c), p in zip(TRIANGLES.tolist(), own))
    group = (
        '<m:colorgroup id="1"><m:color color="#FF0000"/><m:color color="#00FF0080"/></m:colorgroup>' * colours
    )
    mesh = f"<mesh><vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh>"
    model = (
        f'<?xml version="1.0" encoding="UTF-8"?>\n<model unit="inch" xmlns="{CORE}" xmlns:m="{MATERIALS}">\n'
        f'<metadata name="Title">&lt;cube&gt; \u00e4</metadata><resources>{group}'
        f'<object id="5" name="one">{mesh}'
        f'</object><object id="7" name="two">{mesh}</object></resources><build><item objectid="5"/>'
        '<item objectid="7" transform="-2 0 0 0 2 0 0 0 2 9 0 0"/></build></model>')
    types = (
        '<?xml version="1.0" encoding="UTF-8"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/'
        'content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-'
        'package.relationships'
        '+xml"/><Default Extension="model" ContentType="application/'
        'vnd.ms-package.3dmanufacturing-3dmodel+xml"/>'
        '</Types>')
    relations = (
        '<?xml version="1.0" encoding="UTF-8"?><Relationships xmlns="'
        'http://schemas.openxmlformats.org/package/'
        '2006/relationships"><Relationship Target="/3D/3dmodel.model" Id="r" Type="'
        'http://schemas.microsoft.com/'
        '3dmanufacturing/2013/01/3dmodel"/></Relationships>')
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as package:
        for name, content in (("[Content_Types].xml", types), ("_rels/.rels", relations),
                              ("3D/3dmodel.model", model)):
            package.writestr(zipfile.ZipInfo(name), content.encode())
        package.writestr(zipfile.ZipInfo("Metadata/thumbnail.png"), png(noise(2, 2)))
    return out.getvalue()


def every():
    """{name: bytes} One file of each kind."""
    text, data = rich().gltf("rich.bin")
    strips = (
        b"ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        b"element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n"
        b"8 0 1 2 3 -1 0 2 1\n")
    return {
        "all.obj": OBJ,
        "ascii.ply": ply(None),
        "little.ply": ply("<"),
        "big.ply": ply(">", coordinates=True),
        "even.ply": ply("<", list(TRIANGLES), coordinates=True),
        "texts.ply": ply(None, coordinates=True),
        "strips.ply": strips,
        "rich.glb": rich().glb(),
        "rich.gltf": text,
        "rich.bin": data,
        "cube.stl": stl(),
        "text.stl": stl_text(),
        "cube.off": off(),
        "bare.off": off(False),
        "cube.3mf": threemf(),
        "some.mtl": MTL,
        "a b.png": png(noise(4, 4)),
    }
