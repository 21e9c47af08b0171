r"""Stress that bridges carry in a heap, and its shares.

.. math:: \boldsymbol\sigma = \frac1V \sum_b F_b l_b\, \mathbf n_b \otimes \mathbf n_b
          = \frac1V \frac{\mathrm d\Omega}{\mathrm d\boldsymbol\varepsilon}

Moments of all forces about the centres of the two grains divide a term of the sum into

.. math:: F l\, \mathbf n\otimes\mathbf n = \Delta p V\, \mathbf I
          + \gamma\int(\mathbf I - \mathbf n\otimes\mathbf n)\,\mathrm dA + \mathbf C,

what the liquid carries, what the meniscus carries, and what the pull at the wetted surfaces and contact lines leaves to
the grains.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.rows import element, entry, over_rows
from .answers import Answers
from .neighbours import Neighbours
from .setting import Setting
from .shape import ACROSS, AREA, AXIAL, FILLING_1, WETTED_1, cap_of, plane_cap

__all__ = ["Shares", "fabric_of", "shares_of", "stress_sum"]

Floats = NDArray[np.float64]

_CHUNK = 65536
_FEW = 8192  # rows that a cache holds


class Shares(NamedTuple):
    """Parts of the stress, (3, 3) each, [Pa]: they add up to all of it."""

    liquid: Floats  # pressure in the liquid
    surface: Floats  # tension of the menisci
    contact: Floats  # grains, pulled at wetted surfaces and contact lines


def stress_sum(force: Floats, normals: Floats, lengths: Floats) -> Floats:
    """Σ F l n ⊗ n, [J]."""
    return _dyads(force * lengths, normals)


def fabric_of(normals: Floats) -> Floats:
    """(1/N) Σ n ⊗ n; NaN without a bridge."""
    if len(normals) == 0:
        return np.full((3, 3), np.nan)
    return _dyads(np.ones(len(normals)), normals) / len(normals)


def _dyads(weights: Floats, normals: Floats) -> Floats:
    """Σ w n ⊗ n."""
    total = np.zeros((3, 3))
    for start in range(0, len(weights), _FEW):
        part = normals[start : start + _FEW]
        total += (weights[start : start + _FEW, None] * part).T @ part
    return 0.5 * (total + total.T)


def shares_of(setting: Setting, near: Neighbours, normals: Floats, answers: Answers, shape: Floats) -> Shares:
    """Sums over bridges of the three parts, [J]."""
    tension = setting.liquid.surface_tension
    moments = np.empty((len(normals), 2))
    over_rows(
        _moment_range, len(normals), _CHUNK,
        near.pairs, near.gap, setting.radii, setting.kind, setting.angles, answers.suction, answers.force, shape,
        tension, moments,
    )  # fmt: skip
    identity = np.eye(3)
    liquid = np.sum(answers.suction * answers.volume) * identity
    across, axial, area = shape[:, ACROSS], shape[:, AXIAL], shape[:, AREA]
    surface = tension * (np.sum(area - across) * identity + _dyads(across - axial, normals))
    contact = np.sum(moments[:, 1]) * identity + _dyads(moments[:, 0] - moments[:, 1], normals)
    return Shares(liquid, surface, contact)


@entry(plain_cost=1e-05)
def _moment_range(
    pairs: NDArray[np.int32],
    gaps: Floats,
    radii: Floats,
    kind: NDArray[np.int32],
    angles: Floats,
    suctions: Floats,
    forces: Floats,
    shape: Floats,
    tension: float,
    out: Floats,
    start: int,
    stop: int,
) -> None:
    """Moments of the pull on the solids about their centres: along the axis and across it; a plane has no centre."""
    for row in range(start, stop):
        curvature = element(suctions, row) / tension
        axial, across, arm = 0.0, 0.0, min(gaps[row], 0.0)
        for side in range(2):
            body = pairs[row, side]
            angle = angles[kind[body]]
            if np.isinf(radii[body]):
                cap = plane_cap(shape[row, WETTED_1 + side], math.cos(angle))
            else:
                filling = shape[row, FILLING_1 + side]
                cap = cap_of(
                    filling,
                    math.cos(filling),
                    math.sin(filling),
                    curvature,
                    radii[body],
                    math.cos(angle),
                    math.sin(angle),
                )
                arm += radii[body]
            axial += cap.axial_moment
            across += cap.across_moment
        out[row, 0], out[row, 1] = tension * axial + forces[row] * arm, tension * across
