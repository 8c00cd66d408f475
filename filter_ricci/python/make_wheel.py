# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the Python package around the plugin: a folder to import from, and the same as a wheel.
Called by CMake; nothing but Python itself is needed. The same input gives the same wheel."""

import argparse
import base64
import hashlib
import os
import re
import shutil
import subprocess
import zipfile

NAME = "pymeshlab_ricci"
GLIBC = 35  # minor version, of PyMeshLab's own wheels
METADATA = """\
Metadata-Version: 2.4
Name: pymeshlab-ricci
Version: {version}
Summary: Conformal UV unwrapping of triangle meshes by discrete Ricci flow, for PyMeshLab
Author: {author}
License-Expression: GPL-3.0-or-later
{licences}Keywords: mesh,uv,parametrization,conformal,ricci-flow,uniformization,meshlab
Classifier: Operating System :: POSIX :: Linux
Classifier: Topic :: Multimedia :: Graphics :: 3D Modeling
Classifier: Topic :: Scientific/Engineering :: Mathematics
Classifier: Typing :: Typed
Requires-Python: >=3.9
Requires-Dist: pymeshlab>=2025.7,<2025.8
Requires-Dist: numpy
Provides-Extra: cluster
Requires-Dist: dask[distributed]; extra == "cluster"
Provides-Extra: progress
Requires-Dist: tqdm; extra == "progress"
Provides-Extra: gltf
Requires-Dist: trimesh; extra == "gltf"
Description-Content-Type: text/markdown

{description}"""
SCRIPTS = """\
[console_scripts]
pymeshlab-ricci = pymeshlab_ricci.__main__:main
"""
COMMAND = """
`pymeshlab-ricci IN OUT` does a file or a folder. PyMeshLab needs the system's libGL and libOpenGL
(Debian: libgl1, libopengl0).
"""


def parse():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--plugin", required=True)
    parser.add_argument("--strip", default="", help="program that takes symbols out of a library")
    parser.add_argument("--version", required=True)
    parser.add_argument("--machine", required=True)
    parser.add_argument("--folder", required=True, help="for the package as it is imported")
    parser.add_argument("--wheels", required=True, help="folder for the wheel")
    parser.add_argument("--readme", required=True, help="that begins with an example, then says what it is")
    parser.add_argument("--author", required=True)
    parser.add_argument("--licences", nargs="*", default=[], metavar="FILE[=NAME]")
    return parser.parse_args()


def read(path):
    with open(path, "rb") as source:
        return source.read()


def platform_tag(plugin, machine):
    """The oldest manylinux that has the C library which plugin and PyMeshLab need."""
    needed = [int(minor) for minor in re.findall(rb"GLIBC_2\.(\d+)", read(plugin))]
    return f"manylinux_2_{max([GLIBC] + needed)}_{machine}"


def description(readme):
    """The README's example and what it says below it, up to the next heading."""
    text = read(readme).decode()
    code, said = re.search(r"```python\n(?:# pip [^\n]*\n)?(.*?)```\n\n(.*?)\n## ", text, re.DOTALL).groups()
    return f"{said}\n```python\n{code}```\n{COMMAND}"


def content(options, plugin):
    """Name in the wheel -> bytes, without RECORD."""
    sources = os.path.join(os.path.dirname(os.path.abspath(__file__)), NAME)
    files = {f"{NAME}/{name}": read(os.path.join(sources, name))
             for name in sorted(os.listdir(sources)) if name.endswith((".py", ".pyi", ".typed"))}
    files[f"{NAME}/libfilter_ricci.so"] = read(plugin)
    information = f"{NAME}-{options.version}.dist-info"
    licences = ""
    for licence in options.licences:
        path, _, name = licence.partition("=")
        name = name or os.path.basename(path)
        files[f"{information}/licenses/{name}"] = read(path)
        licences += f"License-File: {name}\n"
    files[f"{information}/METADATA"] = METADATA.format(
        version=options.version, licences=licences, author=options.author,
        description=description(options.readme)).encode()
    files[f"{information}/entry_points.txt"] = SCRIPTS.encode()
    files[f"{information}/WHEEL"] = (
        "Wheel-Version: 1.0\nGenerator: make_wheel\nRoot-Is-Purelib: false\n"
        f"Tag: py3-none-{platform_tag(plugin, options.machine)}\n").encode()
    return files, f"{information}/RECORD"


def record(files, name):
    lines = []
    for path, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        lines.append(f"{path},sha256={digest},{len(data)}\n")
    return "".join(lines + [f"{name},,\n"]).encode()


def write_folder(folder, files):
    shutil.rmtree(folder, ignore_errors=True)
    for path, data in files.items():
        target = os.path.join(folder, path)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        with open(target, "wb") as out:
            out.write(data)


def write_wheel(wheel, files):
    with zipfile.ZipFile(wheel + ".part", "w", zipfile.ZIP_DEFLATED) as archive:
        for path, data in files.items():
            entry = zipfile.ZipInfo(path, date_time=(1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o100755 if path.endswith(".so") else 0o100644) << 16
            archive.writestr(entry, data)
    os.replace(wheel + ".part", wheel)


def main():
    options = parse()
    os.makedirs(options.wheels, exist_ok=True)
    plugin = os.path.join(options.wheels, "stripped.part")
    shutil.copy(options.plugin, plugin)
    try:
        if options.strip:
            subprocess.run([options.strip, "--strip-unneeded", plugin], check=True)
        files, record_name = content(options, plugin)
        tag = platform_tag(plugin, options.machine)
    finally:
        os.remove(plugin)
    files[record_name] = record(files, record_name)
    write_folder(options.folder, files)
    write_wheel(os.path.join(options.wheels, f"{NAME}-{options.version}-py3-none-{tag}.whl"), files)


if __name__ == "__main__":
    main()
