"""Files that are whole or not there, made by one process at a time, and one line for those that cannot be had."""

import hashlib
import os
import shutil
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from uuid import uuid4

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

__all__ = ["alone", "in_one_line", "whole"]

_PAUSE = 0.05  # between two looks at a lock, [s]


@contextmanager
def whole(path: Path) -> Iterator[Path]:
    """Give a path to write a file or a folder to, of the same suffix, and move it in place when all is written.

    What cannot be replaced, like a device, is written to as it is.

    Parameters
    ----------
    path : Path
        Where the file is to be. A link is followed, and a file that is there is replaced.

    Yields
    ------
    Path
        Beside it.

    Raises
    ------
    OSError
        If it cannot be written, or a folder is there already.
    """
    place = Path(os.path.realpath(path))
    if place.exists() and not place.is_file() and not place.is_dir():
        yield place
        return
    draft = place.with_name(f".{place.stem}.{uuid4().hex[:12]}{place.suffix}")
    try:
        yield draft
        draft.replace(place)
    finally:
        if draft.is_dir():
            shutil.rmtree(draft)
        draft.unlink(missing_ok=True)


@contextmanager
def in_one_line(name: str, path: Path, done: str = "written") -> Iterator[None]:
    """Refuse in one line, as an argument, a path that cannot be written or read."""
    try:
        yield
    except OSError as error:
        raise ValueError(f"{name}: '{path}' cannot be {done}: {error.strerror or error}") from error


@contextmanager
def alone(locks: Path, task: str, patience: float) -> Iterator[None]:
    """Let one process at a time do a task; others wait.

    The lock is the system's, on a byte of a file: a process that ends, in whatever way, leaves none behind. Where
    nothing can be locked all pass. It is for processes, not for threads of one.

    Parameters
    ----------
    locks : Path
        The file, common to all tasks.
    task : str
        Its name, by which its byte is found.
    patience : float
        Time after which a process passes though another is still at it, [s].
    """
    byte = int.from_bytes(hashlib.sha256(task.encode()).digest()[:3], "big")
    deadline = time.monotonic() + patience
    with ExitStack() as held:
        with suppress(OSError):
            locks.parent.mkdir(parents=True, exist_ok=True)
            file = held.enter_context(locks.open("ab"))
            while not _is_locked(file.fileno(), byte) and time.monotonic() < deadline:
                time.sleep(_PAUSE)
        yield


def _is_locked(file: int, byte: int) -> bool:
    """Lock a byte for this process; False if another one has it."""
    try:
        if sys.platform == "win32":
            os.lseek(file, byte, os.SEEK_SET)
            msvcrt.locking(file, msvcrt.LK_NBLCK, 1)
        else:
            fcntl.lockf(file, fcntl.LOCK_EX | fcntl.LOCK_NB, 1, byte)
    except (BlockingIOError, PermissionError):
        return False
    return True
