"""Which law is best over a range of conditions, computed on a sample of it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ground.check import angle, in_range, quantity, scalar
from ..laws import Law, laws
from .domain import why_silent
from .sample import NO_BRIDGE, ControlName, Sample, exact_sample, law_errors
from .words import size_words, variable_words

__all__ = ["Ranked", "Recommendation", "recommend"]

Floats = NDArray[np.float64]

_CONTROLS, _ANGLES, _RATIOS, _SEPARATIONS = 25, 9, 5, 11


class Ranked(NamedTuple):
    """A law and the largest relative error of its force over the sample, with the place where it is."""

    name: str
    largest_error: float  # without its sign
    control_star: float
    contact_angle: float  # [rad]
    size_ratio: float
    fraction: float  # D/D_c
    rupture_error: float  # largest one of the rupture distance; NaN if the law gives none


class Recommendation(NamedTuple):
    """Laws of one control, the best first, and the sample on which they were judged."""

    ranked: tuple[Ranked, ...]
    disqualified: dict[str, str]  # laws that are not fit for the whole range, with the reason
    control: ControlName
    control_star: Floats
    contact_angle: Floats  # [rad]
    size_ratio: Floats
    fraction: Floats

    @property
    def bridges(self) -> int:
        """How many exact bridges the sample has."""
        return self.control_star.size * self.contact_angle.size * self.size_ratio.size * self.fraction.size


def recommend(
    *,
    reduced_suction: ArrayLike | None = None,
    reduced_volume: ArrayLike | None = None,
    contact_angle: ArrayLike = 0.0,
    size_ratio: ArrayLike = 1.0,
    up_to: float = 0.9,
) -> Recommendation:
    r"""Rank the laws by the largest error of their force over a range of conditions.

    .. math:: \max |F_\text{law}/F_\text{exact} - 1|

    Parameters
    ----------
    reduced_suction, reduced_volume : (float, float) or float
        Range of H* = Δp R̄/γ, or of V* = V/R̄³, [-], > 0; exactly one of them. The laws of that control are judged.
    contact_angle : (float, float) or float
        Range of θ, the same on both solids, [rad].
    size_ratio : (float, float) or float
        Range of R2/R1, [-], >= 1; infinite for a plane.
    up_to : float
        Largest separation over the rupture distance, [-], from 0 to below 1.

    Returns
    -------
    Recommendation
        With the sample: 25 controls in geometric steps, 9 angles, 5 ratios even in R1/R2, 11 separations, dense
        towards the last; one of each where the range is a number.

    Raises
    ------
    ValueError
        For bad input, and for ranges with solids that hold no bridge apart.

    Notes
    -----
    **Validity.** The error is computed at the points of the sample, so that between them it may be a little larger.
    A law that says nothing, or has no bridge, at some point of the sample is disqualified.

    Examples
    --------
    >>> found = recommend(reduced_suction=(10.0, 1e4), contact_angle=(0.0, 0.7))
    >>> found.bridges
    2475
    >>> found.ranked[0].largest_error < 0.01
    True
    """
    given = {"suction": reduced_suction, "volume": reduced_volume}
    held = [name for name, values in given.items() if values is not None]
    if len(held) != 1:
        what = "both are" if held else "none is"
        raise ValueError(f"control: exactly one of reduced_suction and reduced_volume is needed, {what} given")
    control: ControlName = "suction" if held[0] == "suction" else "volume"
    controls = _span(f"reduced_{control}", given[control], 0.0, "()")
    angles = _span("contact_angle", angle("contact_angle", contact_angle), 0.0, "[)")
    smaller = 1.0 / _span("size_ratio", size_ratio, 1.0, "[]", allow_inf=True)
    last = in_range("up_to", scalar("up_to", up_to, ""), 0.0, 1.0, brackets="[)")
    with np.errstate(divide="ignore"):
        ratios = 1.0 / _steps(smaller, _RATIOS)
    empty = Recommendation(
        ranked=(),
        disqualified={},
        control=control,
        control_star=np.geomspace(controls[0], controls[-1], _CONTROLS) if controls[0] < controls[-1] else controls[:1],
        contact_angle=_steps(angles, _ANGLES),
        size_ratio=ratios,
        fraction=last * (1.0 - np.linspace(1.0, 0.0, _SEPARATIONS) ** 2) if last else np.zeros(1),
    )
    grid = np.meshgrid(empty.control_star, empty.contact_angle, empty.size_ratio, indexing="ij")
    sample = exact_sample(control, *grid, empty.fraction)
    _refuse_dry(sample)
    ranked, disqualified = [], {}
    for law in (law for law in laws.values() if law.control == control):
        judged = _judge(law, sample)
        if isinstance(judged, str):
            disqualified[law.name] = judged
        else:
            ranked.append(judged)
    return empty._replace(ranked=tuple(sorted(ranked, key=lambda law: law.largest_error)), disqualified=disqualified)


def _refuse_dry(sample: Sample) -> None:
    """Refuse ranges in which there is not everywhere an exact bridge to compare with."""
    dry = np.flatnonzero(np.isnan(sample.rupture_star))
    if dry.size:
        raise ValueError(
            f"reduced_{sample.control}: {sample.control_star[dry[0]]:.6g} holds no bridge apart at "
            f"{_solids_in_words(sample, int(dry[0]))}; narrow the ranges"
        )


def _solids_in_words(sample: Sample, i: int) -> str:
    return f"{variable_words('contact_angle', sample.contact_angle[i])}, {size_words(1.0 / sample.size_ratio[i])}"


def _span(name: str, values: ArrayLike | None, low: float, brackets: str, *, allow_inf: bool = False) -> Floats:
    """Two ends of a range, equal ones for a single number."""
    array = np.atleast_1d(quantity(name, values, "", allow_inf=allow_inf))
    in_range(name, array, low, brackets=brackets)
    if array.shape not in ((1,), (2,)) or array[0] > array[-1]:
        raise ValueError(f"{name}: {array.tolist()} is neither a number nor a range (lowest, highest)")
    return array[[0, -1]]


def _steps(ends: Floats, count: int) -> Floats:
    """Even steps over a range; one for a single number."""
    return np.linspace(ends[0], ends[-1], count if ends[0] != ends[-1] else 1)


def _judge(law: Law, sample: Sample) -> Ranked | str:
    """Place of the largest error, or the reason why the law is not fit for all of the sample."""
    if "force" not in law.gives:
        return f"gives no force, only the {' and the '.join(law.gives)}".replace("_", " ")
    errors = law_errors(law, sample)
    unfit = np.argwhere(np.isnan(errors.force) | (errors.force == NO_BRIDGE))
    if len(unfit):
        i, j = unfit[0]
        return _reason(law, sample, int(i), int(j), says_nothing=bool(np.isnan(errors.force[i, j])))
    size = np.abs(errors.force)
    i, j = np.unravel_index(int(np.argmax(size)), size.shape)
    return Ranked(
        name=law.name,
        largest_error=float(size[i, j]),
        control_star=float(sample.control_star[i]),
        contact_angle=float(sample.contact_angle[i]),
        size_ratio=float(sample.size_ratio[i]),
        fraction=float(sample.fraction[j]),
        rupture_error=float(np.max(np.abs(errors.rupture))),
    )


def _reason(law: Law, sample: Sample, i: int, j: int, *, says_nothing: bool) -> str:
    place = {
        f"{sample.control}_star": sample.control_star[i],
        "contact_angle": (sample.contact_angle[i], sample.contact_angle[i]),
        "size_ratio": sample.size_ratio[i],
        "separation_star": sample.fraction[j] * sample.rupture_star[i],
    }
    where = (
        f"at {variable_words(f'{sample.control}_star', sample.control_star[i])}, {_solids_in_words(sample, i)}, "
        f"{sample.fraction[j]:.3g} D_c"
    )
    return f"{why_silent(law, place, 'force')} ({where})" if says_nothing else f"has no bridge {where}"
