# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the layers that make.sh shows in MeshLab's window, with PyMeshLab and the plugin.

    python layers.py PLUGIN MESHES OUT [ROCKER_ARM]

MESHES is the folder data/ of Debian's package libcgal-demo. Every surface is turned here so that
MeshLab's first view, from the front, is the one wanted: pictures of one surface share their camera.
"""

import colorsys
import json
import os
import struct
import sys
import zlib

import numpy
import pymeshlab

FILTER = "compute_texcoord_parametrization_ricci_flow_euclidean_per_wedge"
INK = (124, 143, 166)
SEAM = (205, 60, 40)
CONE = (30, 30, 30)

# PyMeshLab 2025.7 writes into the log of a MeshSet in which a filter has failed, even if it is gone.
_alive = []


def documents():
    _alive.append(pymeshlab.MeshSet(verbose=False))
    return _alive[-1]


# Textures


def write_png(path, pixels):
    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + row.tobytes() for row in pixels.astype(numpy.uint8))

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data
                + struct.pack(">I", zlib.crc32(kind + data)))

    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n"
                  + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
                  + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def blend(share, ink=INK):
    """White with a share of ink, as pixels."""
    return 255 + (numpy.array(ink) - 255) * share[:, :, None]


def checkerboard(path, cells, size=2048):
    i = numpy.arange(size) * cells // size
    write_png(path, blend((i[:, None] + i[None, :]) % 2.0))


def circles(path, across, size=2048):
    """Equal circles, each touched by six others. Their rows fill a square, as nearly as 26 across do
    by themselves, so that the picture can be repeated."""
    x, y = numpy.meshgrid((numpy.arange(size) + 0.5) / size, (numpy.arange(size) + 0.5) / size)
    step = 1.0 / across
    high = 1.0 / round(1.0 / (step * 3 ** 0.5))
    distance = numpy.full_like(x, 9.0)
    for dx, dy in ((0, 0), (step / 2, high / 2)):
        u = (x - dx + step / 2) % step - step / 2
        v = (y - dy + high / 2) % high - high / 2
        distance = numpy.minimum(distance, numpy.hypot(u, v))
    edge = (0.5 * step - distance) * size  # pixels inside the circle
    rim = numpy.clip(edge, 0, 1) * numpy.clip(5 - edge, 0, 1)
    disk = numpy.clip(edge - 5, 0, 1)
    ink = blend(disk, (236, 190, 110)) / 255 * blend(rim, (90, 60, 30))
    write_png(path, ink)


# Layers


def normals(points, faces):
    """By area, one for each vertex."""
    face = numpy.cross(points[faces[:, 1]] - points[faces[:, 0]],
                       points[faces[:, 2]] - points[faces[:, 0]])
    sums = numpy.zeros_like(points)
    for k in range(3):
        numpy.add.at(sums, faces[:, k], face)
    return sums / numpy.maximum(numpy.linalg.norm(sums, axis=1), 1e-30)[:, None]


def write_ply(path, points, faces, colours=None, wedges=None, texture=None, normal=None):
    normal = normals(points, faces) if normal is None else normal
    colours = numpy.full((len(points), 3), 255) if colours is None else colours
    vertex = numpy.empty(len(points), dtype=[("p", "<f4", 3), ("n", "<f4", 3), ("c", "u1", 4)])
    vertex["p"], vertex["n"], vertex["c"][:, :3], vertex["c"][:, 3] = points, normal, colours, 255
    header = ["ply", "format binary_little_endian 1.0"]
    header += [f"comment TextureFile {texture}"] if texture else []
    header += [f"element vertex {len(points)}", *(f"property float {a}" for a in "x y z nx ny nz".split()),
               *(f"property uchar {c}" for c in "red green blue alpha".split()),
               f"element face {len(faces)}", "property list uchar int vertex_indices"]
    kinds = [("k", "u1"), ("v", "<i4", 3)]
    if wedges is not None:
        header.append("property list uchar float texcoord")
        kinds += [("m", "u1"), ("t", "<f4", 6)]
    face = numpy.zeros(len(faces), dtype=kinds)
    face["k"], face["v"] = 3, faces
    if wedges is not None:
        face["m"], face["t"] = 6, wedges.reshape(-1, 6)
    with open(path, "wb") as out:
        out.write(("\n".join(header + ["end_header"]) + "\n").encode())
        out.write(vertex.tobytes() + face.tobytes())


def turned(points, about_y=0.0, about_x=0.0):
    """Turned by degrees, first about the upright axis, then towards the viewer."""
    a, b = numpy.radians([about_y, about_x])
    y = numpy.array([[numpy.cos(a), 0, numpy.sin(a)], [0, 1, 0], [-numpy.sin(a), 0, numpy.cos(a)]])
    x = numpy.array([[1, 0, 0], [0, numpy.cos(b), -numpy.sin(b)], [0, numpy.sin(b), numpy.cos(b)]])
    return points @ (x @ y).T


class Surface:
    """A mesh with texture coordinates."""

    def __init__(self, mesh, results=None):
        self.results = results
        self.points, self.faces = mesh.vertex_matrix(), mesh.face_matrix()
        self.wedges = mesh.wedge_tex_coord_matrix().reshape(-1, 3, 2)
        self.quality = mesh.vertex_scalar_array()

    @classmethod
    def flattened(cls, source, name=FILTER, selected=None, **parameters):
        """What the filter makes of a mesh, of which it gets no more than the triangles."""
        ms = documents()
        ms.add_mesh(pymeshlab.Mesh(source.vertex_matrix(), source.face_matrix()))
        if selected is not None:
            ms.compute_selection_by_condition_per_vertex(
                condselect=" || ".join(f"(vi=={v})" for v in selected))
        return cls.of_current(ms, name, **parameters)

    @classmethod
    def of_current(cls, ms, name=FILTER, **parameters):
        """What the filter makes of the current mesh with all that is selected there."""
        results = ms.apply_filter(name, **parameters)
        return cls(ms.current_mesh(), results)

    def textured(self, path, texture, view, repeat=1.0, colours=None):
        """With colours for the faces, those of one chart are a part of their own."""
        if colours is None:
            write_ply(path, turned(self.points, *view), self.faces, wedges=self.wedges * repeat,
                      texture=texture)
            return
        places, faces, of_place = self.places()
        points, vertices = turned(self.points, *view), places[:, 2].astype(int)
        write_ply(path, points[vertices], faces, colours=colours[of_place],
                  wedges=self.wedges * repeat, texture=texture, normal=normals(points, self.faces)[vertices])

    def coloured(self, path, view, top):
        """MeshLab's colours by quality are red, green, blue; the paper's are blue for 1, red for
        the top."""
        write_ply(path, turned(self.points, *view), self.faces, colours=ramp(self.quality, top))

    def places(self):
        """Every vertex at each of its places in the plane (two coordinates and its number), the
        faces between them, and one face at each."""
        places, first, of_corner = numpy.unique(
            numpy.column_stack([self.wedges.reshape(-1, 2), self.faces.reshape(-1)]), axis=0,
            return_index=True, return_inverse=True)
        return places, of_corner.reshape(-1, 3), first // 3

    def chart_numbers(self):
        """For each face the number of its chart, the largest chart first."""
        places, faces, of_place = self.places()
        chart, before = numpy.arange(len(places)), None
        while before is None or (chart != before).any():
            before = chart.copy()
            least = chart[faces].min(axis=1)
            for k in range(3):
                numpy.minimum.at(chart, faces[:, k], least)
            chart = chart[chart]
        _, of_face, sizes = numpy.unique(chart[faces[:, 0]], return_inverse=True, return_counts=True)
        rank = numpy.empty(len(sizes), dtype=int)
        rank[numpy.argsort(-sizes, kind="stable")] = numpy.arange(len(sizes))
        return rank[of_face.reshape(-1)]

    def chart(self, path, view, texture=None, repeat=1.0, quarters=0, colours=None):
        """The plane, shaded as the surface is in that view, so that its features can be seen, or
        with colours for the faces, and turned by quarters."""
        # MeshLab shades one vertex for all faces at it: corners at one place are one vertex.
        places, faces, of_place = self.places()
        if colours is None:
            normal = turned(normals(self.points, self.faces), *view)
            light = numpy.clip(0.62 + 0.38 * normal[:, 2], 0.3, 1.0)[places[:, 2].astype(int)]
            colours = numpy.repeat((255 * light)[:, None], 3, axis=1)
        else:
            colours = colours[of_place]
        turn = numpy.linalg.matrix_power(numpy.array([[0, 1], [-1, 0]]), quarters)
        points = numpy.column_stack([places[:, :2] @ turn, numpy.zeros(len(places))])
        write_ply(path, points, faces, colours=colours,
                  wedges=self.wedges * repeat if texture else None, texture=texture,
                  normal=numpy.tile([0.0, 0.0, 1.0], (len(points), 1)))

    def seams(self):
        """Edges whose sides lie in different places of the plane, as pairs of vertices."""
        places = {}
        for f, face in enumerate(self.faces):
            for k in range(3):
                i, j = k, (k + 1) % 3
                a, b = face[i], face[j]
                uv = (tuple(self.wedges[f, i]), tuple(self.wedges[f, j]))
                if a > b:
                    a, b, uv = b, a, uv[::-1]
                places.setdefault((a, b), set()).add(uv)
        return [edge for edge, sides in places.items() if len(sides) > 1]

    def write_seams(self, path, view, cones=()):
        """Seams as red rods and cones as black balls, a little larger than life."""
        points = turned(self.points, *view)
        size = numpy.linalg.norm(numpy.ptp(points, axis=0))
        parts = [rod(points[a], points[b], 0.0022 * size) for a, b in self.seams()]
        colours = [SEAM] * len(parts)
        parts += [ball(points[v], 0.011 * size) for v in cones]
        colours += [CONE] * len(cones)
        write_parts(path, parts, colours)


def ramp(values, top):
    """Blue, cyan, green, yellow, red from 1 to the top."""
    t = numpy.clip((values - 1.0) / (top - 1.0), 0.0, 1.0)
    stops = numpy.linspace(0, 1, 5)
    colours = numpy.array([(0, 0, 255), (0, 255, 255), (0, 255, 0), (255, 255, 0), (255, 0, 0)])
    return numpy.column_stack([numpy.interp(t, stops, colours[:, c]) for c in range(3)])


def tints(numbers):
    """A light colour for each number."""
    table = [colorsys.hsv_to_rgb((0.08 + 0.618034 * i) % 1, (0.5, 0.25)[i % 2], 1)
             for i in range(numbers.max() + 1)]
    return 255 * numpy.array(table)[numbers]


def rod(a, b, radius, sides=6):
    axis = (b - a) / max(numpy.linalg.norm(b - a), 1e-30)
    across = numpy.cross(axis, numpy.eye(3)[numpy.argmin(numpy.abs(axis))])
    across /= numpy.linalg.norm(across)
    other = numpy.cross(axis, across)
    angles = 2 * numpy.pi * numpy.arange(sides) / sides
    ring = radius * (numpy.outer(numpy.cos(angles), across) + numpy.outer(numpy.sin(angles), other))
    points = numpy.concatenate([a - radius * axis + ring, b + radius * axis + ring])
    i, j = numpy.arange(sides), (numpy.arange(sides) + 1) % sides
    return points, numpy.concatenate([numpy.column_stack([i, j, j + sides]),
                                      numpy.column_stack([i, j + sides, i + sides])])


def ball(centre, radius, rings=10):
    points = [centre + [0, 0, radius]]
    for r in range(1, rings):
        for s in range(2 * rings):
            a, b = numpy.pi * r / rings, numpy.pi * s / rings
            points.append(centre + radius * numpy.array(
                [numpy.sin(a) * numpy.cos(b), numpy.sin(a) * numpy.sin(b), numpy.cos(a)]))
    points.append(centre - [0, 0, radius])
    n, faces = 2 * rings, []
    for s in range(n):
        t = (s + 1) % n
        faces.append((0, 1 + s, 1 + t))
        for r in range(rings - 2):
            a, b = 1 + r * n, 1 + (r + 1) * n
            faces += [(a + s, b + s, b + t), (a + s, b + t, a + t)]
        faces.append((1 + (rings - 2) * n + s, len(points) - 1, 1 + (rings - 2) * n + t))
    return numpy.array(points), numpy.array(faces)


def write_parts(path, parts, colours):
    counts = numpy.cumsum([0] + [len(points) for points, _ in parts])
    write_ply(path, numpy.concatenate([points for points, _ in parts]),
              numpy.concatenate([faces + counts[i] for i, (_, faces) in enumerate(parts)]),
              colours=numpy.concatenate([numpy.tile(colour, (len(points), 1))
                                         for (points, _), colour in zip(parts, colours)]))


# Surfaces


def load(path):
    ms = documents()
    ms.load_new_mesh(path)
    return ms


def marching_cubes_kitten(meshes):
    """MeshLab's Poisson surface through libcgal-demo's points, then its marching cubes: the second
    makes the thin triangles, as in the paper's Fig. 4."""
    ms = load(os.path.join(meshes, "points_3", "kitten.xyz"))
    ms.generate_surface_reconstruction_screened_poisson(depth=7, threads=1)
    ms.generate_resampled_uniform_mesh(cellsize=pymeshlab.PercentageValue(0.7))
    return ms.current_mesh()


def cut_below(ms, share, axis=1):
    """The part of the current mesh above a plane, cut by MeshLab: share of its height goes."""
    box = ms.current_mesh().bounding_box()
    low, high = box.min()[axis], box.max()[axis]
    height = low + share * (high - low)
    ms.compute_selection_by_condition_per_face(
        condselect=" && ".join(f"({'xyz'[axis]}{k} < {height})" for k in range(3)))
    ms.meshing_remove_selected_vertices_and_faces()
    return ms


def far_apart(points, count, first):
    """Vertices, each as far from those before as possible."""
    chosen = [first]
    distance = numpy.linalg.norm(points - points[first], axis=1)
    while len(chosen) < count:
        chosen.append(int(numpy.argmax(distance)))
        distance = numpy.minimum(distance, numpy.linalg.norm(points - points[chosen[-1]], axis=1))
    return chosen


# Pictures


def kitten(meshes, out, _):
    """The paper's Figs 5, 7 and 10: the conventional against the generalized flow."""
    mesh = marching_cubes_kitten(meshes)
    generalized = Surface.flattened(mesh, target_curvature="Flat everywhere")
    conventional = Surface.flattened(mesh, target_curvature="Flat everywhere", method="Thurston")
    for name, surface in (("generalized", generalized), ("conventional", conventional)):
        surface.textured(f"{out}/kitten_{name}.ply", "checkerboard.png", KITTEN, 2.5)
    compare("kitten", generalized, conventional, out, KITTEN)


def rocker_arm(_, out, path):
    mesh = load(path).current_mesh()
    compare("rocker_arm", Surface.flattened(mesh, target_curvature="Flat everywhere"),
            Surface.flattened(mesh, target_curvature="Flat everywhere", method="Thurston"),
            out, (65, 20))


def compare(name, generalized, conventional, out, view):
    """Colours and histograms of both on one scale: from 1 to the generalized flow's largest value."""
    top = float(generalized.quality.max())
    table = {"top": top, "bins": 60}
    for kind, surface in (("generalized", generalized), ("conventional", conventional)):
        surface.coloured(f"{out}/{name}_qc_{kind}.ply", view, top)
        counts, _ = numpy.histogram(numpy.clip(surface.quality, 1, top), bins=60, range=(1, top))
        table[kind] = {"counts": [int(c) for c in counts],
                       "beyond": int((surface.quality > top).sum()),
                       "vertices": len(surface.quality),
                       "mean": surface.results["qc_vertex_mean"]}
    with open(f"{out}/{name}_qc.json", "w", encoding="utf-8") as target:
        json.dump(table, target, indent=1)


def bunny(meshes, out, _):
    """The paper's Fig. 1: circles go to circles. Eight cones take the whole curvature."""
    mesh = load(os.path.join(meshes, "meshes", "bunny00.off")).current_mesh()
    points = mesh.vertex_matrix()
    cones = far_apart(points, 8, int(numpy.argmax(points[:, 1])))
    surface = Surface.flattened(mesh, selected=cones, target_curvature="Cones at selected vertices")
    surface.textured(f"{out}/bunny_circles.ply", "circles.png", BUNNY, 3.0)
    surface.textured(f"{out}/bunny_checkerboard.ply", "checkerboard.png", BUNNY, 2.2)
    surface.write_seams(f"{out}/bunny_seams.ply", BUNNY, cones)


def mask(meshes, out, _):
    """The paper's Figs 11 and 12: one face, its boundary round, rectangular, or as long as it is."""
    ms = load(os.path.join(meshes, "meshes", "mannequin-devil.off"))
    upright(ms)
    cut_below(ms, 0.35, 2)
    mesh = largest(ms)
    # However much areas change, no cones: the boundary alone is free.
    for name, quarters, parameters in (("free", 1, {"cone_distortion": 1e9}),
                                       ("disk", 3, {"target_curvature": "Disk"}),
                                       ("rectangle", 3, {"target_curvature": "Rectangle"})):
        surface = Surface.flattened(mesh, **parameters)
        surface.textured(f"{out}/mask_{name}.ply", "checkerboard.png", MASK)
        surface.chart(f"{out}/mask_{name}_chart.ply", MASK, "checkerboard.png", quarters=quarters)


def annulus(meshes, out, _):
    """The paper's Fig. 13: a bust with a cut in its crown is an annulus; edges are swapped."""
    ms = load(os.path.join(meshes, "meshes", "mannequin-devil.off"))
    upright(ms)
    points = ms.current_mesh().vertex_matrix()
    top = points[:, 1].max()
    ms.compute_selection_by_condition_per_vertex(condselect=f"(y > {top - 1.2})")
    ms.compute_selection_transfer_vertex_to_face()
    ms.meshing_remove_selected_faces()
    surface = Surface.flattened(largest(ms), target_curvature="Flat everywhere", method="Edge swaps")
    with open(f"{out}/annulus.txt", "w", encoding="utf-8") as target:
        target.write(f"annulus, {surface.results['edge_swaps']} edges swapped (Fig. 13)")
    surface.textured(f"{out}/annulus.ply", "checkerboard.png", ANNULUS, 1.5)
    surface.chart(f"{out}/annulus_chart.ply", ANNULUS, "checkerboard.png", 1.5)


def bust(meshes, out, _):
    """The default map of a bust, whose boundary is its neck, against the one without cones."""
    ms = load(os.path.join(meshes, "meshes", "mannequin-devil.off"))
    upright(ms)
    for name, says, parameters in (
            ("plain", "no cones, no finish", {"finish": "None", "cone_distortion": 1e9}),
            ("default", "default parameters", {})):
        surface = Surface.flattened(ms.current_mesh(), **parameters)
        surface.textured(f"{out}/bust_{name}.ply", "checkerboard.png", BUST, 1.4)
        surface.chart(f"{out}/bust_{name}_chart.ply", BUST, "checkerboard.png", 1.4)
        with open(f"{out}/bust_{name}.txt", "w", encoding="utf-8") as target:
            target.write(rf"{says}\nareas change {surface.results['area_distortion_mean']:.1f}-fold")


def texture(meshes, out, _):
    """A texture in an atlas of single triangles, and the same drawn for the filter's chart."""
    ms = load(os.path.join(meshes, "meshes", "bunny00.off"))
    ms.meshing_decimation_quadric_edge_collapse(targetfacenum=3000)
    ms.compute_texcoord_parametrization_triangle_trivial_per_wedge(textdim=1024, border=1)
    mesh = ms.current_mesh()
    points, faces = mesh.vertex_matrix(), mesh.face_matrix()
    wedges = mesh.wedge_tex_coord_matrix().reshape(-1, 3, 2)
    write_png(f"{out}/texture_old.png", solid_texture(points, faces, wedges, 1024))
    # By way of a file, which is what makes the host load an image.
    write_ply(f"{out}/texture_in.ply", points, faces, wedges=wedges, texture="texture_old.png")
    ms = load(f"{out}/texture_in.ply")
    ms.apply_filter(FILTER, carry_texture="texture_new.png", texture_size=1024)
    mesh = ms.current_mesh()
    seen = turned(points, *BUNNY)
    write_ply(f"{out}/texture_before.ply", seen, faces, wedges=wedges, texture="texture_old.png")
    wedges = mesh.wedge_tex_coord_matrix().reshape(-1, 3, 2)
    write_ply(f"{out}/texture_after.ply", seen, faces, wedges=wedges, texture="texture_new.png")
    corners = numpy.column_stack([wedges.reshape(-1, 2), numpy.zeros(3 * len(faces))])
    write_ply(f"{out}/texture_chart.ply", corners, numpy.arange(3 * len(faces)).reshape(-1, 3),
              wedges=wedges, texture="texture_new.png",
              normal=numpy.tile([0.0, 0.0, 1.0], (3 * len(faces), 1)))


def solid_texture(points, faces, wedges, size):
    """Bands that run through space, in the texels of each triangle and a little round it; else black."""
    pixels = numpy.zeros((size, size, 3))
    low, high = points.min(axis=0), points.max(axis=0)
    places = (points - low) / (high - low).max()
    for face, wedge in zip(faces, wedges):
        corners = numpy.column_stack([wedge[:, 0], 1 - wedge[:, 1]]) * size
        first = numpy.floor(corners.min(axis=0)).astype(int).clip(0)
        last = numpy.ceil(corners.max(axis=0)).astype(int).clip(0, size)
        x, y = numpy.meshgrid(*(numpy.arange(a, b) for a, b in zip(first, last)))
        at = numpy.stack([x + 0.5, y + 0.5, numpy.ones_like(x)]).reshape(3, -1)
        weights = numpy.linalg.solve(numpy.vstack([corners.T, numpy.ones(3)]), at)
        inside = weights.min(axis=0) > -0.02
        p = (places[face].T @ weights).T[inside]
        bands = 0.5 + 0.5 * numpy.tanh(4 * numpy.sin(50 * p[:, 1] + 5 * numpy.sin(9 * p[:, 0])))
        share = numpy.clip(p[:, 1], 0, 1)[:, None]
        colour = (1 - share) * (214, 120, 60) + share * (70, 110, 190)
        pixels[y.ravel()[inside], x.ravel()[inside]] = colour + (250 - colour) * 0.8 * bands[:, None]
    return pixels


def seams(meshes, out, _):
    """A part cut along its creases, and an atlas of MeshLab's whose seams stay."""
    ms = load(os.path.join(meshes, "meshes", "fandisk.off"))
    ms.compute_selection_crease_per_edge(angledegneg=-45, angledegpos=45)
    part = Surface.of_current(ms, seams="Selected edges")
    ms = load(os.path.join(meshes, "meshes", "bear.off"))
    ms.generate_voronoi_atlas_parametrization(regionnum=12)
    ms.set_current_mesh(1)
    ms.meshing_merge_close_vertices()  # each region is a part of its own
    atlas = Surface(ms.current_mesh())
    again = Surface.of_current(ms, seams="Existing texture seams")
    # The second map of the bear has the colours of the first one's charts.
    for name, surface, first, view in (("creases", part, part, PART), ("atlas", atlas, atlas, BEAR),
                                       ("again", again, atlas, BEAR)):
        colours = tints(first.chart_numbers())
        surface.textured(f"{out}/seams_{name}.ply", "checkerboard.png", view, colours=colours)
        surface.chart(f"{out}/seams_{name}_chart.ply", view, "checkerboard.png", colours=colours)


def upright(ms):
    """The mannequin lies on its back."""
    ms.compute_matrix_from_rotation(rotaxis="X axis", angle=-90)


def largest(ms):
    """The largest component, without vertices of no face."""
    ms.generate_splitting_by_connected_components()
    parts = [ms.mesh(i) for i in range(1, ms.mesh_number())]
    return max(parts, key=lambda part: part.face_number())


KITTEN, BUNNY, MASK, ANNULUS, BUST = (10, 8), (-25, 5), (20, 0), (25, 25), (20, 10)
PART, BEAR = (-30, 25), (20, 0)
PICTURES = {"kitten": kitten, "bunny": bunny, "mask": mask, "annulus": annulus, "bust": bust,
            "texture": texture, "seams": seams}


def main(arguments):
    if len(arguments) < 3:
        sys.exit(__doc__)
    plugin, meshes, out = arguments[:3]
    pymeshlab.load_plugin(plugin)
    checkerboard(f"{out}/checkerboard.png", 48)
    circles(f"{out}/circles.png", 26)
    wanted = os.environ.get("RICCI_PICTURES", " ".join(PICTURES)).split()
    for name in wanted:
        PICTURES[name](meshes, out, None)
    if len(arguments) > 3:
        rocker_arm(meshes, out, arguments[3])


if __name__ == "__main__":
    main(sys.argv[1:])
