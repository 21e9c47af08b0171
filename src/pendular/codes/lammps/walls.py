"""Walls of a LAMMPS simulation, at which there are no bridges: said aloud, for nothing else would tell.

The library of LAMMPS names fixes, but not their styles; its command ``info`` prints both.
"""

import functools
import re
import warnings
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from .failures import COMMANDS

__all__ = ["watch_walls"]

_WALL = re.compile(r"^Fix\[ *\d+\]: *(\S+), +style = (wall\S*),", re.MULTILINE)


def watch_walls(lammps: Any) -> None:
    """Warn of the walls that there are, and of those that later commands add."""
    if hasattr(lammps, "_pendular_walls"):
        return
    lammps._pendular_fixes, lammps._pendular_walls = [], set()
    _warn_of_new(lammps, stacklevel=4)
    for name in COMMANDS:
        setattr(lammps, name, _watched(lammps, getattr(lammps, name)))


def _watched(lammps: Any, command: Callable[..., Any]) -> Callable[..., Any]:
    @functools.wraps(command)
    def run(*arguments: Any, **options: Any) -> Any:
        answer = command(*arguments, **options)
        _warn_of_new(lammps, stacklevel=3)
        return answer

    return run


def _warn_of_new(lammps: Any, stacklevel: int) -> None:
    """Warn of walls that were not there before; the first rank does so for all."""
    fixes = lammps.available_ids("fix")
    if fixes == lammps._pendular_fixes:
        return
    walls = _walls(lammps)
    new = [f"{fix} ({style})" for fix, style in walls.items() if fix not in lammps._pendular_walls]
    lammps._pendular_fixes, lammps._pendular_walls = fixes, set(walls)
    if new:
        warnings.warn(
            f"wall: fix {', '.join(new)} is dry: bridges join grains to grains and none to a wall; a wall that is to "
            "be wet is made of grains",
            UserWarning,
            stacklevel=stacklevel,
        )


def _walls(lammps: Any) -> dict[str, str]:
    """Name and style of each fix that is a wall; none on other ranks than the first, which alone writes."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "fixes.txt"
        type(lammps).command(lammps, f'info fixes out overwrite "{path}"')
        return dict(_WALL.findall(path.read_text(encoding="utf-8"))) if path.exists() else {}
