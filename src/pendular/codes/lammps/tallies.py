"""Energies and virials of the bridges, handed to LAMMPS in the steps in which it adds them up."""

import ctypes
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .ranks import added_up

__all__ = ["Tallies"]

Floats = NDArray[np.float64]

_ROW = 6 * 8  # bytes of the virial of an atom
_WANTS = ("eflag_global", "eflag_atom", "vflag_global", "vflag_atom")


class Tallies:
    """Where LAMMPS says in which steps it adds up energies and virials."""

    def __init__(self, lammps: Any, fix: str, world: Any) -> None:
        self._lammps, self._fix, self._world = lammps, fix, world
        find = lammps.lib.lammps_extract_global
        find.restype = ctypes.c_void_p  # LAMMPS' own function sets it at each call
        self._steps = [ctypes.c_int64.from_address(find(lammps.lmp, name.encode())) for name in _WANTS]

    def hand_over(self, step: int, energies: Callable[[], Floats], virials: Callable[[], Floats]) -> None:
        """Set what LAMMPS wants in this step, from functions that return it by local atom."""
        energy_of_all, energy_of_each, virial_of_all, virial_of_each = (wanted.value == step for wanted in self._steps)
        lammps, library, name = self._lammps, self._lammps.lib, self._fix.encode()
        if energy_of_all or energy_of_each:
            energy = energies()
            total = float(added_up(self._world, energy.sum(keepdims=True))[0])
            lammps.fix_external_set_energy_global(self._fix, total)
            pointer = energy.ctypes.data_as(ctypes.POINTER(ctypes.c_double))
            library.lammps_fix_external_set_energy_peratom(lammps.lmp, name, pointer)
        if virial_of_all or virial_of_each:
            virial = virials()
            lammps.fix_external_set_virial_global(self._fix, added_up(self._world, virial.sum(axis=0)).tolist())
            rows = (virial.ctypes.data + _ROW * np.arange(len(virial))).astype(np.uintp)
            pointers = rows.ctypes.data_as(ctypes.POINTER(ctypes.POINTER(ctypes.c_double)))
            library.lammps_fix_external_set_virial_peratom(lammps.lmp, name, pointers)
