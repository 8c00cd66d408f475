# SPDX-License-Identifier: GPL-3.0-or-later
"""Wavefront OBJ and its materials. Written again, every line stays but vt and the second numbers of f."""

import re
from functools import cached_property
from pathlib import Path

import numpy as np

from . import _pictures
from ._shared import (FileError, MeshFile, beside, copy_beside, counted, distinct, mixed, relative, rewritten,
                      write_file)
from ._text import (Lines, counts_between, digits, numbers, spliced, table, word_starts, without_comments,
                    words_of_lines)

# Options of map_Kd and how many words follow; -o, -s, -t have up to three numbers.
_OPTIONS = {b'-blendu': 1, b'-blendv': 1, b'-boost': 1, b'-mm': 2, b'-o': 3, b'-s': 3, b'-t': 3,
            b'-texres': 1, b'-clamp': 1, b'-bm': 1, b'-imfchan': 1, b'-type': 1, b'-cc': 1}

_NO_SLASH = bytes.maketrans(b'/f', b'  ')


class ObjFile(MeshFile):
    """An OBJ. Objects and groups lie in one space and may share vertices, so that it has one part."""

    def __init__(self, path, data=None):
        super().__init__(path)
        self._data = self.path.read_bytes() if data is None else data
        text = self._data
        if b'\\' in text:  # continued lines
            text = re.sub(rb'\\\r?\n', lambda m: b' ' * len(m[0]), text)
        self._lines = lines = Lines(text)
        self._v, self._f = lines.beginning(b'v'), lines.beginning(b'f')
        self._vt, self._vn = lines.beginning(b'vt'), lines.beginning(b'vn')
        self._read_vertices()
        self._read_faces()
        self._read_materials()

    # Reading

    def _rows(self, lines, skipped, least, what):
        """Numbers of the lines, (n, the most in a line) with NaN where a line has less."""
        if not len(lines):
            return np.zeros((0, least))
        text, begin = self._lines.text(lines, skipped)
        count = words_of_lines(text, begin)
        values = numbers(text.tobytes())
        if len(values) != count.sum() or count.min() < least:
            self._complain(lines, least, what)
        if count.min() == count.max():
            return values.reshape(len(lines), -1)
        width = min(int(count.max()), 9)
        column = np.arange(width)
        has = column < count[:, None]
        rows = np.full((len(lines), width), np.nan)
        rows[has] = values[((np.cumsum(count) - count)[:, None] + column)[has]]
        return rows

    def _complain(self, lines, least, what):
        for line in lines:
            words = self._lines.words(line)[1:]
            try:
                good = len(words) >= least and all(np.isscalar(float(w)) for w in words)
            except ValueError:
                good = False
            if not good:
                raise FileError(f'{self.path.name}: line {line + 1} is not a valid {what}: '
                                f'{self._lines.shown(line)}')
        raise FileError(f'{self.path.name}: a {what} cannot be read')

    def _read_vertices(self):
        rows = self._rows(self._v, 1, 3, 'vertex')
        self.vertices = np.ascontiguousarray(rows[:, :3])
        if rows.shape[1] >= 6 and not np.isnan(rows[:, 3:6]).all():
            colours = np.where(np.isfinite(rows[:, 3:6]), rows[:, 3:6], 1)
            colours = np.clip(colours / 255 if colours.max() > 1 else colours, 0, 1)
            self.vertex_colours = np.c_[colours, np.ones(len(rows))].astype(np.float32)

    def _read_faces(self):
        lines = self._f
        text, begin = self._lines.text(lines)
        words = np.flatnonzero(word_starts(text))
        count = counts_between(words, begin, len(text)) - 1  # without f
        starts = np.r_[0, np.cumsum(count)]
        slash, slashes = text == ord('/'), None
        content = text.tobytes()
        if slash.any():
            words = np.delete(words, starts[:-1] + np.arange(len(lines)))
            slashes = counts_between(np.flatnonzero(slash), words, len(text))
            if (slash[:-1] & (slash[1:] | (text[1:] <= 32))).any():  # a number is left out
                content = re.sub(rb'/(?=[/\s])', b'/0', content)
        values = numbers(content.translate(_NO_SLASH), np.int64)
        if (len(values) != starts[-1] + (0 if slashes is None else int(slashes.sum())) or
                (slashes is not None and len(slashes) and slashes.max() > 2) or
                np.count_nonzero(text == ord('f')) != len(lines)):  # which become spaces
            self._complain_of_face()
        self._slashes = slashes
        self._relative = bool(len(values)) and int(values.min()) < 0
        texture = None
        if slashes is not None and len(slashes):
            if slashes.min() == slashes.max():
                corner, texture = values.reshape(-1, slashes[0] + 1).T[:2]
            else:
                at = np.cumsum(slashes + 1) - slashes - 1
                corner = values[at]
                texture = np.where(slashes > 0, values[np.minimum(at + 1, len(values) - 1)], 0)
        else:
            corner = values
        corner = self._from_zero(corner, self._v, count)
        self.set_polygons(corner, starts)
        self._texture = None  # number of vt at each corner, from 0, len(vt) for none
        if texture is not None and len(self._vt):
            index = self._from_zero(texture, self._vt, count)
            if len(index) and (index.min() < 0 or index.max() >= len(self._vt)):
                none = (index < 0) | (index >= len(self._vt))
                beyond = int((none & (texture != 0)).sum())
                if beyond:
                    self.messages.append(f'{counted(beyond, "corner")} of faces name a texture coordinate '
                                         'that the file does not have')
                index[none] = len(self._vt)
            self._texture = index

    @cached_property
    def uv(self):
        """As in MeshFile, moved as the materials say; read when it is asked for."""
        if self._texture is None or (self._texture == len(self._vt)).all():
            return None
        points = self._rows(self._vt, 2, 1, 'texture coordinate')[:, :2]
        if np.isnan(points.sum()):
            points = np.nan_to_num(points)
        places = np.zeros((len(points) + 1, 2))
        places[:-1, :points.shape[1]], places[-1] = points, np.nan
        uv = places[self._texture]
        uv = uv.reshape(-1, 3, 2) if self.all_triangles else uv[self.corners]
        for triangles, material in self._moved:
            uv[triangles] = uv[triangles] * material.scale + material.offset
        return uv

    @cached_property
    def uv_picture(self):
        """As in MeshFile."""
        if self._picture is None or self.uv is None:
            return None
        return np.where(np.isnan(self.uv).any((1, 2)), -1, self._picture).astype(np.int32)

    def _from_zero(self, index, lines, count):
        """Numbers from 1, or from -1 back from their line, as numbers from 0; beyond the end: -1."""
        result = index - 1
        if index.size and index.min() < 0:
            before = np.repeat(np.searchsorted(lines, self._f), count)
            result = np.where(index < 0, np.maximum(before + index, -1), result)
        return result

    def _complain_of_face(self):
        good = re.compile(rb'[+-]?\d+(/([+-]?\d*)(/[+-]?\d*)?)?')
        for line in self._f:
            words = self._lines.words(line)[1:]
            if not all(good.fullmatch(w) for w in words):
                raise FileError(f'{self.path.name}: line {line + 1} is not a valid face: '
                                f'{self._lines.shown(line)}')
        raise FileError(f'{self.path.name}: the faces cannot be read')

    def _statements(self, keyword):
        """(line, what follows) of each line that begins with the keyword."""
        return [(int(line), self._lines.rest(line, len(keyword))) for line in self._lines.beginning(keyword)]

    def _read_materials(self):
        used = self._statements(b'usemtl')
        self._libraries = []  # (line, names as written, files)
        materials = {}
        for line, names in self._statements(b'mtllib'):
            whole = beside(self.path.parent, _text(names))
            found = [(_text(names), whole)] if whole else [(_text(n), beside(self.path.parent, _text(n)))
                                                          for n in names.split()]
            self._libraries.append((line, [(n, f) for n, f in found if f]))
            for name, file in found:
                if file is None:
                    self.messages.append(f'the material file {name} is not beside {self.path.name}')
                else:
                    materials.update(read_materials(file))
        self._materials, self._picture, self._moved = materials, None, []
        if not used or not materials:
            return
        names = [b''] + [name for _, name in used]
        current = np.searchsorted([line for line, _ in used], self._f)[self.polygon]
        known = [materials.get(name) for name in names]
        colour = np.array([m.colour if m else (1, 1, 1, 1) for m in known], np.float32)
        self.material_colours = colour[current]
        numbers_ = {}
        picture = np.array([numbers_.setdefault(m.picture, len(numbers_)) if m and m.picture else -1
                            for m in known])
        self.pictures = [_pictures.Picture(name, beside(self.path.parent, name)) for name in numbers_]
        if numbers_:
            self._picture = picture[current]
            self._moved = [(np.flatnonzero(current == k), m) for k, m in enumerate(known)
                           if m and m.picture and (m.scale != [1, 1] or m.offset != [0, 0])]

    @np.errstate(all='ignore')
    def corner_normals(self):
        if self._slashes is None or not (self._slashes == 2).any() or not len(self._vn):
            return None
        rows = self._rows(self._vn, 2, 3, 'normal')
        text, _ = self._lines.text(self._f, 1)
        third = re.findall(rb'[^\s/]+(?:/[^\s/]*(?:/([^\s/]*))?)?', text.tobytes())
        index = np.array([int(t) if t else 0 for t in third])
        count = np.diff(self.starts)
        index = self._from_zero(index, self._vn, count)
        if (index < 0).any() or (index >= len(rows)).any():
            return None
        return rows[index, :3].astype(np.float32)[self.corners]

    # Writing

    def _patch(self, path, uv, texture, refined, uv_set):
        messages = []
        new = rewritten(self, uv, refined)
        folder, stem = path.parent, path.stem
        points, index = distinct(np.r_[new.corner_uv, new.uv.reshape(-1, 2)])
        corner_vt, vt = index[:len(new.corner_uv)] + 1, index[len(new.corner_uv):].reshape(-1, 3) + 1
        used = np.zeros(len(points), bool)
        stays = np.repeat(~new.torn, np.diff(self.starts))
        used[corner_vt[stays] - 1] = True
        gone = np.concatenate([np.zeros(0, np.int64), *(new.triangles(p) for p in np.flatnonzero(new.torn))])
        used[vt[gone] - 1] = True
        number = np.cumsum(used)
        corner_vt, vt, points = number[corner_vt - 1], number[vt - 1], points[used]

        torn_lines = self._f[new.torn]
        gone = [self._vt, torn_lines]
        if texture is not None:
            gone.append(np.array([line for line, _ in self._libraries], int))
        gone = np.concatenate(gone)
        numbers_of_lines = np.array(self._numbers_of_polylines(), int).reshape(-1, 2)
        at, end, plain = self._second_numbers()
        rows, mask = digits(corner_vt, b'/')
        mask[~plain, 0] = False
        rows, mask = rows[stays], mask[stays]

        def without(begin, end):
            return begin, end, np.zeros(len(begin), np.int64), np.zeros(0, np.uint8)
        written, moved = spliced(
            np.frombuffer(self._data, np.uint8), (at[stays], end[stays], mask.sum(1), rows[mask]),
            without(self._lines.begin[gone], np.minimum(self._lines.end[gone] + 1, len(self._data))),
            without(*numbers_of_lines.T))

        end_line = b'\r\n' if b'\r\n' in self._data[:10000] else b'\n'
        head = table('vt %.9g %.9g\n', points)
        vertices, normal_count = [], len(self._vn)
        if len(new.points):
            vertices.append(self._new_vertices(new))
        pieces = {}
        for p, line in zip(np.flatnonzero(new.torn), torn_lines):
            pieces[line], normals = self._torn_line(new, p, vt, normal_count)
            normal_count += len(normals)
            vertices.append(b''.join(b'vn %.9g %.9g %.9g\n' % tuple(n) for n in normals))
        first = int(self._lines.begin[self._f[0]]) if len(self._f) else len(self._data)
        materials = b''
        if texture is not None:
            materials, said = self._write_materials(folder, stem, texture)
            messages += said
        else:
            messages += self._copy_materials(folder)
        pieces = [(int(self._lines.begin[line]), pieces[line] + b'\n') for line in torn_lines]
        # New vertices must not change the numbers of others.
        late = (
            self._relative or any(len(k) and k[-1] > self._f[0] for k in (self._v, self._vn))
            if vertices
            else False)
        tail = b''.join(vertices) if late else b''
        if tail and not self._data.endswith(b'\n'):
            tail = b'\n' + tail
        out, done = [], 0
        for place, content in [(first, (b'' if late else b''.join(vertices)) + head + materials)] + pieces:
            out += [written[done:moved(place)], content.replace(b'\n', end_line)]
            done = moved(place)
        out += [written[done:], tail.replace(b'\n', end_line)]
        write_file(path, b''.join(out))
        return messages

    def _numbers_of_polylines(self):
        """(begin, end) of what lines `l` say of the old coordinates, which are gone."""
        return [
            (self._lines.begin[line] + match.start(), self._lines.begin[line] + match.end())
            for line in self._lines.beginning(b'l')
            for match in re.finditer(
                rb'/[^\s/]*', self._data[self._lines.begin[line] : self._lines.end[line]])]

    def _second_numbers(self):
        """(C,) where the second number of each corner begins and ends; and whether it has no slash."""
        lines = self._f
        if not len(lines):
            return np.zeros(0, int), np.zeros(0, int), np.zeros(0, bool)
        text, begin = self._lines.text(lines, 1)
        first = np.flatnonzero(word_starts(text))
        last = np.flatnonzero((text[:-1] > 32) & (text[1:] <= 32)) + 1
        moved = np.repeat(self._lines.begin[lines] - begin, np.diff(self.starts))
        if self._slashes is None:
            return last + moved, last + moved, np.ones(len(first), bool)
        slash = np.r_[np.flatnonzero(text == ord('/')), 0, 0]
        one = np.cumsum(self._slashes) - self._slashes
        plain = self._slashes == 0
        at = np.where(plain, last, slash[one] + 1)
        return at + moved, np.where(self._slashes == 2, slash[one + 1], last) + moved, plain

    def _torn_line(self, new, p, vt, normal_count):
        """The triangles in place of polygon p, and the normals that they need."""
        words = [w.split(b'/') for w in self._lines.words(self._f[p])[1:]]
        normals, lines = [], []
        has_normals = all(len(w) > 2 and w[2] for w in words) and len(self._vn)
        given = self._normal_values if has_normals else None
        seen = int(np.searchsorted(self._vn, self._f[p])) if has_normals else 0
        for t in new.triangles(p):
            line = []
            for k in range(3):
                weight = new.weights[t, k]
                local = self.corners[new.origin[t]] - self.starts[p]
                exact = weight.max() == 1
                word = words[local[weight.argmax()]]
                vertex, third = b'%d' % (new.vertices[t, k] + 1), word[2] if len(word) > 2 else None
                if has_normals:
                    index = [int(words[c][2]) for c in local]
                    index = [i - 1 if i > 0 else seen + i for i in index]
                    if exact or max(index) >= len(given) or min(index) < 0:
                        third = b'%d' % (index[weight.argmax()] + 1)
                    else:
                        normal = mixed(given[index][None], weight[None])[0]
                        normals.append(normal / (np.linalg.norm(normal) or 1))
                        third = b'%d' % (normal_count + len(normals))
                line.append(b'%s/%d' % (vertex, vt[t, k]) + (b'/' + third if third else b''))
            lines.append(b'f ' + b' '.join(line))
        return b'\n'.join(lines), normals

    @cached_property
    def _normal_values(self):
        return self._rows(self._vn, 2, 3, 'normal')[:, :3]

    def _new_vertices(self, new):
        """Lines v of the vertices that a refinement adds."""
        if self.vertex_colours is None:
            return table('v %.17g %.17g %.17g\n', new.points)
        t, k = new.samples.T
        colours = mixed(self.vertex_colours[self.faces[new.origin[t]]], new.weights[t, k])[:, :3]
        return table('v %.17g %.17g %.17g %.9g %.9g %.9g\n', np.c_[new.points, colours])

    def _copy_materials(self, folder):
        files = [(name, file) for _, found in self._libraries for name, file in found]
        files += [(p.name, p.source) for p in self.pictures if isinstance(p.source, Path)]
        return copy_beside(files, self.path.parent, folder)

    def _write_materials(self, folder, stem, texture):
        """A material file in which every material shows the picture; its lines for the OBJ."""
        messages, out, left = [], [], set()
        names = list(dict.fromkeys(name for _, name in self._statements(b'usemtl')))
        sources = [f.read_bytes() for _, found in self._libraries for _, f in found]
        picture = relative(texture, folder).encode()
        shows = b'Kd 1 1 1\nmap_Kd %s\n' % picture
        defined, white = set(), True
        for line in b'\n'.join(sources).splitlines():
            word = (line.split() or [b''])[0].lower()
            if word == b'newmtl':
                name = line.strip()[6:].strip()
                defined.add(name)
                # The colour of a material with a picture goes on multiplying it; others are in the new one.
                white = name not in self._materials or self._materials[name].picture is None
                out.append(line + b'\n' + (shows if white else shows.split(b'\n', 1)[1]))
            elif word.startswith((b'map_', b'bump', b'disp', b'decal', b'refl', b'norm')):
                if word != b'map_kd':
                    left.add(_text(line.strip()))
            elif not (white and word in (b'kd', b'd', b'tr')):
                out.append(line + b'\n')
        out += [b'newmtl %s\n' % name + shows for name in names if name not in defined]
        first_used = min((line for line, _ in self._statements(b'usemtl')), default=len(self._lines.end))
        bare = len(self._f) and self._f[0] < first_used
        use = b''
        if bare:
            out.append(b'newmtl unwrapped\n' + shows)
            use = b'usemtl unwrapped\n'
        if left:
            messages.append('maps that belong to the old texture coordinates are left out: ' +
                            ', '.join(sorted(left)))
        name = f'{stem}.mtl'
        write_file(folder / name, b''.join(out))
        return b'mtllib %s\n' % name.encode() + use, messages


class Material:
    """What a material of an MTL shows."""

    def __init__(self):
        self.colour = [1.0, 1.0, 1.0, 1.0]
        self.picture = None
        self.scale, self.offset = [1.0, 1.0], [0.0, 0.0]


def read_materials(file):
    """Material by name; pictures by the name that the OBJ's folder knows them by."""
    materials, current = {}, Material()
    for line in without_comments(file.read_bytes().replace(b'\\\n', b' ')).splitlines():
        words = line.split()
        if not words:
            continue
        key = words[0].lower()
        if key == b'newmtl':
            current = materials[line.strip()[6:].strip()] = Material()
        elif key == b'kd':
            values = numbers(b' '.join(words[1:4]))
            if len(values) == 3 and np.isfinite(values).all():
                current.colour[:3] = np.clip(values, 0, 1)
        elif key in (b'd', b'tr'):
            value = numbers(words[-1])
            if len(value) and np.isfinite(value[0]):
                current.colour[3] = float(np.clip(value[0] if key == b'd' else 1 - value[0], 0, 1))
        elif key == b'map_kd':
            _read_map(line.strip()[6:].strip(), current)
    return materials


def _read_map(rest, material):
    while rest.startswith(b'-'):
        words = rest.split()
        count = _OPTIONS.get(words[0].lower())
        if count is None:
            break
        if count == 3:
            count = next((k for k in range(3) if len(words) <= k + 1 or not len(numbers(words[k + 1]))), 3)
            values = [float(numbers(w)[0]) for w in words[1:1 + count]]
            if words[0] in (b'-s', b'-o') and np.isfinite(values).all():
                goal = material.scale if words[0] == b'-s' else material.offset
                goal[:] = (values + goal[len(values):])[:2]
        for _ in range(count + 1):
            rest = (rest.split(None, 1) + [b''])[1]
    material.picture = _text(rest).strip('"') or None


def plain(mesh):
    """(bytes) An OBJ of the mesh without texture coordinates."""
    out = [b'']
    if mesh.vertex_colours is None:
        out.append(table('v %.17g %.17g %.17g\n', mesh.vertices))
    else:
        out.append(
            table('v %.17g %.17g %.17g %.6g %.6g %.6g\n', np.c_[mesh.vertices, mesh.vertex_colours[:, :3]]))
    corner = np.zeros(int(mesh.starts[-1]), np.int64)
    corner[mesh.corners] = mesh.faces + 1
    normals = mesh.corner_normals()
    if normals is None:
        words = list(map(str, corner.tolist()))
    else:
        at = np.zeros((len(corner), 3))
        at[mesh.corners] = normals
        points, index = np.unique(at, axis=0, return_inverse=True)
        out.append(table('vn %.9g %.9g %.9g\n', points))
        words = [f'{v}//{n}' for v, n in zip(corner.tolist(), (index.ravel() + 1).tolist())]
    starts = mesh.starts.tolist()
    out.append(''.join(f'f {" ".join(words[a:b])}\n' for a, b in zip(starts, starts[1:])).encode())
    return b''.join(out)


def _text(name):
    return name.decode('utf-8', 'surrogateescape') if isinstance(name, bytes) else name

