# SPDX-License-Identifier: GPL-3.0-or-later
"""The filters and their parameters in the library's own words, and what a caller gives for them."""

import html
import inspect
import operator
import os
import re

from ._library import DESCRIPTIONS

TYPES = {"enum": str, "bool": bool, "int": int, "float": float, "file": str}
EUCLIDEAN, HYPERBOLIC = (description["python_name"] for description in DESCRIPTIONS)


def plain(text):
    """A text of the dialogs without its HTML, in one line."""
    text = html.unescape(re.sub(r"<[^>]+>", " ", text))
    return re.sub(r"\s+([:,;.])", r"\1", re.sub(r"\s+", " ", text)).strip()


class Signature(inspect.Signature):
    """One that help() shows in a short line; the parameters are listed below it, with their texts."""

    def __str__(self):
        own = [parameter for parameter in self.parameters.values()
               if parameter.kind is not inspect.Parameter.KEYWORD_ONLY]
        others = inspect.Parameter("parameters", inspect.Parameter.VAR_KEYWORD)
        return str(inspect.Signature([*own, others]))

    def format(self, **_):
        return str(self)


def signature(description, *before):
    """Of a function that takes the parameters of the filter by their names."""
    return Signature([*before, *(
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


def nearest(text, names):
    """A question that suggests one of the names, or all of them where none is near."""
    import difflib
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
    raise ValueError(f"{text!r} is not a choice: {nearest(str(text), names)}")


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


# What other unwrappers call it.
_ELSEWHERE = {
    "margin": "padding", "island_margin": "padding", "gutter": "padding", "pack_margin": "padding",
    "islands": "charts", "max_charts": "charts", "pack": "charts", "max_stretch": "cone_distortion",
    "stretch": "finish", "fill_holes": "holes", "resolution": "texture_size", "bake": "carry_texture",
    "texture": "carry_texture", "weld": "join_vertices", "timeout": "time_limit",
    "angle_limit": "sharp_angle", "hard_angle": "sharp_angle", "scale_to_bounds": "normalize_uv",
    "rotate": "chart_rotation", "rotate_charts": "chart_rotation"}

_READ = {"bool": operator.index, "int": operator.index, "float": _number, "file": _file}


def meant(name, description):
    """What to give in place of a parameter that there is none of."""
    known = [p["name"] for p in description["parameters"]]
    here = _ELSEWHERE.get(name)
    if name == "options":
        return "its names are parameters of their own here"
    return description["renamed"].get(name) or (
        f"it is {here!r} here" if here in known else nearest(name, known))


def checked(function, description, given):
    """The parameters as a host takes them. A slip of the caller is a TypeError or a ValueError."""
    known = {p["name"]: p for p in description["parameters"]}
    values = {}
    for name, value in given.items():
        if name not in known:
            raise TypeError(f"{function}() has no parameter {name!r}: {meant(name, description)}")
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
