"""Bridges along a path, and what their contact lines did."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from ..ask.result import Bridge

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["MODES", "BridgePath"]

Floats = NDArray[np.float64]

MODES = ("pinned", "advancing", "receding", "free")  # what a line does, by its number in the solver


@dataclass(frozen=True, eq=False, kw_only=True)
class BridgePath(Bridge):
    """Bridges along a path, one a step: all fields of a :class:`Bridge`, and what the contact lines did.

    After the step at which the bridge broke ``exists`` is False, ``force`` is 0.0 and everything else is NaN.

    Attributes
    ----------
    contact_angle : ndarray
        Contact angle on each solid as it is, [rad].
    line : ndarray of str
        What the line on each solid does: ``"pinned"``, ``"advancing"``, ``"receding"``; ``"free"`` for one that has one
        angle; empty where there is no bridge.
    work : ndarray
        Work done on the bridge since the first step, [J]: by pulling, ∫F dD, and by supplying liquid, -∫Δp dV.
    dissipated : ndarray
        Of this the part that moving lines have dissipated, [J]. The rest is the change of ``surface_energy``, in which
        the contact angles of the pair count.
    control : str
        What is held from step to step, ``"suction"`` or ``"volume"``.
    rupture : BridgePath or None
        The bridge as it broke, one state; None for a path that has come to its end.
    ending : str
        Why it broke; empty for a path that has come to its end.
    """

    contact_angle: Floats
    line: NDArray[np.str_]
    work: Any
    dissipated: Any
    control: Literal["suction", "volume"]
    rupture: BridgePath | None
    ending: str

    def plot(self, *, title: str = "", subtitle: str = "") -> Figure:
        """Picture of the force, the contact angles and the contact radii along the path.

        Parameters
        ----------
        title, subtitle : str
            Two lines above the picture.

        Returns
        -------
        matplotlib.figure.Figure
            Tied to no window: ``path.plot().savefig("loop.svg")``.
        """
        from .plots import path_figure

        return path_figure(self, title=title, subtitle=subtitle)
