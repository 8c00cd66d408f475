# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line under its former name."""

import sys

from ricciflow.__main__ import main as _main


def main(arguments=None):
    print("pymeshlab_ricci is called ricciflow now: python -m ricciflow", file=sys.stderr)
    return _main(arguments)


if __name__ == "__main__":
    sys.exit(main())
