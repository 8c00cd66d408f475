# SPDX-License-Identifier: GPL-3.0-or-later
"""Damaged files for ricciflow.files: each is read and written again, or refused by FileError, within ten
seconds and ten times its size and 64 MB. Usage: fuzz_files.py SECONDS [SEED], with numpy."""

import os
import random
import re
import resource
import signal
import sys
import tempfile
import time
import traceback
import tracemalloc
import warnings

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [
    os.path.join(ROOT, "tests", "hosts"),
    os.path.join(ROOT, "filter_ricci", "python", "ricciflow"),
]
import file_samples  # noqa: E402
import files  # noqa: E402
import numpy as np  # noqa: E402

NUMBERS = [
    b"0",
    b"-1",
    b"1",
    b"3",
    b"99",
    b"1e999",
    b"nan",
    b"-inf",
    b"4294967295",
    b"2147483648",
    b"1000000000000",
    b"99999999999999999999999",
    b"-9223372036854775808",
    b"1.5",
    b"",
    b"[]",
    b"null",
    b"{}",
    b'"a"',
    b"true",
]
WORDS = [int(2**k - 1).to_bytes(4, "little") for k in (0, 8, 16, 31, 32)] + [
    b"\0\0\xc0\x7f",
    b"\xff\xff\xff\xff",
]


class Hang(BaseException):
    """Not to be caught by anything but the loop."""


def damaged(content, rng):
    """The file with one to four faults."""
    for _ in range(rng.choice((1, 1, 2, 4))):
        at = rng.randrange(len(content) + 1)
        stop = min(len(content), at + rng.choice((1, 4, 30, 1000)))
        kind = rng.randrange(8)
        if kind == 0:
            content = content[:at]
        elif kind == 1:
            content = content[:at] + bytes([rng.randrange(256)]) + content[at + 1:]
        elif kind == 2:
            content = content[:at] + rng.choice(WORDS) + content[at + 4:]
        elif kind == 3:
            other = rng.randrange(len(content) + 1)
            content = content[:at] + content[other:other + stop - at] + content[stop:]
        elif kind == 4:
            content = content[:at] + content[stop:]
        elif kind == 5:
            content = content[:at] + content[at:stop] * rng.choice((2, 50)) + content[stop:]
        else:
            found = list(re.finditer(rb"-?\d+(\.\d*)?", content))
            if found:
                match = rng.choice(found)
                content = content[:match.start()] + rng.choice(NUMBERS) + content[match.end():]
    return content


def tried(path, size, folder, rng):
    """'read' or 'refused'; raises what is a fault."""
    tracemalloc.reset_peak()
    before = tracemalloc.get_traced_memory()[0]
    try:
        mesh = files.read(path)
        for picture in mesh.pictures:
            try:
                picture.read()
            except files.FileError:
                pass
        mesh.uv_picture, mesh.corner_colours(), mesh.corner_normals(), mesh.sized_vertices()
        uv = np.random.default_rng(0).random((len(mesh.faces), 3, 2))
        if rng.random() < 0.5:
            uv = np.zeros(uv.shape)
        for ending in (os.path.splitext(path)[1], rng.choice(files.WRITES)):
            if ending in files.WRITES:
                mesh.save(os.path.join(folder, "out", "out" + ending), uv,
                          os.path.join(folder, "a b.png") if rng.random() < 0.3 else None)
        return "read"
    except files.FileError as problem:
        if not str(problem):
            raise AssertionError("an error without a sentence") from problem
        return "refused"
    finally:
        peak = tracemalloc.get_traced_memory()[1] - before
        if peak > 10 * size + (64 << 20):
            raise AssertionError(f"{peak} bytes for a file of {size}")


def main():
    seconds, seed = float(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 0
    warnings.simplefilter("error")
    warnings.filterwarnings("ignore", category=DeprecationWarning)
    resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))

    def late(*_):
        raise Hang("more than ten seconds")
    signal.signal(signal.SIGALRM, late)
    rng, counts, faults, end = random.Random(seed), {}, 0, time.monotonic() + seconds
    tracemalloc.start()
    with tempfile.TemporaryDirectory() as folder:
        os.mkdir(os.path.join(folder, "out"))
        samples = file_samples.every()
        names = [n for n in samples if os.path.splitext(n)[1] in files.READS + (".mtl", ".png", ".bin")]
        while time.monotonic() < end:
            for name, content in samples.items():
                with open(os.path.join(folder, name), "wb") as file:
                    file.write(content)
            name = rng.choice(names)
            content = damaged(samples[name], rng)
            with open(os.path.join(folder, name), "wb") as file:
                file.write(content)
            read = {".mtl": "all.obj", ".png": "all.obj", ".bin": "rich.gltf"}.get(name[-4:], name)
            signal.alarm(10)
            try:
                outcome = tried(os.path.join(folder, read), len(content), folder, rng)
            except (Exception, Hang) as problem:  # pylint: disable=broad-except
                faults += 1
                outcome = "FAULT"
                kept = f"defect-{faults}-{name}"
                with open(kept, "wb") as file:
                    file.write(content)
                frames = [f for f in traceback.extract_tb(problem.__traceback__) if "files" in f.filename][-1]
                print(
                    f"{type(problem).__name__}: {str(problem)[:100]} at {os.path.basename(frames.filename)}:"
                    f"{frames.lineno}, file {kept}",
                    flush=True,
                )
            finally:
                signal.alarm(0)
            counts[name, outcome] = counts.get((name, outcome), 0) + 1
    for key in sorted(counts):
        print(*key, counts[key])
    print(sum(counts.values()), "files,", faults, "faults")
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
