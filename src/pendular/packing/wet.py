"""A heap asked: its water and its stress at a suction, a humidity, or with a given amount of liquid."""

import math
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ask.face import rupture
from ..ask.liquid import Liquid, suction_from_humidity
from ..ask.pair import Pair
from ..ground.check import in_range, one_of, scalar
from ..ground.warn import warn
from .amount import equilibrium_of
from .answers import Answers, answers_at, geometry_of, uses_table
from .heap import Packing, PackingWarning
from .history import pairs_at, solid_volume_at, step_at
from .neighbours import Neighbours
from .precision import centre_noise
from .setting import Setting, setting_of
from .shape import AREA
from .solids import pore_volume_of
from .state import Book, State, standing_of
from .undrained import RULES, Rule, undrained_of
from .wetted import TableError, Wet, bridges_of

__all__ = ["wet", "wetted_of"]

Floats = NDArray[np.float64]
Path = Literal["drying", "wetting"]

_AMOUNTS = ("saturation", "water_content", "mass_ratio", "mass_fraction", "liquid_volume")
_CONTROLS = ("suction", "humidity", *_AMOUNTS, "volume")
NOT_CHECKED = TableError(0, math.nan, math.nan, math.nan, math.nan)
_MANY = 100  # grains of which the digits are looked at; a few may be placed by hand
_SAMPLE = 400  # bridges on which the error of a table is found


class Outcome(NamedTuple):
    """Pairs that hold a bridge, and the liquid."""

    pairs: Neighbours
    answers: Answers
    suction: float
    supplied: float
    released: float
    unheld: float


def wet(
    heap: Packing,
    contact_angle: ArrayLike,
    *,
    suction: float | None = None,
    humidity: float | None = None,
    saturation: float | None = None,
    water_content: float | None = None,
    mass_ratio: float | None = None,
    mass_fraction: float | None = None,
    liquid_volume: float | None = None,
    volume: float | None = None,
    liquid: Liquid,
    path: Path | State | Wet = "drying",
    start: State | Wet | None = None,
    formation_distance: float = 0.0,
    condensation: bool = True,
    rule: Rule = "shared",
    grain_density: float | None = None,
    method: Literal["auto", "exact", "table"] = "auto",
) -> Wet:
    r"""Wet a heap of grains: which pairs hold a bridge, how much water, and what stress they carry.

    .. math:: S_r = \frac{\sum_b V_b}{V_p}, \qquad
              \boldsymbol\sigma = \frac1V \sum_b F_b l_b\, \mathbf n_b \otimes \mathbf n_b

    A bridge forms where bodies touch, and condenses where it is the lower state, Ω(D) ≤ 0. It breaks at its own rupture
    distance.

    Parameters
    ----------
    heap : Packing
        The grains.
    contact_angle : float or array_like, (grains + walls,)
        Through the liquid, on all bodies or on each grain and then each wall, [rad].
    suction, humidity : float, optional
        Common to all bridges: Δp > 0, [Pa], or relative humidity in (0, 1). Exactly one control is given.
    saturation, water_content, mass_ratio, mass_fraction, liquid_volume : float, optional
        All liquid of the heap, that finds a common suction: over the pores, over the cell (volumetric), over the mass
        of the grains (gravimetric), over the mass of grains and liquid, or in [m³].
    volume : float, optional
        Undrained: liquid of each bridge that forms, [m³]; those of ``start`` keep theirs. 0 lets none form.
    liquid : Liquid
        Surface tension; density for masses, and more for humidity.
    path : {"drying", "wetting"}
        Without ``start``: the heap was wet, and all pairs hold a bridge up to its rupture; or it was dry.
    start : State or Wet, optional
        A state to go on from, of the same grains, which may have moved; it may also be given as ``path``.
    formation_distance : float
        Largest gap at which a bridge forms at once: twice the thickness of a film, [m].
    condensation : bool
        Whether new bridges also condense.
    rule : {"shared", "lost"}
        Undrained: the liquid of a broken bridge goes to the other bridges of its two grains, half to each grain and
        evenly there, or is lost.
    grain_density : float, optional
        ρ_s, [kg/m³], for masses.
    method : {"auto", "exact", "table"}
        Exactly, or from tables of exact bridges, which ``"auto"`` takes for more than 20 000 pairs;
        bridges that a table does not hold to its tolerance are exact all the same.

    Returns
    -------
    Wet
        Water, stress, meetings, the bridges one by one, and the book of the liquid.

    Raises
    ------
    ValueError
        For bad input, grains in one place or inside another, a cell smaller than twice the reach of a bridge, no pores.

    Warns
    -----
    PackingWarning
        Where grains overlap by more than the rupture distance, or the digits of their centres tell gaps no better: such
        noise opens contacts.

    Notes
    -----
    **Validity.** No gravity, no roughness; each bridge as if it were alone. Where two meet on a grain
    or on a wall, ``meetings`` tells so and all numbers are those of overlapping bridges. Grains that overlap count as
    touching. Bodies touch up to 1e-9 of the smaller radius, the rounding of positions.

    A given amount is distributed in steps: a bridge that breaks leaves its liquid to the others at a lower suction. The
    least suction tried is 0.01 γ/R with the largest grain; what bridges do not hold there is ``unheld``.

    Examples
    --------
    >>> import pendular as pl
    >>> heap = pl.Packing([(0, 0, 0)], 1e-4, cell=(2e-4, 2e-4, 2e-4)).repeated((3, 3, 3))
    >>> w = pl.wet(heap, 0.35, suction=20e3, liquid=pl.Liquid(surface_tension=0.0728))
    >>> print(w)
    81 bridges, suction 20000 Pa, saturation 0.00283453, suction stress 968.112 Pa
    """
    setting = setting_of(heap, contact_angle, liquid, formation_distance, condensation, method)
    one_of("rule", rule, RULES)
    density = None if grain_density is None else _positive("grain_density", grain_density, "kg/m**3")
    before = _start_of(setting, path, start)
    given = dict(
        zip(
            _CONTROLS,
            (suction, humidity, saturation, water_content, mass_ratio, mass_fraction, liquid_volume, volume),
            strict=True,
        )
    )
    name, value = _control_of(given)
    if name == "volume":
        outcome = _undrained(setting, value, before, rule)
    elif name in _AMOUNTS:
        amount = _amount_of(setting, name, value, density)
        outcome = _equilibrium(setting, amount, before)
    else:
        outcome = _drained(setting, _suction_of(name, value, liquid), before)
    return wetted_of(setting, outcome, before, density)


def wetted_of(
    setting: Setting, outcome: Outcome, before: State | bool, density: float | None, is_checked: bool = True
) -> Wet:
    """The answer, from the pairs that hold a bridge."""
    solid_volume = solid_volume_at(setting.heap)
    pore_volume_of(setting.heap, solid_volume)
    bridges = bridges_of(setting, outcome.pairs, outcome.answers)
    had = before.liquid_volume if isinstance(before, State) else 0.0
    book = Book(had, outcome.supplied, float(np.sum(bridges.volume)), outcome.released, outcome.unheld)
    return Wet(
        setting.heap,
        bridges,
        book,
        outcome.suction,
        solid_volume,
        density,
        _table_error(setting, outcome) if is_checked else NOT_CHECKED,
        setting,
    )


def _drained(setting: Setting, suction: float, before: State | bool) -> Outcome:
    """All bridges at one suction."""
    pairs = pairs_at(setting, "suction", suction)
    released, liquid = 0.0, 0.0
    if isinstance(before, State):
        standing = standing_of(before, pairs)
        had = standing.has
        step = step_at(setting, pairs, suction, had)
        broken = standing.bridge[had & ~step.members]
        released = float(np.sum(before.volume[broken]) + np.sum(before.volume[standing.gone]))
        liquid = before.liquid_volume
    else:
        step = step_at(setting, pairs, suction, before)
    _tell_noise(setting, pairs, suction)
    kept, answers = pairs.taken(step.members), step.answers.taken(step.members)
    held = float(np.sum(answers.volume))
    unheld = before.unheld if isinstance(before, State) else 0.0
    return Outcome(kept, answers, suction, held + released + unheld - liquid, released, unheld)


def _equilibrium(setting: Setting, amount: float, before: State | bool) -> Outcome:
    """A given amount of liquid."""
    found = equilibrium_of(setting, amount, before)
    liquid = before.liquid_volume if isinstance(before, State) else 0.0
    if math.isfinite(found.suction):
        _tell_noise(setting, found.pairs, found.suction)
    kept, answers = found.pairs.taken(found.step.members), found.step.answers.taken(found.step.members)
    return Outcome(kept, answers, found.suction, amount - liquid, 0.0, found.unheld)


def _undrained(setting: Setting, volume: float, before: State | bool, rule: Rule) -> Outcome:
    """Each bridge with its own liquid."""
    if volume == 0.0 and not isinstance(before, State):
        raise ValueError("volume: 0.0 m^3 is not > 0 without a state to go on from")
    found = undrained_of(setting, volume, before, rule)
    return Outcome(found.pairs, found.answers, math.nan, found.supplied, found.released, found.unheld)


def _start_of(setting: Setting, path: Any, start: Any) -> State | bool:
    """State to go on from, or whether all pairs hold a bridge at first."""
    if isinstance(path, (State, Wet)):
        if start is not None:
            raise ValueError("start: given together with a state as path")
        path, start = "drying", path
    one_of("path", path, ("drying", "wetting"))
    if start is None:
        return bool(path == "drying")
    state = start.state if isinstance(start, Wet) else start
    if not isinstance(state, State):
        raise ValueError(f"start: {start!r} is not a state of a heap; take a Wet, or load_state")
    bodies = setting.heap.count + len(setting.heap.walls)
    if state.bodies != bodies:
        raise ValueError(f"start: its state is of {state.bodies} grains and walls, the heap has {bodies}")
    return state


def _control_of(given: dict[str, float | None]) -> tuple[str, float]:
    """The one control that is given."""
    named = [name for name, value in given.items() if value is not None]
    if len(named) != 1:
        raise ValueError(f"control: {' and '.join(named) or 'none'} given; exactly one of {', '.join(given)} is needed")
    name = named[0]
    unit = {"suction": "Pa", "liquid_volume": "m**3", "volume": "m**3"}.get(name, "")
    value = scalar(name, given[name], unit)
    high, brackets = {"suction": (math.inf, "(]"), "humidity": (1.0, "()"), "mass_fraction": (1.0, "[)")}.get(
        name, (math.inf, "[]")
    )
    in_range(name, value, 0.0, high, brackets=brackets, unit=unit.replace("**", "^"))
    return name, value


def _suction_of(name: str, value: float, liquid: Liquid) -> float:
    return float(suction_from_humidity(value, liquid)) if name == "humidity" else value


def _amount_of(setting: Setting, name: str, value: float, density: float | None) -> float:
    """Liquid, [m³]."""
    if name == "liquid_volume":
        return value
    if name == "water_content":
        return value * setting.heap.volume
    solid = solid_volume_at(setting.heap)
    if name == "saturation":
        return value * pore_volume_of(setting.heap, solid)
    if density is None or setting.liquid.density is None:
        raise ValueError(f"{name}: needs grain_density and a liquid with a density")
    ratio = value / (1.0 - value) if name == "mass_fraction" else value
    return ratio * density * solid / setting.liquid.density


def _positive(name: str, value: object, unit: str) -> float:
    return in_range(name, scalar(name, value, unit), 0.0, brackets="(]", unit=unit.replace("**", "^"))


def _tell_noise(setting: Setting, pairs: Neighbours, suction: float) -> None:
    """Warn where grains overlap by more than a bridge spans, or the digits of their centres tell no such gap."""
    overlap = max(0.0, -float(pairs.gap.min(initial=0.0)))
    cut = 2.0 * centre_noise(setting.heap.positions) if setting.heap.count >= _MANY else 0.0
    if max(overlap, cut) <= setting.rounding:
        return
    bodies = pairs.pairs[np.argmin(pairs.gap)] if pairs.gap.size else np.zeros(2, np.int32)
    radii, angles = setting.radii[bodies], setting.angles[setting.kind[bodies]]
    pair = Pair((radii[0], radii[1]), (angles[0], angles[1]))
    spanned = float(np.nan_to_num(rupture(pair, suction=suction, liquid=setting.liquid).separation))
    if overlap > spanned:
        warn(
            f"positions: grains overlap by up to {overlap:.3g} m, more than a bridge spans at "
            f"{suction:.6g} Pa, {spanned:.3g} m; with noise of that size gaps look too wide and the stress is too low",
            PackingWarning,
        )
    elif cut > spanned:
        warn(
            f"positions: their digits tell gaps to {cut:.3g} m, no better than a bridge spans at {suction:.6g} Pa, "
            f"{spanned:.3g} m; contacts look open and the stress is too low",
            PackingWarning,
        )


def _table_error(setting: Setting, outcome: Outcome) -> TableError:
    """Compare some answers from a table with the exact ones."""
    rows = len(outcome.answers.force)
    if not rows or not uses_table(setting, rows):
        return TableError(0, 0.0, 0.0, 0.0, 0.0)
    chosen = np.unique(np.linspace(0, rows - 1, _SAMPLE).astype(np.int64))
    some, near = outcome.answers.taken(chosen), outcome.pairs.taken(chosen)
    held = some.suction if some.control == "suction" else some.volume
    exact = answers_at(setting._replace(method="exact"), near, some.control, held)

    def worst(found: Floats, true: Floats, all_of: Floats) -> float:
        return float(np.nanmax(np.abs(found - true)) / np.max(np.abs(all_of)))

    shape, true_shape = geometry_of(setting, near, some), geometry_of(setting, near, exact)
    whole = outcome.answers
    return TableError(
        len(chosen),
        worst(some.force, exact.force, whole.force),
        worst(some.volume, exact.volume, whole.volume),
        worst(shape[:, AREA], true_shape[:, AREA], shape[:, AREA]),
        worst(some.potential, exact.potential, whole.potential),
    )
