"""LAMMPS: exact bridges in a running simulation, by its fix external."""

try:
    from .attach import couple
    from .coupling import Coupling
except ModuleNotFoundError as absent:
    if absent.name not in ("numba", "llvmlite"):
        raise
    raise ModuleNotFoundError(
        "pendular.codes.lammps needs Numba, which is not installed; pip install numba"
    ) from absent

__all__ = ["Coupling", "couple"]
