# SPDX-License-Identifier: GPL-3.0-or-later
"""3MF with its materials extension. Written again, only the tags of triangles and what they name change."""

import re
import zipfile
import zlib
from array import array
from io import BytesIO
from pathlib import Path
from xml.parsers import expat

import numpy as np

from . import _pictures
from ._shared import FileError, MeshFile, Part, counted, distinct, rewritten, write_file
from ._text import table

_MATERIALS = 'http://schemas.microsoft.com/3dmanufacturing/material/2015/02'
_TEXTURE = 'http://schemas.microsoft.com/3dmanufacturing/2013/01/3dtexture'
_RELATIONS = 'http://schemas.openxmlformats.org/package/2006/relationships'
_PRODUCTION = 'http://schemas.microsoft.com/3dmanufacturing/production/2015/06'
_PICTURE = '3D/Textures/unwrapped'


class _Object:
    """One object of a model: a mesh, or components."""

    def __init__(self, name, pid, pindex):
        self.name, self.pid, self.pindex = name, pid, pindex
        self.points, self.corners = array('d'), array('q')
        self.properties = []  # (triangle, pid or None, (p1, p2, p3)) of triangles that have some
        self.tags = array('q')  # where the tag of each triangle begins
        self.vertices_end = 0
        self.components = []  # (model or None, object, matrix)
        self.is_mesh = False


class _Model:
    """What one .model part says."""

    def __init__(self, name, data):
        self.name, self.data = name, data
        self.objects, self.items, self.ids = {}, [], {0}
        self.colours, self.textures, self.groups = {}, {}, {}  # by id: (n, 4); path; (texture, (n, 2))
        self.mixtures = {}  # by id: name of a kind that is not read
        self.first_object = None
        self._object = self._list = None
        parser = self._parser = expat.ParserCreate(namespace_separator=' ')
        parser.StartElementHandler, parser.EndElementHandler = self._start, self._end
        parser.StartDoctypeDeclHandler = self._doctype
        parser.buffer_text = True
        parser.Parse(data, True)

    def _doctype(self, *_):
        raise FileError('its model has a document type, which 3MF forbids')

    def _start(self, name, attributes):
        tag = name.rsplit(' ', 1)[-1]
        get = attributes.get
        if tag == 'vertex' and self._object:
            self._object.points.extend((float(get('x')), float(get('y')), float(get('z'))))
        elif tag == 'triangle' and self._object:
            mesh = self._object
            mesh.tags.append(self._parser.CurrentByteIndex)
            mesh.corners.extend((int(get('v1')), int(get('v2')), int(get('v3'))))
            if 'p1' in attributes or 'pid' in attributes:
                p = get('p1', '0')
                mesh.properties.append(
                    (len(mesh.tags) - 1, get('pid'), (int(p), int(get('p2', p)), int(get('p3', p)))))
        elif tag == 'object':
            self._object = self.objects[get('id')] = _Object(
                get('name', ''), get('pid'), int(get('pindex', 0)))
            if self.first_object is None:
                self.first_object = self._parser.CurrentByteIndex
        elif tag == 'mesh' and self._object:
            self._object.is_mesh = True
        elif tag in ('component', 'item'):
            entry = get(f'{_PRODUCTION} path'), get('objectid'), _matrix(get('transform'))
            (self.items if tag == 'item' else self._object.components).append(entry)
        elif tag in ('basematerials', 'colorgroup'):
            self._list = self.colours[get('id')] = []
        elif tag in ('base', 'color'):
            self._list.append(_colour(get('displaycolor' if tag == 'base' else 'color')))
        elif tag == 'texture2d':
            self.textures[get('id')] = get('path')
        elif tag == 'texture2dgroup':
            self._list = []
            self.groups[get('id')] = get('texid'), self._list
        elif tag in ('multiproperties', 'compositematerials'):
            self.mixtures[get('id')] = tag
        elif tag == 'tex2coord':
            self._list.append((float(get('u')), float(get('v'))))
        if get('id', '').isdigit() and len(get('id')) < 12:
            self.ids.add(int(get('id')))

    def _end(self, name):
        if name.endswith(' vertices') and self._object:
            self._object.vertices_end = self._parser.CurrentByteIndex
        elif name.endswith(' object'):
            self._object = None


class ThreeMfFile(MeshFile):
    """A 3MF; each of its mesh objects is a part with a space of its own."""

    def __init__(self, path, data=None):
        super().__init__(path)
        self._data = self.path.read_bytes() if data is None else data
        try:
            with zipfile.ZipFile(BytesIO(self._data)) as package:
                self._entries = [(info, _content(package, info)) for info in package.infolist()]
            self._models = [_Model(info.filename, content) for info, content in self._entries
                            if info.filename.lower().endswith('.model')]
        except FileError as error:
            raise FileError(f'{self.path.name}: {error}') from None
        except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError, OSError,
                ValueError, TypeError, AttributeError, KeyError, OverflowError, expat.ExpatError) as error:
            raise FileError(f'{self.path.name} is damaged: {error}') from error
        if not self._models:
            raise FileError(f'{self.path.name} has no 3D model')
        self._read_meshes()

    # Reading

    def _read_meshes(self):
        points, faces, looks, self._meshes, self._mixed = [], [], [], [], {}
        places = self._places()
        vertex_count = face_count = 0
        for model in self._models:
            for key, mesh in model.objects.items():
                if not mesh.is_mesh or not mesh.tags:
                    continue
                own = np.array(mesh.points).reshape(-1, 3)
                corners = np.array(mesh.corners).reshape(-1, 3)
                if corners.min() < 0 or corners.max() >= len(own):
                    bad = ((corners < 0) | (corners >= len(own))).any(1)
                    raise FileError(
                        f'{self.path.name}: {int(bad.sum())} faces of object {key}, first of face '
                        f'{int(bad.argmax()) + 1}, name a vertex beyond its {len(own)}')
                part = Part(mesh.name or f'object {key}', slice(face_count, face_count + len(corners)),
                            slice(vertex_count, vertex_count + len(own)),
                            places.get((model.name, key), [np.eye(4)]))
                if part.mirrored:
                    own, corners = own * [-1, 1, 1], corners[:, [0, 2, 1]]
                points.append(own)
                faces.append(corners + vertex_count)
                looks.append(self._look(model, mesh, part))
                self.parts.append(part)
                self._meshes.append((model, mesh))
                vertex_count, face_count = part.vertices.stop, part.faces.stop
        if not points:
            return
        self.vertices = np.concatenate(points)
        self.set_polygons(np.concatenate(faces))
        self.messages += [f'{counted(count, "face")} with {kind}: their colours and pictures are not read'
                          for kind, count in self._mixed.items()]
        colours, uv, pictures = (np.concatenate(a) for a in zip(*looks))
        self._colours = (
            None if np.isnan(colours).all() else np.where(np.isnan(colours), 1, colours).astype(np.float32))
        if not np.isnan(uv).all():
            self.uv, self.uv_picture = uv, pictures.astype(np.int32)
            self.pictures = [_pictures.Picture(n, self._part(n)) for n in self._picture_names]

    def _look(self, model, mesh, part):
        """Colours (f, 3, 4) and coordinates (f, 3, 2), NaN where there are none, and pictures (f,)."""
        count = len(mesh.tags)
        colours, uv, pictures = (
            np.full((count, 3, 4), np.nan),
            np.full((count, 3, 2), np.nan),
            np.full(count, -1),
        )
        self._picture_names = getattr(self, '_picture_names', [])
        groups, whole = {}, np.arange(count)
        if mesh.pid is not None:
            groups[mesh.pid] = [(whole, np.full((count, 3), mesh.pindex))]
        by_group = {}
        for triangle, pid, p in mesh.properties:
            by_group.setdefault(mesh.pid if pid is None else pid, []).append((triangle, *p))
        for pid, rows in by_group.items():
            rows = np.array(rows)
            groups.setdefault(pid, []).append((rows[:, 0], rows[:, 1:]))
        mixture = np.full(count, '', 'U20')
        for pid, entries in groups.items():
            texture, pairs = model.groups.get(pid, (None, None))
            values = np.array(model.colours.get(pid, pairs), float) if pid in model.colours or pairs else None
            for triangles, index in entries:
                mixture[triangles] = model.mixtures.get(pid, '')
                if values is None or not len(values) or index.min() < 0 or index.max() >= len(values):
                    continue
                colours[triangles], uv[triangles], pictures[triangles] = np.nan, np.nan, -1
                if pairs is None:
                    colours[triangles] = values[index]
                    continue
                uv[triangles] = values[index]
                name = (model.textures.get(texture) or '').lstrip('/')
                if name:
                    if name not in self._picture_names:
                        self._picture_names.append(name)
                    pictures[triangles] = self._picture_names.index(name)
        for kind in sorted(set(model.mixtures.values())):
            found = int((mixture == kind).sum())
            self._mixed.update({kind: self._mixed.get(kind, 0) + found} if found else {})
        if part.mirrored:
            colours, uv = colours[:, [0, 2, 1]], uv[:, [0, 2, 1]]
        return colours, uv, pictures

    def _part(self, name):
        return next((c for info, c in self._entries if info.filename.lower() == name.lower()), None)

    def _places(self):
        """For each object of a model the matrices of the items that show it."""
        models, places = {m.name.lower(): m for m in self._models}, {}
        main = next((m for m in self._models if m.items), self._models[0])
        stack = [(main, entry, np.eye(4), 0) for entry in main.items]
        while stack:
            model, (path, key, matrix), above, depth = stack.pop()
            model = models.get(path.lstrip('/').lower()) if path else model
            if model is None or key not in model.objects or depth > 50 or len(places) > 100000:
                continue
            here = above @ matrix
            mesh = model.objects[key]
            known = places.setdefault((model.name, key), [])
            if mesh.is_mesh and len(known) < 10000:
                known.append(here)
            if len(stack) < 100000:
                stack += [(model, c, here, depth + 1) for c in mesh.components]
        return places

    def holds(self, plain):
        return False

    def corner_colours(self):
        return getattr(self, '_colours', None)

    # Writing

    def _patch(self, path, uv, texture, refined, uv_set):
        messages, changed, relations = [], {}, []
        kind, content = 'png', _pictures.encode_png(np.full((1, 1, 3), 255, np.uint8))
        if texture is not None:
            content = Path(texture).read_bytes()
            kind = 'png' if content[:4] == b'\x89PNG' else 'jpeg' if content[:2] == b'\xff\xd8' else ''
            if not kind:
                picture = _pictures.decode(content, Path(texture).name)
                kind, content = 'png', _pictures.encode_png(picture)
        elif self.corner_colours() is not None or self.uv is not None or self._mixed:
            messages.append(
                'the colours and pictures of the 3MF give way to the coordinates, which show a white '
                'picture')
        name = f'{_PICTURE}.{kind}'
        number = 1
        while self._part(name) is not None:
            name, number = f'{_PICTURE}{number}.{kind}', number + 1
        new = rewritten(self, uv, refined)
        for model in self._models:
            meshes = [(mesh, part) for (m, mesh), part in zip(self._meshes, self.parts) if m is model]
            if meshes:
                changed[model.name] = self._new_model(model, meshes, new, name, kind)
                relations.append(model.name)
        self._write(path, changed, relations, name, kind, content)
        return messages

    def _new_model(self, model, meshes, new, picture, kind):
        data, first = model.data, max(model.ids) + 1
        if not data.lstrip()[:1] == b'<':
            raise FileError(f'{self.path.name}: a model that is not in UTF-8 cannot be changed')
        resources = [f'<m:texture2d xmlns:m="{_MATERIALS}" id="{first}" path="/{picture}" '
                     f'contenttype="image/{kind}"/>'.encode()]
        edits = []  # (begin, end, bytes)
        for n, (mesh, part) in enumerate(meshes):
            group = first + 1 + n
            triangles = np.flatnonzero((new.origin >= part.faces.start) & (new.origin < part.faces.stop))
            turn = [0, 2, 1] if part.mirrored else [0, 1, 2]
            pairs, index = distinct(new.uv[triangles][:, turn].reshape(-1, 2))
            index = index.reshape(-1, 3).tolist()
            resources.append(
                f'<m:texture2dgroup xmlns:m="{_MATERIALS}" id="{group}" texid="{first}">'.encode()
                + table('<m:tex2coord u="%.9g" v="%.9g"/>', pairs)
                + b'</m:texture2dgroup>')
            vertices = new.vertices[triangles][:, turn].astype(np.int64)
            fresh, where = np.unique(vertices[vertices >= len(self.vertices)], return_inverse=True)
            vertices[vertices >= len(self.vertices)] = where.ravel() + part.vertices.stop
            vertices = (vertices - part.vertices.start).tolist()
            if len(fresh):
                points = new.points[fresh - len(self.vertices)] * ([-1, 1, 1] if part.mirrored else [1, 1, 1])
                edits.append((mesh.vertices_end, mesh.vertices_end,
                              table('<vertex x="%.17g" y="%.17g" z="%.17g"/>', points)))
            pieces = {}
            for k, t in enumerate(new.origin[triangles].tolist()):
                pieces.setdefault(t - part.faces.start, []).append(k)
            torn = new.torn
            for t, begin in enumerate(mesh.tags):
                end = data.index(b'>', begin)
                bare = data[end - 1:end] == b'/'
                tag = re.sub(
                    rb'''\s(?:pid|p[123])\s*=\s*("[^"]*"|'[^']*')''', b'', data[begin : end - bare]
                ).rstrip()
                out = []
                for k in pieces.get(t, []):
                    own = tag if not torn[part.faces.start + t] else re.sub(
                        rb'''(\sv[123]\s*=\s*)("[^"]*"|'[^']*')''',
                        lambda m, v=vertices[k]: m[1] + b'"%d"' % v[int(m[1].strip()[1:2]) - 1], tag)
                    out.append(own + b' pid="%d" p1="%d" p2="%d" p3="%d"' % (group, *index[k]) + b'/>')
                if not bare:
                    out[-1] = out[-1][:-2] + b'>' if len(out) == 1 else out[-1]
                edits.append((begin, end + 1, b''.join(out)))
        edits.append((model.first_object, model.first_object, b''.join(resources)))
        result, done = [], 0
        for begin, end, content in sorted(edits, key=lambda e: e[0]):
            result += [data[done:begin], content]
            done = end
        return b''.join(result + [data[done:]])

    def _write(self, path, changed, models, picture, kind, content):
        relations = {}
        for n, name in enumerate(models):
            folder, _, file = name.rpartition('/')
            relations[f'{folder}/_rels/{file}.rels'.lstrip('/')] = (
                f'<Relationship Target="/{picture}" Id="unwrapped{n}" Type="{_TEXTURE}"/>'.encode())
        out = BytesIO()
        with zipfile.ZipFile(out, 'w', zipfile.ZIP_DEFLATED) as package:
            for info, old in self._entries:
                new = changed.get(info.filename, old)
                if info.filename == '[Content_Types].xml' and f'Extension="{kind}"'.encode() not in old:
                    new = old.replace(b'</Types>', f'<Default Extension="{kind}" ContentType="image/{kind}"/>'
                                      '</Types>'.encode())
                if info.filename in relations:
                    new = old.replace(b'</Relationships>', relations.pop(info.filename) + b'</Relationships>')
                package.writestr(_entry(info.filename, info), new)
            for name, relation in relations.items():
                package.writestr(
                    _entry(name),
                    b'<?xml version="1.0" encoding="UTF-8"?>\n<Relationships xmlns="'
                    + _RELATIONS.encode()
                    + b'">'
                    + relation
                    + b'</Relationships>',
                )
            package.writestr(_entry(picture), content)
        write_file(path, out.getvalue())


def _entry(name, like=None):
    """An entry with the time of another or always the same."""
    info = zipfile.ZipInfo(name, like.date_time if like else (1980, 1, 1, 0, 0, 0))
    info.compress_type = zipfile.ZIP_DEFLATED
    if like:
        info.external_attr, info.comment = like.external_attr, like.comment
    return info


def _content(package, info):
    if info.file_size > 100 * info.compress_size + (64 << 20):
        raise FileError(f'{info.filename} claims {info.file_size} bytes in {info.compress_size}')
    return package.read(info)


def _matrix(text):
    """(4, 4) of a transform, which is written by columns of rows of three."""
    result = np.eye(4)
    if text:
        result[:, :3] = np.array(text.split(), float).reshape(4, 3)
    return result.T


def _colour(text):
    values = bytes.fromhex(text.strip().lstrip('#'))
    return [v / 255 for v in (values + b'\xff')[:4]]


def plain(mesh):
    """(bytes) A 3MF of the mesh, one object."""
    triangles = table('<triangle v1="%d" v2="%d" v3="%d"/>', mesh.faces)
    name = re.sub(r'[^\w .-]', '_', mesh.path.stem)
    model = (
        b'<?xml version="1.0" encoding="UTF-8"?>\n<model unit="millimeter" xml:lang="en-US" xmlns="http://'
        b'schemas.'
        b'microsoft.com/3dmanufacturing/core/2015/02"><resources><object id="1" type="model" name="'
        + name.encode('utf-8', 'replace')
        + b'"><mesh><vertices>'
        + table('<vertex x="%.17g" y="%.17g" z="%.17g"/>', mesh.vertices)
        + b'</vertices><triangles>'
        + triangles
        + b'</triangles></mesh></object></resources><build><item objectid="1"/></build></model>')
    kinds = (
        b'<?xml version="1.0" encoding="UTF-8"?>\n<Types xmlns="http://schemas.openxmlformats.org/package/'
        b'2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.'
        b'relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.'
        b'3dmanufacturing-3dmodel+xml"/></Types>')
    relations = (
        b'<?xml version="1.0" encoding="UTF-8"?>\n<Relationships xmlns="' + _RELATIONS.encode() + b'">'
        b'<Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/'
        b'3dmanufacturing/2013/01/3dmodel"/></Relationships>')
    out = BytesIO()
    with zipfile.ZipFile(out, 'w', zipfile.ZIP_DEFLATED) as package:
        for entry, content in (('[Content_Types].xml', kinds), ('_rels/.rels', relations),
                               ('3D/3dmodel.model', model)):
            package.writestr(_entry(entry), content)
    return out.getvalue()
