# SPDX-License-Identifier: GPL-3.0-or-later
"""The process of one mesh. Its argument is a job in JSON, its last line of output the answer."""

import json
import os
import signal
import sys
import warnings

import numpy

from ._batch import in_words, partial_folder
from ._errors import RicciWarning, Refused
from ._loading import from_path
from ._parametrize import flatten, uniformize


def die_with_parent():
    """Where the system offers it (Linux): a lost parent leaves no process behind."""
    try:
        import ctypes
        ctypes.CDLL(None).prctl(1, signal.SIGKILL)
    except (AttributeError, OSError):
        pass


def save(result, target):
    """Complete or not at all, with what belongs to the file, such as materials of OBJ. The names
    of the files."""
    folder, name = os.path.split(os.path.abspath(target))
    partial = partial_folder(target, os.getpid())
    os.makedirs(partial)
    result.save(os.path.join(partial, name))
    for kind in result.layers:  # of mesh.ply, 'Flat mesh' is mesh.flat.ply
        result.save_layer(kind, os.path.join(partial, f"{os.path.splitext(name)[0]}.{kind}.ply"))
    written = sorted(os.listdir(partial), key=lambda file: (file == name, file))
    for file in written:
        os.replace(os.path.join(partial, file), os.path.join(folder, file))
    os.rmdir(partial)
    return written


def written_by_filter(parameters):
    report, texture = (parameters.get(key, "") for key in ("report", "carry_texture"))
    data = os.path.splitext(report)[0] + ".csv" if report else ""
    return sorted(os.path.basename(path) for path in {report, data, texture}
                  if os.path.isfile(path))


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
                answer["files"] = save(result, job["target"])
            answer.update(state="solved", messages=[str(one.message) for one in said
                                                    if issubclass(one.category, RicciWarning)],
                          results={key: numpy.asarray(value).tolist()
                                   for key, value in result.results.items()})
        except Refused as refusal:
            answer.update(state="refused", reason=" ".join(str(refusal).split()))
        except (OSError, ValueError, ImportError) as problem:
            answer.update(state="failed", reason=in_words(problem))
    answer["files"] += written_by_filter(job["parameters"])
    print("\n" + json.dumps(answer), flush=True)


if __name__ == "__main__":
    main()
