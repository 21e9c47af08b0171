"""The public face: a bridge between two solids, its rupture and its force curve, in SI units."""

from collections.abc import Sequence
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ground.check import instance, one_of, quantity, whole_number
from ..laws import laws
from .by_angle import bridge_by_angle
from .by_dataset import bridge_by_dataset, rupture_by_dataset
from .by_law import bridge_by_law, rupture_by_law
from .by_shape import bridge_by_shape, curve_by_shape
from .by_table import bridge_by_table, rupture_by_table
from .fields import TO_GO_ON, checked_fields, narrowed
from .liquid import HUMIDITY_UNCERTAINTY, Liquid, humidity_from_suction, suction_from_humidity, warn_kelvin
from .many import many_bridges
from .pair import Pair, PerSolid, check_pair, refuse_planes
from .problem import (
    Asked,
    Control,
    ConvergenceWarning,
    Limit,
    control_of,
    reduce,
    refuse_drained_planes,
    solve,
    trace,
)
from .result import FIELDS, Bridge, Profile

__all__ = ["FIELDS", "Bridge", "ConvergenceWarning", "Pair", "Profile", "bridge", "curve", "rupture"]

Floats = NDArray[np.float64]

# Methods that are neither exact nor a law.
_BRIDGES = {"table": bridge_by_table, "dataset": bridge_by_dataset}
_RUPTURES = {"table": rupture_by_table, "dataset": rupture_by_dataset}


def bridge(
    pair: Pair,
    separation: ArrayLike | None = None,
    *,
    half_filling_angle: PerSolid | tuple[ArrayLike | None, ArrayLike | None] | None = None,
    suction: ArrayLike | None = None,
    volume: ArrayLike | None = None,
    humidity: ArrayLike | None = None,
    liquid: Liquid,
    branch: Literal["stable", "unstable"] = "stable",
    limit: Limit = "stability",
    method: str = "exact",
    fields: Sequence[str] | None = None,
    near: Bridge | None = None,
) -> Bridge:
    r"""Capillary bridge between two solids at a separation, or of a half-filling angle, exactly.

    .. math:: & \frac{Y''}{(1+Y'^2)^{3/2}} - \frac{1}{Y\sqrt{1+Y'^2}} = \frac{\Delta p}{\gamma}
        \quad \text{([1], Eq. 8)} \\ & F = 2\pi\gamma\lambda \quad \text{(Eq. 11)}

    Parameters
    ----------
    pair : Pair
        The solids.
    separation : array_like, optional
        D, whole gap from surface to surface, [m], above minus half the smaller radius; negative means overlap. Between
        two planes it is > 0. Beside a half-filling angle it is a guess: of several bridges the nearest is answered.
    half_filling_angle : array_like or tuple of two, optional
        δ of the contact circle of radius R sin δ, [rad], in (0, π), in the place of the separation. On the first solid;
        a tuple names which, ``(None, 0.5)`` is on the second. At a constant volume several stable bridges may have it.
    suction : array_like, optional
        Δp = p_gas - p_liquid held constant, [Pa], up to 1e13 γ/R̄ either way. Exactly one of the three controls is
        given.
    volume : array_like, optional
        Liquid volume held constant, [m³], 1e-30 to 1e4 R̄³. Where it is too large for a bridge at contact, there is one
        from the lower end of the stable branch on; see :func:`rupture`.
    humidity : array_like, optional
        Relative humidity in (0, 1), [-]: suction by the Kelvin equation.
    liquid : Liquid
        Surface tension, and for humidity density and molar mass.
    branch : {"stable", "unstable"}
        The stable bridge, or the one beyond the end of the stable branch that meets it there.
    limit : {"stability", "fold"}
        Where the stable branch ends: at the end of stability, or at the fold. They differ for equal solids only; with
        ``"fold"`` the symmetric bridges between the two are answered, too, and ``stable`` is False there.
    method : str
        ``"exact"``; ``"table"``, the exact answer from a :class:`Table` that is made first, for very many bridges;
        ``"dataset"``, the interpolation of the paper; or the name of a law in ``pendular.laws``. A table gives force,
        stiffness, volume and suction, the data base and a law the force only. A law of the other control is asked with
        the volume or the suction of the exact bridge; one at constant suction has no answer where that suction would
        not hold the bridge. Where a method has no answer the force is NaN and ``exists`` False.
    fields : sequence of str, optional
        Names of the fields that are wanted; all others are NaN, or False, but for those that tell of existence and
        stability. For arrays, what is not wanted is not computed: ``("force",)`` costs about four fifths.
    near : Bridge, optional
        Bridges of the same arrays a little before, as the step before of a simulation answered them, with all fields or
        near others: those that stood are looked for from where they were. It changes no answer, but its cost.

    Returns
    -------
    Bridge
        Fields of the shape to which the arguments, radii and angles broadcast.

    Raises
    ------
    ValueError
        For bad input, naming the argument, its value and what is allowed; for a half-filling angle that several
        bridges have, where no separation tells which is meant; and for two planes under suction, where no bridge is
        stable: each is a nucleus that dries up or floods the gap, and ``branch="unstable"`` answers it.

    Warns
    -----
    KelvinWarning
        Where the Kelvin equation is doubtful, or the humidity does not fix the force.
    RangeWarning
        Where a law is asked outside its range, takes a mean of solids that differ, or says nothing; once a call.
    ConvergenceWarning
        Where the solver failed; the fields are NaN there.

    Notes
    -----
    **Validity.** No gravity, no roughness. Relative error below 1e-10 up to 0.999 of the rupture distance for reduced
    suctions from 0 to 1e12, and for volumes below 1e-9; printed by ``python -m benchmarks.accuracy``.
    In an overlap the volume counts the liquid outside the two caps, each of them whole.

    References
    ----------
    .. [1] C.-F. Zhao, N. P. Kruyt, O. Millet, Powder Technology 360 (2020) 622.

    Examples
    --------
    >>> grains = Pair(radius=50e-6, contact_angle=np.deg2rad(20))
    >>> b = bridge(grains, 1e-6, suction=20e3, liquid=Liquid(surface_tension=0.0728))
    >>> print(f"{b.force:.4e} N, {b.volume:.4e} m3, stable: {b.stable}")
    1.5087e-05 N, 1.3015e-15 m3, stable: True
    """
    one_of("limit", limit, ("stability", "fold"))
    wanted = checked_fields(fields)
    check_pair(pair)
    control = control_of(suction, volume, humidity, liquid)
    is_approximate = _is_approximate(method, pair)
    one_of("branch", branch, ("stable",) if is_approximate else ("stable", "unstable"))
    if pair.shape is not None:
        _refuse_filling_angle(half_filling_angle, pair)
        answer = bridge_by_shape(pair, control, liquid, separation, branch, limit)
        _judge_curvature(control, humidity, liquid, answer)
        return narrowed(answer, wanted)
    if half_filling_angle is not None:
        if is_approximate:
            raise ValueError(f"half_filling_angle: method {method!r} does not know it; 'exact' does")
        answer = bridge_by_angle(pair, control, liquid, half_filling_angle, separation, branch, limit)
        if humidity is not None:
            found = np.where(answer.exists, answer.separation, 0.0)
            _judge_humidity(pair, found, control, liquid, branch, answer)
        return narrowed(answer, wanted)
    if separation is None:
        raise ValueError("separation: None given; a separation or a half_filling_angle is needed")
    if branch == "stable":
        _refuse_drained_planes(pair, control, humidity)
    if is_approximate:
        problem = reduce(pair, control, liquid, separation)
        return narrowed(_BRIDGES[method](problem) if method in _BRIDGES else bridge_by_law(problem, method), wanted)
    gap = quantity("separation", separation, "m")
    if near is not None:
        instance("near", near, Bridge)
    if humidity is not None and wanted is not None:  # whose judgement takes the force
        whole = bridge(pair, gap, suction=control.value, liquid=liquid, branch=branch, limit=limit, near=near)
        _judge_humidity(pair, separation, control, liquid, branch, whole)
        return narrowed(whole, wanted if near is None else (*wanted, *TO_GO_ON))
    many = many_bridges(pair, control, liquid, gap, limit, wanted, near) if branch == "stable" else None
    answer = many or narrowed(solve(reduce(pair, control, liquid, gap), branch, limit), wanted)
    if humidity is not None:
        _judge_humidity(pair, separation, control, liquid, branch, answer)
    return answer


def rupture(
    pair: Pair,
    *,
    suction: ArrayLike | None = None,
    volume: ArrayLike | None = None,
    humidity: ArrayLike | None = None,
    liquid: Liquid,
    end: Literal["upper", "lower"] = "upper",
    limit: Limit = "stability",
    method: str = "exact",
) -> Bridge:
    r"""Bridge at the end of its stable branch; its separation is the rupture distance.

    .. math:: \left.\frac{\partial D}{\partial\lambda}\right|_{\Delta p} = 0 \quad\text{or}\quad
              \left.\frac{\partial D}{\partial\lambda}\right|_V = 0

    Parameters
    ----------
    pair, suction, volume, humidity, liquid
        As for :func:`bridge`.
    end : {"upper", "lower"}
        The rupture distance; or the lower end, below which no bridge of a large volume is stable since the drop would
        rather swallow the better wetted solid. ``exists`` is False where the branch goes on to contact.
    limit : {"stability", "fold"}
        Where the bridge loses its stability; or the fold, beyond which there is no bridge. The two differ only at
        constant volume between equal solids of equal contact angle, above about 31°, where the liquid slides to one
        side before the fold.
    method : str
        ``"exact"``, ``"table"``, ``"dataset"``, or the name of a law of the given control in ``pendular.laws``.

    Returns
    -------
    Bridge
        Fields of the shape to which the arguments broadcast; ``exists`` is False where solids hold no bridge apart.

    Raises
    ------
    ValueError
        For bad input.

    Warns
    -----
    KelvinWarning
        Where the Kelvin equation is doubtful.
    ConvergenceWarning
        Where the solver failed; the fields are NaN there.

    Notes
    -----
    **Validity.** Relative error of the rupture distance below 1e-11. At a fold the stiffness is infinite, and
    ``unstable_directions`` and ``stable`` tell of the branch that ends there.

    Examples
    --------
    >>> grains = Pair(radius=50e-6, contact_angle=np.deg2rad(40))
    >>> water = Liquid(surface_tension=0.0728)
    >>> print(f"{rupture(grains, suction=20e3, liquid=water).separation:.6e}")
    2.443824e-06
    >>> first = rupture(grains, volume=1.25e-16, liquid=water)
    >>> fold = rupture(grains, volume=1.25e-16, liquid=water, limit="fold")
    >>> print(f"{first.separation / 50e-6:.6f} {fold.separation / 50e-6:.6f}")
    0.133586 0.135844
    """
    one_of("end", end, ("upper", "lower"))
    one_of("limit", limit, ("stability", "fold"))
    check_pair(pair)
    control = control_of(suction, volume, humidity, liquid)
    _refuse_drained_planes(pair, control, humidity)
    if humidity is not None:
        warn_kelvin(liquid.surface_tension / control.value, 0.0)
    is_approximate = _is_approximate(method, pair)
    if pair.shape is not None:
        return bridge_by_shape(pair, control, liquid, None, end, limit)
    problem = reduce(pair, control, liquid, None)
    if is_approximate:
        one_of("end", end, ("upper",))
        one_of("limit", limit, ("stability",))
        return _RUPTURES[method](problem) if method in _RUPTURES else rupture_by_law(problem, method)
    return solve(problem, end, limit)


def curve(
    pair: Pair,
    *,
    suction: ArrayLike | None = None,
    volume: ArrayLike | None = None,
    humidity: ArrayLike | None = None,
    liquid: Liquid,
    points: int = 201,
    limit: Limit = "stability",
) -> Bridge:
    """Bridges from contact, or the lower end, to rupture and down the unstable branch, at one control.

    Between two planes, which hold no bridge in contact, they begin at a fifth of the rupture distance.

    Parameters
    ----------
    pair, suction, volume, humidity, liquid
        As for :func:`bridge`.
    points : int
        States on the curve, at least 5; rupture is the one with index ``points // 2``.
    limit : {"stability", "fold"}
        As for :func:`rupture`.

    Returns
    -------
    Bridge
        Fields with the points on a further last axis (before a solid's own axis).

    Raises
    ------
    ValueError
        For bad input.

    Examples
    --------
    >>> c = curve(Pair(radius=50e-6, contact_angle=0.0), suction=20e3, liquid=Liquid(surface_tension=0.0728))
    >>> int(np.argmax(c.separation)), bool(c.stable[0]), bool(c.stable[-1])
    (100, True, False)
    """
    one_of("limit", limit, ("stability", "fold"))
    count = whole_number("points", points, 5)
    check_pair(pair)
    control = control_of(suction, volume, humidity, liquid)
    _refuse_drained_planes(pair, control, humidity)
    if humidity is not None:
        warn_kelvin(liquid.surface_tension / control.value, 0.0)
    if pair.shape is not None:
        return curve_by_shape(pair, control, liquid, count, limit)
    problem = reduce(pair, control, liquid, None)
    return trace(problem, count, limit)


def _is_approximate(method: str, pair: Pair) -> bool:
    """Whether a method is a table, the data base or a law of the registry; any other but exact is refused."""
    if method == "exact":
        return False
    one_of("method", method, ("exact", *_BRIDGES, *laws))
    if method != "exact":
        refuse_planes(pair, f"method {method!r} does not know")
    return method != "exact"


def _refuse_filling_angle(half_filling_angle: object, pair: Pair) -> None:
    if half_filling_angle is not None:
        raise ValueError(f"half_filling_angle: means nothing beside {pair.shape}; give a separation")


def _refuse_drained_planes(pair: Pair, control: Control, humidity: ArrayLike | None) -> None:
    if control.name == "suction" and pair.shape is None:
        refuse_drained_planes(pair, "suction" if humidity is None else "humidity")


def _judge_curvature(control: Control, humidity: ArrayLike | None, liquid: Liquid, answer: Bridge) -> None:
    """Warn where the Kelvin equation is doubtful."""
    if humidity is not None:
        warn_kelvin(liquid.surface_tension / np.where(answer.exists, control.value, np.nan), 0.0)


def _judge_humidity(
    pair: Pair, separation: ArrayLike, control: Control, liquid: Liquid, branch: Asked, answer: Bridge
) -> None:
    """Warn where the Kelvin equation is doubtful or 0.1 % RH moves the force by more than a tenth."""
    humidity = np.asarray(humidity_from_suction(control.value, liquid))
    change = np.zeros(np.shape(answer.force))
    for shift in (-HUMIDITY_UNCERTAINTY, HUMIDITY_UNCERTAINTY):
        shifted = np.clip(humidity + shift, 1e-9, 1.0 - 1e-12)
        other = Control("suction", np.asarray(suction_from_humidity(shifted, liquid)))
        moved = solve(reduce(pair, other, liquid, separation), branch).force
        with np.errstate(invalid="ignore", divide="ignore"):
            relative = np.where(np.asarray(answer.exists), moved / np.asarray(answer.force) - 1.0, 0.0)
        change = np.maximum(change, np.abs(relative))
    radius = liquid.surface_tension / np.where(answer.exists, control.value, np.nan)
    warn_kelvin(radius, change)
