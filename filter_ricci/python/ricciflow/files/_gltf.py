# SPDX-License-Identifier: GPL-3.0-or-later
"""glTF 2.0 and GLB. Written again, vertices are split at the new seams; every attribute follows bit by bit.

The JSON stays as it is except for primitives that get coordinates. What they used alone gives its number to
what takes its place, so that nothing else is renumbered.
"""

import base64
import copy
import json
import struct
from functools import cached_property
from pathlib import Path
from urllib.parse import unquote

import numpy as np

from . import _pictures
from ._shared import (FileError, MeshFile, Part, beside, copy_beside, counted, linear_to_srgb, mixed,
                      relative, remarks, srgb_to_linear, write_file)

_KINDS = {5120: 'i1', 5121: 'u1', 5122: '<i2', 5123: '<u2', 5125: '<u4', 5126: '<f4'}
_WIDTHS = {'SCALAR': 1, 'VEC2': 2, 'VEC3': 3, 'VEC4': 4, 'MAT2': 4, 'MAT3': 9, 'MAT4': 16}
_TRIANGLES = (4, 5, 6)
# Extensions that refer to no accessor and no buffer view, and may be required: they change no triangle.
_PLAIN = ('KHR_materials_', 'KHR_texture_', 'KHR_lights_', 'KHR_mesh_quantization', 'KHR_animation_pointer',
          'KHR_xmp', 'KHR_node_visibility', 'EXT_texture_')
_COMPRESSED = {'KHR_draco_mesh_compression': 'Draco', 'EXT_meshopt_compression': 'meshopt',
               'KHR_meshopt_compression': 'meshopt'}


def _guarded(function):
    """What goes wrong with JSON of any kind is an error of the file."""
    def call(self, *args, **options):
        try:
            return function(self, *args, **options)
        except FileError:
            raise
        except (KeyError, IndexError, TypeError, ValueError, AttributeError, OverflowError, struct.error,
                RecursionError, ZeroDivisionError) as error:
            raise FileError(f'{self.path.name} is damaged: {type(error).__name__} {error}') from error
    call.__doc__ = function.__doc__
    return call


class _Primitive:
    """Triangles of one primitive: which of `faces`, as its accessors count vertices, and as shown."""

    def __init__(self, mesh, number, faces, triangles, turned):
        self.mesh, self.number, self.faces, self.triangles, self.turned = (
            mesh,
            number,
            faces,
            triangles,
            turned,
        )
        self.shown = triangles[:, [0, 2, 1]] if turned else triangles


class GltfFile(MeshFile):
    """A glTF or GLB; each of its meshes is a part with a space of its own."""

    split = True
    linear = True

    @_guarded
    def __init__(self, path, data=None):
        super().__init__(path)
        data = self.path.read_bytes() if data is None else data
        self._most = 10 * len(data) + (64 << 20)  # bytes that an accessor without data may claim
        self._binary = data[:4] == b'glTF'
        body = None
        if self._binary:
            data, body = self._chunks(data)
        self.json = json.loads(data.decode('utf-8-sig'))
        if not str(self.json.get('asset', {}).get('version', '')).startswith('2'):
            raise FileError(f'{self.path.name} is not glTF 2.0')
        self._check_extensions()
        self._buffers = [self._buffer(i, b, body) for i, b in enumerate(self.json.get('buffers', []))]
        self._read_pictures()
        self._read_meshes()

    # Reading

    def _chunks(self, data):
        _, version, _ = struct.unpack('<4sII', data[:12])
        if version != 2:
            raise FileError(f'{self.path.name} is a GLB of version {version}, not 2')
        data = memoryview(data)  # no copies
        at, text, body = 12, None, None
        while at + 8 <= len(data):
            length, kind = struct.unpack('<I4s', data[at:at + 8])
            content = data[at + 8:at + 8 + length]
            if len(content) < length:
                raise FileError(f'{self.path.name} is cut off')
            text = content if kind == b'JSON' and text is None else text
            body = content if kind == b'BIN\0' and body is None else body
            at += 8 + length
        if text is None:
            raise FileError(f'{self.path.name} is cut off')
        return bytes(text), body

    def _check_extensions(self):
        required = self.json.get('extensionsRequired', [])
        for name in required:
            self._refuse_compressed(name)
            if not name.startswith(_PLAIN):
                raise FileError(f'{self.path.name} needs the glTF extension {name}, which is not known here')

    def _refuse_compressed(self, extension):
        if extension in _COMPRESSED:
            raise FileError(f'{self.path.name} is compressed with {_COMPRESSED[extension]} ({extension}), '
                            'which is not read here: export it without compression')

    def _buffer(self, number, buffer, body):
        uri, length = buffer.get('uri'), buffer['byteLength']
        if uri is None:
            content = body if number == 0 else None
        elif uri.startswith('data:'):
            content = base64.b64decode(uri.split(',', 1)[1])
        else:
            file = beside(self.path.parent, unquote(uri))
            content = file and file.read_bytes()
        if content is None or len(content) < length:
            if content is None and any('meshopt' in n for n in self.json.get('extensionsUsed', [])):
                return b''  # to be filled by what is compressed
            raise FileError(f'{self.path.name}: the data {uri or "of buffer %d" % number} is '
                            f'{"missing" if content is None else "cut off"}')
        return content

    def _view(self, number, offset, count, size):
        """(count, size) bytes of a buffer view."""
        view = self.json['bufferViews'][number]
        for name in view.get('extensions', {}):
            self._refuse_compressed(name)
        stride = view.get('byteStride', size)
        begin = view.get('byteOffset', 0) + offset
        buffer = self._buffers[view['buffer']]
        stop = begin + stride * (count - 1) + size
        if min(offset, begin, count, stride) < 0 or count and (
                stop > len(buffer) or stop - view.get('byteOffset', 0) > view['byteLength']):
            raise FileError(f'{self.path.name} is damaged: an accessor goes beyond buffer view {number}')
        if not count:
            return np.zeros((0, size), np.uint8)
        flat = np.frombuffer(buffer, np.uint8, stop - begin, begin)
        return np.lib.stride_tricks.as_strided(flat, (count, size), (stride, 1))

    def _raw(self, number):
        """(count, bytes of an element); no value is changed."""
        accessor = self.json['accessors'][number]
        if number < 0:
            raise IndexError('accessor', number)
        kind, count = np.dtype(_KINDS[accessor['componentType']]), accessor['count']
        size = kind.itemsize * _WIDTHS[accessor['type']]
        if 'bufferView' in accessor:
            rows = self._view(accessor['bufferView'], accessor.get('byteOffset', 0), count, size)
        else:
            if not 0 <= count * size <= self._most:
                raise FileError(f'{self.path.name} is damaged: accessor {number} claims {count} elements')
            rows = np.zeros((count, size), np.uint8)
        if 'sparse' in accessor:
            sparse = accessor['sparse']
            at, new = sparse['indices'], sparse['values']
            index_kind = np.dtype(_KINDS[at['componentType']])
            index = self._view(
                at['bufferView'], at.get('byteOffset', 0), sparse['count'], index_kind.itemsize)
            rows = rows.copy()
            rows[np.ascontiguousarray(index).view(index_kind).ravel()] = self._view(
                new['bufferView'], new.get('byteOffset', 0), sparse['count'], size)
        return rows

    def _values(self, number):
        """(count, width) numbers, normalised where the accessor says so."""
        accessor = self.json['accessors'][number]
        values = np.ascontiguousarray(self._raw(number)).view(_KINDS[accessor['componentType']])
        if accessor.get('normalized') and values.dtype.kind in 'iu':
            return np.maximum(values / np.iinfo(values.dtype).max, -1.0)
        return values

    def _triangles(self, primitive):
        """(f, 3) numbers of vertices as the accessors count them."""
        count = self.json['accessors'][primitive['attributes']['POSITION']]['count']
        if 'indices' in primitive:
            index = self._values(primitive['indices']).ravel()
            if index.dtype.kind not in 'iu':
                raise FileError(f'{self.path.name} is damaged: indices that are not whole numbers')
            if len(index) and int(index.max()) >= count:
                raise FileError(
                    f'{self.path.name}: {counted(int((index >= count).sum()), "corner")} of faces name a '
                    f'vertex beyond the {count} of the primitive')
            index = index.view(np.int32) if index.dtype == np.uint32 else index.astype(np.int32)
        else:
            index = np.arange(count, dtype=np.int32)
        mode = primitive.get('mode', 4)
        if mode == 4:
            if len(index) % 3:
                self.messages.append(
                    f'{len(index) % 3} indices after the last triangle of a primitive left out')
            return index[:len(index) // 3 * 3].reshape(-1, 3)
        if len(index) < 3:
            return np.zeros((0, 3), np.int32)
        if mode == 6:
            return np.c_[index[1:-1], index[2:], np.full(len(index) - 2, index[0])]
        triangles = np.c_[index[:-2], index[1:-1], index[2:]]
        triangles[1::2] = triangles[1::2, [0, 2, 1]]
        return triangles

    def _places(self):
        """For each mesh the matrices of the nodes that show it."""
        nodes, places = self.json.get('nodes', []), {}
        children = {c for n in nodes for c in n.get('children', [])}
        stack = [(i, np.eye(4)) for i in range(len(nodes)) if i not in children]
        seen = set()
        while stack:
            i, above = stack.pop()
            if i in seen:
                continue
            seen.add(i)
            node = nodes[i]
            matrix = above @ _matrix(node)
            if 'mesh' in node:
                matrix_of = np.eye(4) if 'skin' in node else matrix
                places.setdefault(node['mesh'], []).append(matrix_of)
            stack += [(c, matrix) for c in reversed(node.get('children', []))]
        return places

    def _read_meshes(self):
        places = self._places()
        points, faces, self._primitives, self._colours_of = [], [], [], []
        vertex_count = face_count = 0
        for m, mesh in enumerate(self.json.get('meshes', [])):
            part = Part(mesh.get('name', f'mesh {m}'), slice(0), slice(0), places.get(m, [np.eye(4)]))
            turned, begin, first = part.mirrored, vertex_count, face_count
            bases = {}
            for n, primitive in enumerate(mesh['primitives']):
                if primitive.get('mode', 4) not in _TRIANGLES or 'POSITION' not in primitive['attributes']:
                    continue
                position = primitive['attributes']['POSITION']
                if 'bufferView' not in self.json['accessors'][position]:
                    for name in primitive.get('extensions', {}):
                        self._refuse_compressed(name)
                triangles = self._triangles(primitive)
                colour = primitive['attributes'].get('COLOR_0')
                key = position, colour, None if colour is None else primitive.get('material')
                if key not in bases:  # colours of vertices are multiplied by those of materials
                    bases[key] = vertex_count
                    xyz = self._values(position)
                    if xyz.shape[1:] != (3,):
                        raise FileError(f'{self.path.name} is damaged: positions that are not VEC3')
                    points.append(xyz * [-1, 1, 1] if turned else xyz)
                    self._colours_of.append((colour, len(xyz)))
                    vertex_count += len(xyz)
                stop = face_count + len(triangles)
                primitive = _Primitive(m, n, slice(face_count, stop), triangles, turned)
                self._primitives.append(primitive)
                base = bases[key]
                faces.append(primitive.shown + np.int32(base) if base else primitive.shown)
                face_count = stop
            if face_count > first:
                part.faces, part.vertices = slice(first, face_count), slice(begin, vertex_count)
                self.parts.append(part)
        if not points:
            return
        self.vertices = np.concatenate(points, dtype=np.float64)
        self.faces = faces[0] if len(faces) == 1 else np.concatenate(faces)
        self.diagonals = np.broadcast_to(np.False_, self.faces.shape)
        self.messages += remarks(self.vertices, self.faces)

    @cached_property
    @_guarded
    def _looks(self):
        """Of each primitive: old coordinates (vertices, 2) or None, its picture or -1, its factor."""
        return [self._look(p) for p in self._used()]

    @cached_property
    @_guarded
    @np.errstate(all='ignore')
    def uv(self):
        """As in MeshFile; read when it is asked for, as all below."""
        if all(uv is None for uv, _, _ in self._looks):
            return None
        return np.concatenate([np.full((len(p.shown), 3, 2), np.nan) if uv is None else uv[p.shown]
                               for p, (uv, _, _) in zip(self._primitives, self._looks)])

    @cached_property
    @_guarded
    def uv_picture(self):
        if self.uv is None:
            return None
        return self._of_faces([picture for _, picture, _ in self._looks], np.int32)

    @cached_property
    def material_colours(self):
        if all(p.get('material') is None for p in self._used()):
            return None
        return self._of_faces(linear_to_srgb([factor for _, _, factor in self._looks]), np.float32)

    @cached_property
    @_guarded
    @np.errstate(all='ignore')
    def vertex_colours(self):
        if all(number is None for number, _ in self._colours_of):
            return None
        return linear_to_srgb(np.concatenate([self._colours(*entry) for entry in self._colours_of]))

    def _of_faces(self, values, kind):
        """Of each triangle what is given for each primitive."""
        return np.repeat(np.asarray(values, kind), [len(p.triangles) for p in self._primitives], 0)

    def _used(self):
        return [self.json['meshes'][p.mesh]['primitives'][p.number] for p in self._primitives]

    def _colours(self, number, count):
        colours = np.ones((count, 4), np.float32)
        if number is not None:
            values = self._values(number)
            if len(values) != count or values.shape[1] not in (3, 4):
                raise FileError(f'{self.path.name} is damaged: colours that do not belong to the vertices')
            colours[:, :values.shape[1]] = np.clip(np.nan_to_num(values), 0, 1)
        return colours

    def _look(self, primitive):
        """Of a primitive: old coordinates (vertices, 2) or None, its picture or -1, its factor (linear)."""
        material = self.json['materials'][primitive['material']] if 'material' in primitive else {}
        pbr = material.get('pbrMetallicRoughness', {})
        texture, factor = pbr.get('baseColorTexture'), pbr.get('baseColorFactor', [1, 1, 1, 1])
        older = material.get('extensions', {}).get('KHR_materials_pbrSpecularGlossiness')
        if older is not None:
            texture, factor = older.get('diffuseTexture', texture), older.get('diffuseFactor', factor)
        factor = np.clip(np.array(factor, float), 0, 1)
        if factor.shape != (4,):
            raise FileError(f'{self.path.name} is damaged: a colour of a material')
        change = (texture or {}).get('extensions', {}).get('KHR_texture_transform', {})
        number = change.get('texCoord', (texture or {}).get('texCoord', 0))
        accessor = primitive['attributes'].get(f'TEXCOORD_{number}')
        if accessor is None:
            return None, -1, factor
        uv = self._values(accessor).astype(np.float64)
        if uv.shape != (self.json['accessors'][primitive['attributes']['POSITION']]['count'], 2):
            raise FileError(f'{self.path.name} is damaged: TEXCOORD_{number} does not belong to the vertices')
        if texture is None:
            return np.c_[uv[:, 0], 1 - uv[:, 1]], -1, factor
        angle = change.get('rotation', 0.0)
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])  # of rows
        uv = uv * change.get('scale', [1, 1]) @ turn + change.get('offset', [0, 0])
        entry = self.json['textures'][texture['index']]
        source = entry.get('source')
        for name in ('EXT_texture_webp', 'EXT_texture_avif', 'KHR_texture_basisu'):
            source = (
                entry.get('extensions', {}).get(name, {}).get('source', source) if source is None else source)
        return np.c_[uv[:, 0], 1 - uv[:, 1]], -1 if source is None else source, factor

    def _read_pictures(self):
        for i, image in enumerate(self.json.get('images', [])):
            uri = image.get('uri')
            name = image.get('name') or f'image {i}'
            if uri is None:
                view = self.json['bufferViews'][image['bufferView']]
                source = self._view(image['bufferView'], 0, 1, view['byteLength']).tobytes()
            elif uri.startswith('data:'):
                source = base64.b64decode(uri.split(',', 1)[1])
            else:
                name, source = unquote(uri), beside(self.path.parent, unquote(uri))
            self.pictures.append(_pictures.Picture(name, source))

    @_guarded
    @np.errstate(all='ignore')
    def corner_normals(self):
        result = np.full((len(self.faces), 3, 3), np.nan, np.float32)
        for primitive, p in zip(self._primitives, self._used()):
            if 'NORMAL' not in p['attributes']:
                return None
            normals = self._values(p['attributes']['NORMAL'])[primitive.triangles]
            if primitive.turned:
                normals = normals[:, [0, 2, 1]] * [-1, 1, 1]
            result[primitive.faces] = normals
        return result if len(self.faces) else None

    # Writing

    def holds(self, plain):
        return True

    def _same_format(self, path):
        return path.suffix.lower() in ('.glb', '.gltf')

    @_guarded
    def _patch(self, path, uv, texture, refined, uv_set):
        out = _Writer(self)
        messages = []
        material = None if texture is None else self._new_picture(out, path, texture)
        origin = None if refined is None else np.asarray(refined.origin)
        for primitive in self._primitives:
            if refined is None:
                mine = primitive.faces
                triangles, weights = primitive.triangles, None
                coordinates = uv[mine]
            else:
                mine = np.flatnonzero((origin >= primitive.faces.start) & (origin < primitive.faces.stop))
                triangles = primitive.triangles[origin[mine] - primitive.faces.start]
                weights, coordinates = refined.weights[mine], uv[mine]
            if primitive.turned:
                coordinates = coordinates[:, [0, 2, 1]]
                weights = None if weights is None else weights[:, [0, 2, 1]][:, :, [0, 2, 1]]
            if not len(triangles):
                continue
            new = out.json['meshes'][primitive.mesh]['primitives'][primitive.number]
            new.get('extensions', {}).pop('KHR_draco_mesh_compression', None)
            (number, said), attributes = self._set_number(new, uv_set, material), new['attributes']
            if said and said not in messages:
                messages.append(said)
            if material is not None:
                moved = material(new, number)
                if moved is not None:
                    attributes[f'TEXCOORD_{moved}'] = attributes['TEXCOORD_0']
            attributes.pop(f'TEXCOORD_{number}', None)
            flipped = (
                np.stack([coordinates[..., 0], 1 - coordinates[..., 1]], -1).astype('<f4').reshape(-1, 2))
            out.split(new, triangles, weights, flipped + np.float32(0), number)
        out.write(path)
        return messages + copy_beside(out.files, self.path.parent, path.parent)

    def _set_number(self, primitive, uv_set, material):
        """Which TEXCOORD_n a primitive gets, and a sentence or None."""
        present = primitive['attributes']
        if uv_set is not None:
            missing = [n for n in range(uv_set) if f'TEXCOORD_{n}' not in present]
            if missing or uv_set < 0:
                raise FileError(
                    f'{self.path.name}: TEXCOORD_{uv_set} cannot be written, since a primitive has no '
                    f'TEXCOORD_{missing[0] if missing else 0}')
            return int(uv_set), None
        if material is not None or 'TEXCOORD_0' not in present:
            return 0, None
        if 'TEXCOORD_1' not in present:
            return 1, None
        shown = self.json['materials'][primitive['material']] if 'material' in primitive else {}
        if all(t.get('texCoord', 0) != 1 for base in (True, False) for t in _textures(shown, base)):
            return 1, 'TEXCOORD_1, which no picture of the material used, is replaced'
        free = next(n for n in range(100) if f'TEXCOORD_{n}' not in present)
        return free, f'the coordinates are TEXCOORD_{free}, since pictures of the material use 0 and 1'

    def _new_picture(self, out, path, texture):
        """Adds the picture; a function that gives a primitive the material with it.

        The function returns the number that the old TEXCOORD_0 gets for the other pictures of its material,
        or None. Materials are copied, since others refer to them by number.
        """
        content = Path(texture).read_bytes()
        image = {'name': Path(texture).stem}
        kind = (
            'image/png' if content[:4] == b'\x89PNG' else 'image/jpeg' if content[:2] == b'\xff\xd8' else None
        )
        if path.suffix.lower() == '.gltf':
            image['uri'] = relative(texture, path.parent)
        else:
            if kind is None:
                picture = _pictures.decode(content, Path(texture).name)
                content, kind = _pictures.encode_png(picture), 'image/png'
            image.update(mimeType=kind, bufferView=out.view(content))
        out.json.setdefault('images', []).append(image)
        out.json.setdefault('textures', []).append({'source': len(out.json['images']) - 1})
        shown, materials, copies = len(out.json['textures']) - 1, out.json.setdefault('materials', []), {}

        def give(primitive, number):
            attributes, old = primitive['attributes'], primitive.get('material')
            others = 0
            if old is not None:
                others = sum(t.get('texCoord', 0) == 0 for t in _textures(materials[old], False))
            free = next(n for n in range(100) if f'TEXCOORD_{n}' not in attributes)
            moved = free if others and number == 0 and free else None
            if (old, number, moved) not in copies:
                new = copy.deepcopy(materials[old]) if old is not None else {'name': 'unwrapped'}
                pbr = new.setdefault('pbrMetallicRoughness', {})
                older = new.get('extensions', {}).pop('KHR_materials_pbrSpecularGlossiness', None)
                if 'baseColorTexture' not in pbr and 'diffuseTexture' not in (older or {}):
                    pbr.pop('baseColorFactor', None)  # it is in the picture now
                if 'metallicRoughnessTexture' not in pbr:
                    pbr.setdefault('metallicFactor', 0.0)
                if moved is not None:
                    for info in _textures(new, False):
                        if info.get('texCoord', 0) == 0:
                            info['texCoord'] = moved
                pbr['baseColorTexture'] = {'index': shown, **({'texCoord': number} if number else {})}
                materials.append(new)
                copies[old, number, moved] = len(materials) - 1
            if old is None or not any(True for _ in _textures(materials[old], True)):
                attributes.pop('COLOR_0', None)  # likewise
            primitive['material'] = copies[old, number, moved]
            return moved

        return give


class _Writer:
    """The file that is written: its JSON, and data in place of what patched primitives used alone."""

    def __init__(self, source):
        self.source = source
        self.json = copy.deepcopy(source.json)
        self.new = []  # (number of the view, bytes)
        self.files = []
        self._done = {}
        self._free_accessors, self._free_views = self._given_up()

    def _given_up(self):
        """Accessors and views that only primitives use that are rewritten."""
        data = self.source.json
        if not all(n.startswith(_PLAIN) for n in data.get('extensionsUsed', [])):
            return [], []  # an extension may refer to any
        rewritten = {(p.mesh, p.number) for p in self.source._primitives if len(p.triangles)}
        mine, others = set(), set()
        for m, mesh in enumerate(data.get('meshes', [])):
            for n, primitive in enumerate(mesh['primitives']):
                used = mine if (m, n) in rewritten else others
                for attributes in [primitive['attributes'], *primitive.get('targets', [])]:
                    used.update(attributes.values())
                if 'indices' in primitive:
                    used.add(primitive['indices'])
        for skin in data.get('skins', []):
            others.add(skin.get('inverseBindMatrices'))
        for animation in data.get('animations', []):
            for sampler in animation['samplers']:
                others.update((sampler['input'], sampler['output']))
        mine -= others

        def views(accessor):
            sparse = accessor.get('sparse', {})
            return {
                accessor.get('bufferView'),
                *(sparse[k]['bufferView'] for k in ('indices', 'values') if k in sparse),
            }

        kept = {image.get('bufferView') for image in data.get('images', [])}
        free = set()
        for i, accessor in enumerate(data.get('accessors', [])):
            (free if i in mine else kept).update(views(accessor))
        return sorted(mine, reverse=True), sorted(free - kept - {None}, reverse=True)

    def view(self, content, **members):
        """The number of a buffer view with these bytes."""
        views = self.json.setdefault('bufferViews', [])
        entry = {'buffer': -1, 'byteLength': len(content), **members}
        if self._free_views:
            number = self._free_views.pop()
            views[number] = entry
        else:
            number = len(views)
            views.append(entry)
        self.new.append((number, content))
        return number

    def _accessor(self, entry, rows, target):
        """The number of an accessor of rows (n, bytes of an element), each padded to whole words."""
        padded = rows if target == 34963 else np.pad(rows, ((0, 0), (0, -rows.shape[1] % 4)))
        members = {'target': target}
        if padded.shape[1] != rows.shape[1]:
            members['byteStride'] = padded.shape[1]
        accessor = {k: v for k, v in entry.items() if k not in ('bufferView', 'byteOffset', 'sparse')}
        accessor.update(
            bufferView=self.view(np.ascontiguousarray(padded).tobytes(), **members), count=len(rows))
        accessors = self.json.setdefault('accessors', [])
        if self._free_accessors:
            number = self._free_accessors.pop()
            accessors[number] = accessor
        else:
            number = len(accessors)
            accessors.append(accessor)
        return number

    def split(self, primitive, triangles, weights, uv, number):
        """Gives the primitive coordinates (3 f, 2) at corners; its other attributes follow the vertices.

        `primitive` names accessors of the source, and afterwards of this file.
        """
        source, corners = self.source, triangles.ravel().astype(np.int64)
        places = [primitive['attributes'], *primitive.get('targets', [])]
        raw = {a: source._raw(a) for d in places for a in d.values()}
        if any(len(rows) <= corners.max() for rows in raw.values()):
            raise FileError(f'{source.path.name} is damaged: attributes with fewer elements than vertices')
        at = uv.view(np.uint64).ravel()
        if weights is None:
            first, index = _distinct(corners, at)
            rows = {a: r[corners[first]] for a, r in raw.items()}
            key = corners[first].tobytes()
        else:
            rows = {a: self._mixed(a, r, triangles, weights, primitive) for a, r in raw.items()}
            whole = np.concatenate(
                [np.ascontiguousarray(r) for r in rows.values()] + [uv.view(np.uint8).reshape(-1, 8)], 1)
            _, first, index = np.unique(whole.view(np.dtype((np.void, whole.shape[1]))).ravel(),
                                        return_index=True, return_inverse=True)
            rows, key = {a: r[first] for a, r in rows.items()}, object()
        for d in places:
            for name, a in d.items():
                if (a, key) not in self._done:
                    entry = dict(source.json['accessors'][a])
                    values = np.ascontiguousarray(rows[a]).view(_KINDS[entry['componentType']])
                    for bound, find in (('min', np.min), ('max', np.max)):
                        if bound in entry:
                            entry[bound] = find(values, 0).tolist()
                    self._done[a, key] = self._accessor(entry, rows[a], 34962)
                d[name] = self._done[a, key]
        primitive['attributes'][f'TEXCOORD_{number}'] = self._accessor(
            {'componentType': 5126, 'type': 'VEC2'}, uv[first].view(np.uint8).reshape(-1, 8), 34962)
        small = len(first) < 65535
        index = index.ravel().astype('<u2' if small else '<u4')[:, None].view(np.uint8)
        primitive['indices'] = self._accessor(
            {'componentType': 5123 if small else 5125, 'type': 'SCALAR'}, index, 34963)
        primitive.pop('mode', None)

    def _mixed(self, number, raw, triangles, weights, primitive):
        """Rows of an attribute at corners of a refinement."""
        name = next((n for n, a in primitive['attributes'].items() if a == number), '')
        corners = triangles[:, None].repeat(3, 1).reshape(-1, 3)  # of the origin, at each corner
        weights = weights.reshape(-1, 3)
        nearest = corners[np.arange(len(corners)), weights.argmax(1)]
        if name.startswith(('JOINTS_', 'WEIGHTS_')):
            return raw[nearest]
        values = np.ascontiguousarray(raw).view(
            _KINDS[self.source.json['accessors'][number]['componentType']])
        result = mixed(values[corners], weights)
        if name in ('NORMAL', 'TANGENT') and result.dtype.kind == 'f':
            new = weights.max(1) < 1
            length = np.linalg.norm(result[new, :3], axis=1, keepdims=True)
            result[new, :3] /= np.where(length > 0, length, 1)
        if name == 'TANGENT':
            result[:, 3] = values[nearest, 3]
        return np.ascontiguousarray(result).view(np.uint8).reshape(len(result), -1)

    def write(self, path):
        """Packs the data: in a GLB all, in a glTF what is new."""
        data, source = self.json, self.source
        external = path.suffix.lower() == '.gltf'
        buffers = data.setdefault('buffers', [])
        new = dict(self.new)
        views = data.get('bufferViews', [])
        body, done = bytearray(), {}
        for number, view in enumerate(views):
            if number in new:
                content, key = new[number], None
            elif external:
                continue
            else:
                key = view['buffer'], view.get('byteOffset', 0), view['byteLength']
                content = source._buffers[key[0]][key[1]:key[1] + key[2]]
                if len(content) < key[2]:
                    raise FileError(
                        f'{source.path.name} is damaged: buffer view {number} goes beyond its buffer')
            if key is None or key not in done:
                body += bytes(-len(body) % 4)
                done[key] = len(body)
                body += content
            view['byteOffset'] = done[key] if key is not None else len(body) - len(content)
            view['buffer'] = len(buffers) if external else 0
        if external:
            for i, buffer in enumerate(buffers):
                uri = buffer.get('uri')
                if uri is None:
                    buffer['uri'] = _data_uri(source._buffers[i], 'application/octet-stream')
                elif not uri.startswith('data:'):
                    self.files.append((unquote(uri), beside(source.path.parent, unquote(uri))))
            if body:
                buffers.append({'byteLength': len(body), 'uri': _data_uri(body, 'application/octet-stream')})
            content = json.dumps(data, ensure_ascii=False, indent=1).encode()
        else:
            body += bytes(-len(body) % 4)
            first = {k: v for k, v in (buffers[0] if buffers else {}).items() if k != 'uri'}
            data['buffers'] = [{**first, 'byteLength': len(body)}] if body else []
            text = json.dumps(data, ensure_ascii=False, separators=(',', ':')).encode()
            text += b' ' * (-len(text) % 4)
            content = (
                struct.pack('<4sIII4s', b'glTF', 2, 28 + len(text) + len(body), len(text), b'JSON') + text)
            content += struct.pack('<I4s', len(body), b'BIN\0') + body
        for picture in source.pictures:
            if isinstance(picture.source, Path):
                self.files.append((picture.name, picture.source))
        write_file(path, content)


def _data_uri(content, kind):
    return f'data:{kind};base64,' + base64.b64encode(content).decode()


def _textures(material, base):
    """The texture infos of a material: of the base colour, or all others."""
    stack = [(k, v) for k, v in material.items() if k != 'extras']
    while stack:
        name, value = stack.pop()
        if isinstance(value, dict):
            if name.endswith('Texture') and 'index' in value:
                if (name in ('baseColorTexture', 'diffuseTexture')) == base:
                    yield value
            else:
                stack += value.items()


def _matrix(node):
    """(4, 4) of a node below the one above it."""
    if 'matrix' in node:
        return np.array(node['matrix'], float).reshape(4, 4).T
    x, y, z, w = node.get('rotation', (0, 0, 0, 1))
    turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    result = np.eye(4)
    result[:3, :3] = turn * np.array(node.get('scale', (1, 1, 1)), float)
    result[:3, 3] = node.get('translation', (0, 0, 0))
    return result


def _distinct(corners, uv):
    """Where each pair of a vertex and coordinates comes first, and the number of each corner's."""
    order = np.lexsort((uv, corners))
    a, b = corners[order], uv[order]
    new = np.r_[True, (a[1:] != a[:-1]) | (b[1:] != b[:-1])]
    index = np.empty(len(order), np.int64)
    index[order] = np.cumsum(new) - 1
    first = np.minimum.reduceat(order, np.flatnonzero(new))
    by_place = np.argsort(first)  # in the order of the faces, which caches of vertices like
    rank = np.empty_like(by_place)
    rank[by_place] = np.arange(len(by_place))
    return first[by_place], rank[index]


def plain(mesh):
    """(bytes) A GLB of the mesh without texture coordinates, all parts in one primitive."""
    colours, normals = mesh.corner_colours(), mesh.corner_normals()
    points = mesh.vertices[mesh.faces].reshape(-1, 3).astype('<f4')
    if not np.isfinite(points).all():
        raise FileError(
            f'{mesh.path.name} has coordinates that glTF cannot hold, which has finite floats only')
    keys = [mesh.faces.reshape(-1, 1).astype(np.uint32)]
    entries = [('POSITION', 'VEC3', points)]
    if normals is not None:
        length = np.linalg.norm(normals, axis=2, keepdims=True)
        if (length > 0).all() and np.isfinite(length).all():
            entries.append(('NORMAL', 'VEC3', (normals / length).reshape(-1, 3).astype('<f4')))
    if colours is not None:
        entries.append(('COLOR_0', 'VEC4', srgb_to_linear(colours).reshape(-1, 4).astype('<f4')))
    keys += [np.ascontiguousarray(v).view(np.uint32) for _, _, v in entries[1:]]
    key = np.ascontiguousarray(np.concatenate(keys, 1))
    _, first, index = np.unique(key.view(np.dtype((np.void, 4 * key.shape[1]))).ravel(), return_index=True,
                                return_inverse=True)
    body, views, accessors, attributes = b'', [], [], {}
    for name, kind, values in entries + [('', 'SCALAR', index.astype('<u4').reshape(-1, 1))]:
        values = np.ascontiguousarray(values[first] if name else values)
        views.append({'buffer': 0, 'byteOffset': len(body), 'byteLength': values.nbytes})
        accessors.append({'bufferView': len(views) - 1, 'componentType': 5126 if name else 5125,
                          'count': len(values), 'type': kind})
        if name == 'POSITION' and len(values):
            accessors[-1].update(min=values.min(0).tolist(), max=values.max(0).tolist())
        if name:
            attributes[name] = len(accessors) - 1
        body += values.tobytes()
    data = {'asset': {'version': '2.0', 'generator': 'ricciflow'}, 'scene': 0, 'scenes': [{'nodes': [0]}],
            'nodes': [{'mesh': 0, 'name': mesh.path.stem}], 'buffers': [{'byteLength': len(body)}],
            'bufferViews': views, 'accessors': accessors,
            'materials': [{'pbrMetallicRoughness': {'metallicFactor': 0.0}}],
            'meshes': [{'name': mesh.path.stem, 'primitives': [
                {'attributes': attributes, 'indices': len(accessors) - 1, 'material': 0}]}]}
    text = json.dumps(data).encode()
    text += b' ' * (-len(text) % 4)
    return (struct.pack('<4sIII4s', b'glTF', 2, 28 + len(text) + len(body), len(text), b'JSON') + text +
            struct.pack('<I4s', len(body), b'BIN\0') + body)
