"""Machine code made in the background, by one process of the lowest priority, so that the next process finds it.

It starts only where a person watches, on a terminal or in an interactive session: a batch job pays for its own answers
alone. ``PENDULAR_BACKGROUND=0`` switches it off.
"""

import os
import subprocess
import sys
import time
from contextlib import suppress
from functools import cache
from pathlib import Path

from . import native

__all__ = ["LOCK", "compile_all"]

LOCK = "compiling.lock"  # in the folder of machine code, while a process is at work

_LONGEST = 3600.0  # s, after which a lock is of a process that was killed
# By its name, as stamps follow statements that import: no kernel depends on the front.
_COMMAND = """
import importlib, os, sys
if hasattr(os, "nice"):
    os.nice(19)
try:
    for _ in importlib.import_module("pendular.front.ahead").compile_ahead():
        pass
finally:
    os.unlink(sys.argv[1])
"""


@cache
def compile_all() -> None:
    """Start to make all machine code in the background; once in a process, and not where another is at it."""
    if os.environ.get("PENDULAR_BACKGROUND") == "0" or not _is_watched():
        return
    with suppress(OSError):
        lock = native.folder() / LOCK
        if _locked(lock):
            subprocess.Popen(
                [sys.executable, "-c", _COMMAND, str(lock)],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                start_new_session=True,
            )


def _is_watched() -> bool:
    """Whether a person waits for the answers."""
    if os.environ.get("CI"):
        return False
    return hasattr(sys, "ps1") or bool(sys.stderr and sys.stderr.isatty())


def _locked(lock: Path) -> bool:
    """Take the lock, unless another process has it."""
    lock.parent.mkdir(parents=True, exist_ok=True)
    with suppress(FileNotFoundError):
        if time.time() - lock.stat().st_mtime > _LONGEST:
            lock.unlink()
    try:
        lock.touch(exist_ok=False)
    except FileExistsError:
        return False
    return True
