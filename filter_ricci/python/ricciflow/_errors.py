# SPDX-License-Identifier: GPL-3.0-or-later
"""What the package raises and warns of."""


class Refused(Exception):
    """The mesh is refused; the text says why. It is unchanged."""


class RicciWarning(UserWarning):
    """A doubt about a map that was made: what it is, and what to do."""
