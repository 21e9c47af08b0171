r"""Stress that bridges carry in a heap, and its shares.

.. math:: \boldsymbol\sigma = \frac1V \sum_b F_b l_b\, \mathbf n_b \otimes \mathbf n_b
          = \frac1V \frac{\mathrm d\Omega}{\mathrm d\boldsymbol\varepsilon}

Moments of all forces about the centres of the two grains divide a term of the sum into

.. math:: F l\, \mathbf n\otimes\mathbf n = \Delta p V\, \mathbf I
          + \gamma\int(\mathbf I - \mathbf n\otimes\mathbf n)\,\mathrm dA + \mathbf C,

what the liquid carries, what the meniscus carries, and what the pull at the wetted surfaces and contact lines leaves to
the grains.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .._jit import element, in_chunks, kernel
from .answers import Answers, Ends
from .shape import ACROSS, AREA, AXIAL, FILLING_1, FILLING_2, WETTED_1, WETTED_2, cap_of, moments_of, plane_cap

__all__ = ["Shares", "fabric_of", "shares_of", "stress_sum"]

Floats = NDArray[np.float64]

_CHUNK = 65536


class Shares(NamedTuple):
    """Parts of the stress, (3, 3) each, [Pa]: they add up to all of it."""

    liquid: Floats  # pressure in the liquid
    surface: Floats  # tension of the menisci
    contact: Floats  # grains, pulled at wetted surfaces and contact lines


def stress_sum(force: Floats, normals: Floats, lengths: Floats) -> Floats:
    """Σ F l n ⊗ n, [J]."""
    return dyads(force * lengths, normals)


def fabric_of(normals: Floats) -> Floats:
    """(1/N) Σ n ⊗ n; NaN without a bridge."""
    if len(normals) == 0:
        return np.full((3, 3), np.nan)
    return dyads(np.full(len(normals), 1.0 / len(normals)), normals)


def dyads(weights: Floats, normals: Floats) -> Floats:
    """Σ w n ⊗ n, symmetric to the last digit."""
    total = normals.T @ (weights[:, None] * normals)
    return np.asarray(0.5 * (total + total.T))


def shares_of(ends: Ends, answers: Answers, angles: Floats, normals: Floats, tension: float) -> Shares:
    """Sums over bridges of the three parts, [J]."""
    moments = np.empty((len(normals), 2))
    in_chunks(
        _moment_range, len(normals), _CHUNK,
        answers.suction, answers.shape, ends.radius1, ends.radius2, angles[ends.kind1], angles[ends.kind2], tension,
        moments,
    )  # fmt: skip
    identity = np.eye(3)
    liquid = np.sum(answers.suction * answers.volume) * identity
    across, axial = answers.shape[:, ACROSS], answers.shape[:, AXIAL]
    area = answers.shape[:, AREA]
    surface = tension * (np.sum(area - across) * identity + dyads(across - axial, normals))
    # From the poles of the grains to their centres; a plane is its own centre.
    solid = sum(np.where(np.isinf(radius), 0.0, radius) for radius in (ends.radius1, ends.radius2))
    arm = answers.force * (solid + np.minimum(ends.gap, 0.0))
    pull = tension * moments
    contact = np.sum(pull[:, 1]) * identity + dyads(pull[:, 0] - pull[:, 1] + arm, normals)
    return Shares(liquid, surface, contact)


@kernel
def _moment_range(
    suctions: Floats,
    shape: Floats,
    radii1: Floats,
    radii2: Floats,
    angles1: Floats,
    angles2: Floats,
    tension: float,
    out: Floats,
    start: int,
    stop: int,
) -> None:
    """Moments of the pull on the solids about their poles, over γ: along the axis and across it."""
    for i in range(start, stop):
        curvature = element(suctions, i) / tension
        if np.isinf(radii1[i]):
            first = plane_cap(shape[i, WETTED_1], angles1[i])
        else:
            first = cap_of(shape[i, FILLING_1], curvature, radii1[i], angles1[i])
        if np.isinf(radii2[i]):
            second = plane_cap(shape[i, WETTED_2], angles2[i])
        else:
            second = cap_of(shape[i, FILLING_2], curvature, radii2[i], angles2[i])
        out[i, 0], out[i, 1] = moments_of(first, second)
