"""LAMMPS: exact bridges in a running simulation, by a plug-in that is written as sources and built beside it."""

from .write import PLUGIN, build, build_line, write

__all__ = ["PLUGIN", "build", "build_line", "write"]
