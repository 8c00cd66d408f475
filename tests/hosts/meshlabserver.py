# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs stock meshlabserver 2020.09 in a private folder that also holds the plugin."""

import atexit
import functools
import os
import re
import shutil
import subprocess
import tempfile
from xml.sax.saxutils import quoteattr

import common


def _stage():
    script = os.path.join(common.REPOSITORY, "filter_ricci", "scripts", "stage_meshlab_2020.sh")
    run = subprocess.run(["bash", script, common.BUILD], capture_output=True, text=True)
    if run.returncode == 77:
        common.skip(run.stderr.strip().replace("SKIPPED: ", ""))
    if run.returncode != 0:
        raise RuntimeError(run.stderr)
    if shutil.which("Xvfb") is None:
        common.skip("meshlabserver needs a display, and Xvfb is not installed")
    return os.path.join(run.stdout.strip(), "bin", "meshlabserver")


SERVER = _stage()


@functools.lru_cache(maxsize=None)
def display():
    """A display of its own for all runs of this process; xvfb-run sometimes fails to clean up."""
    reading, writing = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(writing), "-screen", "0", "1280x1024x24", "-nolisten", "tcp"],
        pass_fds=(writing,), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    atexit.register(server.wait)
    atexit.register(server.terminate)
    os.close(writing)
    with os.fdopen(reading) as numbers:
        return ":" + numbers.readline().strip()


def run(arguments, folder):
    environment = dict(os.environ, HOME=folder, XDG_RUNTIME_DIR=folder, DISPLAY=display())
    return subprocess.run([SERVER] + arguments, cwd=folder, env=environment,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300)


def parameter_xml(name, kind, value, choices_of):
    if kind == "Bool":
        value = "true" if value else "false"
    extra = ""
    if kind == "Enum":
        choices = choices_of[name]
        extra = f' enum_cardinality="{len(choices)}"' + "".join(
            f" enum_val{i}={quoteattr(choice)}" for i, choice in enumerate(choices))
    return f'  <Param type="Rich{kind}" name="{name}" value={quoteattr(str(value))}{extra}/>\n'


def step(our_filter=common, **values):
    """Our filter as a part of a script, with the defaults where no value is given."""
    values = common.in_dialog(our_filter, values)
    unknown = set(values) - {name for name, _, _ in our_filter.PARAMETERS}
    if unknown:
        raise ValueError(f"unknown parameters {unknown}")
    lines = "".join(parameter_xml(name, kind, values.get(name, default), our_filter.CHOICES)
                    for name, kind, default in our_filter.PARAMETERS)
    return f' <filter name="{our_filter.NAME}">\n{lines} </filter>\n'


def script_of(*steps):
    return f'<!DOCTYPE FilterScript>\n<FilterScript>\n{"".join(steps)}</FilterScript>\n'


def script(before="", our_filter=common, **values):
    """A filter script with our filter."""
    return script_of(before, step(our_filter, **values))


def layer(number):
    """A stock filter that makes another layer the current one."""
    return (' <filter name="Change the current layer">\n'
            f'  <Param type="RichMesh" name="layer" value="{number}"/>\n'
            " </filter>\n")


def selection(condition):
    """A stock filter that selects vertices, to go before ours."""
    return (' <filter name="Conditional Vertex Selection">\n'
            f'  <Param type="RichString" name="condSelect" value={quoteattr(condition)}/>\n'
            " </filter>\n")


def results(output):
    """The key=value pairs of the log."""
    pairs = {}
    for line in re.findall(r"^(?:Result|Surface): (.*)$", output, re.MULTILINE):
        pairs.update(pair.split("=") for pair in line.split())
    return pairs


class Run:
    """One mesh through one script; exit code, output text and the saved mesh's bytes."""

    def __init__(self, script_text, write_input=None, output="out.ply", masks=("wt", "vq", "vc")):
        self.folder = tempfile.mkdtemp(prefix="ricci-")
        try:
            with open(os.path.join(self.folder, "script.mlx"), "w", encoding="utf-8") as out:
                out.write(script_text)
            arguments = []
            if write_input is not None:
                write_input(os.path.join(self.folder, "in.ply"))
                arguments += ["-i", "in.ply", "-o", output, "-m", *masks]
            finished = run(arguments + ["-s", "script.mlx"], self.folder)
            self.code = finished.returncode
            self.text = finished.stdout.decode("utf-8", "replace")
            saved = os.path.join(self.folder, output)
            self.saved = os.path.exists(saved)
            self.mesh = self._read(saved) if self.saved and output.endswith(".ply") else None
            if self.saved and self.mesh is None:
                with open(saved, encoding="utf-8") as source:
                    self.saved_text = source.read()
        finally:
            shutil.rmtree(self.folder)

    @staticmethod
    def _read(path):
        import meshes
        return meshes.read_ply(path)
