# SPDX-License-Identifier: GPL-3.0-or-later
"""The wheels that filter_ricci/wheels.sh makes, and the source distribution: what is in them, and the maps of
every library that can be run here, beside those of the library that the compiler of this machine has made.
Usage: test_wheels.py BUILD_DIR PLATFORM... [sdist], with a Python that has lief and numpy. tests/deep.sh makes the
systems in BUILD_DIR/deep/systems: oldest, a Debian, and arm64, another's files."""

import glob
import hashlib
import json
import math
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zipfile

import common
import meshes

PLATFORMS = [name for name in sys.argv[1:] if name != "sdist"]
HAS_SDIST = "sdist" in sys.argv[1:]
sys.argv[1:] = []
if not PLATFORMS and not HAS_SDIST:
    common.skip("the wheels for other machines: bash tests/deep.sh wheels makes and tries them")

import lief
import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
SYSTEMS = os.path.join(common.BUILD, "deep", "systems")
ARM = os.path.join(SYSTEMS, "arm64")
ZIG = os.path.join(common.BUILD, "wheels", "bin", "zig")
SHARED = os.path.join(os.path.dirname(common.REPOSITORY), "shared", "meshes")
with open(os.path.join(common.REPOSITORY, "CMakeLists.txt"), encoding="utf-8") as project:
    VERSION = re.search(r"(?m)^project\(\w+ VERSION ([\d.]+)", project.read()).group(1)
INCLUDED = os.path.join(common.REPOSITORY, "filter_ricci", "library")
NATIVE = os.path.join(common.BUILD, "library")
IMPORTS = {
    "many": r"lib(c|m|dl|pthread|rt)\.so\.\d|ld-linux-.*\.so\.\d", "musl": r"libc\.so",
    "win": r"api-ms-win-crt-.*\.dll|KERNEL32\.dll", "maco": r"/usr/lib/libSystem\.B\.dylib"}
# Of one sliver, or what the last step of the flow leaves: as near as rounding puts them.
OF_ONE_PLACE = ("log_radius", "quality", "target_curvature", "results.cone_curvatures", "results.qc_max")
SCRIPT = """
import json, os, sys, time
start = time.perf_counter()
import numpy
between = time.perf_counter()
import ricciflow
end = time.perf_counter()
resident = 0
if os.path.exists("/proc/self/status"):  # not where only the root is another
    with open("/proc/self/status") as status:
        resident = next(int(line.split()[1]) for line in status if line.startswith("VmRSS"))
maps = []
for path in sys.argv[1:]:
    numbers = numpy.array(open(path).read().split(), float)
    v, f = (int(n) for n in numbers[:2])
    result = ricciflow.flatten(numbers[2:2 + 3 * v].reshape(-1, 3),
                               numbers[2 + 3 * v:].reshape(-1, 3).astype(int))
    maps.append({"uv": result.uv.ravel().tolist(), "log_radius": result.log_radius.tolist(),
                 **{"results." + key: numpy.ravel(value).tolist() for key, value in result.results.items()}})
json.dump([between - start, end - start, resident, maps], sys.stdout)
"""


def wheel(platform):
    folder = os.path.join(common.BUILD, "release", "wheels")
    found = glob.glob(os.path.join(folder, f"ricciflow-{VERSION}-*-{platform}*.whl"))
    if len(found) != 1:
        raise AssertionError(f"bash filter_ricci/wheels.sh {platform} makes it: {found}")
    return found[0]


def content(platform):
    with zipfile.ZipFile(wheel(platform)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def library(platform, folder):
    """Written there under the name that it was linked with."""
    (name, data), = ((name, data) for name, data in content(platform).items()
                     if name.endswith((".so", ".dylib", ".dll")))
    path = os.path.join(folder, os.path.basename(name).replace("ricciflow.dll", "libricciflow.dll"))
    with open(path, "wb") as target:
        target.write(data)
    return path


def run(command, **options):
    """Standard output. A failure is an error with all that was said."""
    done = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    if done.returncode:
        said = done.stdout[-2000:] + done.stderr[-4000:]
        raise AssertionError(f"{' '.join(command)}: {done.returncode}\n{said}")
    return done.stdout


def uneven(mesh):
    """No two of its parts are alike, so that no choice hangs on the last bit."""
    def moved(x, y, z):
        return (x + 0.05 * math.sin(1.7 * y + 0.9 * z + 0.3), y + 0.05 * math.sin(1.3 * z + 1.1 * x + 0.8),
                z + 0.05 * math.sin(1.9 * x + 0.7 * y + 0.1))
    return meshes.Mesh([moved(*vertex) for vertex in mesh.vertices], mesh.faces)


def all_meshes():
    made = {"torus": uneven(meshes.torus(48, 24)), "screw": uneven(meshes.screw()),
            "double_torus": uneven(meshes.double_torus())}
    for name in ("g1_mc_torus_small", "g2_amphora"):
        path = os.path.join(SHARED, f"{name}.ply")
        if os.path.exists(path):
            made[name] = meshes.read_ply(path)
    return made


def write_meshes(folder):
    """Name of each mesh -> its file, as print_map reads it."""
    paths = {}
    for name, mesh in all_meshes().items():
        paths[name] = os.path.join(folder, f"{name}.txt")
        with open(paths[name], "w", encoding="ascii") as target:
            print(len(mesh.vertices), len(mesh.faces), file=target)
            for row in (*mesh.vertices, *mesh.faces):
                print(*(repr(x) for x in row), file=target)
    return paths


def parsed(text):
    """What print_map says, name -> numbers."""
    lines = (line.split() for line in text.splitlines()[1:])
    return {name: [float(x) for x in numbers] for name, *numbers in lines}


class Files(unittest.TestCase):
    """What is in each wheel."""

    def test_size(self):
        for platform in PLATFORMS:
            self.assertLessEqual(os.path.getsize(wheel(platform)), 4e6, platform)

    def test_licences(self):
        """Those of all that is compiled in, each named and each with its text."""
        wanted = {"LICENSE", "LICENSE.Eigen", "LICENSE.vcglib", "LICENSE.libcxx", "LICENSE.libcxxabi",
                  "LICENSE.libunwind", "LICENSE.zig"}
        terms = "GPL-3.0-or-later AND MPL-2.0"
        if glob.glob(os.path.join(common.BUILD, "sources", "suitesparse-*")):  # else Eigen's solver is inside
            wanted.add("LICENSE.SuiteSparse")
            terms += " AND LGPL-2.1-or-later AND GPL-2.0-or-later AND BSD-3-Clause"
        for platform in PLATFORMS:
            files = content(platform)
            text, = (data.decode() for name, data in files.items() if name.endswith("/METADATA"))
            named = set(re.findall(r"(?m)^License-File: (.*)$", text))
            lie = {name.rsplit("/", 1)[1]: len(data) for name, data in files.items() if "/licenses/" in name}
            self.assertEqual(named, set(lie))
            self.assertEqual(wanted - named, set())
            self.assertGreater(min(lie.values()), 900)
            self.assertIn(f"License-Expression: {terms} AND Apache-2.0 WITH LLVM-exception AND MIT", text)

    def test_libraries(self):
        """Each exports the functions of ricci_c.h alone, and needs what every such system has."""
        with open(os.path.join(INCLUDED, "ricci_c.h"), encoding="utf-8") as header:
            functions = set(re.findall(r"(?m)^RICCI_API .*?(ricci_\w+)\(", header.read()))
        with tempfile.TemporaryDirectory() as folder:
            for platform in PLATFORMS:
                path = library(platform, folder)
                binary = lief.parse(path)
                if platform.startswith("win"):
                    exported = {entry.name for entry in binary.get_export().entries}
                    needed = [entry.name for entry in binary.imports]
                elif platform.startswith("mac"):
                    exported = {symbol.name.removeprefix("_") for symbol in binary.exported_symbols}
                    needed = [entry.name for entry in binary.libraries
                              if entry.command != lief.MachO.LoadCommand.TYPE.ID_DYLIB]
                else:
                    exported = {symbol.name for symbol in binary.dynamic_symbols if symbol.exported}
                    needed = list(binary.libraries)
                self.assertEqual(exported, functions, platform)
                with open(path, "rb") as source:
                    self.assertFalse(common.BUILD.encode() in source.read(), platform)
                for name in needed:
                    self.assertRegex(name, f"^({IMPORTS[platform[:4].rstrip('_')]})$", platform)
                self.assertTrue(needed)
                check = getattr(self, "check_" + platform.split("_")[0], None)
                if check:
                    check(platform, path, binary)

    def check_manylinux(self, platform, path, _):
        with open(path, "rb") as source:
            needed = [int(minor) for minor in re.findall(rb"GLIBC_2\.(\d+)", source.read())]
        self.assertLessEqual(max(needed), int(re.search(r"_2_(\d+)_", platform).group(1)))

    def check_macosx(self, platform, path, binary):
        """For no newer system than the wheel says; for ARM signed, page by page, as these systems demand."""
        wanted = [int(x) for x in re.match(r"macosx_(\d+)_(\d+)_", platform).groups()]
        self.assertEqual(list(binary.build_version.minos)[:2], wanted)
        # Nothing is exchanged for what other libraries of the process have.
        self.assertFalse(binary.header.has(lief.MachO.Header.FLAGS.BINDS_TO_WEAK))
        self.assertEqual(bytes(binary.dyld_info.weak_bind_opcodes).strip(b"\0"), b"")
        with open(path, "rb") as source:
            data = source.read()
        if not binary.has_code_signature and platform.endswith("x86_64"):
            return
        place = binary.code_signature.data_offset
        magic, _, count = struct.unpack_from(">III", data, place)
        self.assertEqual(magic, 0xfade0cc0)
        directories = [place + offset for _, offset in struct.iter_unpack(
            ">II", data[place + 12:place + 12 + 8 * count])
            if struct.unpack_from(">I", data, place + offset)[0] == 0xfade0c02]
        self.assertTrue(directories)
        for directory in directories:
            hashes, _, _, pages, limit, size, kind, _, shift = struct.unpack_from(
                ">IIIIIBBBB", data, directory + 16)
            self.assertEqual((size, kind), (32, 2))
            self.assertEqual(limit, place)
            for page in range(pages):
                start = page << shift
                stated = data[directory + hashes + 32 * page:][:32]
                end = min(start + (1 << shift), limit)
                self.assertEqual(hashlib.sha256(data[start:end]).digest(), stated)


class Maps(unittest.TestCase):
    """The same charts, cuts and counts; figures to 12 digits; texture coordinates to a step of a float."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.paths = write_meshes(cls.folder)
        program = os.path.join(cls.folder, "native")
        run(["cc", "-I", INCLUDED, os.path.join(HERE, "print_map.c"), "-o", program, "-L", NATIVE,
             "-lricciflow", f"-Wl,-rpath,{NATIVE}"])
        cls.expected = {name: parsed(run([program, path])) for name, path in cls.paths.items()}

    def compare(self, where, maps):
        worst = {"figures": 0.0, "single places": 0.0, "uv": 0.0}
        other_floats = corners = 0
        for name, found in maps.items():
            for key, values in self.expected[name].items():
                if key not in found:  # Python gives fewer
                    continue
                self.assertEqual(len(values), len(found[key]), (where, name, key))
                one, two = numpy.array(values), numpy.array(found[key])
                if (one == numpy.floor(one)).all() and key != "uv":
                    self.assertEqual(one.tolist(), two.tolist(), (where, name, key))
                    continue
                off = numpy.abs(one - two) / numpy.maximum(1.0, numpy.abs(one))
                kind = "uv" if key == "uv" else "single places" if key in OF_ONE_PLACE else "figures"
                worst[kind] = max(worst[kind], off.max())
                if key == "uv":
                    other_floats += int((one != two).sum())
                    corners += len(one)
            self.assertIn("results.charts", found)
        told = ", ".join(f"{kind} {value:.1e}" for kind, value in worst.items())
        print(f"{where}: {len(maps)} meshes; largest differences: {told} ({other_floats} of {corners} "
              "floats)", flush=True)
        self.assertLess(worst["figures"], 1e-12, where)
        self.assertLess(worst["single places"], 1e-11, where)
        self.assertLess(worst["uv"], 2.0 ** -24 * 1.01, where)
        self.assertLess(other_floats, 1e-3 * corners, where)

    def in_c(self, platform, launcher, **options):
        """By a program in C that zig compiles for the platform."""
        if platform not in PLATFORMS:
            self.skipTest(f"no wheel for {platform} was asked for")
        place = os.path.join(common.BUILD, "wheels", platform)
        with open(os.path.join(place, "CMakeCache.txt"), encoding="utf-8") as settings:
            target = re.search(r"RICCI_ZIG_TARGET:\w+=(.*)", settings.read()).group(1)
        with tempfile.TemporaryDirectory() as folder:
            linked = library(platform, folder)
            if platform.startswith("win"):
                linked = glob.glob(os.path.join(place, "**", "*ricciflow*.a"), recursive=True)[0]
            program = os.path.join(folder, "print_map.exe")
            cache = os.path.join(common.BUILD, "wheels", "cache")
            run([ZIG, "cc", "-O2", "-target", target, "-I", INCLUDED, os.path.join(HERE, "print_map.c"),
                 linked, "-o", program, "-Wl,-rpath,$ORIGIN"],
                env={**os.environ, "ZIG_GLOBAL_CACHE_DIR": cache, "ZIG_LOCAL_CACHE_DIR": cache})
            self.compare(platform, {name: parsed(run([*launcher, program, path], **options))
                                    for name, path in self.paths.items()})

    def needed(self, what, *places):
        """The first of the programs and files that is there."""
        for place in places:
            found = place if os.path.exists(place) else shutil.which(place)
            if found:
                return found
        return self.skipTest(f"{what} is not there")

    def test_x86_64(self):
        self.in_c("manylinux_2_17_x86_64", [])

    def test_aarch64(self):
        emulator = self.needed("qemu (Debian: qemu-user-static)", "qemu-aarch64-static")
        self.needed("a Debian for arm64 (tests/deep.sh wheels)", ARM)
        self.in_c("manylinux_2_17_aarch64", [emulator, "-L", ARM])

    def test_musl(self):
        self.needed("the C library musl (Debian: musl)", "/lib/ld-musl-x86_64.so.1")
        self.in_c("musllinux_1_2_x86_64", [])

    def test_windows(self):
        wine = self.needed("Wine (Debian: wine64)", "wine64", "/usr/lib/wine/wine64")
        self.in_c("win_amd64", [wine], env={**os.environ, "WINEDEBUG": "-all",
                                            "WINEPREFIX": os.path.join(common.BUILD, "deep", "wine")})

    def by_python(self, where, python, folder=None, **options):
        """Seconds of numpy's import and of both, and the memory then, in kB; the maps are compared."""
        given = folder or self.folder
        paths = write_meshes(given)
        inside = [path if folder is None else f"/{os.path.basename(folder)}/{os.path.basename(path)}"
                  for path in paths.values()]
        *measured, maps = json.loads(run([*python, "-c", SCRIPT, *inside], **options))
        self.compare(where, dict(zip(paths, maps)))
        return measured

    def test_empty_environment(self):
        """Nothing but the wheel and numpy: their size, the time of the import, the memory after it."""
        platform = "manylinux_2_17_x86_64"
        if platform not in PLATFORMS:
            self.skipTest(f"no wheel for {platform} was asked for")
        with tempfile.TemporaryDirectory() as folder:
            run([sys.executable, "-m", "venv", folder])
            python = os.path.join(folder, "bin", "python")
            try:
                run([python, "-m", "pip", "install", "-q", wheel(platform)])
            except AssertionError as problem:
                self.skipTest(f"pip cannot install the wheel and numpy: {problem}")
            installed = json.loads(run([python, "-m", "pip", "list", "--format", "json"]))
            self.assertEqual({each["name"] for each in installed} - {"pip", "setuptools"},
                             {"numpy", "ricciflow"})
            size = sum(os.lstat(os.path.join(place, name)).st_size
                       for place, _, names in os.walk(folder) for name in names)
            tries = [self.by_python(f"Python {sys.version.split()[0]}", [python])]
            tries += [json.loads(run([python, "-c", SCRIPT]))[:3] for _ in range(6)]
            both, alone = min(each[1] for each in tries), min(each[0] for each in tries)
            print(f"{size / 1e6:.0f} MB installed; import {1e3 * both:.0f} ms, numpy alone "
                  f"{1e3 * alone:.0f} ms; then {tries[-1][2] / 1024:.0f} MB in memory", flush=True)
            self.assertLess(size, 110e6)
            self.assertLess(both, 1.3 * alone)
            self.assertLess(tries[-1][2], 30 * 1024)
            self.example(folder, [python])

    def test_source_distribution(self):
        """pip compiles it in an empty environment, as where no wheel fits."""
        if not HAS_SDIST:
            self.skipTest("the source distribution was not asked for")
        self.needed("a compiler of C++ (Debian: g++)", "c++")
        with tempfile.TemporaryDirectory() as folder:
            run([sys.executable, "-m", "venv", folder])
            python, needed = os.path.join(folder, "bin", "python"), os.path.join(folder, "needed")
            try:
                run([python, "-m", "pip", "download", "-q", "-d", needed, "cmake>=3.25", "ninja", "numpy"])
            except AssertionError as problem:
                self.skipTest(f"pip cannot fetch cmake, ninja and numpy: {problem}")
            run([python, "-m", "pip", "install", "-q", "--no-index", "--find-links", needed,
                 os.path.join(common.BUILD, "release", "wheels", f"ricciflow-{VERSION}.tar.gz")])
            self.by_python("source distribution", [python])
            self.example(folder, [python])

    def example(self, folder, python):
        """The README's first lines of Python, as they stand there."""
        with open(os.path.join(common.REPOSITORY, "README.md"), encoding="utf-8") as readme:
            code = re.search(r"```python\n(.*?)```", readme.read(), re.DOTALL).group(1)
        meshes.write_ply(os.path.join(folder, "mesh.ply"), uneven(meshes.torus()))
        run([*python, "-c", code], cwd=folder)
        self.assertTrue(os.path.exists(os.path.join(folder, "uv.obj")))

    def test_oldest_system(self):
        """In a Debian of its own, with its C library and its Python."""
        platform = "manylinux_2_17_x86_64"
        if platform not in PLATFORMS:
            self.skipTest(f"no wheel for {platform} was asked for")
        root = self.needed("an older Debian (tests/deep.sh wheels, as root)", os.path.join(SYSTEMS, "oldest"))
        folder = os.path.join(root, "wheels")
        shutil.rmtree(folder, ignore_errors=True)
        os.mkdir(folder)
        self.addCleanup(shutil.rmtree, folder)
        inside = ["chroot", root, "env", "-i", "-C", "/wheels", "HOME=/root", "PATH=/usr/bin:/bin"]
        version = run([*inside, "python3", "-c", "import sys; print('%d.%d' % sys.version_info[:2])"]).strip()
        libc = run([*inside, "getconf", "GNU_LIBC_VERSION"]).strip()
        self.fetch_numpy(folder, version, "manylinux2014_x86_64")
        shutil.copy(wheel(platform), folder)
        run([*inside, "python3", "-m", "venv", "/wheels/venv"])
        run([*inside, "/wheels/venv/bin/pip", "install", "-q", "--no-index", "--find-links", "/wheels",
             "ricciflow"])
        python = [*inside, "/wheels/venv/bin/python"]
        self.by_python(f"Python {version}, {libc}", python, folder)
        self.example(folder, python)

    def fetch_numpy(self, folder, version, platform):
        try:
            run([sys.executable, "-m", "pip", "download", "-q", "--no-deps", "--only-binary=:all:",
                 "--python-version", version, "--platform", platform, "-d", folder, "numpy"])
        except AssertionError as problem:
            self.skipTest(f"pip cannot fetch numpy for {platform}: {problem}")

    def test_python_aarch64(self):
        """That processor's Python and numpy, emulated."""
        platform = "manylinux_2_17_aarch64"
        if platform not in PLATFORMS:
            self.skipTest(f"no wheel for {platform} was asked for")
        emulator = self.needed("qemu (Debian: qemu-user-static)", "qemu-aarch64-static")
        program = self.needed("a Debian for arm64 (tests/deep.sh wheels)",
                              *glob.glob(os.path.join(ARM, "usr", "bin", "python3.[0-9]*[0-9]")), ARM + "/no")
        version = os.path.basename(program).removeprefix("python")
        with tempfile.TemporaryDirectory() as folder:
            self.fetch_numpy(folder, version, "manylinux2014_aarch64")
            run([sys.executable, "-m", "pip", "install", "-q", "--no-deps", "--no-index", "--find-links",
                 folder, "--only-binary=:all:", "--python-version", version,
                 "--platform", "manylinux2014_aarch64", "--platform", platform,
                 "--target", os.path.join(folder, "installed"), "numpy", wheel(platform)])
            self.by_python(f"Python {version}, aarch64", [emulator, "-L", ARM, program],
                           env={**os.environ, "PYTHONPATH": os.path.join(folder, "installed")})


if __name__ == "__main__":
    common.main()
