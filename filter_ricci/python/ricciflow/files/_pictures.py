# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of meshes: read when they are asked for, by Pillow where it is installed, else PNG only."""

import io
import struct
import zlib
from pathlib import Path

import numpy as np

from ._shared import FileError, write_file

MOST_TEXELS = 1 << 28
"""More in one picture are refused: a file of a few bytes can claim any size."""


class Picture:
    """A picture that a mesh shows; `source` is its path, its bytes, or None where it was not found."""

    def __init__(self, name, source):
        self.name = name
        self.source = source

    def bytes(self):
        """The file of the picture."""
        if self.source is None:
            raise FileError(f'the picture {self.name} is not beside the mesh')
        return self.source.read_bytes() if isinstance(self.source, Path) else bytes(self.source)

    def read(self):
        """(height, width, 4) uint8 or uint16, the first row at the top."""
        return decode(self.bytes(), self.name)


def decode(data, name):
    """(height, width, 4) uint8, or uint16 where the picture has 16 bits."""
    try:
        if data[:8] == b'\x89PNG\r\n\x1a\n':
            if data[24:25] == b'\x10':
                return _decode_png(data)  # Pillow would drop 8 of the 16 bits
        try:
            from PIL import Image
        except ImportError:
            if data[:8] == b'\x89PNG\r\n\x1a\n':
                return _decode_png(data)
            raise FileError(f'the picture {name} is not a PNG: to read it, install Pillow '
                            '(pip install Pillow)') from None
        with Image.open(io.BytesIO(data)) as image:
            if image.width * image.height > MOST_TEXELS:
                raise FileError(f'the picture {name} claims {image.width} x {image.height} texels')
            bits = image.tag_v2.get(258, (8,)) if image.format == 'TIFF' else (8,)
            if max(bits) > 8 and len(bits) > 1:
                raise FileError(f'the picture {name} is a TIFF with {max(bits)} bits and colours, of which '
                                'Pillow reads 8: save it as PNG')
            if image.mode.startswith('I;16'):
                grey = np.array(image).astype(np.uint16)
                return np.dstack([grey, grey, grey, np.full_like(grey, 65535)])
            if image.mode in ('I', 'F'):
                raise FileError(f'the picture {name} has 32 bits per texel: save it with 8 or 16')
            return np.array(image.convert('RGBA'))
    except FileError as error:
        raise FileError(str(error) if name in str(error) else f'the picture {name}: {error}') from None
    except Exception as error:  # Pillow's readers raise anything
        reason = error if '<_io' not in str(error) else 'Pillow does not know its format, or it is damaged'
        raise FileError(f'the picture {name} cannot be read: {reason}') from error


def write(path, picture, quality=95):
    """Writes (height, width, 3 or 4) uint8 or uint16 in the format of the path's ending.

    Args:
        quality: of JPEG and lossy WebP, 1 to 100.
    """
    path, picture = Path(path), np.asarray(picture)
    if path.suffix.lower() == '.png':
        return write_file(path, encode_png(picture))
    if picture.dtype == np.uint16:
        raise FileError(f'{path.name}: a picture with 16 bits can be written as PNG only')
    try:
        from PIL import Image
    except ImportError:
        raise FileError(f'{path.name}: to write other pictures than PNG, install Pillow '
                        '(pip install Pillow)') from None
    image, out = Image.fromarray(picture), io.BytesIO()
    suffix = path.suffix.lower()
    if suffix in ('.jpg', '.jpeg', '.bmp'):
        image = image.convert('RGB')
    options = {'quality': quality, 'subsampling': 0} if suffix in ('.jpg', '.jpeg') else {}
    if suffix == '.webp':
        options = {'lossless': quality == 100, 'quality': quality}
    try:
        image.save(out, Image.registered_extensions()[suffix], **options)
    except (KeyError, OSError, ValueError) as error:
        raise FileError(f'{path.name}: Pillow cannot write such a picture ({error})') from error
    return write_file(path, out.getvalue())


def encode_png(picture):
    """(bytes) The PNG of (height, width, 3 or 4) uint8 or uint16."""
    height, width, channels = picture.shape
    rows = picture.astype(picture.dtype.newbyteorder('>')).reshape(height, -1).view(np.uint8)
    size = channels * picture.dtype.itemsize
    filtered = rows.copy()
    filtered[:, size:] -= rows[:, :-size]  # filter 1: less the texel to the left
    body = np.c_[np.ones(height, np.uint8), filtered].tobytes()
    head = struct.pack(
        '>IIBBBBB', width, height, picture.dtype.itemsize * 8, 2 if channels == 3 else 6, 0, 0, 0)

    def chunk(kind, content):
        return (
            struct.pack('>I', len(content)) + kind + content + struct.pack('>I', zlib.crc32(kind + content)))

    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', head) + chunk(b'IDAT', zlib.compress(body, 6)) +
            chunk(b'IEND', b''))


def _decode_png(data):
    chunks, at = {}, 8
    while at + 8 <= len(data):
        length, kind = struct.unpack('>I4s', data[at:at + 8])
        chunks.setdefault(kind, []).append(data[at + 8:at + 8 + length])
        at += length + 12
    width, height, depth, colour, _, _, interlaced = struct.unpack('>IIBBBBB', chunks[b'IHDR'][0][:13])
    channels = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}.get(colour)
    if interlaced or channels is None or depth not in (1, 2, 4, 8, 16):
        raise FileError('an interlaced or damaged PNG, which only Pillow reads')
    if not 0 < width * height <= MOST_TEXELS:
        raise FileError(f'claims {width} x {height} texels')
    line = (width * channels * depth + 7) // 8
    inflate = zlib.decompressobj()
    raw = inflate.decompress(b''.join(chunks.get(b'IDAT', [])), (line + 1) * height)
    if len(raw) < (line + 1) * height:
        raise FileError('a PNG that is cut off')
    raw = np.frombuffer(raw, np.uint8).reshape(height, line + 1)
    rows = _unfiltered(raw[:, 0], raw[:, 1:], max(channels * depth // 8, 1))
    if depth == 16:
        values, most = rows.view('>u2').astype(np.uint16), 65535
    else:
        bits = np.unpackbits(rows, axis=1)[:, :width * channels * depth].reshape(height, -1, depth)
        values = (bits * (1 << np.arange(depth - 1, -1, -1))).sum(2).astype(np.uint8)
        most = 255
    values = values.reshape(height, width, channels)
    clear = chunks.get(b'tRNS', [b''])[0]
    if colour == 3:
        palette = np.zeros((256, 4), np.uint8)
        entries = np.frombuffer(chunks[b'PLTE'][0], np.uint8).reshape(-1, 3)
        palette[:len(entries), :3], palette[:, 3] = entries, 255
        palette[:len(clear), 3] = np.frombuffer(clear, np.uint8)
        return palette[values[..., 0]]
    alpha = np.full((height, width), most, values.dtype)
    if clear and colour in (0, 2):
        alpha[(values == np.frombuffer(clear, '>u2')).all(2)] = 0
    if depth < 8:
        values = values * (255 // ((1 << depth) - 1))
    if channels in (2, 4):
        alpha = values[..., -1]
    rgb = values[..., :3] if channels > 2 else np.repeat(values[..., :1], 3, 2)
    return np.dstack([rgb, alpha]).astype(values.dtype)


def _unfiltered(kinds, raw, size):
    """Rows of bytes from those that PNG's filters left, along the diagonals of the picture at once."""
    height, line = raw.shape
    width = line // size
    if (kinds > 4).any():
        raise FileError('a damaged PNG')
    texels = raw[:, :width * size].reshape(height, width, size).astype(np.int16)
    out = np.zeros((height + 1, width + 1, size), np.int16)  # a row and column of zeros before
    for diagonal in range(height + width - 1):
        y = np.arange(max(0, diagonal - width + 1), min(height, diagonal + 1))
        x = diagonal - y
        left, up, corner = out[y + 1, x], out[y, x + 1], out[y, x]
        kind = kinds[y, None]
        by_left, by_up, by_corner = np.abs(up - corner), np.abs(left - corner), np.abs(left + up - 2 * corner)
        paeth = np.where(
            (by_left <= by_up) & (by_left <= by_corner), left, np.where(by_up <= by_corner, up, corner))
        guess = np.select(
            [kind == 1, kind == 2, kind == 3, kind == 4], [left, up, (left + up) >> 1, paeth], 0)
        out[y + 1, x + 1] = (texels[y, x] + guess) & 255
    return out[1:, 1:].astype(np.uint8).reshape(height, -1)
