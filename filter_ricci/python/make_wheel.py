# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the Python package around the library: a wheel, and on request a folder to import from.
Nothing but Python itself is needed. The same input gives the same wheel, bit by bit."""

import argparse
import base64
import hashlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

HERE = os.path.dirname(os.path.abspath(__file__))
NAME = "ricciflow"
FORMER_NAME = "pymeshlab_ricci"  # its module says that it has another name now
SOURCES = (".py", ".pyi", ".typed")
LIBRARIES = {".so": "libricciflow.so", ".dylib": "libricciflow.dylib", ".dll": "ricciflow.dll"}
PLUGIN = "libfilter_ricci.so"
METADATA = """\
Metadata-Version: 2.4
Name: {name}
Version: {version}
Summary: UV unwrap: conformal parametrization of triangle meshes by discrete Ricci flow
Author: {author}
License-Expression: {expression}
{licences}Keywords: mesh,uv,unwrap,parametrization,conformal,ricci-flow,uniformization,meshlab
{systems}Classifier: Topic :: Multimedia :: Graphics :: 3D Modeling
Classifier: Topic :: Scientific/Engineering :: Mathematics
Classifier: Typing :: Typed
Requires-Python: >=3.9
Requires-Dist: numpy
Provides-Extra: images
Requires-Dist: Pillow; extra == "images"
Provides-Extra: pymeshlab
Requires-Dist: pymeshlab; extra == "pymeshlab"
Provides-Extra: progress
Requires-Dist: tqdm; extra == "progress"
Provides-Extra: cluster
Requires-Dist: dask[distributed]; extra == "cluster"
Description-Content-Type: text/markdown

{description}"""
SCRIPTS = """\
[console_scripts]
ricciflow = ricciflow.__main__:main
pymeshlab-ricci = pymeshlab_ricci.__main__:main
"""
COMMAND = """
`ricciflow IN OUT` unwraps a file, or every mesh of a folder.
"""
SYSTEMS = {"linux": "POSIX :: Linux", "macosx": "MacOS", "win": "Microsoft :: Windows"}


def parse(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--library", required=True, help="the C library, .so, .dylib or .dll")
    parser.add_argument("--plugin", help="PyMeshLab's plugin, where there is one for the platform")
    parser.add_argument("--tag", default="", help="platform, such as win_amd64; names that a dot "
                        "joins are all meant. Default: what this Python and the library say")
    parser.add_argument("--strip", default="", help="program that takes symbols out of a library")
    parser.add_argument("--version", required=True)
    parser.add_argument("--readme", required=True,
                        help="that begins with an example, then says what it is")
    parser.add_argument("--author", required=True)
    parser.add_argument("--expression", default="GPL-3.0-or-later",
                        help="the licences of all that is inside, in SPDX's words")
    parser.add_argument("--licences", nargs="*", default=[], metavar="FILE[=NAME]")
    parser.add_argument("--folder", help="for the package as it is imported")
    parser.add_argument("--wheels", required=True, help="folder for the wheel")
    return parser.parse_args(arguments)


def read(path):
    with open(path, "rb") as source:
        return source.read()


def stripped(path, strip):
    """The bytes of a library, without the symbols that only a linker needs."""
    if not strip:
        return read(path)
    with tempfile.TemporaryDirectory() as folder:
        copy = shutil.copy(path, folder)
        subprocess.run([strip, "--strip-unneeded", copy], check=True)
        return read(copy)


def platform_tag(library):
    """Of a library that was built here. On Linux it is the oldest manylinux that has the C library
    which it needs; the plugin loads in PyMeshLab only, which needs a newer one by itself."""
    system = re.sub(r"[^\w]", "_", sysconfig.get_platform())
    if not system.startswith("linux_"):
        return system
    needed = [int(minor) for minor in re.findall(rb"GLIBC_2\.(\d+)", library)]
    if not needed:  # of another C library
        return system
    return f"manylinux_2_{max([17] + needed)}_{system[len('linux_'):]}"


def description(readme):
    """The README's example and what it says below it, up to the next heading."""
    text = read(readme).decode()
    found = re.search(r"```python\n(?:# pip [^\n]*\n)?(.*?)```\n\n(.*?)\n## ", text, re.DOTALL)
    if not found:
        sys.exit(f"{readme} has no example in Python with a text below it.")
    code, said = found.groups()
    return f"{said}\n```python\n{code}```\n{COMMAND}"


def named(licences):
    """Name in the package -> file, of FILE[=NAME]."""
    pairs = (licence.partition("=") for licence in licences)
    return {name or os.path.basename(path): path for path, _, name in pairs}


def metadata(options, licences, systems):
    return METADATA.format(
        name=NAME, version=options.version, author=options.author, expression=options.expression,
        licences="".join(f"License-File: {name}\n" for name in licences),
        systems="".join(f"Classifier: Operating System :: {system}\n" for system in systems),
        description=description(options.readme)).encode()


def package(name):
    """Name in the wheel -> bytes, of all Python in a package."""
    files = {}
    for place, folders, names in os.walk(os.path.join(HERE, name)):
        folders[:] = sorted(folder for folder in folders if folder != "__pycache__")
        inside = os.path.relpath(place, HERE).replace(os.sep, "/")
        files.update((f"{inside}/{file}", read(os.path.join(place, file)))
                     for file in sorted(names) if file.endswith(SOURCES))
    return files


def content(options):
    """Tag of the platform, and name in the wheel -> bytes with RECORD."""
    library = stripped(options.library, options.strip)
    tag = options.tag or platform_tag(library)
    files = {**package(NAME), **package(FORMER_NAME)}
    files[f"{NAME}/{LIBRARIES[os.path.splitext(options.library)[1]]}"] = library
    if options.plugin:
        files[f"{NAME}/{PLUGIN}"] = stripped(options.plugin, options.strip)
    information = f"{NAME}-{options.version}.dist-info"
    licences = named(options.licences)
    files.update((f"{information}/licenses/{name}", read(path)) for name, path in licences.items())
    systems = [system for key, system in SYSTEMS.items() if re.match(rf"(many|musl)?{key}", tag)]
    files[f"{information}/METADATA"] = metadata(options, licences, systems)
    files[f"{information}/entry_points.txt"] = SCRIPTS.encode()
    files[f"{information}/WHEEL"] = (
        "Wheel-Version: 1.0\nGenerator: make_wheel\nRoot-Is-Purelib: false\n" +
        "".join(f"Tag: py3-none-{one}\n" for one in tag.split("."))).encode()
    record = f"{information}/RECORD"
    files[record] = recorded(files, record)
    return tag, files


def recorded(files, name):
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
    with zipfile.ZipFile(wheel + ".part", "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for path, data in files.items():
            entry = zipfile.ZipInfo(path, date_time=(1980, 1, 1, 0, 0, 0))
            entry.create_system = 3  # the modes below are Unix's wherever the wheel is made
            entry.compress_type = zipfile.ZIP_DEFLATED
            is_library = os.path.splitext(path)[1] in LIBRARIES
            entry.external_attr = (0o100755 if is_library else 0o100644) << 16
            archive.writestr(entry, data, compresslevel=9)
    os.replace(wheel + ".part", wheel)


def main(arguments=None):
    """The path of the wheel."""
    options = parse(arguments)
    os.makedirs(options.wheels, exist_ok=True)
    tag, files = content(options)
    if options.folder:
        write_folder(options.folder, files)
    wheel = os.path.join(options.wheels, f"{NAME}-{options.version}-py3-none-{tag}.whl")
    write_wheel(wheel, files)
    return wheel


if __name__ == "__main__":
    print(main())
