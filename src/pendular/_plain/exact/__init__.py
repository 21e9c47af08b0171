"""The source of :mod:`pendular.exact`, imported without the compiler."""

from pathlib import Path

__path__ = [str(Path(__file__).parents[2] / "exact")]
