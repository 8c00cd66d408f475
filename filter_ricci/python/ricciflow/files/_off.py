# SPDX-License-Identifier: GPL-3.0-or-later
"""OFF, ascii, with colours and normals, which is read only: few programs read its texture coordinates."""

import re

import numpy as np

from ._shared import FileError, MeshFile
from ._text import Lines, numbers, whole, without_comments, words_of_lines

_HEAD = re.compile(rb'(ST)?(C)?(N)?(4)?(n)?OFF(\s+BINARY)?')


class OffFile(MeshFile):
    """An OFF, which has one part."""

    def __init__(self, path, data=None):
        super().__init__(path)
        data = self.path.read_bytes() if data is None else data
        data = without_comments(data)
        head = _HEAD.match(data.lstrip())
        if head:
            if head[4] or head[5] or head[6]:
                self._fail(f'{head[0].decode()} is not supported: only three coordinates as text are read')
            data = data.lstrip()[head.end():]
        counts = re.match(rb'\s*(\d{1,18})\s+(\d{1,18})(?:\s+\d+)?', data)
        if not counts:
            self._fail('not an OFF file: the numbers of vertices and faces are missing')
        vertices, faces = int(counts[1]), int(counts[2])
        data = data[counts.end():]
        if 6 * vertices + 2 * faces - 1 > len(data):
            self._fail(f'the file ends within its {vertices} vertices and {faces} faces')
        normals = 3 if head and head[3] else 0
        if not self._read_lines(data, vertices, faces, normals):
            self._read_words(data, vertices, faces)

    def _fail(self, what):
        raise FileError(f'{self.path.name}: {what}')

    def _read_lines(self, data, vertices, faces, normals):
        """One row in each line, as all programs write it; False if it is otherwise."""
        lines = Lines(data)
        used = np.flatnonzero(lines.word < lines.end)
        if len(used) < vertices + faces:
            return False
        text, _ = lines.text(used[:vertices])
        values = numbers(text.tobytes())
        if vertices and (len(values) % vertices or len(values) < 3 * vertices):
            return False
        values = values.reshape(vertices, len(values) // vertices if vertices else 3)
        self.vertices = np.ascontiguousarray(values[:, :3])
        colours = values[:, 3 + normals:7 + normals]
        if colours.shape[1] >= 3:
            self.vertex_colours = _colours(colours)
        text, begin = lines.text(used[vertices:vertices + faces])
        count = words_of_lines(text, begin)
        content = text.tobytes()
        values = numbers(content, np.int64)
        if len(values) != count.sum():
            values = numbers(content)
            if len(values) != count.sum():
                self._fail('a face has a word that is not a number')
        if faces and count.min() == count.max() == 4 and (values[::4] == 3).all():
            self.set_polygons(values.reshape(-1, 4)[:, 1:])
            return True
        begin = np.cumsum(count) - count
        corners = whole(values[begin])
        if faces and not ((corners >= 0) & (corners < count)).all():
            return False
        starts = np.r_[0, np.cumsum(corners)]
        place = np.repeat(begin + 1 - starts[:-1], corners) + np.arange(starts[-1])
        self.set_polygons(values[place], starts)
        rest = count - corners - 1
        if faces and ((rest == 3) | (rest == 4)).all() and rest.min() == rest.max():
            extra = values[(begin + 1 + corners)[:, None] + np.arange(rest[0])]
            self.face_colours = _colours(extra)[self.polygon]
        return True

    def _read_words(self, data, vertices, faces):
        """Rows that are not by lines, without colours."""
        values = numbers(data)
        if len(values) < 3 * vertices + faces:
            self._fail(f'the file ends within its {vertices} vertices and {faces} faces')
        self.vertices = values[:3 * vertices].reshape(-1, 3).copy()
        rest = values[3 * vertices:].tolist()
        at, corners, starts = 0, [], [0]
        for _ in range(faces):
            if at >= len(rest) or not 0 <= rest[at] <= len(rest) - at - 1:
                self._fail(f'the file ends within its {faces} faces')
            count = int(rest[at])
            corners += rest[at + 1:at + 1 + count]
            starts.append(len(corners))
            at += 1 + count
        self.set_polygons(np.array(corners), np.array(starts))


def _colours(values):
    values = np.nan_to_num(values.astype(np.float64))
    if (values > 1).any():
        values = values / 255
    result = np.ones((len(values), 4), np.float32)
    result[:, :values.shape[1]] = np.clip(values, 0, 1)
    return result
