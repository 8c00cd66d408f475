# SPDX-License-Identifier: GPL-3.0-or-later
"""The filters of the plugin as methods of MeshSet, described in the plugin's own words."""

import ctypes
import difflib
import html
import inspect
import json
import operator
import os
import re

import pymeshlab

from ._plugin import LIBRARY, PLUGIN, silent, watched

TYPES = {"enum": str, "bool": bool, "int": int, "float": float, "file": str}


def _described():
    """Both filters, each a dictionary with name, python_name, info and parameters."""
    describe = LIBRARY.filter_ricci_description
    describe.restype = ctypes.c_char_p
    described = json.loads(describe().decode())
    for parameter in (p for description in described for p in description["parameters"]):
        if parameter["type"] == "float":  # single precision in the host
            parameter["default"] = float(f"{parameter['default']:.7g}")
    return described


def plain(text):
    """A text of the dialogs without its HTML, in one line."""
    text = html.unescape(re.sub(r"<[^>]+>", " ", text))
    return re.sub(r"\s+([:,;.])", r"\1", re.sub(r"\s+", " ", text)).strip()


def signature(description, *before):
    """Of a function that takes the parameters of the filter by their names."""
    return inspect.Signature([*before, *(
        inspect.Parameter(p["name"], inspect.Parameter.KEYWORD_ONLY, default=p["default"],
                          annotation=TYPES[p["type"]]) for p in description["parameters"])])


def documentation(description):
    """The parameters of the filter, each with its choices and its tooltip."""
    lines = []
    for p in description["parameters"]:
        kind = TYPES[p["type"]].__name__
        if p["type"] == "enum":
            kind = " | ".join(map(repr, p["choices"]))
        lines += [f"{p['name']} : {kind}, default {p['default']!r}",
                  f"    {p['label']}. {plain(p['tooltip'])}"]
    return "\n".join(lines)


def apply(mesh_set, name, **parameters):
    """apply_filter. After a failure PyMeshLab 2025.7 keeps a pointer to the log of the MeshSet, and
    later loads write there even if the MeshSet is gone. A filter that succeeds clears it."""
    try:
        return mesh_set.apply_filter(name, **parameters)
    except Exception:
        pymeshlab.MeshSet().create_cube()
        raise


def nearest(text, names):
    """A question that suggests one of the names, or all of them where none is near."""
    near = difflib.get_close_matches(text.lower(), [name.lower() for name in names], n=1)
    for name in names:
        if [name.lower()] == near:
            return f"did you mean {name!r}?"
    return "it is one of " + ", ".join(map(repr, names))


def choice(text, names):
    """The one of the names that is meant, in any case or by its number."""
    for number, name in enumerate(names):
        if text in (number, str(number)) or str(text).lower() == name.lower():
            return name
    raise ValueError(f"{text!r} is no choice: {nearest(str(text), names)}")


def _file(value):
    """Its absolute path, empty for none: relative names mean the working folder."""
    path = os.fspath(value)
    if path:
        path = os.path.abspath(path)
        if not os.path.isdir(os.path.dirname(path)):
            raise FileNotFoundError(f"{value!r} cannot be written: there is no folder of that name")
    return path


def _number(value):
    if isinstance(value, (str, bytes)):
        raise TypeError
    return float(value)


_READ = {"bool": operator.index, "int": operator.index, "float": _number, "file": _file}


def checked(function, description, given):
    """The parameters as the host takes them. A slip of the caller is a TypeError or a ValueError."""
    known = {p["name"]: p for p in description["parameters"]}
    values = {}
    for name, value in given.items():
        if name not in known:
            raise TypeError(f"{function}() has no parameter {name!r}: {nearest(name, list(known))}")
        kind = known[name]["type"]
        value = value.item() if hasattr(value, "item") else value  # of numpy
        try:
            if kind == "enum":
                values[name] = choice(value, known[name]["choices"])
            else:
                values[name] = TYPES[kind](_READ[kind](value))
        except TypeError:
            raise TypeError(f"{name} must be of type {TYPES[kind].__name__}, not "
                            f"{value!r}") from None
        except ValueError as problem:
            raise ValueError(f"{name}: {problem}") from None
    return values


def _bind(description):
    name = description["python_name"]

    def method(self, **parameters):
        parameters = checked(name, description, parameters)
        return watched(lambda: apply(self, name, **parameters), silent)

    this = inspect.Parameter("self", inspect.Parameter.POSITIONAL_ONLY)
    method.__name__ = name
    method.__qualname__ = f"MeshSet.{name}"
    method.__signature__ = signature(description, this)
    method.__doc__ = (f"MeshLab's filter '{description['name']}' on the current mesh.\n\n"
                      f"{plain(description['info'])}\n\nReturns a dictionary with the results.\n\n"
                      f"{documentation(description)}\n")
    setattr(pymeshlab.MeshSet, name, method)


# A program may have loaded a plugin of these names by itself.
DESCRIPTIONS = _described()
if DESCRIPTIONS[0]["python_name"] not in pymeshlab.filter_list():
    pymeshlab.load_plugin(PLUGIN)
EUCLIDEAN, HYPERBOLIC = (description["python_name"] for description in DESCRIPTIONS)
for _description in DESCRIPTIONS:
    _bind(_description)
