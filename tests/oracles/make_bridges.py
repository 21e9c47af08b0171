"""Draw random bridges over the whole domain and write them, worked out exactly, to tests/data/oracle_bridges.json.

    cd tests && python -m oracles.make_bridges [--output FILE]

A bridge is drawn by its suction and one contact circle, so that nothing has to be solved for: gap, volume, force and
all else follow from it with the digits of `young_laplace.EXACT`. Which branch it lies on is decided in double
precision. Under suction control the gap is a function of the contact circle; the thick side of its maximum is stable.
Under volume control the bridge of zero gap is followed from a tiny volume to the wanted one, then at fixed volume up to
the first fold of the gap; only bridges on that stretch are taken.
"""

import argparse
import itertools
import json
import math
import time
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from oracles.young_laplace import (
    DOUBLE,
    EXACT,
    Bridge,
    Gradient,
    Solid,
    State,
    antisymmetric_mode_is_stable,
    arc_integrals,
    closure,
    connect,
    cylinder,
    extrema,
    force_slopes,
    gradient,
    point,
    state,
)

SEED = 20240607
DIGITS = 20
OUTPUT = Path(__file__).parents[1] / "data" / "oracle_bridges.json"
DEEPEST_OVERLAP = -0.05

Solids = tuple[Solid, Solid]


class NotFollowed(Exception):
    """A draw without the bridge that was asked for; it is repeated."""


# -- draws ----------------------------------------------------------------------------------------------------------


def draw_solids(rng, widest: float, radii=("equal", "near", "far", "plane")) -> Solids:
    """Sphere of radius 1 and another solid; half of the pairs have equal angles, up to `widest` degrees."""
    radius = {
        "equal": 1.0,
        "near": float(rng.uniform(1, 10)),
        "far": float(10 ** rng.uniform(0, 4)),
        "plane": math.inf,
    }[rng.choice(radii)]
    angles = np.radians(np.where(rng.random(2) < 0.15, 0.0, rng.uniform(0, widest, 2))).tolist()
    return Solid(1.0, angles[0]), Solid(radius, angles[rng.integers(2)])


def draw_obtuse(rng) -> Solids:
    """One solid that the liquid wets, another that it does not, with a sum of cosines that is still positive."""
    acute = rng.uniform(0, 60)
    angles = np.radians(rng.permutation([acute, rng.uniform(90, min(130, 175 - acute))])).tolist()
    return Solid(1.0, angles[0]), Solid(draw_solids(rng, 0)[1].radius, angles[1])


def draw_on_unwetted_plane(rng) -> Solids:
    """A wetted sphere above a plane that the liquid does not wet."""
    return Solid(1.0, math.radians(rng.uniform(0, 60))), Solid(math.inf, math.radians(rng.uniform(90, 150)))


def draw_column(rng) -> tuple[Solids, float]:
    """Equal spheres and the volume of a cylinder between them."""
    solid = Solid(1.0, math.radians(rng.uniform(30, 85)))
    length = 2 * (1 - math.sin(solid.angle)) + rng.uniform(0, 1.5) * math.cos(solid.angle)
    return (solid, solid), state(cylinder(DOUBLE, solid, length)).volume


def mean_radius(solids: Solids) -> float:
    """Radius of the two equal spheres that part at the same rate as the solids do."""
    return 2 / sum(1 / solid.radius for solid in solids)


def log_uniform(rng, low: float, high: float) -> float:
    """Draw between two powers of ten."""
    return float(10 ** rng.uniform(low, high))


# -- fixed suction: the gap against the contact circle --------------------------------------------------------------


def gap_at(ctx, solids: Solids, suction, reach):
    """Gap of the bridge with a given contact circle on solid 1; NaN where there is none."""
    bridge = connect(ctx, solids, suction, reach)
    # With suction the far side of a nodoid runs backwards: such an arc crosses itself.
    return ctx.nan if bridge is None or extrema(bridge)[1] else gap_of(bridge)


def gap_of(bridge: Bridge):
    """Gap alone."""
    return arc_integrals(bridge)[0] - sum(circle.cap_height for circle in bridge.contacts)


class SuctionCurve(NamedTuple):
    """Gap against contact circle at fixed suction: the fold, and a circle far below it on either side."""

    solids: Solids
    suction: float
    thin: float
    fold: float
    thick: float

    def gap(self, reach: float) -> float:
        """Gap in double precision."""
        return gap_at(DOUBLE, self.solids, self.suction, reach)

    def reach(self, gap: float, branch: str) -> float:
        """Contact circle of a given gap on the "stable" (thick) or the "unstable" (thin) side."""
        far = self.thick if branch == "stable" else self.thin
        return brentq(lambda reach: self.gap(reach) - gap, self.fold, far, rtol=1e-14)

    def greatest_gap(self):
        """Gap at the fold, exact: the vertex of a parabola through three neighbours."""
        step = EXACT.mpf(self.fold) * EXACT.mpf("1e-7")
        below, middle, above = (gap_at(EXACT, self.solids, self.suction, self.fold + i * step) for i in (-1, 0, 1))
        return middle + (above - below) ** 2 / (8 * (2 * middle - above - below))


def suction_curve(solids: Solids, suction: float) -> SuctionCurve:
    """Walk from a thin bridge to a deep overlap; the fold is the one maximum of the gap on the way."""
    size = mean_radius(solids)
    deepest = DEEPEST_OVERLAP if suction * size < 1e4 else -10 / suction
    reach = 0.01 * min(1.0, (suction * size) ** (-2 / 3) if suction > 0 else 1.0)
    walk: list[tuple[float, float]] = []
    while reach < math.pi and not (walk and walk[-1][1] < deepest):
        gap = gap_at(DOUBLE, solids, suction, reach)
        if not math.isnan(gap):
            walk.append((reach, gap))
        elif walk:
            break
        reach *= 1.1
    tops = [i for i in range(1, len(walk) - 1) if walk[i - 1][1] < walk[i][1] >= walk[i + 1][1]]
    if len(tops) != 1:
        raise NotFollowed(f"{len(tops)} folds at fixed suction")
    around = walk[tops[0] - 1][0], walk[tops[0] + 1][0]
    fold = minimize_scalar(
        lambda r: -gap_at(DOUBLE, solids, suction, r), bounds=around, options={"xatol": 1e-9 * reach}
    )
    return SuctionCurve(solids, suction, walk[0][0], float(fold.x), walk[-1][0])


def suction_gaps(rng, curve: SuctionCurve) -> Iterator[tuple[float, str]]:
    """Gaps on a curve: near the fold, anywhere below, at or below contact; on some curves a thin bridge too."""
    top = curve.gap(curve.fold)
    if top <= 0:
        yield top + (DEEPEST_OVERLAP - top) * rng.uniform(0.01, 0.9), "stable"
        return
    yield top * (1 - log_uniform(rng, -3, -1)), "stable"
    yield top * rng.uniform(0, 1), "stable"
    shallow = max(DEEPEST_OVERLAP, -top * rng.uniform(0, 1))
    yield rng.choice([0.0, shallow, -log_uniform(rng, -4, -1.31)], p=[0.5, 0.3, 0.2]), "stable"
    if rng.random() < 0.65:
        yield top * (1 - log_uniform(rng, -3, -0.05)), "unstable"


def suction_themes(rng) -> Iterator[Callable[[], tuple[Solids, float]]]:
    """Draws of a pair and a suction, each to be repeated until it has a curve."""

    def drawn(draw: Callable[[], Solids], low: float, high: float):
        def pair_and_suction():
            solids = draw()
            return solids, log_uniform(rng, low, high) / mean_radius(solids)

        return pair_and_suction

    yield from itertools.repeat(drawn(lambda: draw_solids(rng, 85), -6, 12), 55)
    yield from itertools.repeat(drawn(lambda: draw_solids(rng, 85), -1, 4), 24)
    yield from itertools.repeat(lambda: (draw_solids(rng, 85), 0.0), 10)
    yield from itertools.repeat(drawn(lambda: draw_solids(rng, 30, ("far", "plane")), -3, -0.3), 12)
    yield from itertools.repeat(drawn(lambda: draw_obtuse(rng), -2, 6), 14)


def suction_bridges(rng, refusals: Counter) -> Iterator[dict]:
    """Draw, choose and record all bridges under suction control."""
    for draw in suction_themes(rng):
        curve = repeated(refusals, lambda draw=draw: suction_curve(*draw()))
        greatest = curve.greatest_gap()
        for gap, branch in suction_gaps(rng, curve):
            if gap < curve.gap(curve.thick) or (branch == "unstable" and gap < curve.gap(curve.thin)):
                refusals["gap off the curve"] += 1
                continue
            bridge = connect(EXACT, curve.solids, curve.suction, curve.reach(gap, branch))
            yield record(bridge, "suction", branch, greatest)


# -- fixed volume: followed from contact ----------------------------------------------------------------------------


class Station(NamedTuple):
    """A bridge on a branch, its derivatives, the direction of the branch, and the step that led there."""

    bridge: Bridge
    slopes: Gradient
    direction: np.ndarray
    step: float

    def growth(self, name: str) -> float:
        """Rate at which gap or volume grows along the branch."""
        return float(np.dot(getattr(self.slopes, name), self.direction))


def moved(bridge: Bridge, change: np.ndarray) -> Bridge:
    """Change the four coordinates, relative to their size; suction relative to the inverse length."""
    first, suction, length, second = (float(value) for value in change)
    reach = (bridge.reach[0] * (1 + first), bridge.reach[1] * (1 + second))
    if bridge.symmetric:
        reach = (reach[0], reach[0])
    return replace(
        bridge, reach=reach, suction=bridge.suction + suction / bridge.length, length=bridge.length * (1 + length)
    )


def quantity(bridge: Bridge, name: str) -> float:
    """Gap or volume in double precision."""
    axial, revolution, *_ = arc_integrals(bridge)
    if name == "gap":
        return axial - sum(circle.cap_height for circle in bridge.contacts)
    return revolution - sum(circle.cap_volume for circle in bridge.contacts)


def corrected(bridge: Bridge, targets: dict[str, float], direction: np.ndarray | None = None) -> Bridge:
    """Newton's method for closure and the targets; with one target, at right angles to a direction."""
    for _ in range(12):
        slopes = gradient(bridge)
        rows = [*slopes.closure, *(getattr(slopes, name) for name in targets)]
        misses = [*closure(bridge), *(quantity(bridge, name) - value for name, value in targets.items())]
        if direction is not None:
            rows.append(direction)
            misses.append(0.0)
        matrix = np.array(rows, dtype=float)
        scales = np.abs(matrix).max(axis=1)
        change = -np.linalg.solve(matrix / scales[:, None], np.array(misses) / scales)
        size = np.abs(change).max()
        if not size < 0.5:
            raise NotFollowed("Newton left the branch")
        bridge = moved(bridge, change)
        if size < 1e-9:
            return bridge
    raise NotFollowed("Newton did not converge")


def arrive(bridge: Bridge, held: str, towards: np.ndarray | None = None, step: float = 0.0) -> Station:
    """Find the direction in which closure and the held quantity do not change."""
    slopes = gradient(bridge)
    matrix = np.array([*slopes.closure, getattr(slopes, held)], dtype=float)
    direction = np.linalg.svd(matrix / np.abs(matrix).max(axis=1)[:, None])[2][-1]
    if towards is not None and np.dot(direction, towards) < 0:
        direction = -direction
    return Station(bridge, slopes, direction, step)


def stepped(station: Station, held: dict[str, float], step: float) -> Station:
    """Go a distance along a branch."""
    bridge = corrected(moved(station.bridge, step * station.direction), held, station.direction)
    return arrive(bridge, *held, station.direction, step)


def follow(bridge: Bridge, held: str, name: str, end: float) -> list[Station]:
    """Follow a branch at fixed `held` until `name` reaches `end` or turns back; the last station lies beyond."""
    fixed = {held: quantity(bridge, held)}
    sense = math.copysign(1, end - quantity(bridge, name))
    first = arrive(bridge, held)
    if first.growth(name) * sense < 0:
        first = first._replace(direction=-first.direction)
    stations, step = [first], 0.04
    while len(stations) < 500:
        try:
            stations.append(stepped(stations[-1], fixed, step))
        except NotFollowed:
            step /= 2
            if step < 1e-5:
                raise
            continue
        step = min(1.4 * step, 0.15)
        if stations[-1].growth(name) * sense < 0 or (quantity(stations[-1].bridge, name) - end) * sense > 0:
            return stations
    raise NotFollowed("too many steps")


def crossing(a: Station, b: Station, held: str, measure: Callable[[Station], float]) -> Station:
    """Find where a measure vanishes between two neighbouring stations."""
    fixed = {held: quantity(a.bridge, held)}
    return stepped(a, fixed, brentq(lambda h: measure(stepped(a, fixed, h)), 0.0, b.step, xtol=1e-8))


def reaching(stations: list[Station], held: str, name: str, value: float) -> Station:
    """Find the first bridge on a branch at which gap or volume has a value."""
    offsets = [quantity(station.bridge, name) - value for station in stations]
    for i, (before, after) in enumerate(itertools.pairwise(offsets)):
        if before * after <= 0:
            return crossing(*stations[i : i + 2], held, lambda s: quantity(s.bridge, name) - value)
    raise NotFollowed(f"the branch turned before the {name}")


def touching(solids: Solids, volume: float) -> Bridge:
    """Bridge of gap zero: a tiny one from the torus between nearly parallel walls, then followed in volume."""
    size = mean_radius(solids)
    tiny = min(volume, 1e-6 * size**3)
    radius = (2 * size * tiny / math.pi) ** 0.25
    width = radius**2 / size
    half = (math.pi - solids[0].angle - solids[1].angle) / 2
    skew = math.cos((solids[0].angle - solids[1].angle) / 2)
    length = width / (np.sinc(half / math.pi) * skew)
    suction = 2 * half / length - 1 / radius
    guess = Bridge(DOUBLE, solids, (radius, radius if solids[0] == solids[1] else radius * (1 + 1e-9)), suction, length)
    bridge = corrected(guess, {"gap": 0.0, "volume": tiny})
    if tiny < volume:
        bridge = reaching(follow(bridge, "gap", "volume", volume), "gap", "volume", volume).bridge
    return bridge


class VolumeBranch(NamedTuple):
    """Bridges of one volume from contact to the fold, its last station, and down into the overlap, to a depth."""

    solids: Solids
    rising: list[Station]
    sinking: list[Station]
    depth: float

    @property
    def greatest_gap(self) -> float:
        """Gap at the fold."""
        return quantity(self.rising[-1].bridge, "gap")

    def at_gap(self, gap: float) -> Bridge:
        """Bridge of a gap below the fold."""
        if gap == 0:
            return self.rising[0].bridge
        return reaching(self.rising if gap >= 0 else self.sinking, "volume", "gap", gap).bridge

    def at_suction(self, suction: float) -> Bridge | None:
        """First bridge of a suction, if the branch has one."""
        for a, b in itertools.pairwise(self.rising):
            if (a.bridge.suction - suction) * (b.bridge.suction - suction) < 0:
                return crossing(a, b, "volume", lambda s: s.bridge.suction - suction).bridge
        return None

    def cylinder(self) -> Bridge | None:
        """Cylinder between equal spheres, if the branch has one, in exact arithmetic."""
        for a, b in itertools.pairwise(self.rising):
            if a.bridge.symmetric and a.bridge.contacts[0].slope * b.bridge.contacts[0].slope < 0:
                found = crossing(a, b, "volume", lambda s: s.bridge.contacts[0].slope).bridge
                return cylinder(EXACT, self.solids[0], found.length)
        return None


def volume_branch(rng, solids: Solids, volume: float) -> VolumeBranch:
    """Follow the branch of one volume in both directions from contact."""
    start = touching(solids, volume)
    rising = follow(start, "volume", "gap", math.inf)
    rising[-1] = crossing(*rising[-2:], "volume", lambda s: s.growth("gap"))
    # The lens that two overlapping solids share counts as negative liquid: keep the overlap thinner than the bridge.
    depth = min(0.02, 0.4 * start.reach[0] ** 2 / mean_radius(solids)) * rng.uniform(0.05, 1)
    return VolumeBranch(solids, rising, follow(start, "volume", "gap", -depth), depth)


def volume_picks(rng, branch: VolumeBranch) -> Iterator[Callable[[], Bridge | None]]:
    """Bridges of one volume: overlap, contact or between, near the fold; at no or hardly any suction; the cylinder."""
    top = branch.greatest_gap
    low = -branch.depth * rng.choice([0.0, rng.uniform(0, 1)])
    for gap in (low, top * rng.uniform(0, 1), top * (1 - log_uniform(rng, -3, -0.5))):
        yield lambda gap=gap: exact(branch.at_gap(gap))
    suction = rng.choice([0.0, 1.0, -1.0]) * log_uniform(rng, -9, -3)

    def weightless():
        found = branch.at_suction(suction)
        return found and exact(replace(found, suction=suction))

    yield weightless
    yield branch.cylinder


def exact(bridge: Bridge) -> Bridge:
    """Make a followed bridge exact: same suction and first contact circle, nearest second one."""
    sharp = connect(EXACT, bridge.solids, bridge.suction, bridge.reach[0], bridge.reach[1])
    if sharp is None or not all(
        abs(a / b - 1) < 1e-5 for a, b in zip((*sharp.reach, sharp.length), (*bridge.reach, bridge.length), strict=True)
    ):
        raise NotFollowed("no exact bridge near")
    return sharp


def volume_themes(rng) -> Iterator[Callable[[], tuple[Solids, float]]]:
    """Draws of a pair and a volume, each to be repeated until its branch can be followed."""

    def drawn(draw: Callable[[], Solids], low: float, high: float):
        def pair_and_volume():
            solids = draw()
            return solids, log_uniform(rng, low, high) * mean_radius(solids) ** 3

        return pair_and_volume

    yield from itertools.repeat(drawn(lambda: draw_solids(rng, 85), -12, 0), 36)
    yield from itertools.repeat(drawn(lambda: draw_solids(rng, 60, ("equal", "near")), -4, 0), 14)
    yield from itertools.repeat(drawn(lambda: draw_solids(rng, 150), -8, -0.5), 22)
    yield from itertools.repeat(drawn(lambda: draw_obtuse(rng), -6, 0), 10)
    yield from itertools.repeat(lambda: draw_column(rng), 12)
    yield from itertools.repeat(drawn(lambda: draw_on_unwetted_plane(rng), -6, -0.5), 6)


def volume_bridges(rng, refusals: Counter) -> Iterator[dict]:
    """Draw, choose and record all bridges under volume control."""
    for draw in volume_themes(rng):
        branch = repeated(refusals, lambda draw=draw: volume_branch(rng, *draw()))
        for pick in volume_picks(rng, branch):
            bridge = attempted(refusals, pick)
            if bridge is not None:
                yield record(bridge, "volume", "stable", branch.greatest_gap)


# -- records --------------------------------------------------------------------------------------------------------


def attempted(refusals: Counter, attempt: Callable):
    """Return what an attempt finds, None where it fails; count why."""
    try:
        return attempt()
    except (NotFollowed, ArithmeticError, ValueError, np.linalg.LinAlgError) as refusal:
        refusals[str(refusal)] += 1
        return None


def repeated(refusals: Counter, attempt: Callable):
    """Repeat a draw until it succeeds."""
    while (found := attempted(refusals, attempt)) is None:
        pass
    return found


def has_inflection(bridge: Bridge) -> bool:
    """Whether the meridian bends both ways; H/2 + force/Y^2 is monotonic between extrema, so they and the ends tell."""
    places = [bridge.ctx.zero, *itertools.chain(*extrema(bridge)), bridge.length]
    radii = [abs(point(bridge.ctx, bridge.start, bridge.suction, s)) for s in places]
    bends = [bridge.suction / 2 + bridge.force / radius**2 for radius in radii]
    return not bridge.cylindrical and min(bends) < 0 < max(bends)


def tags(bridge: Bridge, found: State, greatest, conditions) -> list[str]:
    """Name what is special about a bridge."""
    angles = [solid.angle for solid in bridge.solids]
    first, second = bridge.contacts
    features = {
        "equal_solids": bridge.solids[0] == bridge.solids[1],
        "plane": math.isinf(bridge.solids[1].radius),
        "complete_wetting": max(angles) == 0,
        "obtuse": max(angles) > math.pi / 2,
        "catenoid": bridge.suction == 0,
        "nearly_catenoid": 0 < abs(bridge.suction) < 1e-3,
        "cylinder": bridge.cylindrical,
        "pressed": bridge.suction < 0,
        "inflection": has_inflection(bridge),
        "neck_outside": not found.neck_inside and found.force > 0 and not found.bulge_inside and not bridge.cylindrical,
        "bulge": found.bulge_inside,
        "repulsive": found.force < 0,
        "immersed": max(first.filling_angle, second.filling_angle) > math.pi / 2,
        "second_circle": any(on_second_circle(bridge, i) for i in (0, 1)),
        "contact": abs(found.gap) < 1e-12 * bridge.length,
        "overlap": found.gap < -1e-12 * bridge.length,
        "negative_volume": found.volume < 0,
        "near_fold": found.gap > 0.99 * greatest > 0,
        "ill": max(conditions) > 1e4,
    }
    return [name for name, present in features.items() if present]


def on_second_circle(bridge: Bridge, which: int) -> bool:
    """Whether the surface meets this solid twice at its angle, and the bridge takes the larger contact circle."""
    ctx, solid, circle = bridge.ctx, bridge.solids[which], bridge.contacts[which]
    delta = circle.filling_angle
    rise = ctx.sin(2 * delta + ctx.mpf(solid.angle)) + bridge.suction * circle.radius * ctx.cos(delta)
    return bridge.force > 0 and rise < 0 and not bridge.cylindrical


def record(bridge: Bridge, control: str, branch: str, greatest) -> dict:
    """Write one line of the file.

    Lengths are in units of R1, the surface tension is 1, angles are in radians; numbers are decimal strings, R2 is null
    for a plane. `lam` is the force over 2 pi; `Y0` is negative on the outer arc of a nodoid, which has no neck;
    `dlam_dgap` is taken at fixed control, `dlam_dcontrol` at fixed gap; `gap_max` is the fold under the control (of the
    mirror-symmetric bridges, for equal solids). Equal solids with equal angles also say whether the mirror-breaking
    axisymmetric mode at fixed volume is stable.
    """
    found = state(bridge)
    by_gap, by_control = force_slopes(bridge, control)
    held = bridge.suction if control == "suction" else found.volume
    conditions = [abs(by_gap * found.gap / found.force), abs(by_control * held / found.force)]
    numbers = {
        "R1": bridge.solids[0].radius,
        "R2": bridge.solids[1].radius,
        "theta1": bridge.solids[0].angle,
        "theta2": bridge.solids[1].angle,
        "H": bridge.suction,
        "gap": found.gap,
        "V": found.volume,
        "lam": found.force,
        "area": found.area,
        "wetted1": found.wetted_areas[0],
        "wetted2": found.wetted_areas[1],
        "Y1": bridge.contacts[0].radius,
        "Y2": bridge.contacts[1].radius,
        "delta1": bridge.contacts[0].filling_angle,
        "delta2": bridge.contacts[1].filling_angle,
        "Y0": found.neck_radius,
        "E": found.energy,
        "n11": found.n11,
        "n33": found.n33,
        "dlam_dgap": by_gap,
        "dlam_dcontrol": by_control,
    }
    line = {"control": control, "branch": branch} | {name: decimal(value) for name, value in numbers.items()}
    # Under volume control the fold is found in double precision, to about 1e-9.
    line["gap_max"] = decimal(greatest) if control == "suction" else decimal(greatest, 10)
    line["neck_inside"] = found.neck_inside
    if bridge.solids[0] == bridge.solids[1]:
        line["pitchfork_stable"] = bool(antisymmetric_mode_is_stable(bridge))
    return line | {"tags": tags(bridge, found, greatest, conditions)}


def decimal(value, digits: int = DIGITS) -> str | None:
    """Decimal string; None for an infinite radius."""
    return None if value == math.inf else EXACT.nstr(EXACT.mpf(value), digits)


def main() -> None:
    """Write the file; say what is in it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, default=OUTPUT)
    output = parser.parse_args().output
    began = time.perf_counter()
    refusals: Counter = Counter()
    lines = [
        *suction_bridges(np.random.default_rng([SEED, 1]), refusals),
        *volume_bridges(np.random.default_rng([SEED, 2]), refusals),
    ]
    output.write_text("[\n" + ",\n".join(json.dumps(line) for line in lines) + "\n]\n")
    kinds = Counter((line["control"], line["branch"]) for line in lines)
    counts = Counter(tag for line in lines for tag in line["tags"])
    print(f"seed {SEED}, {len(lines)} bridges, {time.perf_counter() - began:.0f} s")
    for title, table in (("bridges", kinds), ("tags", counts), ("draws repeated or dropped", refusals)):
        print(title, *(f"  {name}: {count}" for name, count in table.most_common()), sep="\n")


if __name__ == "__main__":
    main()
