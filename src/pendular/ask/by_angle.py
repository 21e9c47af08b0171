"""A public question that gives a bridge by its half-filling angle instead of the separation."""

import math
from dataclasses import replace
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..exact import batch
from ..ground.check import in_range, quantity
from .liquid import Liquid
from .pair import Pair
from .problem import ASKED, LIMITS, Control, Limit, Problem, reduce, restore
from .result import Bridge

Floats = NDArray[np.float64]

_WORDS = ("first", "second")
_OTHER = ("(None, angle)", "(angle, None)")


def bridge_by_angle(
    pair: Pair,
    control: Control,
    liquid: Liquid,
    half_filling_angle: Any,
    separation: ArrayLike | None,
    branch: Literal["stable", "unstable"],
    limit: Limit,
) -> Bridge:
    """Bridge that has a half-filling angle; of several the one nearest to a separation."""
    solid, angle = _named(half_filling_angle)
    if np.any(np.isinf(pair.radii[solid])):
        other = "" if np.any(np.isinf(pair.radii[1 - solid])) else f"; {_OTHER[solid]} names the other"
        raise ValueError(f"half_filling_angle: the {_WORDS[solid]} solid is a plane, which has none{other}")
    problem = reduce(pair, control, liquid, separation, angle)
    angles = np.ravel(np.broadcast_to(angle, problem.shape))
    rows = problem.rows.copy()
    if separation is None:
        rows[:, 0] = math.nan
    asking = (ASKED[branch], problem.held, solid, angles, rows, LIMITS[limit])
    states, statuses, separations = batch.answer_filling(*asking)
    _refuse_several(problem, statuses, separations, angles, branch)
    return _echo(restore(problem, states, statuses), solid, angles)


def _named(value: Any) -> tuple[int, Floats]:
    """Number of the solid that is meant, and its angle."""
    solid = 0
    if isinstance(value, tuple):
        given = [i for i, one in enumerate(value) if one is not None]
        if len(value) != 2 or len(given) != 1:
            raise ValueError(
                f"half_filling_angle: {value!r} does not give one angle; write (angle, None) or (None, angle)"
            )
        solid = given[0]
        value = value[solid]
    angle = quantity("half_filling_angle", value, "rad")
    hint = "for degrees use numpy.deg2rad({value})" if np.all(angle < 180.0) else ""
    return solid, in_range("half_filling_angle", angle, 0.0, math.pi, brackets="()", unit="rad", high_hint=hint)


def _refuse_several(
    problem: Problem, statuses: NDArray[np.int8], separations: Floats, angles: Floats, branch: str
) -> None:
    """Refuse a question with more than one answer."""
    several = np.flatnonzero(statuses == batch.SEVERAL)
    if not several.size:
        return
    i = several[0]
    index = np.unravel_index(i, problem.shape)
    place = str([int(one) for one in index]) if index else ""
    found = np.sort(separations[i][~np.isnan(separations[i])]) * problem.length[i]
    told = " and ".join(f"{one:.6g}" for one in found)
    raise ValueError(
        f"half_filling_angle{place}: {angles[i]:.6g} rad, {np.rad2deg(angles[i]):.6g}°, is that of {found.size} "
        f"{branch} bridges, at separations of {told} m; give a separation near to the one that is meant as well"
    )


def _echo(answer: Bridge, solid: int, angles: Floats) -> Bridge:
    """Give back the angle that was asked, not the one that the solver met to the last digits."""
    filling = answer.half_filling_angle.copy()
    filling[..., solid] = np.where(answer.exists, angles.reshape(filling.shape[:-1]), filling[..., solid])
    return replace(answer, half_filling_angle=filling)
