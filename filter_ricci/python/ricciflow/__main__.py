# SPDX-License-Identifier: GPL-3.0-or-later
"""UV-unwraps one mesh, or every mesh of a folder.

    python -m ricciflow scan.ply scan.obj
    python -m ricciflow scan.ply scan.obj --target-curvature Disk --report scan.html
    python -m ricciflow meshes out --workers 8
    python -m ricciflow meshes out --scheduler tcp://host:8786
    python -m ricciflow meshes out --one-atlas --carry-texture out/atlas.png

Each mesh is a process of its own: a crash ends that mesh and nothing else. The folder OUT, which may be
the folder of the meshes, gets for meshes/a/b.off the files a/b.ply and a/b.json, a/b.html for --report
and a/b.png for --carry-texture (or a/b.off.ply and so on, where a/b.ply would replace a mesh or there is
another mesh a/b), and at the end results.csv with a row for each mesh and failures.txt with the meshes
without a result. An OUT that is a file is replaced, even if it is IN. A run that was interrupted goes on
where it stopped; a mesh runs again where mesh, parameters or library have changed. With a cluster, this
package and both folders have to be on every machine, the folders at the same path.

With --one-atlas the charts of all meshes of the folder share one square at one scale, for one texture. It is
one run in this process, from the beginning each time; one mesh that is refused ends it.

Layers (--layers "Flat mesh" and others) are files beside OUT: scan.flat.ply; of one atlas atlas.flat.ply.

Exit: 0 the mesh is solved (in a folder: or refused, each of them), 1 it is not, 2 a slip in the command,
130 interrupted.
"""

import argparse
import contextlib
import errno
import importlib.util
import os
import re
import sys
import time
import warnings

from . import __version__, _batch
from ._errors import RicciWarning, Refused
from ._filters import DESCRIPTIONS, choice, meant, plain
from ._loading import mesh_endings
from ._parametrize import flatten, uniformize
from .files import WRITES


def chosen(names):
    """Reads one of the names, in any case, or its number."""
    def read(text):
        try:
            return choice(text, names)
        except ValueError as problem:
            raise argparse.ArgumentTypeError(str(problem)) from None
    return read


def add_parameter(group, parameter):
    kind = parameter["type"]
    text = f"{parameter['label']}. {plain(parameter['tooltip'])}"
    if kind == "enum":
        text += " One of: " + ", ".join(parameter["choices"]) + "."
    default = "none" if kind == "file" else parameter["default"]
    options = {"dest": parameter["name"], "default": argparse.SUPPRESS,
               "help": f"{text} Default: {default}".replace("%", "%%")}
    if kind == "bool":
        options["action"] = argparse.BooleanOptionalAction
    else:
        options["type"] = {"enum": chosen(parameter.get("choices", ())), "int": int, "float": float,
                           "file": str}[kind]
        options["metavar"] = {"enum": "CHOICE", "int": "N", "float": "X", "file": "FILE"}[kind]
    group.add_argument("--" + parameter["name"].replace("_", "-"), **options)


class Parser(argparse.ArgumentParser):
    """One whose errors are one sentence."""

    def error(self, message):
        self.exit(2, f"{message}\n{self.prog} --help shows what can be given.\n")


def count(text):
    """Reads a whole number from 1."""
    if not text.isdigit() or int(text) == 0:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 1")
    return int(text)


def parse(arguments):
    name = os.path.basename(sys.argv[0])
    parser = Parser(prog="python -m ricciflow" if name == "__main__.py" else name,
                    description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--version", action="version", version=f"ricciflow {__version__}")
    parser.add_argument("mesh", metavar="IN", help="a mesh, or a folder, with everything below it")
    parser.add_argument("out", metavar="OUT", help=f"a file ({', '.join(WRITES)}), or a folder")
    parser.add_argument("--format", choices=[ending[1:] for ending in WRITES], default="ply",
                        help="of the results of a folder. Default: ply")
    parser.add_argument("--hyperbolic", action="store_true",
                        help="the hyperbolic filter, whose parameters --hyperbolic --help shows")
    parser.add_argument("--one-atlas", action="store_true",
                        help="all meshes of a folder in one square, for one texture")
    parser.add_argument("--timeout", type=float, default=3600, help="seconds for one mesh")
    parser.add_argument("--workers", type=count, default=os.cpu_count(), help="meshes at a time")
    parser.add_argument("--scheduler", help="address of a Dask scheduler, or 'local' for Dask here")
    parser.add_argument("--retry", action="store_true", help="run crashes and timeouts again")
    parser.add_argument("--quiet", action="store_true", help="failures only")
    parser.add_argument("--verbose", action="store_true", help="all results of the mesh, by their keys")
    group = parser.add_argument_group("parameters of the filter")
    description = DESCRIPTIONS["--hyperbolic" in arguments]
    for parameter in description["parameters"]:
        add_parameter(group, parameter)
    options, others = parser.parse_known_args(arguments)
    for word in others:
        option = word.partition("=")[0]
        name = re.sub("^(no_)?", "", option.lstrip("-").replace("-", "_"))
        parser.error(f"There is no option {option}: {meant(name, description)}."
                     if word.startswith("--") else f"There is no place for {word!r}.")
    names = {parameter["name"] for parameter in description["parameters"]}
    options.parameters = {name: value for name, value in vars(options).items() if name in names}
    return parser, options


def make_job(options, mesh, name, target, record="", mark="", former=()):
    parameters = dict(options.parameters)
    for key in ("report", "carry_texture"):
        if parameters.get(key):
            if record:  # the ending alone counts
                ending = os.path.splitext("x" + parameters[key])[1]
                parameters[key] = os.path.splitext(target)[0] + ending
            parameters[key] = os.path.abspath(parameters[key])
    return {"mesh": os.path.abspath(mesh), "name": name, "target": os.path.abspath(target),
            "record": record, "former": former, "fingerprint": mark, "hyperbolic": options.hyperbolic,
            "parameters": parameters, "timeout": options.timeout}


def warn(record, write=lambda line: print(line, file=sys.stderr, flush=True)):
    for message in record.get("messages", ()):
        write(f"{record['mesh']}: {message}")


def sentence(record, target):
    """What came out of a run, in one line."""
    results = record["results"]

    flips = results["flipped_faces"] + results["flipped_by_rounding"]
    return ", ".join((f"{results['charts']} chart{'s' if results['charts'] != 1 else ''}",
                      f"{100 * results['occupancy']:.0f} % filled",
                      f"{flips or 'no'} flip{'s' if flips != 1 else ''}",
                      f"{record['seconds']:.1f} s -> {target}"))


def printed(value, key):
    """A result as it is written: vertices are numbers that count."""
    return [int(v) for v in value] if key == "cone_vertices" else value


class Lines:
    """Progress as lines, one for each mesh."""

    def __init__(self, count, quiet):
        self.count, self.quiet, self.ended = count, quiet, 0

    def show(self, record):
        self.ended += 1
        warn(record)
        if not self.quiet or record["state"] != "solved":
            print(f"[{self.ended}/{self.count}] {record['state']:8} {record['mesh']}  "
                  f"{record.get('reason', '')}".rstrip(), flush=True)

    def close(self):
        pass


class Bar:
    """Progress as tqdm's bar, with lines for what is not solved."""

    def __init__(self, count):
        from tqdm import tqdm
        self.bar = tqdm(total=count, unit="mesh")

    def show(self, record):
        warn(record, self.bar.write)
        if record["state"] != "solved":
            self.bar.write(f"{record['state']:8} {record['mesh']}  {record.get('reason', '')}")
        self.bar.update()

    def close(self):
        self.bar.close()


def progress(count, quiet):
    if not quiet and sys.stderr.isatty():
        try:
            return Bar(count)
        except ImportError:
            pass
    return Lines(count, quiet)


def check_writable(place):
    """So that the sentence names this folder, not a file of ours that it would get."""
    if os.path.isdir(place) and not os.access(place, os.W_OK):
        raise PermissionError(errno.EACCES, "the folder cannot be written", place)


def one_mesh(options):
    check_writable(os.path.dirname(os.path.abspath(options.out)))
    job = make_job(options, options.mesh, os.path.basename(options.mesh), options.out)
    with _batch.here(1) as run:
        record, = run([job])
    if record["state"] != "solved":
        print(f"{record['state']}: {record['reason']}", file=sys.stderr)
        return 1
    warn(record)
    if not options.quiet:
        print(sentence(record, options.out))
    if options.verbose:
        for key, value in record["results"].items():
            print(f"{key} = {printed(value, key)}")
    return 0


def folder(parser, options):
    source, out = os.path.abspath(options.mesh), os.path.abspath(options.out)
    for option in ("timeout", "workers", "scheduler", "retry") if options.one_atlas else ():
        if getattr(options, option) != parser.get_default(option):
            parser.error(f"--{option} does not go with --one-atlas, which is one run: --time-limit ends it.")
    names, others = _batch.find_meshes(source)
    if others and not options.quiet:
        print("Skipped: " + ", ".join(f"{n} x {ending}" for ending, n in sorted(others.items())))
    if not names:
        parser.error(f"There are no meshes ({', '.join(mesh_endings())}) below {options.mesh}.")
    stems = _batch.stems(names, source, out, "." + options.format)
    targets = {name: os.path.join(out, f"{stems[name]}.{options.format}") for name in names}
    meshes = {os.path.join(source, name) for name in names}
    for name in names:
        if targets[name] in meshes:
            parser.error(f"The result of {name} would replace the mesh {targets[name]}: choose "
                         "another OUT.")
    os.makedirs(out, exist_ok=True)
    check_writable(out)
    settings = (options.hyperbolic, options.format, options.parameters)
    common = _batch.fingerprint(*settings, *(["one atlas", names] if options.one_atlas else ()))
    marks = {name: _batch.mark_of(os.path.join(source, name), common) for name in names}
    records = {name: _batch.record_path(out, stem) for name, stem in stems.items()}
    jobs = [make_job(options, os.path.join(source, name), name, targets[name], records[name],
                     marks[name], [_batch.record_path(out, stem)
                                   for stem in (name, os.path.splitext(name)[0])])
            for name in names if options.one_atlas or not _batch.is_done(
                _batch.read_record(records[name]), name, marks[name], options.retry)]
    if options.one_atlas:
        code = atlas(options, names, jobs)
        _batch.summarize(out, stems)
        return code
    if not options.quiet:
        print(f"{len(names)} {'mesh' if len(names) == 1 else 'meshes'}, {len(names) - len(jobs)} done "
              f"before, {len(jobs)} to run", flush=True)
    shown = progress(len(jobs), options.quiet)
    interrupted = False
    try:
        with runner(options) as run:
            for record in run(jobs) if jobs else ():
                shown.show(record)
    except KeyboardInterrupt:
        interrupted = True
    shown.close()
    failures = _batch.summarize(out, stems)
    if interrupted:
        print("Interrupted: run the same command again to continue.", file=sys.stderr)
        return 130
    if not options.quiet:
        print(f"Results: {os.path.join(options.out, 'results.csv')}; without a result: "
              f"{os.path.join(options.out, 'failures.txt')}")
    return 1 if failures else 0


def atlas(options, names, jobs):
    """Runs all meshes of a folder as one. Its exit."""
    parameters = make_job(options, ".", "", options.out)["parameters"]
    started = time.monotonic()
    solve = uniformize if options.hyperbolic else flatten
    record = {"mesh": f"{len(names)} meshes"}
    place = os.path.dirname(jobs[0]["target"])
    for file in _batch.read_record(jobs[0]["record"]).get("files", ()):
        if file.startswith("atlas."):  # layers of an earlier run
            with contextlib.suppress(OSError):
                os.remove(os.path.join(place, file))
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always", RicciWarning)
        try:
            results = solve([job["mesh"] for job in jobs], progress=not options.quiet and
                            sys.stderr.isatty(), **parameters)
            for job, result in zip(jobs, results):
                os.makedirs(os.path.dirname(job["target"]), exist_ok=True)
                result.save(job["target"])
            layers = [f"atlas.{kind}.ply" for kind in results[0].layers]
            for kind, name in zip(results[0].layers, layers):
                results[0].save_layer(kind, os.path.join(place, name))
        except (Refused, ValueError, OSError) as problem:
            state = "unreadable" if isinstance(problem, OSError) else "refused"
            reason = " ".join(_batch.in_words(problem).split())
            print(f"{state}: {reason}", file=sys.stderr)
            blamed = [job for job in jobs if re.search(
                rf"(?<![\w.-]){re.escape(os.path.basename(job['mesh']))}(?![\w-])", reason)]
            for job in jobs:
                own = job in blamed or not blamed
                _batch.clear(job["record"])
                _batch.write_record(job["record"], {
                    "mesh": job["name"], "state": state if own else "missing", "fingerprint": job["fingerprint"],
                    "reason": reason if own else f"not run, because {blamed[0]['name']} cannot be used: move that "
                                                 f"file away", "files": []})
            return 1
    record.update(seconds=time.monotonic() - started, results=results[0].results,
                  messages=[str(one.message) for one in said])
    warn(record)
    if not options.quiet:
        print(sentence(record, options.out))
    for job in jobs:
        _batch.write_record(job["record"], {
            "mesh": job["name"], "state": "solved", "fingerprint": job["fingerprint"],
            "seconds": round(record["seconds"], 3), "messages": record["messages"],
            "files": [os.path.basename(job["target"]), *(layers if job is jobs[0] else ())],
            "results": {key: getattr(value, "tolist", lambda v=value: v)()
                        for key, value in record["results"].items()}})
    return 0


def runner(options):
    if not options.scheduler:
        return _batch.here(options.workers)
    if importlib.util.find_spec("distributed") is None:
        sys.exit('Dask is missing: pip install "dask[distributed]"')
    return _batch.by_dask(options.scheduler, options.workers)


def solve(parser, options):
    if os.path.isdir(options.mesh):
        return folder(parser, options)
    if not os.path.isfile(options.mesh):
        parser.error(f"There is no file or folder {options.mesh}.")
    if options.one_atlas:
        parser.error("--one-atlas is for a folder of meshes.")
    if not options.out.lower().endswith(WRITES):
        parser.error(f"OUT must end in {' or '.join(WRITES)}.")
    return one_mesh(options)


def main(arguments=None):
    parser, options = parse(sys.argv[1:] if arguments is None else arguments)
    try:
        return solve(parser, options)
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:  # such as of `| head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except OSError as problem:
        print(_batch.in_words(problem), file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
