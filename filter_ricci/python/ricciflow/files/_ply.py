# SPDX-License-Identifier: GPL-3.0-or-later
"""Stanford PLY, ascii and binary. Written again, every element and property stays; texcoord is of corners."""

import struct
from functools import cached_property

import numpy as np

from . import _pictures
from ._shared import FileError, MeshFile, beside, copy_beside, counted, mixed, relative, rewritten, write_file
from ._text import numbers, spliced, whole, word_starts, words_of_lines

_TYPES = {'char': 'i1', 'uchar': 'u1', 'short': 'i2', 'ushort': 'u2', 'int': 'i4', 'uint': 'u4',
          'float': 'f4', 'double': 'f8', 'int8': 'i1', 'uint8': 'u1', 'int16': 'i2', 'uint16': 'u2',
          'int32': 'i4', 'uint32': 'u4', 'float32': 'f4', 'float64': 'f8'}
_INDICES = ('vertex_indices', 'vertex_index')
_COORDINATES = (('s', 't'), ('u', 'v'), ('texture_u', 'texture_v'), ('texture_s', 'texture_t'))


class _Element:
    """One element: its rows lie in `data` from `begin` to `end`; columns are read from there."""

    def __init__(self, name, count):
        self.name, self.count = name, count
        self.types = {}  # by property: (type, type of the count of a list or None)
        self.begin = self.end = 0
        self.columns = {}  # by property: (n,) values, or (counts (n,), all values one after another)
        self.rows = None  # (n + 1,) where each row begins, or None: all have the same length
        self.table = None  # then, in a binary file, (n,) structured

    def row_begins(self):
        """(n + 1,) bytes of `data`."""
        if self.rows is None:
            return np.linspace(self.begin, self.end, self.count + 1).astype(np.int64)
        return self.rows

    def side_by_side(self, names):
        """(n, k) the numbers of properties; None where they do not follow each other in the table.

        Rows are copied whole, in a quarter of the time that their numbers take.
        """
        if self.table is None:
            return None
        kinds, places = zip(*(self.table.dtype.fields[name][:2] for name in names))
        sizes = [kind.itemsize for kind in kinds]
        if not sum(sizes) or any(k.base != kinds[0].base for k in kinds) or any(
                place + size != other for place, size, other in zip(places, sizes, places[1:])):
            return None
        rows = np.ndarray(self.count, np.dtype((np.void, sum(sizes))), self.table, places[0],
                          (self.table.itemsize,))
        return np.ascontiguousarray(rows).view(kinds[0].base).reshape(self.count, -1)


class PlyFile(MeshFile):
    """A PLY, which has one part."""

    def __init__(self, path, data=None):
        super().__init__(path)
        self._data = self.path.read_bytes() if data is None else data
        self._read_header()
        at = self._body
        for element in self._elements:
            element.begin = at
            if element.types:
                (self._read_text if self._order is None else self._read_binary)(element)
            else:
                element.end = at
            at = element.end
        self._by_name = {e.name: e for e in self._elements}
        if 'face' not in self._by_name and 'tristrips' in self._by_name:
            self._expand_strips(self._by_name['tristrips'])
            return
        self._read_mesh()

    # Reading

    def _fail(self, what):
        raise FileError(f'{self.path.name}: {what}')

    def _read_header(self):
        stop = self._data.find(b'end_header')
        line_end = self._data.find(b'\n', stop)
        if line_end < 0:
            line_end = self._data.find(b'\r', stop)
        if not self._data.startswith(b'ply') or stop < 0 or line_end < 0 or stop > 1 << 20:
            self._fail('not a PLY file: the header is missing or has no end')
        self._body = line_end + 1
        self._header = self._data[:self._body].decode('latin1').splitlines()
        self._elements, self._order, known = [], '', False
        for number, line in enumerate(self._header):
            words = line.split()
            try:
                if words[:1] == ['format']:
                    self._order = {'ascii': None, 'binary_little_endian': '<', 'binary_big_endian': '>'}[
                        words[1]]
                    known = True
                elif words[:1] == ['element']:
                    if int(words[2]) < 0 or any(words[1] == e.name for e in self._elements):
                        raise ValueError
                    self._elements.append(_Element(words[1], int(words[2])))
                elif words[:1] == ['property'] and words[-1] in self._elements[-1].types:
                    raise ValueError
                elif words[:2] == ['property', 'list']:
                    self._elements[-1].types[words[4]] = _TYPES[words[3]], _TYPES[words[2]]
                    if _TYPES[words[2]][0] == 'f':
                        raise ValueError
                elif words[:1] == ['property']:
                    self._elements[-1].types[words[2]] = _TYPES[words[1]], None
            except (KeyError, IndexError, ValueError):
                self._fail(f'line {number + 1} of the header is not understood: {line[:60]}')
        if not known:
            self._fail('the header names no format')

    def _read_binary(self, element):
        data, n, at = self._data, element.count, element.begin
        kinds = [(name, np.dtype(self._order + t), l and np.dtype(self._order + l))
                 for name, (t, l) in element.types.items()]
        least = sum((l or t).itemsize for _, t, l in kinds)
        if n * least > len(data) - at:
            self._fail(f'the file ends within the {n} rows of {element.name}')
        if not n:
            element.end = at
            for name, t, l in kinds:
                element.columns[name] = np.zeros(0, t) if l is None else (np.zeros(0, int), np.zeros(0, t))
            return
        fields, length, first = [], {}, at
        for name, t, l in kinds:  # the lengths of the first row are tried for all
            if l is not None:
                if first + l.itemsize > len(data):
                    break
                length[name] = int(np.frombuffer(data, l, 1, first)[0])
                if not 0 <= length[name] <= len(data):
                    break
                fields.append((f'{name} count', l))
                first += l.itemsize
            size = length.get(name, 1)
            fields.append((name, t, (size,)) if l is not None else (name, t))
            first += t.itemsize * size
        else:
            row = np.dtype(fields)
            if row.itemsize * n <= len(data) - at:
                table = np.frombuffer(data, row, n, at)
                if all((table[f'{name} count'] == k).all() for name, k in length.items()):
                    element.end, element.table = at + n * row.itemsize, table
                    for name, _, l in kinds:
                        element.columns[name] = table[name] if l is None else (length[name], table[name])
                    return
        element.rows = self._row_begins(element, kinds)
        element.end = int(element.rows[-1])
        raw, place = np.frombuffer(data, np.uint8), element.rows[:-1].copy()

        def values(kind, where):
            return raw[where[:, None] + np.arange(kind.itemsize)].view(kind).ravel()

        for name, t, l in kinds:
            if l is None:
                element.columns[name] = values(t, place)
                place += t.itemsize
            else:
                counts = values(l, place).astype(np.int64)
                place += l.itemsize
                element.columns[name] = counts, values(t, _spread(place, counts, t.itemsize))
                place += counts * t.itemsize

    def _row_begins(self, element, kinds):
        """(n + 1,) where the rows begin, one after another, since lists have any length."""
        steps, fixed = [], 0  # bytes before each list's count, then its format and size of its values
        for _, t, l in kinds:
            if l is None:
                fixed += t.itemsize
            else:
                steps.append((fixed, struct.Struct(self._order + l.char).unpack_from, l.itemsize, t.itemsize))
                fixed = 0
        data, at, begins = self._data, element.begin, []
        try:
            lists = [l.char for _, _, l in kinds if l is not None]
            if lists == ['B']:  # one list with a byte as its count, as most files have it: four times as fast
                (skip, _, own, size), = steps
                lengths = [skip + own + count * size + fixed for count in range(256)]
                for _ in range(element.count):
                    begins.append(at)
                    at += lengths[data[at + skip]]
            for _ in range(element.count - len(begins)):
                begins.append(at)
                for skip, unpack, own, size in steps:
                    at += skip
                    count, = unpack(data, at)
                    if count < 0:
                        self._fail(f'a list of {element.name} has {count} values')
                    at += own + count * size
                at += fixed
            if at > len(data):
                raise IndexError
        except (struct.error, IndexError):
            self._fail(f'the file ends within the {element.count} rows of {element.name}')
        return np.array(begins + [at], np.int64)

    def _read_text(self, element):
        data, n = self._data, element.count
        kinds = list(element.types.items())
        if n * len(kinds) * 2 - 1 > len(data) - element.begin:
            self._fail(f'the file ends within the {n} rows of {element.name}')
        if not hasattr(self, '_lines'):
            self._text = np.frombuffer(data + (b'' if data.endswith(b'\n') else b'\n'), np.uint8)
            ends = np.flatnonzero(self._text[self._body:] == 10) + self._body
            if len(ends) == 1 and b'\r' in data[self._body:]:
                ends = np.flatnonzero(self._text[self._body:] == 13) + self._body
            self._lines = np.r_[self._body, ends + 1]
            self._next = 0
        begins = self._lines[self._next:self._next + n + 1]
        floats = any(t[0] == 'f' for _, (t, _) in kinds)
        if len(begins) == n + 1 and n:
            text = data[begins[0]:begins[-1]]
            values = numbers(text, np.float64 if floats else np.int64)
            width, at = 0, 0  # of the first row
            for _, (_, l) in kinds:
                if l is not None and at < len(values):
                    at += int(whole(np.clip(values[at], 0, len(data))))
                at += 1
            width = at
            if len(values) == n * width:
                table, at, good = values.reshape(n, width), 0, True
                for name, (t, l) in kinds:
                    if l is None:
                        element.columns[name] = _typed(table[:, at], t)
                        at += 1
                    else:
                        k = int(table[0, at])
                        good &= bool((table[:, at] == k).all())
                        element.columns[name] = k, table[:, at + 1:at + 1 + k]
                        at += 1 + k
                if good:
                    element.rows, element.end = begins, int(begins[-1])
                    self._next += n
                    return
        self._read_uneven_text(element, kinds)

    def _read_uneven_text(self, element, kinds):
        """Rows with lists of several lengths, lines without words, rows not by lines."""
        n, lines = element.count, self._lines[self._next:]
        count = (
            words_of_lines(self._text[lines[0] :], lines[:-1] - lines[0])
            if len(lines) > 1
            else np.zeros(0, int))
        used = np.flatnonzero(count)[:n]
        if len(used) < n:
            if self._by_words(element):
                return
            self._fail(f'the file ends within the {n} rows of {element.name}')
        stop = used[-1] + 1 if n else 0
        values = numbers(self._data[lines[0]:lines[stop]])
        count = count[used]
        place = np.cumsum(count) - count
        if len(values) != count.sum():
            bad = int(np.searchsorted(np.cumsum(count), len(values), 'right'))
            self._fail(f'a row of {element.name} has a word that is not a number: '
                       f'{self._data[lines[used[bad]]:lines[used[bad] + 1]][:60].decode("latin1").strip()}')
        end = place + count
        for name, (t, l) in kinds:
            if not (place < end).all():
                place = None
                break
            if l is None:
                element.columns[name] = _typed(values[place], t)
                place = place + 1
            else:
                length = values[place]
                if not ((length >= 0) & (length <= end - place - 1)).all():
                    place = None
                    break
                length = whole(length)
                element.columns[name] = length, values[_spread(place + 1, length, 1)]
                place = place + 1 + length
        if place is None or not np.array_equal(place, end):
            if self._by_words(element):
                return
            self._fail(f'the rows of {element.name} do not have the words that the header says')
        begins = lines[used]
        element.rows, element.end = np.r_[begins, lines[stop]], int(lines[stop])
        self._next += int(stop)

    def _by_words(self, element):
        """Gives each row of this and the following elements a line of its own, if the words suffice."""
        if getattr(self, '_rowed', False):
            return False
        self._rowed = True
        words, at, rows = self._data[element.begin:].split(), 0, []
        for other in self._elements[self._elements.index(element):]:
            for _ in range(other.count if other.types else 0):
                begin = at
                for _, l in other.types.values():
                    try:
                        at += 1 + (0 if l is None else int(words[at]))
                    except (ValueError, IndexError):
                        return False
                if at > len(words) or at < begin:
                    return False
                rows.append(b' '.join(words[begin:at]) + b'\n')
        self._data = self._data[:element.begin] + b''.join(rows)
        before = self._lines[:self._next]
        self._text = np.frombuffer(self._data, np.uint8)
        ends = np.flatnonzero(self._text[element.begin:] == 10) + element.begin
        self._lines = np.r_[before, element.begin, ends + 1]
        self._read_text(element)
        return True

    def _expand_strips(self, element):
        """Reads the file again with its strips of triangles as faces."""
        name = next((p for p in _INDICES if p in element.types), None)
        if name is None:
            self._fail('the strips have no vertex_indices')
        _, values = element.columns[name]
        values = whole(np.ravel(values))
        counts, _ = element.columns[name]
        counts = np.broadcast_to(counts, element.count)
        ends = np.zeros(len(values), bool)
        ends[np.cumsum(counts)[counts > 0] - 1] = True
        strip = np.r_[0, np.cumsum(ends | (values < 0))[:-1]]
        begin = np.flatnonzero(np.r_[True, (strip[1:] != strip[:-1])])
        place = np.arange(len(values)) - begin[np.searchsorted(begin, np.arange(len(values)), 'right') - 1]
        last = np.arange(2, len(values))
        last = last[(strip[last] == strip[last - 2]) & (values[last] >= 0)]
        flip = (place[last] % 2 == 1)
        faces = np.c_[np.where(flip, values[last - 1], values[last - 2]),
                      np.where(flip, values[last - 2], values[last - 1]), values[last]]
        at = next(i for i, line in enumerate(self._header) if line.split()[:2] == ['element', 'tristrips'])
        stop = at + 1
        while self._header[stop].split()[:1] == ['property']:
            stop += 1
        header = self._header[:at] + [f'element face {len(faces)}', 'property list uchar int vertex_indices']
        head = '\n'.join(header + self._header[stop:]).encode('latin1') + b'\n'
        if self._order is None:
            rows = ''.join('3 %d %d %d\n' % tuple(f) for f in faces.tolist()).encode()
        else:
            table = np.zeros(len(faces), [('n', 'u1'), ('v', self._order + 'i4', 3)])
            table['n'], table['v'] = 3, faces
            rows = table.tobytes()
        self.__init__(
            self.path, head + self._data[self._body : element.begin] + rows + self._data[element.end :])
        self.messages.append('strips of triangles are written as faces')

    def _read_mesh(self):
        vertex, face = self._by_name.get('vertex'), self._by_name.get('face')
        if vertex is None or not all(p in vertex.types and vertex.types[p][1] is None for p in 'xyz'):
            self._fail('there are no vertices with x, y and z')
        points = vertex.side_by_side('xyz')
        if points is None:
            points = np.stack([vertex.columns[p] for p in 'xyz'], 1)
        self.vertices = points.astype(np.float64)
        self.vertex_colours = _colours(vertex)
        name = next((p for p in _INDICES if face and p in face.types and face.types[p][1]), None)
        self._indices = name
        if name is None:
            return self.set_polygons(np.zeros((0, 3), np.int64))
        counts, values = face.columns[name]
        if np.isscalar(counts) and counts == 3:
            rows = face.side_by_side([name])
            self.set_polygons(values if rows is None else rows)
        else:
            starts = np.r_[0, np.cumsum(np.broadcast_to(counts, face.count), dtype=np.int64)]
            self.set_polygons(np.ravel(values), starts)
        colours = _colours(face)
        self.face_colours = None if colours is None else colours[self.polygon]
        names = [_name(line.split(None, 2)[2].strip()) for line in self._header
                 if line.split()[:2] == ['comment', 'TextureFile'] and len(line.split()) > 2]
        self.pictures = [_pictures.Picture(n, beside(self.path.parent, n)) for n in names]
        return None

    @cached_property
    @np.errstate(all='ignore')
    def uv(self):
        """As in MeshFile; read when it is asked for."""
        vertex, face = self._by_name['vertex'], self._by_name.get('face')
        if self._indices is None:
            return None
        if face.types.get('texcoord', ('', None))[1]:
            counts, values = face.columns['texcoord']
            if self.all_triangles and np.isscalar(counts) and counts == 6:
                return values.reshape(-1, 3, 2).astype(np.float64)
            counts = np.broadcast_to(counts, face.count)
            uv, own = np.full((int(self.starts[-1]), 2), np.nan), np.diff(self.starts)
            full = counts == 2 * own
            value = np.repeat(full, counts)
            uv[np.repeat(full, own)] = np.ravel(values)[value].reshape(-1, 2)
            return uv[self.corners]
        pair = self._coordinates_of_vertices()
        return pair and np.c_[vertex.columns[pair[0]], vertex.columns[pair[1]]].astype(np.float64)[self.faces]

    def _coordinates_of_vertices(self):
        """The names of the two properties, or None."""
        types = self._by_name['vertex'].types
        return next((pair for pair in _COORDINATES if all(p in types and types[p][1] is None for p in pair)),
                    None)

    @cached_property
    def uv_picture(self):
        """As in MeshFile."""
        if self.uv is None or not self.pictures:
            return None
        face = self._by_name['face']
        number = face.columns['texnumber'] if face.types.get('texnumber', ('', 1))[1] is None else 0
        number = whole(np.broadcast_to(number, face.count))[self.polygon]
        known = (number >= 0) & (number < len(self.pictures)) & ~np.isnan(self.uv).any((1, 2))
        return np.where(known, number, -1).astype(np.int32)

    @np.errstate(all='ignore')
    def corner_normals(self):
        vertex = self._by_name['vertex']
        if not all(p in vertex.types and vertex.types[p][1] is None for p in ('nx', 'ny', 'nz')):
            return None
        return np.stack([vertex.columns[p] for p in ('nx', 'ny', 'nz')], 1).astype(np.float32)[self.faces]

    # Writing

    def _patch(self, path, uv, texture, refined, uv_set):
        if self._indices is None:
            self._fail('there are no faces')
        new = rewritten(self, uv, refined)
        face, corners = self._by_name['face'], np.diff(self.starts)
        most = 2 * int(corners[~new.torn].max(initial=3))
        t, l = face.types.get('texcoord', ('f4', 'u1'))
        kind = (t if t[0] == 'f' else 'f4',
                l if l is not None and most <= np.iinfo(l).max else 'u1' if most < 256 else 'u4')
        extra = sum(len(new.triangles(p)) - 1 for p in np.flatnonzero(new.torn))
        body = []
        for element in self._elements:
            if element is face:
                body.append(self._face_rows(face, kind, new, texture is not None))
            else:
                body.append(self._data[element.begin:element.end])
            if element.name == 'vertex' and len(new.points):
                body.append(self._new_vertices(element, new))
        body.append(self._data[self._elements[-1].end:])
        header = self._new_header(path, face, kind, face.count + extra, len(new.points), texture)
        write_file(path, b''.join([header, *body]))
        messages, large = [], int(((corners > 3) & ~new.torn).sum())
        if large:
            messages.append(f'{counted(large, "face")} with more than 3 corners: MeshLab opens no PLY of '
                            'such faces with texture coordinates; save it as OBJ for MeshLab')
        if self._coordinates_of_vertices():
            messages.append(f'{" and ".join(self._coordinates_of_vertices())} of the vertices stay: programs '
                            'that read these, and not texcoord, show the old map')
        files = [(p.name, p.source) for p in self.pictures if p.source is not None and texture is None]
        return messages + copy_beside(files, self.path.parent, path.parent)

    @property
    def _line_end(self):
        header = self._data[:self._body]
        return b'\r\n' if b'\r\n' in header else b'\n' if b'\n' in header else b'\r'

    def _new_header(self, path, face, kind, faces, vertices, texture):
        lines, out, current = self._header, [], None
        names = [i for i, line in enumerate(lines) if line.split()[:2] == ['comment', 'TextureFile']]
        shows = None if texture is None else 'comment TextureFile ' + relative(
            texture, path.parent).encode('utf-8', 'surrogateescape').decode('latin1')  # as all lines are kept
        names_of = {kind: name for name, kind in reversed(_TYPES.items())}
        coordinates = f'property list {names_of[kind[1]]} {names_of[kind[0]]} texcoord'
        for i, line in enumerate(lines):
            words = line.split()
            if words[:1] in (['element'], ['end_header']):
                if current == 'face' and 'texcoord' not in face.types:
                    out.append(coordinates)
                current = words[1] if words[0] == 'element' else None
                if current == 'face':
                    line = f'element face {faces}'
                elif current == 'vertex' and vertices:
                    line = f'element vertex {int(words[2]) + vertices}'
            elif current == 'face' and words[:1] == ['property'] and words[-1] == 'texcoord':
                line = line if face.types['texcoord'] == kind else coordinates
            if shows and i in names:
                continue
            out.append(line)
            if shows and words[:1] == ['format']:
                out.append(shows)
        end = self._line_end.decode()
        return (end.join(out) + end).encode('latin1')

    def _spans(self, element):
        """By property, where in `data` it begins and ends in each row: two (n,)."""
        at, spans = element.row_begins()[:-1], {}
        if self._order is None:
            text = np.frombuffer(self._data, np.uint8, element.end - element.begin, element.begin)
            words = np.flatnonzero(word_starts(text)) + element.begin
            ends = element.end - np.flatnonzero(word_starts(text[::-1]))[::-1]
            at = np.searchsorted(words, at)
        for name, (t, l) in element.types.items():
            count = 0 if l is None else np.asarray(element.columns[name][0])
            if self._order is None:
                stop = at + 1 + count
                spans[name] = words[at], ends[stop - 1]
            else:
                size = np.dtype(t).itemsize
                stop = at + (size if l is None else np.dtype(l).itemsize + size * count)
                spans[name] = at, stop
            at = stop
        return spans

    def _face_rows(self, face, kind, new, zero):
        """The rows of faces with texcoord, which keeps its place or is the last."""
        text = self._order is None
        spans = self._spans(face)
        row_begin, row_end = next(iter(spans.values()))[0], list(spans.values())[-1][1]
        begin, end = spans.get('texcoord', (row_end, row_end))
        stays, count = ~new.torn, np.diff(self.starts)
        uv = new.corner_uv if stays.all() else new.corner_uv[np.repeat(stays, count)]
        lead = ' ' if text and 'texcoord' not in spans else ''
        edits = [(begin[stays], end[stays], *self._listed(uv, count[stays], kind, lead))]
        number = b''
        if zero and face.types.get('texnumber', ('', 1))[1] is None:
            begin, end = spans['texnumber']
            number = b'0' if text else bytes(np.dtype(face.types['texnumber'][0]).itemsize)
            kept = int(stays.sum())
            edits.append((begin[stays], end[stays], np.full(kept, len(number)),
                          np.frombuffer(number * kept, np.uint8)))
        of_faces = np.frombuffer(self._data, np.uint8, face.end - face.begin, face.begin)
        if face.table is not None and stays.all():  # the same places in every row
            old, pieces, at = of_faces.reshape(face.count, -1), [], 0
            for begin, end, _, content in sorted(edits, key=lambda edit: edit[0][0]):
                pieces += [old[:, at:begin[0] - face.begin], content.reshape(face.count, -1)]
                at = end[0] - face.begin
            return np.concatenate([*pieces, old[:, at:]], 1).tobytes()
        rows = []
        for p in np.flatnonzero(new.torn):
            row = {name: self._data[b[p]:e[p]] for name, (b, e) in spans.items()}
            if number:
                row['texnumber'] = number
            rows.append((self._line_end if text else b'').join(
                self._row(row, face, new.vertices[k], new.uv[k], kind) for k in new.triangles(p)))
        edits.append((row_begin[new.torn], row_end[new.torn], np.array([len(r) for r in rows], np.int64),
                      np.frombuffer(b''.join(rows), np.uint8)))
        return spliced(of_faces, *((b - face.begin, e - face.begin, *what) for b, e, *what in edits))[0]

    def _listed(self, uv, count, kind, lead=''):
        """Coordinates (C, 2) of polygons with so many corners as lists: their lengths, and all as uint8."""
        if self._order is None:
            number = ' %.9g' if kind[0] == 'f4' else ' %.17g'
            forms = {n: f'{lead}{2 * n}' + number * (2 * n) for n in np.unique(count).tolist()}
            lists = '\n'.join([forms[n] for n in count.tolist()]) % tuple(uv.ravel().tolist())
            lengths = np.array([len(one) for one in lists.split('\n')][:len(count)], np.int64)
            return lengths, np.frombuffer(lists.replace('\n', '').encode(), np.uint8)
        heads = (2 * count).astype(self._order + kind[1])
        values = np.ascontiguousarray(uv, self._order + kind[0])
        if len(count) and count.min() == count.max():
            lists = np.concatenate([a.view(np.uint8).reshape(len(count), -1) for a in (heads, values)], 1)
            return np.full(len(count), lists.shape[1]), lists.ravel()
        sizes = 2 * np.dtype(kind[0]).itemsize * count
        at, of_head = np.cumsum(sizes) - sizes, np.full(len(count), heads.itemsize)
        lists, _ = spliced(values.view(np.uint8).ravel(), (at, at, of_head, heads.view(np.uint8)))
        return sizes + heads.itemsize, np.frombuffer(lists, np.uint8)

    def _row(self, row, face, vertices, uv, kind):
        """(bytes) A row of bytes by property with another triangle."""
        t, l = face.types[self._indices]
        _, listed = self._listed(uv, np.array([3]), kind)
        new = {**row, 'texcoord': listed.tobytes(), self._indices: b'3 %d %d %d' % tuple(vertices)}
        if self._order is not None:
            new[self._indices] = (np.array(3, self._order + l).tobytes() +
                                  vertices.astype(self._order + t).tobytes())
        return (b' ' if self._order is None else b'').join(new.values())

    def _new_vertices(self, element, new):
        """Rows of the vertices that a refinement adds: what lies at the corners of the face, mixed."""
        t, k = new.samples.T
        corners, weights = self.faces[new.origin[t]], new.weights[t, k]
        nearest = corners[np.arange(len(t)), weights.argmax(1)]
        columns = {}
        for name, (kind, l) in element.types.items():
            if l is None:
                columns[name] = mixed(np.asarray(element.columns[name])[corners], weights)
        for axis, name in enumerate('xyz'):
            columns[name] = new.points[:, axis].astype(element.types[name][0])
        spans, rows = self._spans(element), []
        gap, line_end = (b' ', self._line_end) if self._order is None else (b'', b'')
        for i, vertex in enumerate(nearest):
            row = {name: self._data[b[vertex]:e[vertex]] for name, (b, e) in spans.items()}
            for name, values in columns.items():
                kind = element.types[name][0]
                form = '%.9g' if kind == 'f4' else '%.17g' if kind == 'f8' else '%d'
                row[name] = ((form % values[i]).encode() if self._order is None else
                             np.array(values[i], self._order + kind).tobytes())
            rows.append(gap.join(row.values()) + line_end)
        return b''.join(rows)


def _name(text):
    """The name of a file that a line of the header says."""
    raw = text.encode('latin1')
    try:
        return raw.decode('utf-8')
    except UnicodeDecodeError:
        return text


def _typed(values, kind):
    return values.astype(kind) if kind[0] == 'f' else whole(values, kind)


def _spread(begin, counts, size):
    """Where the values of lists lie, which begin at `begin`."""
    total = int(counts.sum())
    inner = np.arange(total) - np.repeat(np.cumsum(counts) - counts, counts)
    return np.repeat(begin, counts) + inner * size


def _colours(element):
    for lead in ('', 'diffuse_'):
        names = [lead + c for c in ('red', 'green', 'blue')]
        if all(n in element.types and element.types[n][1] is None for n in names):
            if 'alpha' in element.types and element.types['alpha'][1] is None:
                names.append('alpha')
            columns = []
            for n in names:
                values = np.asarray(element.columns[n])
                kind = element.types[n][0]
                columns.append(values.astype(np.float32) / (1 if kind[0] == 'f' else np.iinfo(kind).max))
            if len(columns) == 3:
                columns.append(np.ones(element.count, np.float32))
            return np.clip(np.nan_to_num(np.stack(columns, 1)), 0, 1)
    return None


def plain(mesh):
    """(bytes) A binary PLY of the mesh's triangles, which MeshLab reads, without texture coordinates."""
    single = np.array_equal(mesh.vertices.astype('f4').astype('f8'), mesh.vertices)
    kind, word = ('<f4', 'float') if single else ('<f8', 'double')
    fields, header = [(p, kind) for p in 'xyz'], [f'property {word} {p}' for p in 'xyz']
    if mesh.vertex_colours is not None:
        fields += [(p, 'u1') for p in ('red', 'green', 'blue', 'alpha')]
        header += [f'property uchar {p}' for p in ('red', 'green', 'blue', 'alpha')]
    table = np.zeros(len(mesh.vertices), fields)
    for k, p in enumerate('xyz'):
        table[p] = mesh.vertices[:, k]
    if mesh.vertex_colours is not None:
        for k, p in enumerate(('red', 'green', 'blue', 'alpha')):
            table[p] = np.rint(mesh.vertex_colours[:, k] * 255)
    faces = np.zeros(len(mesh.faces), [('n', 'u1'), ('v', '<i4', 3)])
    faces['n'], faces['v'] = 3, mesh.faces
    lines = ['ply', 'format binary_little_endian 1.0', f'element vertex {len(mesh.vertices)}', *header,
             f'element face {len(faces)}', 'property list uchar int vertex_indices', 'end_header', '']
    return '\n'.join(lines).encode() + table.tobytes() + faces.tobytes()
