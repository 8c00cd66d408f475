# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes what the library says of its filters into the repository: their pages in the user manual, in
the form of PyMeshLab's own, and the types of the Python package. What the results mean is taken the
other way, from the manual's tables into the package.

    PYTHONPATH=build/python build/venv/bin/python filter_ricci/scripts/document_filters.py [--check]

With --check nothing is written; exit 1 where a file is not current."""

import html
import os
import pprint
import re
import sys

from ricciflow._filters import DESCRIPTIONS, plain

HERE = os.path.dirname(os.path.abspath(__file__))
MANUAL = os.path.join(os.path.dirname(HERE), "README.md")
PACKAGE = os.path.join(os.path.dirname(HERE), "python", "ricciflow")
LICENCE = "# SPDX-License-Identifier: GPL-3.0-or-later\n"
MADE = "# Made by document_filters.py.\n"
PYTHON_WIDTH = 96
PLACES = {"shown": "**Parameters:**", "advanced": "**Advanced parameters:**",
          "options": "**Options** (in MeshLab one text, `options`, such as `time_limit=60; colorize=true`):"}


def wrapped(text, indent="", first=None, width=PYTHON_WIDTH):
    """The words of a text in lines of at most so many characters."""
    lines, line = [], indent if first is None else first
    start = True
    for word in text.split():
        if not start and len(line) + 1 + len(word) > width:
            lines.append(line)
            line, start = indent, True
        line += word if start else " " + word
        start = False
    return "\n".join(lines + [line])


def markdown(text):
    """Of a text of the dialogs, which has bold, italic and line ends."""
    for tag, mark in (("b", "**"), ("i", "*")):
        text = re.sub(rf"</?{tag}>", mark, text)
    return html.unescape(re.sub(r"<br ?/?>", " ", text)).replace("****", "** **").strip()


def paragraphs(info):
    return [markdown(part) for part in re.split(r"<br ?/?>(?=<b>[A-Z]\w+:</b>)|<br>(?=See:)", info)]


def words(parameter):
    """What a list says of a parameter; where a dialog has it does not matter."""
    return {key: value for key, value in parameter.items() if key != "place"}


def item(parameter):
    """A parameter of the list."""
    name, default = parameter["name"], parameter["default"]
    if parameter["type"] == "enum":
        number = parameter["choices"].index(default)
        kind = f"str = '{default}' (or int = {number})"
        values = ", ".join(f"{i}. `'{c}'`" for i, c in enumerate(parameter["choices"]))
        values = f"Possible enum values: {values}<br>"
    else:
        kind = {"bool": "bool", "int": "int", "float": "float", "file": "str"}[parameter["type"]]
        kind += f" = {default!r}" if not isinstance(default, float) else f" = {default:g}"
        values = ""
    return f"- **`{name} : {kind}`**<br>{values} *{parameter['label']}*: {markdown(parameter['tooltip'])}"


def page(description, said=()):
    """The filter as PyMeshLab's documentation would show it, without what has been said before."""
    parts = [f"### {description['python_name']}", f"*MeshLab filter name*: '{description['name']}'"]
    parts += [text for text in paragraphs(description["info"]) if text not in said]
    for place, title in PLACES.items():
        here = [p for p in description["parameters"] if p["place"] == place]
        lines = [item(p) for p in here if words(p) not in said]
        same = ", ".join(f"**`{p['name']}`**" for p in here if words(p) in said)
        parts += [title, "\n".join(lines + [f"- {same}: as in the Euclidean filter."] * bool(same))]
    return "\n\n".join(parts)


def manual(text):
    for key, description in zip(("Euclidean", "hyperbolic"), DESCRIPTIONS):
        marks = [f"<!-- {word}: the {key} filter, by scripts/document_filters.py -->\n"
                 for word in ("begin", "end")]
        before, rest = text.split(marks[0])
        _, after = rest.split(marks[1])
        said = []
        if description is not DESCRIPTIONS[0]:
            said = paragraphs(DESCRIPTIONS[0]["info"])
            said += map(words, DESCRIPTIONS[0]["parameters"])
        text = before + marks[0] + "\n" + page(description, said) + "\n\n" + marks[1] + after
    return text


def results(text):
    """Of each filter: key -> (type, meaning), from the manual's tables."""
    found = []
    for part in text.split("| key | type | |\n")[1:]:
        keys = {}
        for row in part.splitlines()[1:]:
            if not row.startswith("|"):
                break
            cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", row)[1:-1]]
            names = re.findall(r"`(\w+)`", cells[0])
            kinds = cells[1].split(", ")
            meaning = re.sub(r"\[(.*?)\]\(.*?\)", r"\1", cells[2].replace("\\|", "|"))
            meaning = re.sub(r"[`*]", "", meaning)
            parts = meaning.split("; ")  # one for each key, or all for each
            for i, name in enumerate(names):
                keys[name] = (kinds[i % len(kinds)],
                              parts[i] if len(parts) == len(names) else meaning)
        found.append(keys)
    return found


def results_module(both):
    lines = [LICENCE, '"""What the filters return: key -> (type, meaning)."""\n', MADE]
    for name, keys in zip(("EUCLIDEAN_RESULTS", "HYPERBOLIC_RESULTS"), both):
        text = pprint.pformat(keys, width=PYTHON_WIDTH, sort_dicts=False)
        lines.append(f"\n{name} = \\\n{text}\n")
    return "".join(lines)


TYPES = {"bool": "bool", "int": "int", "float": "float", "vector": "Floats"}

STUB = LICENCE + '''\
"""UV-unwraps triangle meshes: conformal maps by the discrete Ricci flow."""
''' + MADE + '''
import os
from typing import Any, Callable, Literal, NamedTuple, Protocol, Union, overload

import numpy
import numpy.typing
import pymeshlab

Floats = numpy.typing.NDArray[numpy.float64]
Integers = numpy.typing.NDArray[numpy.int32]
Complex = numpy.typing.NDArray[numpy.complex128]

class HasVerticesAndFaces(Protocol):
    vertices: Any
    faces: Any

MeshLike = Union[str, os.PathLike[str], pymeshlab.MeshSet, pymeshlab.Mesh,
                 HasVerticesAndFaces,
                 tuple[numpy.typing.ArrayLike, numpy.typing.ArrayLike]]

__version__: str
EUCLIDEAN: str
HYPERBOLIC: str

class Refused(Exception):
    """The mesh is refused; the text says why. It is unchanged."""

class RicciWarning(UserWarning):
    """A doubt about a map that was made: what it is, and what to do."""

'''

PARAMETRIZATION = '''class Layer(NamedTuple):
    """A new layer: vertices (V, 3) float64, and what joins them."""

    vertices: Floats
    faces: Integers
    edges: Integers

class Parametrization:
    """A mesh and its texture coordinates. It can be pickled and copied."""

    vertices: Floats
    """(V, 3) float64"""
    faces: Integers
    """(F, 3) int32, indices of vertices"""
    uv: Floats
    """(F, 3, 2) float64, texture coordinates of each corner of each face, as floats have them"""
    quality: Floats
    """(V,) float64, quasi-conformal distortion sigma1/sigma2 at the vertices; 1: angles kept"""
    log_radius: Floats
    """(V,) float64, logarithms of the radii of the flow's circles, up to a constant"""
    target_curvature: Floats
    """(V,) float64, the Gaussian curvature that the flow reached, in radians"""
    @property
    def layers(self) -> dict[str, Layer]:
        """those that were asked for, by what they are: flat, sphere, disk, cover, axes, polygon"""
    @property
    def mesh_set(self) -> pymeshlab.MeshSet:
        """PyMeshLab's MeshSet that holds the mesh, and the new layers if some were asked for"""
    results: dict[str, Any]
    """what the filter returned; each result is an attribute too"""
    messages: list[str]
    """doubts about the map; each is a RicciWarning, too"""
    log: list[str]
    """all lines that the run has written"""
    def indexed(self) -> tuple[Floats, numpy.typing.NDArray[numpy.intp]]:
        """Texture vertices (T, 2) and their indices at the corners of the faces (F, 3)."""
    def save(self, path: Union[str, os.PathLike[str]]) -> None:
        """Writes the mesh with its texture coordinates, and with the texture that carry_texture
        has drawn. What else was in the file that the mesh is from stays."""
    def save_layer(self, kind: str, path: Union[str, os.PathLike[str]]) -> None:
        """Writes one of the layers to a PLY file."""

'''


HOST_STUB = LICENCE + '''\
"""PyMeshLab as a host: both filters as methods of MeshSet."""
''' + MADE + '''
from typing import Any, Literal, Union

import pymeshlab
from pymeshlab import Mesh as Mesh

from . import Refused as _Refused

USES_PLUGIN: bool

class Refused(_Refused, pymeshlab.PyMeshLabException):
    """The mesh of a MeshSet is refused; the text says why."""

class MeshSet(pymeshlab.MeshSet):
'''


def attributes(keys):
    lines = []
    for key, (kind, meaning) in keys.items():
        matrices = key in ("generators", "generators_low")
        lines.append(f"    {key}: {'Complex' if matrices else TYPES[kind]}")
        if matrices:
            meaning += "; here (n, 2, 2) complex128, the matrices of the isometries"
        lines.append(wrapped(f'{meaning}"""', "    ", '    """', PYTHON_WIDTH))
    return "\n".join(lines) + "\n"


def stub_parameters(description, indent):
    lines = []
    for p in description["parameters"]:
        if p["type"] == "enum":
            choices = "".join(f"{indent}    {choice!r},\n" for choice in p["choices"])
            kind = f"Union[int, Literal[\n{choices}{indent}]]"
        else:
            kind = {"file": "str"}.get(p["type"], p["type"])
        lines.append(f"{indent}{p['name']}: {kind} = {p['default']!r},\n")
    return "".join(lines)


def stub(both):
    own = ("    mesh: Union[MeshLike, numpy.typing.ArrayLike],\n"
           "    faces: Union[numpy.typing.ArrayLike, None] = None,\n    *,\n"
           "    selected: Union[numpy.typing.ArrayLike, set[int], None] = None,\n"
           "    curvature: Union[numpy.typing.ArrayLike, None] = None,\n"
           "    uv: Union[numpy.typing.ArrayLike, None] = None,\n"
           "    selected_edges: Union[numpy.typing.ArrayLike, None] = None,\n"
           "    selected_faces: Union[numpy.typing.ArrayLike, set[int], None] = None,\n"
           "    diagonals: Union[numpy.typing.ArrayLike, None] = None,\n"
           "    progress: Union[bool, Callable[[float, str], object], None] = None,\n")
    parts = [STUB, PARAMETRIZATION,
             "class Flattening(Parametrization):\n", attributes(both[0]),
             "\nclass Uniformization(Parametrization):\n    disk: Complex\n"
             '    """(F, 3) complex128: the corners of the faces in the Poincaré disk, |z| < 1"""\n',
             attributes({**both[0], **both[1]})]
    for name, d, kind, text in zip(
            ("flatten", "uniformize"), DESCRIPTIONS, ("Flattening", "Uniformization"),
            ("UV-unwraps a mesh: a conformal map into the plane.",
             "Hyperbolic metric of a mesh, in the Poincaré disk.")):
        parts.append(f"\n@overload\ndef {name}(\n    mesh: list[MeshLike],\n    *,\n"
                     "    progress: Union[bool, Callable[[float, str], object], None] = None,\n"
                     f"    **parameters: Any,\n) -> list[{kind}]:\n"
                     '    """Several meshes, whose charts share one square."""\n'
                     f"@overload\ndef {name}(\n{own}{stub_parameters(d, '    ')}) -> {kind}:\n"
                     f'    """{text}\n\n')
        for p in d["parameters"]:
            text = f"{p['name']}: {plain(p['tooltip'])}"
            parts.append(wrapped(text, "        ", "    ", PYTHON_WIDTH) + "\n")
        parts.append('    """\n')
    return "".join(parts)


def host_stub():
    parts = [HOST_STUB]
    for d in DESCRIPTIONS:
        parts.append(f"    def {d['python_name']}(\n        self,\n        *,\n"
                     f"{stub_parameters(d, ' ' * 8)}    ) -> dict[str, Any]:\n"
                     f'        """MeshLab\'s filter \'{d["name"]}\' on the current mesh."""\n')
    return "".join(parts)


def read(path):
    if not os.path.exists(path):
        return ""
    with open(path, encoding="utf-8") as source:
        return source.read()


def main():
    text = manual(read(MANUAL))
    both = results(text)
    made = {MANUAL: text, os.path.join(PACKAGE, "_results.py"): results_module(both),
            os.path.join(PACKAGE, "__init__.pyi"): stub(both),
            os.path.join(PACKAGE, "pymeshlab.pyi"): host_stub()}
    old = [path for path, content in made.items() if read(path) != content]
    if "--check" in sys.argv[1:]:
        for path in old:
            print(f"{path} is not current: run document_filters.py")
        return 1 if old else 0
    for path in old:
        with open(path, "w", encoding="utf-8") as target:
            target.write(made[path])
        print(f"written: {path}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
