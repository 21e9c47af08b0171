"""All laws beside the exact solution, for one pair of solids at one control."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ask.face import bridge, rupture
from ..ask.liquid import Liquid
from ..ask.other_control import other_control_star
from ..ask.pair import Pair, check_pair, refuse_planes
from ..ask.problem import Control, control_of, control_star, reduce
from ..ground.check import one_of, whole_number
from ..laws import Law, force_star, rupture_star, rupture_work_star
from ..laws import laws as registry
from .domain import outside_range, why_silent
from .sample import ControlName, rupture_work

__all__ = ["MARKS", "UP_TO", "Comparison", "LawAnswer", "compare"]

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

MARKS = (0.0, 0.5, 0.9)  # D/D_c at which errors are told
UP_TO = 0.9  # D/D_c; nearer to rupture a relative error says how well the law meets the rupture distance

_FEWEST = 5


class LawAnswer(NamedTuple):
    """What a law says of a pair, beside the exact solution; NaN where it says nothing.

    Errors are relative, (law - exact)/exact; -1 where the law has no bridge any more.
    """

    name: str
    converted: bool  # a law of the other control, asked with the exact volume or suction of each state
    force: Floats  # at the separations of the comparison, [N]; what `bridge(method=...)` says there
    error: Floats
    judged: Bools  # where the largest error is sought: up to 0.9 of the rupture distance under the law's control
    error_at_marks: tuple[float, ...]  # at contact, and at 0.5 and 0.9 of the rupture distance
    largest_error: float  # without its sign, of the judged states
    answered_to: float  # D/D_c up to which the law says something, from contact on
    rupture_separation: float  # [m]; known only under the law's own control, as all that follows
    rupture_error: float
    rupture_work: float  # from contact to rupture, [J]
    rupture_work_error: float
    outside: str  # the variable that leaves the range stated for the law, empty if none does


class Comparison(NamedTuple):
    """Exact bridges of a pair from contact to rupture, and what the laws say of them."""

    pair: Pair
    control: ControlName
    value: float  # of the control, [Pa] or [m³]
    fraction: Floats  # D/D_c, from 0 to 1, the last the rupture itself
    separation: Floats  # [m]; these and all that follow are exact
    force: Floats  # [N]
    suction: Floats  # [Pa]
    volume: Floats  # [m³]
    rupture_work: float  # of the force from contact to rupture, [J]
    laws: tuple[LawAnswer, ...]  # those of the control first, in either part the best first
    refused: dict[str, str]  # laws that say nothing of this pair, with the reason


class _Reduced(NamedTuple):
    """A pair and its exact states in the numbers that laws are asked with."""

    length: float  # R̄, [m]
    tension: float
    solids: tuple[float, float, float, float]  # θ1, θ2, κ1, κ2
    controls: dict[str, Floats]  # H* and V* of every state, NaN where a law of it is not asked
    judged: dict[str, Bools]  # states near enough for the error of a law of that control


def compare(
    pair: Pair,
    *,
    suction: ArrayLike | None = None,
    volume: ArrayLike | None = None,
    humidity: ArrayLike | None = None,
    liquid: Liquid,
    points: int = 61,
    laws: Sequence[str | Law] | None = None,
) -> Comparison:
    r"""Force by every law that applies to a pair, beside the exact force, from contact to rupture.

    .. math:: e = F_\text{law}/F_\text{exact} - 1

    Parameters
    ----------
    pair : Pair
        The solids; radii and angles are single numbers.
    suction, volume, humidity : float, optional
        What is held, [Pa], [m³] or [-]; exactly one of them.
    liquid : Liquid
        Surface tension, and for humidity density and molar mass.
    points : int
        Separations from contact to rupture, at least 5; those at which errors are told are added to them.
    laws : sequence of str or Law, optional
        Which laws, by their names or as records, registered or not; by default all that are registered.

    Returns
    -------
    Comparison

    Raises
    ------
    ValueError
        For bad input, for arrays, and for solids that hold no bridge apart.

    Notes
    -----
    **Validity.** A law of the other control is asked with the exact volume (or suction) of each state, so that its
    own error is seen and nothing else. A law of suction control knows only states that their suction would hold. The
    largest error is that of the states from contact, included, to 0.9 of the rupture distance, included, and of a law
    of suction control at constant volume to 0.9 of the rupture distance at the suction of the state; between two of
    the states it may be a little larger. The rupture distance of a law belongs to the law's own control.

    Examples
    --------
    >>> grains = Pair(radius=50e-6, contact_angle=np.deg2rad(20))
    >>> found = compare(grains, suction=20e3, liquid=Liquid(surface_tension=0.0728))
    >>> own = {answer.name: answer for answer in found.laws if not answer.converted}
    >>> print(f"{100 * own['zhao2020'].largest_error:.2f} %")
    3.87 %
    """
    count = whole_number("points", points, _FEWEST)
    chosen = _chosen(laws)
    control = control_of(suction, volume, humidity, liquid)
    check_pair(pair)
    refuse_planes(pair, "no law knows")
    exact = _exact(pair, control, liquid, count)
    reduced = _reduce(exact, control, liquid)
    found, refused = [], {}
    for law in chosen:
        answer = _answer(law, exact, reduced)
        if np.all(np.isnan(answer.error)) and np.isnan(answer.rupture_error) and np.isnan(answer.rupture_work_error):
            refused[law.name] = _why_silent(law, exact, reduced)
        else:
            found.append(answer)
    return exact._replace(laws=tuple(sorted(found, key=_rank)), refused=refused)


def _chosen(laws: Sequence[str | Law] | None) -> list[Law]:
    """Records of the laws that are asked for."""
    if laws is None:
        return list(registry.values())
    if isinstance(laws, str | Law) or not isinstance(laws, Sequence):
        raise ValueError(f"laws: {laws!r} is not a sequence of names and records of laws")
    for law in laws:
        if not isinstance(law, Law):
            one_of("laws", law, tuple(registry))
    return [law if isinstance(law, Law) else registry[law] for law in laws]


def _exact(pair: Pair, control: Control, liquid: Liquid, count: int) -> Comparison:
    """Exact states, dense towards contact and rupture, where force and error change fastest."""
    check_pair(pair)
    if any(np.ndim(number) for number in (control.value, *pair.radii, *pair.contact_angles)):
        raise ValueError(f"pair: an array of radii, angles or {control.name} is given where single numbers are needed")
    held: dict[str, Any] = {control.name: float(control.value), "liquid": liquid}
    end, contact = rupture(pair, **held), bridge(pair, 0.0, **held)
    if not (end.exists and contact.exists):
        raise ValueError("pair: these solids hold no bridge apart, so there is nothing to compare")
    fraction = np.union1d(np.sin(np.linspace(0.0, 0.5 * np.pi, count)) ** 2, MARKS)
    states = bridge(pair, fraction[:-1] * end.separation, **held)
    known = {
        name: np.append(getattr(states, name), getattr(end, name))
        for name in ("separation", "force", "suction", "volume")
    }
    work = float(rupture_work(control.name, contact, end))
    return Comparison(pair, control.name, held[control.name], fraction, **known, rupture_work=work, laws=(), refused={})


def _reduce(exact: Comparison, control: Control, liquid: Liquid) -> _Reduced:
    problem = reduce(exact.pair, control, liquid, exact.separation)
    length = float(exact.pair.derjaguin_radius)
    radii, angles = exact.pair.radii, exact.pair.contact_angles
    other: ControlName = "volume" if exact.control == "suction" else "suction"
    near = exact.fraction <= UP_TO
    controls: dict[str, Floats] = {exact.control: control_star(problem), other: other_control_star(problem, exact)}
    return _Reduced(
        length=length,
        tension=liquid.surface_tension,
        solids=(float(angles[0]), float(angles[1]), length / float(radii[0]), length / float(radii[1])),
        controls=controls,
        judged={"volume": near, "suction": _is_near_by_suction(exact, near & ~np.isnan(controls["suction"]), liquid)},
    )


def _is_near_by_suction(exact: Comparison, asked: Bools, liquid: Liquid) -> Bools:
    """Which of the states that are asked for are well inside the branch that their suction holds."""
    if exact.control == "suction" or not asked.any():
        return asked
    end = rupture(exact.pair, suction=exact.suction[asked], liquid=liquid)
    near = np.zeros(asked.size, bool)
    near[asked] = exact.separation[asked] <= UP_TO * np.asarray(end.separation)
    return near


def _answer(law: Law, exact: Comparison, reduced: _Reduced) -> LawAnswer:
    is_own, judged = law.control == exact.control, reduced.judged[law.control]
    control, silence = reduced.controls[law.control], np.full(exact.fraction.size, np.nan)
    force, distance, work = silence, np.nan, np.nan
    scale = 2.0 * np.pi * reduced.tension * reduced.length
    if "force" in law.gives:
        force = scale * force_star(law, exact.separation / reduced.length, control, *reduced.solids)
    if is_own and "rupture" in law.gives:
        distance = reduced.length * float(rupture_star(law, control[0], *reduced.solids))
    if is_own and "rupture_work" in law.gives:
        work = scale * reduced.length * float(rupture_work_star(law, control[0], *reduced.solids))
    with np.errstate(divide="ignore", invalid="ignore"):
        error = force / exact.force - 1.0
    return LawAnswer(
        name=law.name,
        converted=not is_own,
        force=force,
        error=error,
        judged=judged,
        error_at_marks=tuple(float(error[np.searchsorted(exact.fraction, mark)]) for mark in MARKS),
        largest_error=_largest(error[judged]),
        answered_to=_answered_to(exact.fraction, error),
        rupture_separation=distance,
        rupture_error=distance / float(exact.separation[-1]) - 1.0,
        rupture_work=work,
        rupture_work_error=work / exact.rupture_work - 1.0,
        outside=outside_range(law, _asked(law, exact, reduced)),
    )


def _largest(error: Floats) -> float:
    known = np.abs(error[~np.isnan(error)])
    return float(known.max()) if known.size else np.nan


def _answered_to(fraction: Floats, error: Floats) -> float:
    silent = np.flatnonzero(np.isnan(error))
    if not silent.size:
        return 1.0
    return float(fraction[silent[0] - 1]) if silent[0] else 0.0


def _asked(law: Law, exact: Comparison, reduced: _Reduced) -> dict[str, ArrayLike]:
    """Values with which a law is asked, up to where its error is judged, by the names of its variables."""
    theta1, theta2, kappa1, kappa2 = reduced.solids
    with np.errstate(divide="ignore"):
        ratio = np.divide(max(kappa1, kappa2), min(kappa1, kappa2))
    return {
        f"{law.control}_star": reduced.controls[law.control][reduced.judged[law.control]],
        "contact_angle": (theta1, theta2),
        "size_ratio": ratio,
    }


def _why_silent(law: Law, exact: Comparison, reduced: _Reduced) -> str:
    if law.gives == ("damping",):
        return "its damping belongs to solids that move"
    if law.control != exact.control and "force" not in law.gives:
        given = " and ".join(law.gives).replace("_", " ")
        return f"its {given} belongs to constant {law.control}"
    return why_silent(law, _asked(law, exact, reduced), law.gives[0])


def _rank(answer: LawAnswer) -> tuple[bool, bool, float, str]:
    is_unknown = bool(np.isnan(answer.largest_error))
    # two laws that are alike to rounding, as some are where the angle is zero, are ranked by their names
    return answer.converted, is_unknown, 0.0 if is_unknown else round(answer.largest_error, 9), answer.name
