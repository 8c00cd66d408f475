# SPDX-License-Identifier: GPL-3.0-or-later
"""STL, ascii and binary, which is read only: it cannot hold texture coordinates."""

import numpy as np

from ._shared import FileError, MeshFile
from ._text import Lines, numbers


class StlFile(MeshFile):
    """An STL; every triangle has vertices of its own."""

    split = True

    def __init__(self, path, data=None):
        super().__init__(path)
        data = self.path.read_bytes() if data is None else data
        count = int.from_bytes(data[80:84], 'little') if len(data) >= 84 else 0
        text = data.lstrip()[:5].lower() == b'solid'
        if len(data) >= 84 and (len(data) == 84 + 50 * count or not text):
            if len(data) < 84 + 50 * count:
                raise FileError(f'{self.path.name} ends within its {count} triangles')
            rows = np.frombuffer(data, np.uint8, 50 * count, 84).reshape(count, 50)
            points = np.ascontiguousarray(rows[:, 12:48]).view('<f4')
        elif text:
            points = self._read_text(data)
        else:
            raise FileError(f'{self.path.name} is not an STL file')
        self.vertices = points.reshape(-1, 3).astype(np.float64)
        self.set_polygons(np.arange(len(self.vertices), dtype=np.int32).reshape(-1, 3))

    def _read_text(self, data):
        lines = Lines(data)
        found = np.union1d(lines.beginning(b'vertex'), lines.beginning(b'VERTEX'))
        text, _ = lines.text(found, len('vertex'))
        values = numbers(text.tobytes())
        if len(values) != 3 * len(found) or len(found) % 3:
            for line in found:
                if len(numbers(lines.rest(line, 6))) != 3:
                    raise FileError(f'{self.path.name}: line {line + 1} is not a valid vertex: {lines.shown(line)}')
            raise FileError(f'{self.path.name} ends within a triangle')
        return values
