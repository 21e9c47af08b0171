"""What every bridge obeys, whatever its solids: potentials, Maxwell's relation, scaling, mirror, exact shapes, limits.

Hypothesis draws the bridges, the same ones in every run; lengths are in units of the first radius and γ is 1. The
number after a tolerance is the worst error among twenty times as many bridges as one run draws.
"""

import math
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

import pendular as pl

UNIT = pl.Liquid(surface_tension=1.0)

examples = settings(
    max_examples=100,
    deadline=None,
    derandomize=True,
    database=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much],
)


def close(value, expected, tolerance, scale=0.0):
    """Equal within a tolerance, relative to the expected value or to a scale that is larger."""
    bound = tolerance * np.maximum(np.abs(expected), scale)
    both_nan = np.isnan(value) & np.isnan(expected)
    assert np.all((np.abs(np.asarray(value) - expected) <= bound) | both_nan), f"{value} is not {expected}"


# -- random bridges --------------------------------------------------------------------------------------------------


# Central differences of sixth order. Near the fold the fields depend on the root of the distance to it: steps of a
# hundredth of that distance err by 1e-12, and multiply rounding errors by some thousands.
OFFSETS = np.array([-3.0, -2.0, -1.0, 1.0, 2.0, 3.0])
WEIGHTS = np.array([-1.0, 9.0, -45.0, 45.0, -9.0, 1.0]) / 60.0
STEP = 0.01


def slope(values, step):
    """Derivative from the values at the offsets times a step."""
    return np.dot(WEIGHTS, values) / step


def test_the_comparison_can_fail():
    close(1.0 + 5e-10, 1.0, 1e-9)
    for value in (1.0 + 2e-9, math.nan):
        with pytest.raises(AssertionError):
            close(value, 1.0, 1e-9)


def test_the_differences_are_of_sixth_order():
    assert slope((1.0 + 0.5 * OFFSETS) ** 6, 0.5) == pytest.approx(6.0, rel=1e-14)
    assert slope((1.0 + 0.5 * OFFSETS) ** 7, 0.5) != pytest.approx(7.0, rel=1e-3)


class Case(NamedTuple):
    """A question that has a bridge for an answer, and the distance of its separation to the fold."""

    pair: pl.Pair
    control: str
    value: float
    separation: float
    branch: str
    room: float

    def bridge(self, separation=0.0, value=0.0):
        """Answer the question, with separation and control changed by these amounts."""
        control = {self.control: self.value + value}
        return pl.bridge(self.pair, self.separation + separation, **control, liquid=UNIT, branch=self.branch)

    def along_separation(self):
        """Neighbours of other separations, and the step between them: a small part of the meniscus, too."""
        bridge = self.bridge()
        height = self.separation + np.sum(bridge.contact_radius * np.tan(0.5 * bridge.half_filling_angle))
        step = STEP * min(self.room, height)
        return self.bridge(separation=step * OFFSETS), step

    def along_control(self):
        """Neighbours of other suctions or volumes, and the step between them."""
        step = STEP * self.room / (self.separation + self.room) * abs(self.value)
        return self.bridge(value=step * OFFSETS), step


def log_floats(low, high):
    """Numbers of any magnitude between two."""
    return st.floats(math.log10(low), math.log10(high)).map(lambda exponent: 10.0**exponent)


def pair_of(second_radius, first_angle, second_angle):
    """Solids from plain numbers."""
    return pl.Pair((1.0, second_radius), (first_angle, second_angle))


def is_uneven(pair):
    """Whether the angles differ by more than six degrees."""
    return abs(pair.contact_angles[0] - pair.contact_angles[1]) > 0.1


angles = st.just(0.0) | st.floats(0.01, math.radians(85.0))
equal_pairs = st.builds(pl.Pair, st.just(1.0), angles)
other_pairs = st.builds(pair_of, st.sampled_from([1.0, math.inf]) | log_floats(1.0, 1e4), angles, angles)
pairs = equal_pairs | other_pairs
close_pairs = equal_pairs | st.builds(pair_of, st.floats(1.0, 4.0), angles, angles)

# At a given volume the bridge between nearly equal solids turns sharply where that between equal ones bifurcates.
clear_pairs = equal_pairs | other_pairs.filter(is_uneven)

fractions = st.floats(1e-6, 0.99)
branches = st.sampled_from(["stable", "unstable"])

# Control, branch, its values, the solids, the separation over that at rupture. Where a thin unstable bridge ends,
# nothing has a derivative: under suction at D = 0, at a given volume well before.
SUCTIONS, PRESSURES, VOLUMES = log_floats(1e-2, 1e8), st.floats(-0.2, -0.01), log_floats(1e-9, 0.5)
DRAWN = [
    ("suction", "stable", SUCTIONS, pairs, (1e-6, 0.95)),
    ("suction", "stable", PRESSURES, close_pairs, (1e-6, 0.95)),
    ("suction", "unstable", SUCTIONS, pairs, (0.3, 0.95)),
    ("suction", "unstable", PRESSURES, close_pairs, (0.3, 0.95)),
    ("volume", "stable", VOLUMES, clear_pairs, (1e-6, 0.95)),
    ("volume", "unstable", VOLUMES, clear_pairs, (0.9, 0.98)),
]


@st.composite
def cases(draw, controls=("suction", "volume")):
    """Bridges of both branches under some controls."""
    drawn = [row for row in DRAWN if row[0] in controls]
    control, branch, values, solids, (low, high) = draw(st.sampled_from(drawn))
    pair, value, fraction = draw(solids), draw(values), draw(st.floats(low, high))
    rupture = pl.rupture(pair, **{control: value}, liquid=UNIT).separation
    assume(rupture > 0.0)
    return Case(pair, control, value, fraction * rupture, branch, (1.0 - fraction) * rupture)


# -- potentials ------------------------------------------------------------------------------------------------------


def line_tension(bridge):
    """2πγY, what a force is measured by where it vanishes."""
    return 2.0 * math.pi * np.max(bridge.contact_radius)


@examples
@given(cases(["volume"]))
def test_force_is_the_slope_of_the_surface_energy_at_constant_volume(case):
    neighbours, step = case.along_separation()
    bridge = case.bridge()
    close(slope(neighbours.surface_energy, step), bridge.force, 1e-9, scale=line_tension(bridge))  # 3.3e-11


@examples
@given(cases(["suction"]))
def test_force_is_the_slope_of_the_grand_potential_at_constant_suction(case):
    neighbours, step = case.along_separation()
    bridge = case.bridge()
    close(slope(neighbours.grand_potential, step), bridge.force, 1e-9, scale=line_tension(bridge))  # 3.9e-11


@examples
@given(cases(["suction"]))
def test_volume_is_the_slope_of_the_grand_potential_with_suction(case):
    neighbours, step = case.along_control()
    close(slope(neighbours.grand_potential, step), case.bridge().volume, 1e-8)  # 1.5e-9


@examples
@given(cases(["volume"]))
def test_suction_is_the_slope_of_the_surface_energy_with_volume(case):
    neighbours, step = case.along_control()
    bridge = case.bridge()
    scale = 1.0 / np.max(bridge.contact_radius)
    close(slope(neighbours.surface_energy, step), -bridge.suction, 1e-9, scale)  # 9.0e-11


@examples
@given(cases(["suction"]))
def test_maxwell_relation_at_constant_suction(case):
    """∂F/∂Δp at constant D is ∂V/∂D at constant Δp."""
    along_suction, suction_step = case.along_control()
    along_separation, step = case.along_separation()
    scale = case.bridge().volume / (case.separation + case.room)
    close(slope(along_suction.force, suction_step), slope(along_separation.volume, step), 2e-9, scale)  # 3.6e-10


@examples
@given(cases(["volume"]))
def test_maxwell_relation_at_constant_volume(case):
    """∂F/∂V at constant D is -∂Δp/∂D at constant V."""
    along_volume, volume_step = case.along_control()
    along_separation, step = case.along_separation()
    scale = line_tension(case.bridge()) / case.value
    close(slope(along_volume.force, volume_step), -slope(along_separation.suction, step), 1e-9, scale)  # 1.1e-10


@examples
@given(cases())
def test_stiffness_is_the_slope_of_the_force(case):
    neighbours, step = case.along_separation()
    bridge = case.bridge()
    scale = abs(bridge.force) / (case.separation + case.room)
    close(slope(neighbours.force, step), bridge.stiffness, 2e-9, scale)  # 2.2e-10


# -- balances on one bridge ------------------------------------------------------------------------------------------


@examples
@given(cases())
def test_force_is_the_same_at_the_neck_and_at_both_contacts(case):
    """F = 2πγY sin(δ+θ) + πY²Δp, at the neck with sin = 1; a repulsive bridge has no neck."""
    bridge = case.bridge()
    angle = bridge.half_filling_angle + np.stack(case.pair.contact_angles, axis=-1)
    radius, sine = np.append(bridge.contact_radius, bridge.neck_radius), np.append(np.sin(angle), 1.0)
    force = 2.0 * math.pi * radius * sine + math.pi * radius**2 * bridge.suction
    close(force[~np.isnan(force)], bridge.force, 1e-14, scale=line_tension(bridge))  # 1.1e-15


@examples
@given(cases())
def test_trace_of_the_capillary_tensor_is_the_area(case):
    bridge = case.bridge()
    close(bridge.capillary_tensor @ [2.0, 1.0], bridge.liquid_gas_area, 1e-15)  # 1.9e-16


@examples
@given(cases())
def test_energies_are_made_of_areas_and_volume(case):
    bridge = case.bridge()
    wetting = np.sum(np.cos(np.stack(case.pair.contact_angles)) * bridge.wetted_area)
    close(bridge.surface_energy, bridge.liquid_gas_area - wetting, 1e-14, scale=bridge.liquid_gas_area)
    close(bridge.grand_potential, bridge.surface_energy + bridge.suction * bridge.volume, 1e-14, bridge.liquid_gas_area)


# -- symmetries ------------------------------------------------------------------------------------------------------

# Powers of length and of surface tension in each field.
DIMENSIONS = {
    "separation": (1, 0), "suction": (-1, 1), "volume": (3, 0), "force": (1, 1), "exists": (0, 0), "stable": (0, 0),
    "neck_radius": (1, 0), "neck_inside": (0, 0), "contact_radius": (1, 0), "half_filling_angle": (0, 0),
    "liquid_gas_area": (2, 0), "wetted_area": (2, 0), "surface_energy": (2, 1), "grand_potential": (2, 1),
    "stiffness": (0, 1), "capillary_tensor": (2, 0),
}  # fmt: skip


@examples
@given(cases(), log_floats(1e-9, 1e3), log_floats(1e-3, 1e3))
def test_every_field_scales_with_its_dimensions(case, length, tension):
    powers = DIMENSIONS[case.control]
    scaled_pair = pl.Pair(tuple(length * radius for radius in case.pair.radii), case.pair.contact_angles)
    scaled = pl.bridge(
        scaled_pair,
        length * case.separation,
        **{case.control: case.value * length ** powers[0] * tension ** powers[1]},
        liquid=pl.Liquid(surface_tension=tension),
        branch=case.branch,
    )
    bridge = case.bridge()
    for name, (of_length, of_tension) in DIMENSIONS.items():
        close(getattr(scaled, name), getattr(bridge, name) * length**of_length * tension**of_tension, 1e-10)  # 6.9e-13


@examples
@given(cases())
def test_the_order_of_the_solids_is_a_matter_of_naming(case):
    swapped = case._replace(pair=pl.Pair(case.pair.radii[::-1], case.pair.contact_angles[::-1])).bridge()
    bridge = case.bridge()
    for name in DIMENSIONS:
        is_per_solid = name in ("contact_radius", "half_filling_angle", "wetted_area")
        mirrored = getattr(swapped, name)[::-1] if is_per_solid else getattr(swapped, name)
        close(mirrored, 1.0 * getattr(bridge, name), 1e-10)  # 7.6e-12, energies near zero


# -- two controls, one bridge ----------------------------------------------------------------------------------------

NEAR_FOLD = st.floats(1.0, 6.0).map(lambda digits: 1.0 - 10.0**-digits)


@examples
@given(pairs, st.just(0.0) | log_floats(1e-4, 1e8), fractions | NEAR_FOLD)
def test_suction_and_volume_control_find_the_same_bridge(pair, suction, fraction):
    separation = fraction * pl.rupture(pair, suction=suction, liquid=UNIT).separation
    assume(separation >= 0.0)
    drained = pl.bridge(pair, separation, suction=suction, liquid=UNIT)
    undrained = pl.bridge(pair, separation, volume=drained.volume, liquid=UNIT)
    close(undrained.suction, suction, 1e-13, scale=1.0 / np.min(drained.contact_radius))  # 7.3e-15
    for name in ("force", "liquid_gas_area", "neck_radius", "contact_radius", "capillary_tensor"):
        close(getattr(undrained, name), getattr(drained, name), 1e-10)  # 9.7e-12, the capillary tensor


SMOOTH = (
    "force", "volume", "liquid_gas_area", "neck_radius", "contact_radius", "half_filling_angle", "stiffness",
    "capillary_tensor",
)  # fmt: skip


@examples
@given(st.builds(pair_of, st.floats(1.0, 10.0), angles, angles), fractions, branches)
def test_fields_pass_smoothly_from_suction_to_pressure(pair, fraction, branch):
    """Suction and pressure have solvers of their own: the mean of two small ones is the answer at none."""
    separation = fraction * pl.rupture(pair, suction=0.0, liquid=UNIT).separation
    below, at, above = (pl.bridge(pair, separation, suction=p, liquid=UNIT, branch=branch) for p in (-1e-8, 0.0, 1e-8))
    for name in SMOOTH:
        close(0.5 * (getattr(below, name) + getattr(above, name)), getattr(at, name), 1e-9)  # 1.1e-10


# -- exact shapes ----------------------------------------------------------------------------------------------------


def cap(radius, sagitta):
    """Volume of a spherical cap."""
    return math.pi * sagitta * (3.0 * radius**2 + sagitta**2) / 6.0


@examples
@given(pairs, fractions, branches)
def test_without_suction_the_bridge_is_a_catenoid(pair, fraction, branch):
    """Y = Y0 cosh(x/Y0), hence x = Y0 asinh(cot(δ+θ)) at a contact."""
    separation = fraction * pl.rupture(pair, suction=0.0, liquid=UNIT).separation
    assume(separation > 0.0)
    bridge = pl.bridge(pair, separation, suction=0.0, liquid=UNIT, branch=branch)
    neck = bridge.neck_radius
    phase = np.arcsinh(1.0 / np.tan(bridge.half_filling_angle + np.stack(pair.contact_angles)))
    sagitta = bridge.contact_radius * np.tan(0.5 * bridge.half_filling_angle)
    volume = math.pi * neck**3 * (0.5 * phase + 0.25 * np.sinh(2.0 * phase)) - cap(bridge.contact_radius, sagitta)
    close(bridge.force, 2.0 * math.pi * neck, 1e-15)
    # slopes are known to rounding, and the half-filling angle of a thin bridge may be as small as 1e-5
    close(bridge.contact_radius, neck * np.cosh(phase), 1e-10)  # 1.2e-12
    close(neck * np.sum(phase) - np.sum(sagitta), separation, 1e-10, scale=np.sum(sagitta))
    close(bridge.volume, np.sum(volume), 1e-10, scale=np.sum(cap(bridge.contact_radius, sagitta)))  # 1.6e-11


@examples
@given(angle=st.floats(0.0, math.radians(80.0)), slenderness=st.floats(1e-6, 0.9))
def test_a_cylinder_is_a_bridge_without_a_neck(angle, slenderness):
    """Contact circle and slope fit where δ + θ is a right angle; Δp = -γ/Y, F = πγY."""
    radius, sagitta = math.cos(angle), 1.0 - math.sin(angle)
    separation = slenderness * radius
    length = separation + 2.0 * sagitta
    volume = math.pi * radius**2 * length - 2.0 * cap(radius, sagitta)
    bridge = pl.bridge(pl.Pair(1.0, angle), separation, volume=volume, liquid=UNIT)
    close(bridge.suction, -1.0 / radius, 1e-12)  # 2.1e-14, where a wide cylinder is short
    close(bridge.force, math.pi * radius, 1e-12)  # 2e-14
    close(bridge.neck_radius, radius, 1e-12)  # 2.1e-15
    close(bridge.contact_radius, radius, 1e-14)  # 8.2e-16
    close(bridge.liquid_gas_area, 2.0 * math.pi * radius * length, 1e-14)  # 1.8e-15


def sunk_into(radius, angle, drop):
    """How a spherical drop sits on a solid: distance of its centre from the surface, and the volume cut off."""
    if math.isinf(radius):
        height = drop * (1.0 + math.cos(angle))
        return drop - height, math.pi * height**2 * (drop - height / 3.0)
    apart = math.sqrt(radius**2 + drop**2 - 2.0 * radius * drop * math.cos(angle))
    overlap = radius + drop - apart
    lens = math.pi * overlap**2 * (apart**2 + 2.0 * apart * (radius + drop) - 3.0 * (radius - drop) ** 2)
    return apart - radius, lens / (12.0 * apart)


wide_angles = st.floats(math.radians(60.0), math.radians(130.0))


@examples
@given(st.builds(pair_of, st.just(math.inf) | st.floats(1.0, 100.0), wide_angles, wide_angles), log_floats(0.01, 1.0))
def test_a_drop_between_solids_exerts_no_force(pair, drop):
    """A sphere of liquid that meets both solids at their contact angles: Δp = -2γ/ρ, F = 0."""
    solids = zip(pair.radii, pair.contact_angles, strict=True)
    depths, lenses = zip(*(sunk_into(float(radius), float(angle), drop) for radius, angle in solids), strict=True)
    separation, volume = sum(depths), 4.0 / 3.0 * math.pi * drop**3 - sum(lenses)
    assume(separation > 1e-6)
    bridge = pl.bridge(pair, separation, volume=volume, liquid=UNIT)
    close(bridge.force, 0.0, 1e-9, scale=line_tension(bridge))  # 7.9e-11
    close(bridge.suction, -2.0 / drop, 1e-10)  # 9.3e-12


# -- limits ----------------------------------------------------------------------------------------------------------

small_menisci = pytest.mark.parametrize("suction", [1e4, 1e8, 1e12])
solids = pytest.mark.parametrize("radius", [1.0, 8.0, math.inf])
angle_pairs = pytest.mark.parametrize(("first", "second"), [(0.0, 0.0), (0.3, 1.2), (1.4, 1.4)])


@small_menisci
@solids
@angle_pairs
def test_contact_force_tends_to_that_of_derjaguin(suction, radius, first, second):
    """F → 2πγR̄ (cos θ1 + cos θ2)/2, under either control; the error is of the order of the contact radius."""
    pair = pair_of(radius, first, second)
    limit = math.pi * pair.derjaguin_radius * (math.cos(first) + math.cos(second))
    drained = pl.bridge(pair, 0.0, suction=suction, liquid=UNIT)
    undrained = pl.bridge(pair, 0.0, volume=drained.volume, liquid=UNIT)
    close([drained.force, undrained.force], limit, 4.0 / math.sqrt(suction))  # 2.6/√Δp


@small_menisci
@solids
@angle_pairs
def test_two_solids_act_as_two_spheres_of_the_derjaguin_radius(suction, radius, first, second):
    pair = pair_of(radius, first, second)
    spheres = pl.Pair(pair.derjaguin_radius, (first, second))
    ruptures = [pl.rupture(solids, suction=suction, liquid=UNIT) for solids in (pair, spheres)]
    halfway = [pl.bridge(s, 0.5 * ruptures[1].separation, suction=suction, liquid=UNIT).force for s in (pair, spheres)]
    close(ruptures[0].separation, ruptures[1].separation, 1.0 / suction)
    close(halfway[0], halfway[1], 1.0 / suction)


@small_menisci
@pytest.mark.parametrize("angle", [0.0, 0.7, 1.4])
def test_rupture_distance_tends_to_its_expansion(suction, angle):
    """H D = 2 cos θ - 3 A^(2/3) H^(-1/3) + C/H between unit spheres; the next term is of the order H^(-4/3)."""
    p, sine, cosine = 0.5 * math.pi - angle, math.sin(angle), math.cos(angle)
    area = 0.5 * (p + sine * cosine)
    g = -(24.0 * p * math.cos(2.0 * p) + 12.0 * p + 4.0 * math.sin(2.0 * p) + 5.0 * math.sin(4.0 * p)) / 64.0
    expansion = 2.0 * cosine - 3.0 * (area**2 / suction) ** (1 / 3) + (5.0 * sine**2 + 2.0 * g / area) / suction
    rupture = pl.rupture(pl.Pair(1.0, angle), suction=suction, liquid=UNIT)
    close(suction * rupture.separation, expansion, 20.0 * suction ** (-4 / 3) + 1e-14)  # 12 H^(-4/3)
