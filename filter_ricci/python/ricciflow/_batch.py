# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs jobs, each in a process of its own, here or on a cluster, and keeps their records.

For meshes/a/b.off the folder OUT then holds a/b.ply and its record a/b.json (state, results or
reason, messages, files, seconds), or a/b.off.ply and a/b.off.json where the short names would meet
another mesh. The record is written last. A mesh whose record is there is not run again unless mesh,
parameters or library differ: a run that was interrupted goes on where it stopped. What an earlier run
wrote for a mesh is removed before it runs again."""

import collections
import concurrent.futures
import contextlib
import csv
import hashlib
import json
import os
import signal
import subprocess
import sys
import threading
import time

from ._library import PATH as LIBRARY
from ._loading import mesh_endings

ANSWERED = ("solved", "refused")
FINAL = (*ANSWERED, "unreadable")  # states that a second run would only repeat
FAILED = ("crashed", "timeout")


def find_meshes(folder):
    """Paths below the folder, relative to it, in order; and of the other files, how many have which
    ending. Files that a run has written there count as neither."""
    found, others, endings = [], collections.Counter(), mesh_endings()
    for place, _, names in os.walk(folder):
        written = {"results.csv", "failures.txt"}
        for name in names:
            record = read_record(os.path.join(place, name)) if name.endswith(".json") else {}
            if {"mesh", "state", "files"} <= set(record):
                written.update(record["files"], [name])
        for name in set(names) - written:
            ending = os.path.splitext(name)[1].lower()
            if ending in endings:
                found.append(os.path.relpath(os.path.join(place, name), folder))
            else:
                others[ending or "without an ending"] += 1
    return sorted(found), others


def fingerprint(*settings):
    """What the results depend on besides their meshes."""
    with open(LIBRARY, "rb") as library:
        digest = hashlib.sha256(library.read())
    digest.update(json.dumps(settings, sort_keys=True).encode())
    return digest.hexdigest()[:16]


def mark_of(mesh, common):
    """What one result depends on: the fingerprint, and the file as it is."""
    state = os.stat(mesh)
    return f"{common}-{state.st_size}-{state.st_mtime_ns}"


def stems(names, source, out, ending):
    """For each mesh the name that its files in OUT begin with: its own without the ending, or the whole
    of it where a result would replace it, or another mesh has a name that begins so, or a file
    that is not a record of ours is in the place of one."""
    taken = collections.Counter()
    for name in map(os.path.normcase, names):
        folder, file = os.path.split(name)
        parts = file.split(".")
        taken.update(os.path.join(folder, ".".join(parts[:k])) for k in range(1, len(parts) + 1))
    found = {}
    for name in names:
        short = os.path.splitext(name)[0]
        record = record_path(out, short)
        meets = (taken[os.path.normcase(short)] > 1 or
                 os.path.join(out, short + ending) == os.path.join(source, name) or
                 os.path.exists(record) and "state" not in read_record(record))
        found[name] = name if meets else short
    return found


def record_path(out, stem):
    return os.path.join(out, stem + ".json")


def read_record(path):
    try:
        with open(path, encoding="utf-8") as source:
            record = json.load(source)
    except (OSError, ValueError):
        return {}
    return record if isinstance(record, dict) else {}


def write_record(path, record):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    partial = f"{path}.{os.getpid()}.{threading.get_ident()}.part"
    with open(partial, "w", encoding="utf-8") as target:
        json.dump(record, target, indent=1, sort_keys=True)
    os.replace(partial, path)


def clear(path):
    """Removes a record and what the run wrote under the mesh's name, not a texture that others show
    too. The record is removed first: files without some of theirs must not pass for a result."""
    folder, name = os.path.split(path.removesuffix("json"))
    files = read_record(path).get("files", ())
    for file in (name + "json", *(file for file in files if file.startswith(name))):
        with contextlib.suppress(OSError):
            os.remove(os.path.join(folder, file))


def remove_parts(target):
    """What a process that was ended has left: a mesh without its record, and the names under which
    files are written before they get their own."""
    folder, name = os.path.split(target)
    hidden = f".{os.path.splitext(name)[0]}."
    with contextlib.suppress(OSError):
        for file in os.listdir(folder):
            if file == name or file.startswith(hidden):
                os.remove(os.path.join(folder, file))


def in_words(problem):
    """What an error says; one of the system names its file first."""
    named = isinstance(problem, OSError) and problem.filename
    return f"{problem.filename}: {problem.strerror}" if named else str(problem)


def is_done(record, name, mark, retry):
    if (record.get("mesh"), record.get("fingerprint")) != (name, mark):
        return False
    return record.get("state") in (FINAL if retry else FINAL + FAILED)


class Processes:
    """Those that run, for who wants to end them all."""

    def __init__(self):
        self.running = set()
        self.stopped = False
        self._lock = threading.Lock()

    def start(self, command):
        with self._lock:
            if self.stopped:
                raise concurrent.futures.CancelledError
            # A session of its own: Ctrl-C is for the parent.
            process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                       start_new_session=True)
            self.running.add(process)
            return process

    def end(self, process):
        process.kill()
        process.communicate()
        with self._lock:
            self.running.discard(process)

    def stop(self):
        with self._lock:
            self.stopped = True
            for process in self.running:
                process.kill()


def run_one(job, processes=None):
    """One job in a process of its own. Its record, on disk too where the job names a file."""
    started = time.monotonic()
    record = {"mesh": job["name"], "fingerprint": job["fingerprint"]}
    processes = processes or Processes()
    for path in job["former"]:
        if read_record(path).get("mesh") == job["name"]:
            clear(path)
    process = processes.start([sys.executable, "-m", "ricciflow._worker", json.dumps(job)])
    try:
        printed, errors = process.communicate(timeout=job["timeout"])
        try:
            record.update(json.loads(printed.decode().splitlines()[-1]))
        except (ValueError, IndexError):
            record.update(state="crashed", reason=how_it_ended(process.returncode, errors))
    except subprocess.TimeoutExpired:
        record.update(state="timeout", reason=f"no result after {job['timeout']:g} s")
    finally:
        processes.end(process)
    record["seconds"] = round(time.monotonic() - started, 3)
    if job["record"] and not processes.stopped:
        if record["state"] != "solved":
            remove_parts(job["target"])
        write_record(job["record"], record)
    return record


def how_it_ended(code, errors):
    how = signal.Signals(-code).name if code < 0 else f"exit {code}"
    last = errors.decode(errors="replace").strip().splitlines()[-1:]
    return ": ".join([how] + last)


@contextlib.contextmanager
def here(workers):
    """A way to run jobs on this machine: an iterator of their records, as they end."""
    pool = concurrent.futures.ThreadPoolExecutor(workers)
    processes = Processes()

    def run(jobs):
        for future in concurrent.futures.as_completed(
                [pool.submit(run_one, job, processes) for job in jobs]):
            yield future.result()
    try:
        yield run
    finally:
        processes.stop()
        pool.shutdown(cancel_futures=True)


@contextlib.contextmanager
def by_dask(scheduler, workers):
    """The same by Dask, on a cluster or on this machine ('local'): what a lost worker held is given
    to another."""
    from dask import distributed
    cluster = None
    if scheduler == "local":
        cluster = distributed.LocalCluster(n_workers=workers, threads_per_worker=1,
                                           dashboard_address=None)
    client = distributed.Client(cluster or scheduler)

    def run(jobs):
        # Each task is pure: a second run of a lost one writes the same files.
        futures = client.map(run_one, jobs, pure=False, retries=2,
                             key=[f"{job['name']}-{job['fingerprint']}" for job in jobs])
        by_key = {future.key: job for future, job in zip(futures, jobs)}
        for future in distributed.as_completed(futures):
            if future.status == "finished":
                yield future.result()
            else:
                job = by_key[future.key]
                lost = {"mesh": job["name"], "state": "lost", "reason": repr(future.exception())}
                write_record(job["record"], lost)
                yield lost
            future.release()
    try:
        yield run
    finally:
        client.close()
        if cluster is not None:
            cluster.close()


def summarize(out, names):
    """Rewrites results.csv and failures.txt from the records of the meshes, whose stems are given. The
    number of failures."""
    records = [{"mesh": name, "state": "missing", **read_record(record_path(out, stem))}
               for name, stem in names.items()]
    keys = sorted({key for record in records for key in record.get("results", {})})
    text = {"mode": "w", "encoding": "utf-8", "errors": "backslashreplace"}  # names may be of any bytes
    with open(os.path.join(out, "results.csv"), newline="", **text) as target:
        table = csv.writer(target)
        table.writerow(["mesh", "state", "seconds", "messages", *keys])
        for record in records:
            results = record.get("results", {})
            table.writerow([record["mesh"], record["state"], record.get("seconds", ""),
                            " ".join(record.get("messages", ())),
                            *(results.get(key, "") for key in keys)])
    with open(os.path.join(out, "failures.txt"), **text) as target:
        for record in records:
            if record["state"] != "solved":
                target.write(f"{record['mesh']}\t{record['state']}\t{record.get('reason', '')}\n")
    return sum(record["state"] not in ANSWERED for record in records)
