"""The source of the laws in :mod:`pendular.laws`, imported without the compiler."""

from pathlib import Path

__path__ = [str(Path(__file__).parents[2] / "laws")]
