"""Where the pendular state of a heap ends: the suction at which the first bridges meet."""

import math
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ask.liquid import Liquid
from ..ground.check import one_of
from .amount import LEAST_REDUCED_SUCTION
from .answers import geometry_of
from .heap import Packing
from .history import pairs_at, step_at
from .meetings import mark_meetings
from .neighbours import Neighbours, arms_of
from .setting import Setting, setting_of

__all__ = ["limit_between", "limit_of", "pendular_limit"]

Bools = NDArray[np.bool_]

_PRECISION = 1e-9  # of the suction
_STEP = 2.0


def pendular_limit(
    heap: Packing,
    contact_angle: ArrayLike,
    *,
    liquid: Liquid,
    path: Literal["drying", "wetting"] = "drying",
    formation_distance: float = 0.0,
    condensation: bool = True,
    method: Literal["auto", "exact", "table"] = "auto",
) -> float:
    r"""Suction below which bridges meet, :math:`\delta_a + \delta_b \ge \angle(\mathbf n_a, \mathbf n_b)` on a grain.

    Parameters
    ----------
    heap, contact_angle, liquid, path, formation_distance, condensation, method
        As for :func:`wet`.

    Returns
    -------
    float
        [Pa]; 0.0 if none meet from 0.01 γ/R on, with the largest grain.

    Raises
    ------
    ValueError
        For bad input.

    Examples
    --------
    >>> import pendular as pl
    >>> heap = pl.Packing([(0, 0, 0)], 1.0, cell=(2, 2, 2)).repeated((3, 3, 3))
    >>> print(f"{pendular_limit(heap, 0.0, liquid=pl.Liquid(surface_tension=1.0), path='wetting'):.4f}")
    0.9458
    """
    one_of("path", path, ("drying", "wetting"))
    setting = setting_of(heap, contact_angle, liquid, formation_distance, condensation, method)
    return limit_of(setting, path == "drying")


def limit_of(setting: Setting, is_drying: bool) -> float:
    """Limit on a main branch."""
    tension, radii = setting.liquid.surface_tension, setting.heap.radii
    least = LEAST_REDUCED_SUCTION * tension / float(radii.max())
    high = 16.0 * tension / float(radii.min())
    while _meeting(setting, pairs_at(setting, "suction", high), high, is_drying).any():
        high *= _STEP**4
    low = high
    while low > least:
        low = max(low / _STEP, least)
        if _meeting(setting, pairs_at(setting, "suction", low), low, is_drying).any():
            return limit_between(setting, low, low * _STEP, is_drying)
    return 0.0


def limit_between(setting: Setting, low: float, high: float, is_drying: bool) -> float:
    """Limit between a suction at which bridges meet and one at which none do.

    Half-filling angles fall with the suction, and no bridge is added: only those that meet at the lower suction count.
    """
    pairs = pairs_at(setting, "suction", low)
    pairs = pairs.taken(_meeting(setting, pairs, low, is_drying))
    while high / low - 1.0 > _PRECISION:
        middle = math.sqrt(low * high)
        meets = _meeting(setting, pairs, middle, is_drying)
        if meets.any():
            pairs, low = pairs.taken(meets), middle
        else:
            high = middle
    return low


def _meeting(setting: Setting, pairs: Neighbours, suction: float, is_drying: bool) -> Bools:
    """Pairs whose bridges meet others."""
    step = step_at(setting, pairs, suction, is_drying)
    held, answers = pairs.taken(step.members), step.answers.taken(step.members)
    normals, _ = arms_of(setting.heap, held)
    meets = np.zeros(len(pairs.gap), bool)
    meets[step.members] = mark_meetings(setting.heap, held, normals, geometry_of(setting, held, answers)).bridges
    return meets
