"""Tables for YADE, built so that its interpolation keeps a tolerance and breaks bridges at the right gap.

YADE is linear between blocks of equal gap and between the rows of a block, so what is missed is the curvature of the
force and of the volume times the square of the spacing over 8. Blocks and rows are laid where that product is the same.

A bridge breaks in YADE at the gap of a block. Blocks stand therefore at most 1.4 % apart wherever bridges break, and
each ends at the suction at which its gap is 0.6 % short of the exact rupture distance. A point at 0.98 of the rupture
distance has then both of its blocks, and the gap at which YADE breaks the bridge is -0.8 % to +0.8 % off.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...ground.check import angle, in_range, scalar
from .exact import exact_rows, exact_rupture
from .files import Table

__all__ = ["REACH", "REDUCED_SUCTION", "TOLERANCE", "acute_angle", "last_suction", "make_table"]

Floats = NDArray[np.float64]

TOLERANCE = 1e-3  # of the force, over the force at contact
REDUCED_SUCTION = 1e4  # u R2/γ
REACH = 0.98  # of the rupture distance, up to which the tolerance is kept

_STEP = 1.014  # largest ratio of the gaps of two blocks
_END = REACH * _STEP  # of the rupture distance, where a block ends
_LAST = 0.9925  # of the rupture distance without suction, where the last block stands
_VOLUME = 10.0  # tolerance of the volume over that of the force, each over its value at contact
_GAP_SHARE, _SUCTION_SHARE = 0.54, 0.46  # of the tolerance
_MARGIN = 1.001  # beyond the largest suction, so that rounding does not leave the table
_SCALE = 0.3  # u R2/γ below which suctions are spread evenly, above evenly in their logarithm

_BISECTIONS = 12
_CURVES, _STATES = 64, 240  # where the curvatures along the gap are sampled: suctions, gaps of each
_SAMPLES, _STRIDE = 64, 4  # where those along the suction are sampled: suctions, every fourth block
_FOLDS, _FINE = 2400, 8000  # points of the rupture curve, and of the spacing along the gap


class _Folds(NamedTuple):
    """Rupture distance of one pair against the suction, from zero to the end of the table."""

    suctions: Floats
    ruptures: Floats


def make_table(
    ratio: float,
    contact_angle: float,
    *,
    tolerance: float = TOLERANCE,
    reduced_suction: float = REDUCED_SUCTION,
) -> Table:
    r"""Table of one ratio in which YADE's interpolation keeps a tolerance.

    .. math:: |F_\text{YADE} - F| \le \varepsilon\, F(D=0) \quad \text{for } D \le 0.98\,D_\text{rupture}

    Parameters
    ----------
    ratio : float
        R2/R1 >= 1.
    contact_angle : float
        θ of both spheres, [rad], below π/2: suction holds no bridge apart beyond it.
    tolerance : float
        ε, from 1e-4 to 0.1.
    reduced_suction : float
        u R2/γ up to which the table reaches, 1 to 1e8.

    Returns
    -------
    Table

    Raises
    ------
    ValueError
        For bad input.

    Notes
    -----
    **Validity.** The volume is kept to ten times the tolerance, over the volume at contact. `measure` gives
    the errors of a table.

    Examples
    --------
    >>> table = make_table(2.0, 0.35, tolerance=1e-2, reduced_suction=100.0)
    >>> float(table.gaps[0]), table.blocks[0][0, :2].tolist()
    (0.0, [0.0, 0.0])
    """
    theta = acute_angle(contact_angle)
    in_range("ratio", scalar("ratio", ratio, ""), 1.0)
    in_range("tolerance", scalar("tolerance", tolerance, ""), 1e-4, 0.1)
    suctions = _spread(last_suction(reduced_suction), _FOLDS)
    folds = _Folds(suctions, exact_rupture(ratio, theta, suctions))
    gaps = _gaps(ratio, theta, _GAP_SHARE * tolerance, folds)
    blocks = _suctions(ratio, theta, _SUCTION_SHARE * tolerance, folds, gaps)
    counts = [len(block) for block in blocks]
    rows = exact_rows(ratio, theta, np.repeat(gaps, counts), np.concatenate(blocks))
    return Table(ratio, tuple(np.split(rows, np.cumsum(counts)[:-1])))


def acute_angle(contact_angle: float) -> float:
    """Contact angle below π/2, beyond which no suction holds a bridge apart."""
    return in_range("contact_angle", float(angle("contact_angle", contact_angle)), 0.0, 0.5 * np.pi, brackets="[)")


def last_suction(reduced_suction: float) -> float:
    """Where a table that reaches to a suction ends, just beyond it."""
    return _MARGIN * in_range("reduced_suction", scalar("reduced_suction", reduced_suction, ""), 1.0, 1e8)


def _spread(last: float, count: int) -> Floats:
    """Suctions from zero, evenly spread at first and evenly in their logarithm then."""
    return _SCALE * np.sinh(np.linspace(0.0, np.arcsinh(last / _SCALE), count))


def _gaps(ratio: float, theta: float, tolerance: float, folds: _Folds) -> Floats:
    """Gaps of the blocks, from contact to just short of the largest rupture distance."""
    shortest, longest = folds.ruptures[-1], folds.ruptures[0]
    fine = np.append(0.0, np.geomspace(1e-4 * shortest, _LAST * longest, _FINE))
    step = np.where(fine > shortest / _STEP**2, (1.0 - 1.0 / _STEP) * fine, np.inf)
    gaps, allowed = _allowed_steps(ratio, theta, tolerance, folds.suctions[-1])
    for gap, most in zip(gaps, allowed, strict=True):
        # Along one fraction of the rupture distance, from the largest suction to none and a cell further.
        here = (fine >= gap[0]) & (fine <= _STEP * gap[-1])
        step[here] = np.minimum(step[here], np.interp(fine[here], gap, most))
    step[fine < gaps[1, 0]] = allowed[0].min()
    return _even_shares(fine, 1.0 / step)


def _allowed_steps(ratio: float, theta: float, tolerance: float, last: float) -> tuple[Floats, Floats]:
    """Gaps, and the spacing that the curvatures allow there: rows by fraction of the rupture distance.

    In a row the suction falls, so that the gap rises.
    """
    suctions = _spread(last, _CURVES)[::-1, None]
    # Evenly spread in the square root of the distance to the fold, in which the force is smooth, and denser at contact.
    fractions = _END * (1.0 - (1.0 - np.linspace(0.0, 1.0, _STATES) ** 2) ** 2)
    gaps = exact_rupture(ratio, theta, suctions) * fractions
    bend = _bend(gaps, exact_rows(ratio, theta, gaps, suctions), exact_rows(ratio, theta, 0.0, suctions))
    kept = fractions <= REACH
    allowed = [_longest_step(gap, curve, 8.0 * tolerance)[kept] for gap, curve in zip(gaps, bend, strict=True)]
    return gaps[:, kept].T, np.array(allowed).T


def _longest_step(x: Floats, bend: Floats, product: float) -> Floats:
    """Step h from each x with h² times the second derivative at x + h, which rises to the fold, equal to a product."""
    low, high = np.zeros(len(x)), np.sqrt(product / bend)
    for _ in range(_BISECTIONS):
        step = 0.5 * (low + high)
        fits = step**2 * np.maximum(bend, np.interp(x + step, x, bend)) <= product
        low, high = np.where(fits, step, low), np.where(fits, high, step)
    return low


def _bend(x: Floats, rows: Floats, contact: Floats) -> Floats:
    """Second derivative along x of the force, or of the volume by its own tolerance, over the value at contact."""
    force, volume = (np.abs(_second_derivative(x, rows[..., i])) / contact[..., i] for i in (3, 2))
    return np.maximum(force, volume / _VOLUME)


def _second_derivative(x: Floats, y: Floats) -> Floats:
    """Second derivative on the last axis by differences, that of the next point at the ends."""
    slope = np.diff(y, axis=-1) / np.diff(x, axis=-1)
    inner = 2.0 * np.diff(slope, axis=-1) / (x[..., 2:] - x[..., :-2])
    return np.concatenate([inner[..., :1], inner, inner[..., -1:]], axis=-1)


def _even_shares(x: Floats, density: Floats) -> Floats:
    """Points from the first to the last of x with as much of the integral of a density between any two, at most 1."""
    total = np.append(0.0, np.cumsum(0.5 * (density[1:] + density[:-1]) * np.diff(x)))
    shares = np.linspace(0.0, total[-1], max(int(np.ceil(total[-1])), 1) + 1)
    points = np.interp(shares, total, x)
    points[-1] = x[-1]
    return points


def _suctions(ratio: float, theta: float, tolerance: float, folds: _Folds, gaps: Floats) -> list[Floats]:
    """Suctions of the rows of each block, from zero to where the gap is about to be the rupture distance."""
    ends = _last_suctions(folds, gaps)
    # Denser at the end, where the force falls as the square root of the distance to the fold.
    place = 1.0 - (1.0 - np.linspace(0.0, 1.0, _SAMPLES)) ** 2
    suctions = _SCALE * np.sinh(np.arcsinh(ends / _SCALE)[:, None] * place)
    sampled = np.union1d(np.arange(0, len(gaps), _STRIDE), len(gaps) - 1)
    asked = suctions[sampled]
    bend = _bend(asked, exact_rows(ratio, theta, gaps[sampled, None], asked), exact_rows(ratio, theta, 0.0, asked))
    of_unit_length = bend * ends[sampled, None] ** 2
    between = [np.interp(np.arange(len(gaps)), sampled, column) for column in of_unit_length.T]
    bend = np.column_stack(between) / ends[:, None] ** 2
    # The largest of three neighbours: a row stands for all that is between it and the next.
    padded = np.pad(bend, ((0, 0), (1, 1)), mode="edge")
    bend = np.maximum(np.maximum(padded[:, :-2], padded[:, 1:-1]), padded[:, 2:])
    density = np.sqrt(bend / (8.0 * tolerance))
    return [_even_shares(*block) for block in zip(suctions, density, strict=True)]


def _last_suctions(folds: _Folds, gaps: Floats) -> Floats:
    """Suction at which each gap is so close to the rupture distance that its block ends."""
    coordinate = np.arcsinh(folds.suctions / _SCALE)
    with np.errstate(divide="ignore"):
        asked = np.log(gaps / _END)
    ends: Floats = _SCALE * np.sinh(np.interp(asked, np.log(folds.ruptures[::-1]), coordinate[::-1]))
    return ends
