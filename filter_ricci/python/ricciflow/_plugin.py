# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin's library, and runs of it that say how far they are and that Ctrl-C ends."""

import contextlib
import ctypes
import os
import sys
import threading

PLUGIN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "libfilter_ricci.so")
LIBRARY = ctypes.CDLL(PLUGIN)

_LISTENER = ctypes.CFUNCTYPE(ctypes.c_bool, ctypes.c_int, ctypes.c_char_p)
_listen = LIBRARY.filter_ricci_listen
_listen.restype = None
_listen.argtypes = [_LISTENER]


def watched(run, tell):
    """What run() returns or raises. It has a thread of its own, because Python gives signals to one
    that waits; tell(fraction, what) is called in this one. What it raises, and Ctrl-C, ends the run."""
    outcome, ended = {}, threading.Event()
    latest, goes_on = (0, b"Starting"), True

    def hear(percent, what):
        nonlocal latest
        latest = percent, what
        return goes_on

    def work():
        listener = _LISTENER(hear)
        _listen(listener)
        try:
            outcome["value"] = run()
        except BaseException as problem:  # pylint: disable=broad-except
            outcome["problem"] = problem
        finally:
            _listen(_LISTENER())
            ended.set()

    thread = threading.Thread(target=work, name="pymeshlab_ricci")
    thread.start()
    try:
        while not ended.wait(0.1):
            tell(latest[0] / 100, latest[1].decode())
    except BaseException:
        goes_on = False
        raise
    finally:
        thread.join()
    if "problem" in outcome:
        raise outcome["problem"] from None
    tell(1.0, "Done")
    return outcome["value"]


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
