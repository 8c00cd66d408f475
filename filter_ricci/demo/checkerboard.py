# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a checkerboard as PNG: checkerboard.py FILE. Standard library only."""

import struct
import sys
import zlib

SIZE, SQUARES = 1024, 32
LIGHT, DARK = (255, 255, 255), (140, 140, 140)


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def row(y):
    side = SIZE // SQUARES
    return b"\0" + b"".join(bytes(DARK if (x // side + y // side) % 2 else LIGHT) for x in range(SIZE))


with open(sys.argv[1], "wb") as out:
    out.write(b"\x89PNG\r\n\x1a\n")
    out.write(chunk(b"IHDR", struct.pack(">IIBBBBB", SIZE, SIZE, 8, 2, 0, 0, 0)))
    out.write(chunk(b"IDAT", zlib.compress(b"".join(row(y) for y in range(SIZE)), 9)))
    out.write(chunk(b"IEND", b""))
