"""Files that are whole or not there, and one line for those that cannot be read or written."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from uuid import uuid4

__all__ = ["in_one_line", "whole"]


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
