"""Bridges between two spheres on a grid of half-filling angle and neck ratio, and what lies between its points.

The half-filling angle δ of the smaller sphere and the ratio Q = Y0/Yc of the neck to the contact circle on it determine
the surface: suction and force are closed forms of the two, the larger sphere follows from them, and nothing is solved.
The grid is a folded sheet over (H, D) and over (V, D). A line of constant δ meets a suction at most once, and a line of
constant Q a volume while that rises along it. So a curve of equilibria is what it has on such lines: D and λ on an
ordered list of points, with the fold at the largest D and the stable branch after it.

Lengths are in one unit, γ = 1.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..exact.algebra import Four
from ..exact.arc import WIDEST_ETA, Arc, half_from_neck, half_length_of
from ..exact.meridian import measure_arc, place_after, tensor_of, turn_of
from ..ground.compile import kernel
from ..ground.rows import entry
from ..laws.contact_circle import Contact, cap_volume, contact_at, wetted_arc_of, wetted_area

Vector = NDArray[np.float64]
Table = NDArray[np.float64]
Spans = NDArray[np.int64]

_BISECTIONS = 60
_SECTIONS = 40  # each leaves two thirds of the interval: 1e-7 of it in the end, 1e-14 in the value of a maximum
_NEAR_CONTACT = 0.03  # share of the largest separation up to which a volume is better sought on lines of constant angle


class Solids(NamedTuple):
    """Two spheres: curvature k = 1/R and contact angle, each."""

    k1: float
    theta1: float
    k2: float
    theta2: float


class Side(NamedTuple):
    """The half of a bridge between its neck and one sphere."""

    gap: float  # from the plane of the neck to the sphere
    volume: float
    area: float  # liquid-gas
    wetted_area: float


class GridPoint(NamedTuple):
    """A bridge of the grid; all NaN where there is none with its neck between the two contact circles."""

    curvature: float  # H
    force: float  # λ
    gap_small: float  # from the neck to the smaller sphere, Ss
    gap_large: float
    half_separation: float  # S = (Ss + SL)/2, negative where the spheres overlap
    volume_small: float  # Vs
    volume_large: float
    volume: float
    area_small: float  # liquid-gas, on either side of the neck
    area_large: float
    wetted_area_small: float  # liquid-solid
    wetted_area_large: float
    filling_large: float  # half-filling angle of the larger sphere
    surface_energy: float  # A_lg - cos θ A_ls
    grand_potential: float  # E + HV


@kernel
def _no_point() -> GridPoint:
    nan = math.nan
    return GridPoint(nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan)


@kernel
def _side(curvature: float, force: float, contact: Contact) -> Side:
    """Gap, volume and areas between the neck and a sphere: half of an arc with the neck in its middle.

    Its half width is τ = (2/H) tan(Hs/2) = 2 Y sin ψ/(q + 1 + HY cos ψ), with s its length to the contact circle and q
    = 1 + HY0.
    """
    ratio = math.sqrt(1.0 + 2.0 * curvature * force)
    neck = 2.0 * force / (1.0 + ratio)
    width = 2.0 * contact.radius * contact.sin_slope / (ratio + 1.0 + curvature * contact.radius * contact.cos_slope)
    arc = Arc(neck, 0.0, width, curvature * width)
    square = math.pi * width * width
    if abs(arc.eta) < WIDEST_ETA:
        half = half_from_neck(arc)
        length, liquid, area = width * half.length, square * width * half.volume, 2.0 * square * half.area
    else:
        length, liquid, area = _measured(arc)
    return Side(length - contact.sagitta, liquid - cap_volume(contact), area, wetted_area(contact))


@kernel
def _measured(arc: Arc) -> tuple[float, float, float]:
    """Length, volume and area of the second half of an arc with any neck in its middle."""
    length = 0.5 * half_length_of(arc)
    turn = arc.eta / arc.half_width * length
    middle = place_after(complex(arc.radius, 0.0), length, 1.0, turn_of(turn)).zeta
    z = Four(math.log(abs(middle)), math.atan2(middle.imag, middle.real), math.log(length), turn)
    along, liquid = measure_arc(z, True, True)
    across, axial = tensor_of(z)
    return along.value, math.pi * liquid.value, 2.0 * across + axial


@kernel
def force_of(contact: Contact, neck_ratio: float) -> float:
    """λ = Yc Q (1 - Q sin β)/(1 - Q²): its definition with H inserted, without the cancellation at thin necks."""
    spread = (1.0 - neck_ratio) * (1.0 + neck_ratio)
    return contact.radius * neck_ratio * (1.0 - neck_ratio * contact.cos_slope) / spread


@kernel
def grid_point(filling: float, neck_ratio: float, solids: Solids) -> GridPoint:
    r"""Bridge of a given half-filling angle and neck ratio, solid 1 being the smaller sphere.

    .. math:: H = \frac{2 (Y_0 - Y_c \sin\beta)}{Y_c^2 - Y_0^2}, \qquad \lambda = Y_0 + \tfrac12 H Y_0^2, \qquad
              Y_c = R\sin\delta, \quad \beta = \delta + \theta, \quad Y_0 = Q Y_c

    A surface meets the larger sphere in up to two circles. The one of the smaller filling angle is taken, the first on
    the way from the neck; between equal spheres it is the mirror image. The edges are no bridges: at Q = 0 the neck
    has closed, at Q = 1 the suction is infinite.
    """
    small = contact_at(filling / solids.k1, solids.k1, solids.theta1)
    if not (0.0 < neck_ratio < 1.0 and small.sin_slope > 0.0):
        return _no_point()
    spread = (1.0 - neck_ratio) * (1.0 + neck_ratio)
    curvature = 2.0 * (neck_ratio - small.cos_slope) / (small.radius * spread)
    force = force_of(small, neck_ratio)
    if solids.k1 == solids.k2 and solids.theta1 == solids.theta2:
        wetted_arc, large = filling / solids.k1, small
    else:
        wetted_arc = wetted_arc_of(force, curvature, solids.k2, solids.theta2)
        large = contact_at(wetted_arc, solids.k2, solids.theta2)
    if not large.sin_slope > 0.0:
        return _no_point()
    first = _side(curvature, force, small)
    second = first if large == small else _side(curvature, force, large)
    volume = first.volume + second.volume
    energy = (
        first.area
        + second.area
        - math.cos(solids.theta1) * first.wetted_area
        - math.cos(solids.theta2) * second.wetted_area
    )
    return GridPoint(
        curvature,
        force,
        first.gap,
        second.gap,
        0.5 * (first.gap + second.gap),
        first.volume,
        second.volume,
        volume,
        first.area,
        second.area,
        first.wetted_area,
        second.wetted_area,
        solids.k2 * wetted_arc,
        energy,
        energy + curvature * volume,
    )


@entry(plain_cost=math.inf)  # plain Python has other last digits, and the numbers are the same in all runs
def grid_range(
    fillings: Vector, neck_ratios: Vector, solids: Solids, out: NDArray[np.float64], start: int, stop: int
) -> None:
    """Bridges of a grid from start to stop, all of a half-filling angle in turn.

    ``out`` has the fields of :class:`GridPoint`, the angles and the ratios as its axes.
    """
    for number in range(start, stop):
        i, j = number // neck_ratios.size, number % neck_ratios.size
        point = grid_point(fillings[i], neck_ratios[j], solids)
        for field, value in enumerate(point):
            out[field, i, j] = value


class Sheet(NamedTuple):
    """The grid of one pair, ready to be interpolated; on tables the lines come first, then the points along them."""

    k: float  # of the smaller sphere
    theta: float
    fillings: Vector
    neck_ratios: Vector
    # on lines of constant filling angle, along the neck ratio
    separations: Table  # D
    minus_volumes: Table  # -V
    surfaces: Spans  # where there are bridges
    falling: Spans  # where the volume falls
    # on lines of constant neck ratio, along the filling angle
    separations_across: Table
    log_volumes_across: Table
    forces_across: Table
    rising: Spans  # where the volume rises


@kernel
def longest_rises(table: Table, spans: Spans) -> None:
    """First index, and last plus one, of the longest run of increasing values on each line; NaN ends a run."""
    for line in range(table.shape[0]):
        values = table[line]
        start = 0
        spans[line] = 0
        for i in range(1, values.size + 1):
            if i == values.size or not values[i] > values[i - 1]:
                if i - start > max(spans[line, 1] - spans[line, 0], 1):
                    spans[line, 0], spans[line, 1] = start, i
                start = i


@kernel
def _bracket(x: Vector, at: float) -> int:
    """Index i with x[i] <= at <= x[i + 1] among increasing values; -1 if there is none."""
    if x.size < 2 or not x[0] <= at <= x[-1]:
        return -1
    low, high = 0, x.size - 1
    while high - low > 1:
        middle = (low + high) // 2
        if x[middle] <= at:
            low = middle
        else:
            high = middle
    return low


@kernel
def _lagrange(x: Vector, y: Vector, bracket: int, at: float, nodes: int) -> float:
    """Polynomial through the ``nodes`` points about a bracket, one-sided at the ends."""
    first = max(0, min(bracket + 1 - nodes // 2, x.size - nodes))
    last = min(first + nodes, x.size)
    total = 0.0
    for i in range(first, last):
        weight = y[i]
        for k in range(first, last):
            if k != i:
                weight *= (at - x[k]) / (x[i] - x[k])
        total += weight
    return total


@kernel
def suction_on_angles(sheet: Sheet, curvature: float, nodes: int, separations: Vector, forces: Vector) -> None:
    """D and λ where each line of constant filling angle meets the curvature H; NaN where it does not.

    Neck ratio and force are closed forms in H on such a line. The separation is nearly linear in the ratio close to
    Q = 1, where H goes to infinity.
    """
    for i in range(sheet.fillings.size):
        contact = contact_at(sheet.fillings[i] / sheet.k, sheet.k, sheet.theta)
        eta = 0.5 * curvature * contact.radius
        arm = contact.cos_slope + eta  # λ/Yc
        square = 1.0 + 4.0 * eta * arm
        neck_ratio = 2.0 * arm / (1.0 + math.sqrt(square)) if square > 0.0 else math.nan
        span = slice(sheet.surfaces[i, 0], sheet.surfaces[i, 1])
        x = sheet.neck_ratios[span]
        bracket = _bracket(x, neck_ratio)
        separations[i] = forces[i] = math.nan
        if bracket >= 0:
            separations[i] = _lagrange(x, sheet.separations[i, span], bracket, neck_ratio, nodes)
            forces[i] = contact.radius * arm


@kernel
def volume_on_ratios(sheet: Sheet, volume: float, nodes: int, separations: Vector, forces: Vector) -> None:
    """D and λ where each line of constant neck ratio meets the volume V; NaN where it does not."""
    log_volume = math.log(volume)
    for j in range(sheet.neck_ratios.size):
        span = slice(sheet.rising[j, 0], sheet.rising[j, 1])
        x = sheet.log_volumes_across[j, span]
        bracket = _bracket(x, log_volume)
        separations[j] = forces[j] = math.nan
        if bracket >= 0:
            separations[j] = _lagrange(x, sheet.separations_across[j, span], bracket, log_volume, nodes)
            forces[j] = _lagrange(x, sheet.forces_across[j, span], bracket, log_volume, nodes)


@kernel
def volume_on_angles(sheet: Sheet, volume: float, nodes: int, separations: Vector, forces: Vector) -> None:
    """D and λ where each line of constant filling angle meets the volume V with a thick neck; NaN where it does not."""
    for i in range(sheet.fillings.size):
        span = slice(sheet.falling[i, 0], sheet.falling[i, 1])
        x = sheet.minus_volumes[i, span]
        bracket = _bracket(x, -volume)
        separations[i] = forces[i] = math.nan
        if bracket >= 0:
            separations[i] = _lagrange(x, sheet.separations[i, span], bracket, -volume, nodes)
            neck_ratio = _lagrange(x, sheet.neck_ratios[span], bracket, -volume, nodes)
            contact = contact_at(sheet.fillings[i] / sheet.k, sheet.k, sheet.theta)
            forces[i] = force_of(contact, neck_ratio)


@kernel
def _at(values: Vector, position: float, nodes: int) -> float:
    """Polynomial through the ``nodes`` values about a position among evenly spaced values, one-sided at the ends."""
    bracket = min(max(int(position), 0), values.size - 2)
    first = max(0, min(bracket + 1 - nodes // 2, values.size - nodes))
    if nodes == 2 or values.size < 4:
        x = position - bracket
        return (1.0 - x) * values[bracket] + x * values[bracket + 1]
    x = position - first
    return (
        -(x - 1.0) * (x - 2.0) * (x - 3.0) * values[first]
        + 3.0 * x * (x - 2.0) * (x - 3.0) * values[first + 1]
        - 3.0 * x * (x - 1.0) * (x - 3.0) * values[first + 2]
        + x * (x - 1.0) * (x - 2.0) * values[first + 3]
    ) / 6.0


class Branch(NamedTuple):
    """A curve of equilibria at one H or V, thin necks first; evenly spaced in the number of the line."""

    separations: Vector  # D
    forces: Vector  # λ
    top: float  # place of the largest D; NaN if there are less than two lines
    has_fold: bool  # the largest D is inside, not at the edge of the sheet


@kernel
def _branch(separations: Vector, forces: Vector, nodes: int) -> Branch:
    """The last unbroken run of lines, which is the one that comes from contact, and its fold."""
    stop = separations.size
    while stop > 0 and math.isnan(separations[stop - 1]):
        stop -= 1
    start = stop
    while start > 0 and not math.isnan(separations[start - 1]):
        start -= 1
    run = separations[start:stop]
    if run.size < 2:
        return Branch(run, forces[start:stop], math.nan, False)
    largest = np.argmax(run)
    low, high = max(largest - 1.0, 0.0), min(largest + 1.0, run.size - 1.0)
    has_fold = high - low == 2.0
    for _ in range(_SECTIONS):
        third = (high - low) / 3.0
        if _at(run, low + third, nodes) < _at(run, high - third, nodes):
            low += third
        else:
            high -= third
    return Branch(run, forces[start:stop], 0.5 * (low + high), has_fold)


@kernel
def _largest_separation(branch: Branch, nodes: int) -> float:
    return math.nan if math.isnan(branch.top) else _at(branch.separations, branch.top, nodes)


@kernel
def _stable_force(branch: Branch, separation: float, nodes: int) -> float:
    """λ on the stable branch, the lines after the fold; NaN where they do not reach."""
    if not separation <= _largest_separation(branch, nodes):
        return math.nan
    low = branch.top
    for line in range(int(branch.top) + 1, branch.separations.size):
        high = float(line)
        if branch.separations[line] <= separation:
            break
        low = high
    else:
        return math.nan
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        if _at(branch.separations, middle, nodes) > separation:
            low = middle
        else:
            high = middle
    return _at(branch.forces, 0.5 * (low + high), nodes)


@kernel
def interpolate_range(
    sheet: Sheet, is_volume: bool, values: Vector, separations: Vector, nodes: int, forces: Vector, ruptures: Vector
) -> None:
    """Forces on the stable branch and rupture distances for given H or V and D; equal neighbours share their lines.

    At a given volume the lines of constant neck ratio reach over the fold; close to contact they are nearly tangent to
    the curve, which crosses the lines of constant angle there.
    """
    on_angles = np.empty((2, sheet.fillings.size))
    on_ratios = np.empty((2, sheet.neck_ratios.size))
    branch = near_contact = _branch(on_angles[0, :0], on_angles[1, :0], nodes)
    nearer = math.nan
    for i in range(values.size):
        if i == 0 or values[i] != values[i - 1]:
            if is_volume:
                volume_on_angles(sheet, values[i], nodes, on_angles[0], on_angles[1])
                volume_on_ratios(sheet, values[i], nodes, on_ratios[0], on_ratios[1])
                near_contact = _branch(on_angles[0], on_angles[1], nodes)
                branch = _branch(on_ratios[0], on_ratios[1], nodes)
                nearer = _NEAR_CONTACT * _largest_separation(branch, nodes)
            else:
                suction_on_angles(sheet, values[i], nodes, on_angles[0], on_angles[1])
                branch = _branch(on_angles[0], on_angles[1], nodes)
        ruptures[i] = _largest_separation(branch, nodes) if branch.has_fold else math.nan
        if separations[i] > ruptures[i]:
            forces[i] = 0.0
        else:
            forces[i] = _stable_force(near_contact if separations[i] < nearer else branch, separations[i], nodes)
