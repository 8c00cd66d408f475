# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs that say how far they are, and that Ctrl-C ends."""

import contextlib
import sys
import threading


def watched(run, tell):
    """What run(listener) returns or raises. It has a thread of its own, because Python gives signals
    to a thread that waits; tell(fraction, what) is called in this one. What it raises, and Ctrl-C,
    ends the run: listener(fraction, what), which the run calls, then returns False."""
    outcome, ended = {}, threading.Event()
    latest, goes_on = (0.0, "Starting"), True

    def listener(fraction, what):
        nonlocal latest
        latest = fraction, what
        return goes_on

    def work():
        try:
            outcome["value"] = run(listener)
        except BaseException as problem:  # pylint: disable=broad-except
            outcome["problem"] = problem
        finally:
            ended.set()

    thread = threading.Thread(target=work, name="ricciflow")
    thread.start()
    try:
        while not ended.wait(0.1):
            tell(*latest)
    except BaseException:
        goes_on = False
        raise
    finally:
        thread.join()
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
