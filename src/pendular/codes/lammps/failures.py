"""How an error in a callback stops a run and reaches the caller.

LAMMPS calls back from C++, which no Python exception can cross: ctypes would print and forget it. So the run is ended
as at a time limit, after which LAMMPS skips all further runs, and the command that it came from raises the error.
"""

import functools
from collections.abc import Callable
from typing import Any

__all__ = ["COMMANDS", "guard", "stop_with"]

COMMANDS = ("command", "commands_list", "commands_string", "file")
_CUTOFF = "coord/atom cutoff is longer than pairwise cutoff"


def stop_with(lammps: Any, error: Exception) -> None:
    """End the run, and let the command that started it raise an error."""
    lammps._pendular_failure = error
    lammps.lib.lammps_force_timeout(lammps.lmp)


def guard(lammps: Any) -> None:
    """Let the commands of a LAMMPS object raise what stopped them."""
    if not hasattr(lammps, "_pendular_failure"):
        lammps._pendular_failure = None
        for name in COMMANDS:
            setattr(lammps, name, _guarded(lammps, getattr(lammps, name)))


def _guarded(lammps: Any, command: Callable[..., Any]) -> Callable[..., Any]:
    @functools.wraps(command)
    def run(*arguments: Any, **options: Any) -> Any:
        try:
            answer = command(*arguments, **options)
        except Exception as error:  # LAMMPS raises no other class
            if _CUTOFF in str(error):
                raise ValueError(
                    "pair_style: the neighbour list does not reach as far as the bridges; use 'pair_style "
                    "hybrid/overlay ... zero CUTOFF nocoeff' with the cutoff of the coupling"
                ) from error
            if lammps._pendular_failure is None:
                raise
        if lammps._pendular_failure is not None:
            raise lammps._pendular_failure
        return answer

    return run
