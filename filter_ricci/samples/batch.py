#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the filter on every mesh of a folder, on all cores or on a cluster, with Dask and PyMeshLab.

    pip install "pymeshlab>=2025.7,<2025.8" "dask[distributed]"
    python batch.py libfilter_ricci.so meshes out
    python batch.py libfilter_ricci.so meshes out --set target_curvature=Disk --workers 8
    python batch.py libfilter_ricci.so meshes out --scheduler tcp://host:8786

Each mesh is a task, and each task a process of its own: a crash or a hang of a host library ends that
mesh and nothing else. For meshes/a/b.off the folder out then holds a/b.off.json (state, results or
reason, seconds) and a/b.off.ply, written last and renamed into place. A mesh whose .json is there is
not run again unless mesh, parameters or plugin differ: a run that was interrupted goes on where it
stopped, and what a lost worker held is given to another. --retry runs again what crashed or ran out of
time; refusals stay, they would be the same. At the end out/results.csv has a row for each mesh and
out/failures.txt the meshes without a result, with the reason.

one_mesh.py has to lie beside this file. With a cluster both files, the plugin and both folders must
have the same paths on every machine.
Exit: 0 every mesh has a result or a refusal, 1 some crashed, ran out of time or were lost.
"""

import argparse
import csv
import hashlib
import json
import os
import signal
import subprocess
import sys
import time

from one_mesh import FILTER, parameters_of

ENDINGS = (".ply", ".off", ".obj", ".stl")
FINAL = ("solved", "refused")  # states that a second run would only repeat
FAILED = ("crashed", "timeout")


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("plugin")
    parser.add_argument("meshes", help="folder, searched with everything below it")
    parser.add_argument("out", help="folder for the results")
    parser.add_argument("--set", action="append", default=[], metavar="ID=VALUE",
                        help="a parameter of the filter; can be repeated")
    parser.add_argument("--filter", default=FILTER, help="the filter's PyMeshLab name")
    parser.add_argument("--scheduler", help="address of a running Dask scheduler")
    parser.add_argument("--workers", type=int, default=os.cpu_count(), help="processes without one")
    parser.add_argument("--timeout", type=float, default=3600, help="seconds for one mesh")
    parser.add_argument("--retry", action="store_true", help="run failures again")
    return parser.parse_args(arguments)


def find_meshes(folder):
    """Paths below the folder, relative to it, in order."""
    found = []
    for place, _, names in os.walk(folder):
        found += [os.path.relpath(os.path.join(place, name), folder)
                  for name in names if name.lower().endswith(ENDINGS)]
    return sorted(found)


def fingerprint(options, parameters):
    """What the results depend on besides their meshes."""
    with open(options.plugin, "rb") as plugin:
        digest = hashlib.sha256(plugin.read())
    digest.update(json.dumps([options.filter, parameters], sort_keys=True).encode())
    return digest.hexdigest()[:16]


def mark_of(mesh, common):
    """What one result depends on: the fingerprint, and the file as it is."""
    state = os.stat(mesh)
    return f"{common}-{state.st_size}-{state.st_mtime_ns}"


def read_record(out, mesh):
    try:
        with open(os.path.join(out, mesh + ".json"), encoding="utf-8") as source:
            return json.load(source)
    except (OSError, ValueError):
        return {}


def write_record(out, mesh, record):
    path = os.path.join(out, mesh + ".json")
    os.makedirs(os.path.dirname(path), exist_ok=True)
    partial = f"{path}.{os.getpid()}.part"
    with open(partial, "w", encoding="utf-8") as target:
        json.dump(record, target, indent=1, sort_keys=True)
    os.replace(partial, path)


def is_done(record, mark, retry):
    if record.get("fingerprint") != mark:
        return False
    return record.get("state") in (FINAL if retry else FINAL + FAILED)


def run_one(job):
    """The task of a worker: one mesh in a process of its own. Its record, which is also on disk."""
    started = time.monotonic()
    record = {"mesh": job["mesh"], "fingerprint": job["fingerprint"]}
    try:
        finished = subprocess.run(
            [sys.executable, job["script"], "--in-this-process", json.dumps(job)],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=job["timeout"], check=False)
        try:
            record.update(json.loads(finished.stdout.decode().splitlines()[-1]))
        except (ValueError, IndexError):
            record.update(state="crashed", reason=how_it_ended(finished))
    except subprocess.TimeoutExpired:
        record.update(state="timeout", reason=f"no result after {job['timeout']:g} s")
    record["seconds"] = round(time.monotonic() - started, 3)
    write_record(job["out"], job["mesh"], record)
    return record


def how_it_ended(finished):
    code = finished.returncode
    how = signal.Signals(-code).name if code < 0 else f"exit {code}"
    last = finished.stderr.decode(errors="replace").strip().splitlines()[-1:]
    return ": ".join([how] + last)


def die_with_parent():
    """Where the system offers it (Linux): a lost worker leaves no process behind."""
    try:
        import ctypes
        ctypes.CDLL(None).prctl(1, signal.SIGKILL)
    except (AttributeError, OSError):
        pass


def solve_here(job):
    """The process of one mesh: prints one line of JSON."""
    die_with_parent()
    import pymeshlab
    pymeshlab.load_plugin(job["plugin"])
    documents = pymeshlab.MeshSet(verbose=False)
    answer = {"state": "solved"}
    try:
        documents.load_new_mesh(os.path.join(job["meshes"], job["mesh"]))
        answer["results"] = documents.apply_filter(job["filter"], **job["parameters"])
        answer["results"] = {key: result if isinstance(result, (bool, int, float)) else list(result)
                             for key, result in answer["results"].items()}
    except pymeshlab.PyMeshLabException as refusal:
        answer = {"state": "refused", "reason": str(refusal).split("Details: ")[-1].strip()}
    if answer["state"] == "solved":
        save(documents, os.path.join(job["out"], job["mesh"] + ".ply"))
    print("\n" + json.dumps(answer), flush=True)
    # PyMeshLab 2025.7 may crash while it takes down a MeshSet in which a filter has failed.
    os._exit(0)


def save(documents, target):
    """Complete or not at all. What it throws ends the process: the mesh then counts as crashed."""
    os.makedirs(os.path.dirname(target), exist_ok=True)
    partial = f"{target}.{os.getpid()}.part.ply"
    documents.save_current_mesh(partial, save_wedge_texcoord=True, save_vertex_quality=True)
    os.replace(partial, target)


def run_all(options, jobs):
    """Yields a record for each job, in the order in which they end."""
    from dask import distributed
    cluster = None
    if options.scheduler:
        client = distributed.Client(options.scheduler)
    else:
        cluster = distributed.LocalCluster(n_workers=options.workers, threads_per_worker=1,
                                           dashboard_address=None)
        client = distributed.Client(cluster)
    try:
        # Each task is pure: a second run of a lost one writes the same files.
        futures = client.map(run_one, jobs, key=[f"{job['mesh']}-{job['fingerprint']}" for job in jobs],
                             pure=False, retries=2)
        by_key = {future.key: job for future, job in zip(futures, jobs)}
        for future in distributed.as_completed(futures):
            if future.status == "finished":
                yield future.result()
            else:
                job = by_key[future.key]
                yield {"mesh": job["mesh"], "state": "lost", "reason": repr(future.exception())}
            future.release()
    finally:
        client.close()
        if cluster is not None:
            cluster.close()


def summarize(out, meshes):
    """Rewrites results.csv and failures.txt from the records. The number of failures."""
    records = [{"mesh": mesh, "state": "missing", **read_record(out, mesh)} for mesh in meshes]
    keys = sorted({key for record in records for key in record.get("results", {})})
    with open(os.path.join(out, "results.csv"), "w", encoding="utf-8", newline="") as target:
        table = csv.writer(target)
        table.writerow(["mesh", "state", "seconds", *keys])
        for record in records:
            results = record.get("results", {})
            table.writerow([record["mesh"], record["state"], record.get("seconds", ""),
                            *(results.get(key, "") for key in keys)])
    without = [record for record in records if record["state"] != "solved"]
    with open(os.path.join(out, "failures.txt"), "w", encoding="utf-8") as target:
        for record in without:
            target.write(f"{record['mesh']}\t{record['state']}\t{record.get('reason', '')}\n")
    return sum(record["state"] not in FINAL for record in records)


def main(arguments):
    if arguments[:1] == ["--in-this-process"]:
        solve_here(json.loads(arguments[1]))
    options = parse(arguments)
    try:
        import dask.distributed  # noqa: F401
    except ImportError:
        sys.exit('Dask is missing: pip install "dask[distributed]"')
    parameters = parameters_of(options.set)
    plugin, folder, out = (os.path.abspath(p) for p in (options.plugin, options.meshes, options.out))
    if not os.path.isfile(plugin):
        sys.exit(f"There is no plugin {plugin}.")
    meshes = find_meshes(folder)
    if not meshes:
        sys.exit(f"There are no meshes ({', '.join(ENDINGS)}) below {folder}.")
    os.makedirs(out, exist_ok=True)
    common = fingerprint(options, parameters)
    marks = {mesh: mark_of(os.path.join(folder, mesh), common) for mesh in meshes}
    jobs = [{"script": os.path.abspath(__file__), "plugin": plugin, "meshes": folder, "out": out,
             "mesh": mesh, "filter": options.filter, "parameters": parameters,
             "fingerprint": marks[mesh], "timeout": options.timeout}
            for mesh in meshes if not is_done(read_record(out, mesh), marks[mesh], options.retry)]
    print(f"{len(meshes)} meshes, {len(meshes) - len(jobs)} done before, {len(jobs)} to run",
          flush=True)
    ended = 0
    for record in run_all(options, jobs) if jobs else ():
        ended += 1
        if record["state"] == "lost":
            write_record(out, record["mesh"], record)
        print(f"[{ended}/{len(jobs)}] {record['state']:8} {record['mesh']}  {record.get('reason', '')}",
              flush=True)
    failures = summarize(out, meshes)
    print(f"Results: {os.path.join(options.out, 'results.csv')}; without a result: "
          f"{os.path.join(options.out, 'failures.txt')}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
