"""LAMMPS: exact bridges in a running simulation, by its fix external."""

from .attach import couple
from .coupling import Coupling

__all__ = ["Coupling", "couple"]
