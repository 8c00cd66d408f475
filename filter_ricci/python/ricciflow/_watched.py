# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs that say how far they are, and that Ctrl-C ends."""

import _thread
import contextlib
import sys
import time

PATIENCE = 10.0  # seconds that a thread may take to begin


def watched(run, tell):
    """What run(listener) returns or raises. It has a thread of its own, because Python gives signals
    to a thread that waits; tell(fraction, what) is called in this one. What it raises, and Ctrl-C,
    ends the run: listener(fraction, what), which the run calls, then returns False."""
    outcome, running, has_begun = {}, _thread.allocate_lock(), False
    latest, goes_on = (0.0, "Starting"), True

    def listener(fraction, what):
        nonlocal latest
        latest = fraction, what
        return goes_on

    def work():
        nonlocal has_begun
        has_begun = True
        try:
            if not goes_on:
                return
            outcome["value"] = run(listener)
        except BaseException as problem:  # pylint: disable=broad-except
            outcome["problem"] = problem
        finally:
            running.release()

    # Not threading.Thread, which waits for ever for a thread that has no memory to begin with.
    running.acquire()
    _thread.start_new_thread(work, ())
    begun_by = time.monotonic() + PATIENCE
    try:
        while not running.acquire(timeout=0.1):
            if not has_begun and time.monotonic() > begun_by:
                raise MemoryError("There is no memory for the thread of the run")
            tell(*latest)
    except BaseException:
        goes_on = False
        if has_begun:
            running.acquire()
        raise
    try:
        if "problem" in outcome:
            raise outcome["problem"] from None
        tell(1.0, "Done")
        return outcome["value"]
    finally:
        outcome.clear()  # an exception holds this frame, which must not hold the exception


def silent(fraction, what):
    """Of a run that tells nothing."""


@contextlib.contextmanager
def teller(progress):
    """The function of that kind for `progress`: a callable, True for a bar, or nothing."""
    if callable(progress):
        yield progress
    elif progress is None or progress is False:
        yield silent
    elif progress is not True:
        raise TypeError(f"progress must be True or a function, not {progress!r}")
    else:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            yield lambda fraction, what: print(f"\r{fraction:4.0%} {what:40.40}", end="",
                                               file=sys.stderr, flush=True)
            print(file=sys.stderr)
            return
        with tqdm(total=100, unit="%", leave=False) as bar:
            def show(fraction, what):
                bar.n = round(100 * fraction)
                bar.set_description(what)
            yield show
