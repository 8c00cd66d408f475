# SPDX-License-Identifier: GPL-3.0-or-later
"""The process of one mesh. Its argument is a job in JSON, its last line of output the answer."""

import json
import os
import signal
import sys
import warnings

import numpy

from ._batch import in_words
from ._errors import RicciWarning, Refused
from ._loading import from_path
from ._parametrize import flatten, uniformize


def die_with_parent():
    """Where the system offers it (Linux): a lost parent leaves no process behind."""
    try:
        import ctypes
        ctypes.CDLL(None).prctl(1, signal.SIGKILL)
    except (AttributeError, OSError, TypeError):
        pass


def save(result, target):
    """The mesh, and beside mesh.ply the layer 'Flat mesh' as mesh.flat.ply."""
    result.save(target)
    for kind in result.layers:
        result.save_layer(kind, f"{os.path.splitext(target)[0]}.{kind}.ply")


def written(job):
    """The files of the folder run that have this mesh's name."""
    folder, stem = os.path.split(os.path.splitext(job["target"])[0])
    return sorted(name for name in os.listdir(folder) if name.startswith(stem + ".") and
                  os.path.join(folder, name) not in (job["mesh"], job["record"]))


def main():
    die_with_parent()
    job = json.loads(sys.argv[1])
    solve = uniformize if job["hyperbolic"] else flatten
    answer = {"files": []}
    try:
        mesh = from_path(job["mesh"])
    except OSError as problem:
        answer.update(state="unreadable", reason=str(problem))
    else:
        try:
            os.makedirs(os.path.dirname(job["target"]), exist_ok=True)  # for report and texture
            with warnings.catch_warnings(record=True) as said:
                warnings.simplefilter("always", RicciWarning)
                result = solve(mesh, **job["parameters"])
                save(result, job["target"])
            answer.update(state="solved", messages=[str(one.message) for one in said
                                                    if issubclass(one.category, RicciWarning)],
                          results={key: numpy.asarray(value).tolist()
                                   for key, value in result.results.items()})
        except Refused as refusal:
            answer.update(state="refused", reason=" ".join(str(refusal).split()))
        except (OSError, ValueError, ImportError) as problem:
            answer.update(state="failed", reason=in_words(problem))
    if job["record"] and os.path.isdir(os.path.dirname(job["target"])):
        answer["files"] = written(job)
    print("\n" + json.dumps(answer), flush=True)


if __name__ == "__main__":
    main()
