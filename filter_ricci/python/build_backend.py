# SPDX-License-Identifier: GPL-3.0-or-later
"""Between pip and the build (PEP 517): the library by CMake, the wheel around it by make_wheel.py. The
source distribution has what it needs of others in sources/; in a clone CMake looks for it as always.

As a program, for wheels.sh: the wheel around a library that was compiled for another platform.
Usage: build_backend.py LIBRARY TAG WHEELS EXPRESSION [LICENCE=NAME...]; the licences are those of what the
compiler puts into the library."""

import gzip
import io
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile

import make_wheel

ROOT = os.path.dirname(os.path.dirname(make_wheel.HERE))
SOURCES = os.path.join(ROOT, "sources")
OTHERS = {"vcglib": "GPL-3.0-or-later", "Eigen": "MPL-2.0",  # folders there
          "SuiteSparse": "LGPL-2.1-or-later AND GPL-2.0-or-later AND BSD-3-Clause"}


def _stated(expression="", licences=()):
    """What the files of the repository say, as options of make_wheel."""
    def find(name, pattern):
        with open(os.path.join(ROOT, name), encoding="utf-8") as source:
            return re.search(pattern, source.read(), re.MULTILINE).group(1)
    arguments = ["--version", find("CMakeLists.txt", r"^project\(\w+ VERSION ([\d.]+)"),
                 "--author", find("CITATION.cff", r"^  - name: (.*)"),
                 "--readme", os.path.join(ROOT, "README.md")]
    texts, terms = [os.path.join(ROOT, "LICENSE")], ["GPL-3.0-or-later"]
    for other, term in OTHERS.items():
        licence = os.path.join(SOURCES, other, "LICENSE")
        if os.path.exists(licence):
            texts.append(f"{licence}=LICENSE.{other}")
            terms += [term] if term not in terms else []
    terms += [expression] if expression else []
    return [*arguments, "--expression", " AND ".join(terms), "--licences", *texts, *licences]


def get_requires_for_build_wheel(config_settings=None):
    """What pyproject.toml names is all."""
    del config_settings
    return []


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Compiles the library for this machine. Returns the name of the wheel."""
    del config_settings, metadata_directory
    options = ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DBUILD_TESTING=OFF",
               "-DCMAKE_DISABLE_FIND_PACKAGE_Qt5=ON"]
    if os.path.isdir(SOURCES):
        options += [f"-DVCGLIB_DIR={SOURCES}/vcglib",
                    f"-DEigen3_DIR={SOURCES}/Eigen/share/eigen3/cmake"]
        if os.path.isdir(f"{SOURCES}/SuiteSparse"):
            options.append(f"-DSUITESPARSE_SOURCE_DIR={SOURCES}/SuiteSparse")
    with tempfile.TemporaryDirectory() as build:
        subprocess.run(["cmake", "-S", ROOT, "-B", build, *options], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "ricciflow"], check=True)
        library, = (os.path.join(build, "library", name)
                    for name in os.listdir(os.path.join(build, "library"))
                    if os.path.splitext(name)[1] in make_wheel.LIBRARIES)
        strip = ["--strip", "strip"] if sys.platform == "linux" and shutil.which("strip") else []
        return os.path.basename(make_wheel.main(
            ["--library", library, *strip, "--wheels", wheel_directory, *_stated()]))


def build_sdist(sdist_directory, config_settings=None):
    """The tree that wheels.sh gathers as an archive, the same bits for the same tree. Returns its name."""
    del config_settings
    if not os.path.isdir(SOURCES):
        raise FileNotFoundError("bash filter_ricci/wheels.sh sdist makes the source distribution.")
    options = make_wheel.parse(["--library", "", "--wheels", "", *_stated()])
    folder = f"{make_wheel.NAME}-{options.version}"
    files = {"PKG-INFO": make_wheel.metadata(options, make_wheel.named(options.licences), ())}
    for place, folders, names in os.walk(ROOT):
        folders[:] = sorted(name for name in folders if name != "__pycache__")
        for path in (os.path.join(place, name) for name in sorted(names)):
            files[os.path.relpath(path, ROOT)] = make_wheel.read(path)
    name = f"{folder}.tar.gz"
    with open(os.path.join(sdist_directory, name), "wb") as raw, \
            gzip.GzipFile("", "wb", mtime=0, fileobj=raw) as packed, \
            tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as archive:
        for path, data in files.items():
            entry = tarfile.TarInfo(f"{folder}/{path}".replace(os.sep, "/"))
            entry.size, entry.mtime = len(data), 315532800  # 1980, the earliest that a zip file has
            archive.addfile(entry, io.BytesIO(data))
    return name


def _main(library, tag, wheels, expression, *licences):
    print(make_wheel.main(["--library", library, "--tag", tag, "--wheels", wheels,
                           *_stated(expression, licences)]))


if __name__ == "__main__":
    _main(*sys.argv[1:])
