# SPDX-License-Identifier: GPL-3.0-or-later
"""The former place of ricciflow.xatlas."""

from ricciflow.xatlas import parametrize

__all__ = ["parametrize"]
