"""Warnings point at the line outside of this package that asked, however deep in it they arise."""

import os
import sys
import warnings
from pathlib import Path

__all__ = ["warn"]

_HOME = str(Path(__file__).parent.parent) + os.sep


def warn(message: str | Warning, category: type[Warning] | None = None) -> None:
    """Issue a warning about what the caller of the package asked."""
    level = 1  # warnings.warn can skip the files of a package by itself from Python 3.12 on
    while sys._getframe(level).f_code.co_filename.startswith(_HOME):
        level += 1
    warnings.warn(message, category, stacklevel=level + 1)
