"""A public question reduced to numbers, answered by the exact solver, and scaled back to SI units.

Lengths are divided by the smaller radius and γ is 1: each row of a problem is (D, H or V, k1, θ1, k2, θ2).
"""

from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._check import broadcast, in_range, instance, plain, quantity
from ._jit import in_chunks
from ._warn import warn
from .exact import arrays
from .exact.energy import grand_potential, surface_energy
from .exact.equilibrium import State
from .exact.middle import CURVATURE, VOLUME
from .exact.states import FAILED, FOUND
from .liquid import Liquid, suction_from_humidity
from .pair import Pair
from .result import FIELDS, Bridge

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Asked = Literal["stable", "unstable", "fold", "stability"]

# Bridges that one thread takes at a time: some milliseconds, against which the start of a thread is nothing.
_SUCTION_CHUNK, _PATH_CHUNK = 4096, 16
_PER_SOLID = ("contact_radius", "half_filling_angle", "wetted_area", "capillary_tensor")
_DEEPEST_OVERLAP = 0.5  # over the smaller radius

_CODES: dict[Asked, int] = {
    "stable": arrays.STABLE,
    "unstable": arrays.UNSTABLE,
    "fold": arrays.AT_FOLD,
    "stability": arrays.AT_INSTABILITY,
}


class ConvergenceWarning(RuntimeWarning):
    """The solver did not find, or exclude, some of the bridges; all their fields are NaN."""


class Control(NamedTuple):
    """The quantity that is held constant; humidity has become a suction."""

    name: Literal["suction", "volume"]
    value: Floats


class Problem(NamedTuple):
    """A public question, reduced: rows of (D, H or V, k1, θ1, k2, θ2) in units of the smaller radius and of γ."""

    rows: Floats
    held: int
    is_path: Bools  # not answered by the one equation of suction control
    separation: Floats  # as asked
    length: Floats  # unit of length, one a row
    surface_tension: float
    shape: tuple[int, ...]


def control_of(
    suction: ArrayLike | None, volume: ArrayLike | None, humidity: ArrayLike | None, liquid: Liquid
) -> Control:
    """Return the one control that was given; humidity becomes a suction."""
    given = [
        name for name, value in (("suction", suction), ("volume", volume), ("humidity", humidity)) if value is not None
    ]
    if len(given) != 1:
        raise ValueError(
            f"control: {' and '.join(given) or 'none'} given; exactly one of suction, volume, humidity is needed"
        )
    instance("liquid", liquid, Liquid)
    if humidity is not None:
        return Control("suction", np.asarray(suction_from_humidity(humidity, liquid)))
    if volume is not None:
        return Control("volume", in_range("volume", quantity("volume", volume, "m**3"), 0.0, brackets="()", unit="m^3"))
    return Control("suction", quantity("suction", suction, "Pa"))


def reduce(pair: Pair, control: Control, liquid: Liquid, separation: ArrayLike) -> Problem:
    """Check what depends on several arguments, broadcast, and divide by the smaller radius."""
    instance("pair", pair, Pair)
    gap = quantity("separation", separation, "m")
    (radius1, radius2), (angle1, angle2) = pair.radii, pair.contact_angles
    named = {"separation": gap, control.name: control.value, "radius[0]": radius1, "radius[1]": radius2}
    named |= {"contact_angle[0]": angle1, "contact_angle[1]": angle2}
    arrays = broadcast(**named)
    gap, value, radius1, radius2, angle1, angle2 = (np.ravel(array) for array in arrays)
    length = np.minimum(radius1, radius2)
    _refuse_deep_overlap(arrays[0], length.reshape(arrays[0].shape))
    if control.name == "volume":
        _refuse_engulfing(value, gap, (radius1, radius2), (angle1, angle2))
        held, reduced = VOLUME, value / length**3
        is_path = np.ones(value.shape, bool)
    else:
        held, reduced = CURVATURE, value * length / liquid.surface_tension
        is_path = reduced < 0.0
    rows = np.column_stack([gap / length, reduced, length / radius1, angle1, length / radius2, angle2])
    return Problem(rows, held, is_path, arrays[0], length, liquid.surface_tension, arrays[0].shape)


def _refuse_deep_overlap(separation: Floats, smaller_radius: Floats) -> None:
    """Refuse an overlap of half the smaller radius or more, which is no contact of grains."""
    too_deep = np.argwhere(separation <= -_DEEPEST_OVERLAP * smaller_radius)
    if len(too_deep):  # one row of no indices for a single number
        index = tuple(too_deep[0])
        place = str(list(map(int, index))) if index else ""
        raise ValueError(
            f"separation{place}: {separation[index]} m is not > {-_DEEPEST_OVERLAP * smaller_radius[index]:.6g}; "
            f"an overlap may reach half the smaller radius"
        )


def _refuse_engulfing(volume: Floats, gap: Floats, radii: tuple[Floats, Floats], angles: tuple[Floats, Floats]) -> None:
    """Refuse a volume that encloses the solids: a drop through their far poles, less the spheres."""
    radius1, radius2 = radii
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        drop = radius1 + radius2 + 0.5 * gap
        between_spheres = 4.0 / 3.0 * np.pi * (drop**3 - radius1**3 - radius2**3)
        sphere = np.minimum(radius1, radius2)
        theta = np.where(np.isinf(radius1), angles[0], angles[1])
        height = 2.0 * sphere + gap  # of a cap on the plane that just covers the sphere
        cap = np.pi * height**3 * (1.0 / (1.0 - np.cos(theta)) - 1.0 / 3.0)
        on_plane = cap - 4.0 / 3.0 * np.pi * sphere**3
    largest = np.where(np.isinf(np.maximum(radius1, radius2)), on_plane, between_spheres)
    too_much = np.flatnonzero(volume >= largest)
    if too_much.size:
        i = too_much[0]
        raise ValueError(
            f"volume: {volume[i]:.6g} m^3 is not in (0, {largest[i]:.6g}): a drop of that size encloses the solids"
        )


def solve(problem: Problem, asked: Asked) -> Bridge:
    """Answer all rows, each by the solver that suits it."""
    code = _CODES[asked]
    count = len(problem.rows)
    states = np.empty((count, len(State._fields)))
    statuses = np.empty(count, np.int8)
    for is_path in (False, True):
        chosen = problem.is_path == is_path
        rows = np.ascontiguousarray(problem.rows[chosen])
        if not len(rows):
            continue
        found, status = np.empty((len(rows), states.shape[1])), np.empty(len(rows), np.int8)
        if is_path:
            in_chunks(arrays.path_range, len(rows), _PATH_CHUNK, code, problem.held, rows, found, status)
        else:
            in_chunks(arrays.suction_range, len(rows), _SUCTION_CHUNK, code, rows, found, status)
        states[chosen], statuses[chosen] = found, status
    return restore(problem, states, statuses, ())


def restore(problem: Problem, states: Floats, statuses: NDArray[np.int8], extra: tuple[int, ...]) -> Bridge:
    """Turn reduced states into a bridge in SI units, of the shape of the question and the extra axes."""
    shape = problem.shape + extra
    gamma = problem.surface_tension
    unit = np.broadcast_to(problem.length.reshape(-1, *(1,) * len(extra)), statuses.shape).reshape(shape)
    rows = problem.rows.reshape(problem.shape + (1,) * len(extra) + (6,))
    theta = np.broadcast_to(rows[..., (3, 5)], (*shape, 2))
    with np.errstate(divide="ignore"):
        radii = np.broadcast_to(1.0 / rows[..., (2, 4)], (*shape, 2)) * unit[..., None]
    state = dict(zip(State._fields, np.moveaxis(states.reshape(*shape, -1), -1, 0), strict=True))
    exists = np.equal(statuses, FOUND).reshape(shape)
    has_failed = np.equal(statuses, FAILED).reshape(shape)
    failed = int(np.count_nonzero(has_failed))
    if failed:
        warn(f"the solver failed for {failed} of {exists.size} bridges", ConvergenceWarning)

    def pair_of(first: Floats, second: Floats) -> Floats:
        return np.stack([first, second], axis=-1)

    wetted = pair_of(state["wetted_area1"], state["wetted_area2"])
    energy = surface_energy(state["area"], wetted, theta)
    force = np.where(exists, 2.0 * np.pi * gamma * unit * state["force"], 0.0)
    force[has_failed] = np.nan
    values: dict[str, Any] = {
        "separation": state["separation"] * unit,
        "suction": gamma * state["curvature"] / unit,
        "volume": state["volume"] * unit**3,
        "force": force,
        "exists": exists,
        "stable": state["stable"] == 1.0,
        "neck_radius": state["neck_radius"] * unit,
        "neck_inside": state["neck_inside"] == 1.0,
        "liquid_gas_area": state["area"] * unit**2,
        "surface_energy": gamma * energy * unit**2,
        "grand_potential": gamma * grand_potential(energy, state["curvature"], state["volume"]) * unit**2,
        "stiffness": 2.0 * np.pi * gamma * state["stiffness"],
    }
    return Bridge(
        **{name: plain(value) for name, value in values.items()},
        contact_radius=pair_of(state["radius1"], state["radius2"]) * unit[..., None],
        half_filling_angle=pair_of(state["filling1"], state["filling2"]),
        wetted_area=wetted * unit[..., None] ** 2,
        capillary_tensor=pair_of(state["tensor"], state["area"] - 2.0 * state["tensor"]) * unit[..., None] ** 2,
        _meridian=np.stack(
            [state["middle_radius"] * unit, state["middle_slope"], state["half_length"] * unit], axis=-1
        ),
        _solid_radius=radii,
        _surface_tension=gamma,
    )


def control_name(problem: Problem) -> Literal["suction", "volume"]:
    """Name of the quantity that a problem holds."""
    return "volume" if problem.held == VOLUME else "suction"


def derjaguin_radius(problem: Problem) -> Floats:
    """R̄ = 2/(1/R1 + 1/R2), [m]; the rows hold the curvatures of the solids over that of the smaller one."""
    curvatures: Floats = problem.rows[:, 2] + problem.rows[:, 4]
    return 2.0 * problem.length / curvatures


def control_star(problem: Problem) -> Floats:
    """H R̄ or V/R̄³, one a row: what laws and data base are asked with."""
    scale = derjaguin_radius(problem) / problem.length
    held: Floats = problem.rows[:, 1]
    return held / scale**3 if control_name(problem) == "volume" else held * scale


def control_si(problem: Problem) -> Floats:
    """Volume, [m³], or suction, [Pa], one a row."""
    held: Floats = problem.rows[:, 1]
    if control_name(problem) == "volume":
        return held * problem.length**3
    return problem.surface_tension * held / problem.length


def partial_bridge(problem: Problem, separation: Floats, force_star: Any, exists: Bools) -> Bridge:
    """Bridge in SI units with the few fields that a law or a table knows: force and separation at one control."""
    shape, gamma = problem.shape, problem.surface_tension
    known = exists & ~np.isnan(np.asarray(separation))
    fields: dict[str, Any] = {
        "separation": np.where(known, separation, np.nan),
        control_name(problem): np.where(known, control_si(problem), np.nan),
        "force": 2.0 * np.pi * gamma * derjaguin_radius(problem) * np.asarray(force_star),
        "exists": known,
        "stable": known,
    }
    empty = np.full(shape, np.nan)
    answer: dict[str, Any] = {field: plain(empty) for field, _, _ in FIELDS}
    answer |= {field: np.full((*shape, 2), np.nan) for field in _PER_SOLID}
    answer |= {field: plain(np.reshape(value, shape)) for field, value in fields.items()}
    answer["neck_inside"] = plain(np.zeros(shape, bool))
    return Bridge(
        **answer,
        _meridian=np.full((*shape, 3), np.nan),
        _solid_radius=np.full((*shape, 2), np.nan),
        _surface_tension=gamma,
    )
