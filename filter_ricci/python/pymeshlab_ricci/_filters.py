# SPDX-License-Identifier: GPL-3.0-or-later
"""The filters of the plugin as methods of MeshSet, described in the plugin's own words."""

import ctypes
import html
import inspect
import json
import os
import re

import pymeshlab

PLUGIN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "libfilter_ricci.so")
TYPES = {"enum": str, "bool": bool, "int": int, "float": float, "file": str}


def _described():
    """Both filters, each a dictionary with name, python_name, info and parameters."""
    describe = ctypes.CDLL(PLUGIN).filter_ricci_description
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


def _bind(description):
    name = description["python_name"]

    def method(self, **parameters):
        return apply(self, name, **parameters)

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
