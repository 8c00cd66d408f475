# SPDX-License-Identifier: GPL-3.0-or-later
"""The C library, ricci_c.h: what it says of its filters, and one run of a filter."""

import ctypes
import json
import os
import sys

import numpy

from ._errors import Refused

PATH = os.path.join(os.path.dirname(os.path.abspath(__file__)),
                    {"win32": "ricciflow.dll", "darwin": "libricciflow.dylib"}.get(
                        sys.platform, "libricciflow.so"))
INTERFACE = 1  # RICCI_C_VERSION
TYPES = [numpy.dtype(name) for name in ("bool", "uint8", "uint16", "int32", "int64", "float32",
                                        "float64")]
OK, REFUSED, CANCELLED, TIMED_OUT, NO_MEMORY, MISUSE, FAILED = range(7)
WARNING = -2.0  # in place of the share of the work that is done: a line of the log, told again


class _Array(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int32), ("dimensions", ctypes.c_int32),
                ("shape", ctypes.c_int64 * 3), ("data", ctypes.c_void_p)]


_LISTENER = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p, ctypes.c_double, ctypes.c_char_p)
_POINTER = ctypes.POINTER(_Array)
_FUNCTIONS = {  # result and arguments
    "c_version": (ctypes.c_int32,),
    "library_version": (ctypes.c_char_p,),
    "solver": (ctypes.c_char_p,),
    "description": (ctypes.c_char_p,),
    "create": (ctypes.c_void_p, ctypes.c_int32),
    "free": (None, ctypes.c_void_p),
    "set_parameter": (ctypes.c_int32, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_char_p),
    "set_array": (ctypes.c_int32, ctypes.c_void_p, ctypes.c_char_p, _POINTER),
    "set_text": (ctypes.c_int32, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_char_p),
    "add_picture": (ctypes.c_int32, ctypes.c_void_p, ctypes.c_char_p, _POINTER),
    "set_listener": (ctypes.c_int32, ctypes.c_void_p, _LISTENER, ctypes.c_void_p),
    "execute": (ctypes.c_int32, ctypes.c_void_p),
    "message": (ctypes.c_char_p, ctypes.c_void_p),
    "output_count": (ctypes.c_int64, ctypes.c_void_p),
    "output_name": (ctypes.c_char_p, ctypes.c_void_p, ctypes.c_int64),
    "output": (ctypes.c_int32, ctypes.c_void_p, ctypes.c_char_p, _POINTER),
}


def _load():
    """The functions of the library, by their names without ricci_."""
    try:
        library = ctypes.CDLL(PATH)
    except OSError as problem:
        raise ImportError(f"The library of ricciflow cannot be loaded, so the package is one for "
                          f"another system: {problem}") from None
    functions = {}
    for name, (result, *arguments) in _FUNCTIONS.items():
        functions[name] = function = getattr(library, "ricci_" + name)
        function.restype, function.argtypes = result, arguments
    if functions["c_version"]() != INTERFACE:
        raise ImportError(f"{PATH} is of another version of ricciflow: install the package again")
    return functions


def _described():
    """Both filters, each a dictionary with name, python_name, info and parameters."""
    described = json.loads(LIBRARY["description"]().decode())
    for parameter in (p for description in described for p in description["parameters"]):
        if parameter["type"] == "float":
            parameter["default"] = float(parameter["default"])
    return described


LIBRARY = _load()
VERSION, SOLVER = (LIBRARY[name]().decode() for name in ("library_version", "solver"))
DESCRIPTIONS = _described()


def _to_array(values):
    """The structure, and the array that it points into."""
    values = numpy.ascontiguousarray(values)
    shape = (ctypes.c_int64 * 3)(*values.shape)
    return _Array(TYPES.index(values.dtype), values.ndim, shape,
                  values.__array_interface__["data"][0]), values


def _from_array(array):
    """A copy."""
    values = numpy.empty(array.shape[:array.dimensions], TYPES[array.type])
    if values.size:
        ctypes.memmove(values.__array_interface__["data"][0], array.data, values.nbytes)
    return values


def _as_text(value):
    return ("true" if value else "false") if isinstance(value, bool) else str(value)


class _Run:
    """A run of the library, given back at the end of the block."""

    def __init__(self, number):
        self.pointer = LIBRARY["create"](number)
        if not self.pointer:
            raise MemoryError

    def __enter__(self):
        return self

    def __exit__(self, *_):
        LIBRARY["free"](self.pointer)

    def call(self, function, *arguments):
        code = LIBRARY[function](self.pointer, *arguments)
        if code == OK:
            return
        text = LIBRARY["message"](self.pointer).decode()
        if code in (REFUSED, TIMED_OUT, NO_MEMORY):
            raise (ValueError if text.startswith("The value ") else Refused)(text)
        raise RuntimeError(text)

    def set_array(self, function, name, values):
        structure, kept = _to_array(values)  # kept: until the call has copied it
        self.call(function, name.encode(), ctypes.byref(structure))
        del kept

    def outputs(self):
        found, array = {}, _Array()
        for number in range(LIBRARY["output_count"](self.pointer)):
            name = LIBRARY["output_name"](self.pointer, number)
            self.call("output", name, ctypes.byref(array))
            found[name.decode()] = _from_array(array)
        return found


def run(number, parameters, arrays, pictures, texts, listener):
    """Runs the filter with that number of DESCRIPTIONS.

    parameters : name -> value, of the type that the description states
    arrays, texts : the inputs, name -> array or text, as ricci_c.h has them
    pictures : pairs of a name and an array, or None for a picture that cannot be read
    listener : called with the share of the work that is done and the name of the step, many times a
        second, in this thread; False ends the run

    Returns the outputs, name -> array; the lines of the log; and those that are warnings. Raises
    Refused, or ValueError for a value that cannot be used.
    """
    log, warnings = [], []

    def receive(_, fraction, text):
        text = text.decode(errors="replace")
        if fraction >= 0.0:
            return listener(fraction, text) is not False
        (warnings if fraction == WARNING else log).append(text)
        return True

    callback = _LISTENER(receive)
    with _Run(number) as one:
        for name, value in parameters.items():
            one.call("set_parameter", name.encode(), _as_text(value).encode("utf-8", "surrogateescape"))
        for name, values in arrays.items():
            if values is not None:
                one.set_array("set_array", name, values)
        for name, text in texts.items():
            one.call("set_text", name.encode(), text.encode("utf-8", "surrogateescape"))
        for name, picture in pictures:
            if picture is None:
                one.call("add_picture", name.encode(), None)
            else:
                one.set_array("add_picture", name, picture)
        one.call("set_listener", callback, None)
        one.call("execute")
        return one.outputs(), log, warnings
