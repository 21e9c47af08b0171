"""Cones, paraboloids and discs: against bridges that an integrator makes, known limits, and identities."""

import contextlib
import math
import warnings

import numpy as np
import pytest

import pendular as pl
from oracles import any_solids as made

UNIT = pl.Liquid(surface_tension=1.0)
SHAPES = ("sharp cone", "rounded cone", "paraboloid", "disc", "pinned disc", "own profile")


def random_solid(rng, kind):
    """A solid of a kind, with its angle, for the library and for the integrator."""
    angle = float(np.deg2rad(rng.uniform(2.0, 100.0)))
    half, size = float(np.deg2rad(rng.uniform(15.0, 88.0))), float(10.0 ** rng.uniform(-0.7, 0.7))
    solids = {
        "sharp cone": lambda: (pl.Cone(half), made.cone(half, angle)),
        "rounded cone": lambda: (pl.Cone(half, size), made.cone(half, angle, size)),
        "paraboloid": lambda: (pl.Paraboloid(size), made.paraboloid(size, angle)),
        "disc": lambda: (pl.Disc(size), made.edge(size, angle) if rng.random() < 0.6 else made.plane(angle)),
        "own profile": lambda: own_profile(size, rng.uniform(0.0, 0.1), angle),
        "pinned disc": lambda: (pl.Disc(size, pinned=True), made.edge(size, angle)),
        "sphere": lambda: (1.0, made.sphere(1.0, angle)),
        "plane": lambda: (math.inf, made.plane(angle)),
    }
    return *solids[kind](), angle


def own_profile(size, steeper, angle):
    """A profile that is steeper than a paraboloid, far from the axis."""
    library = pl.Convex(np.linspace(0.0, 4.0, 3000), lambda y: 0.5 * y**2 / size + steeper * y**4)
    return library, made.Solid(
        angle,
        lambda y: 0.5 * y**2 / size + steeper * y**4,
        lambda y: y / size + 4.0 * steeper * y**3,
        lambda y: 1.0 / size + 12.0 * steeper * y**2,
    )


def lies_on(solid, other, radius, slope):
    """Whether a contact line of the integrator is one of the solid: on the face of a disc, or at its edge."""
    if not isinstance(solid, pl.Disc):
        return True
    if not other.is_edge:
        return radius < solid.radius
    asked = 0.5 * math.pi - other.angle - slope
    return 0.0 < asked < 0.5 * math.pi if not solid.pinned else math.cos(slope) > 0.0 or math.sin(slope) < 0.0


def random_made(rng, kind, *, volume_held):
    """Two solids with a stable bridge between them, made by the integrator."""
    while True:
        first, one, angle1 = random_solid(rng, kind)
        second, other, angle2 = random_solid(rng, rng.choice([*SHAPES, "sphere", "plane"]))
        suction = rng.choice([-1.0, 1.0, 1.0]) * 10.0 ** rng.uniform(-2.0, 2.0)
        radius, slope = 10.0 ** rng.uniform(-2.0, 0.5), None
        if one.is_edge:
            radius, slope = one.edge, rng.uniform(-1.5, 1.5)
            suction = rng.uniform(-3.0, 3.0) / radius
        try:
            bridge = made.make(one, other, float(radius), float(suction), slope)
        except ValueError:  # wider than the solid
            continue
        if bridge is None or not (bridge.gap > 0.0 and bridge.volume > 0.0 and bridge.is_outside()):
            continue
        ends = zip((first, second), (one, other), bridge.radii, bridge.slopes, strict=True)
        if all(lies_on(*end) for end in ends) and bridge.directions_down(volume_held=volume_held) == 0:
            return pl.Pair((first, second), (angle1, angle2)), bridge


def slides(bridge):
    """Whether a shift along two flat faces costs nothing."""
    return not any(solid.is_edge or solid.steepness(0.05) for solid in bridge.solids)


def check_against_made(seed, kind, count):
    rng = np.random.default_rng(seed)
    worst = 0.0
    for i in range(count):
        pair, one = random_made(rng, kind, volume_held=i % 2 == 0)
        held = {"volume": one.volume} if i % 2 == 0 else {"suction": one.suction}
        found = pl.bridge(pair, float(one.gap), **held, liquid=UNIT)
        assert found.exists, (seed, i, pair, held, one.gap)
        size = one.radii[0]
        if abs(found.contact_radius[0] / size - 1.0) > 1e-6 and "Disc" in repr(pair):
            # of two stable bridges that of the least energy is answered
            energy = one.energy + (0.0 if i % 2 == 0 else one.suction * one.volume)
            assert (found.surface_energy if i % 2 == 0 else found.grand_potential) < energy
            continue
        misses = {
            "force": abs(found.force / (2.0 * math.pi) - one.force) / max(abs(one.force), 1e-2 * size),
            "suction": abs(found.suction - one.suction) * size,
            "volume": abs(found.volume / one.volume - 1.0),
            "area": abs(found.liquid_gas_area / one.area - 1.0),
            "wetted": np.max(np.abs(found.wetted_area / np.array(one.wetted) - 1.0)),
            "radii": np.max(np.abs(found.contact_radius / np.array(one.radii) - 1.0)),
            "tensor": np.max(np.abs(found.capillary_tensor - np.array(one.tensor))) / one.area,
            "energy": abs(found.surface_energy - one.energy) / one.area,
        }
        name = max(misses, key=misses.get)
        allowed = 1e-8 if "Convex" in repr(pair) else 1e-9  # a spline is about as near to its profile
        assert misses[name] < allowed, (seed, i, name, misses[name], pair, held, one.gap)
        worst = max(worst, misses[name])
        if abs(one.force) > 1e-6 * size and not slides(one):
            sideways = one.directions_down(volume_held=False, mode=1)
            assert found.sideways_stable == (sideways == 0), (seed, i, pair, held, one.gap)
    print(f"seed {seed}, {kind}: {count} bridges within {worst:.1e}")


@pytest.mark.parametrize("kind", SHAPES)
def test_bridges_that_an_integrator_makes(kind):
    check_against_made(20, kind, 3)


@pytest.mark.long
@pytest.mark.parametrize("kind", SHAPES)
def test_sixty_bridges_that_an_integrator_makes(kind):
    check_against_made(21, kind, 60)


def check_on_a_side(seed, count):
    rng, found, worst = np.random.default_rng(seed), 0, 0.0
    while found < count:
        angle = float(np.deg2rad(rng.uniform(2.0, 80.0)))
        second, other, angle2 = random_solid(rng, rng.choice(["sharp cone", "paraboloid", "sphere", "plane"]))
        suction = float(rng.uniform(-3.0, 1.0))
        whole = made.make(made.side(0.8, angle, 1e-9), other, 0.8, suction)
        if whole is None or not whole.gap > 0.0:
            continue
        height = float(rng.uniform(0.1, 0.95) * whole.gap)
        one = made.make(made.side(0.8, angle, height), other, 0.8, suction)
        if not (one.volume > 0.0 and one.is_outside() and one.directions_down(volume_held=True) == 0):
            continue
        pair = pl.Pair((pl.Disc(0.8), second), (angle, angle2))
        question = (seed, found, pair, one.volume, one.gap)
        with quietly():
            answer = pl.bridge(pair, float(one.gap), volume=one.volume, liquid=UNIT)
        assert answer.exists, question
        if abs(answer.wetted_area[0] / one.wetted[0] - 1.0) > 1e-6:  # another has less energy
            assert answer.surface_energy < one.energy, question
            continue
        found += 1
        misses = (
            abs(answer.force / (2.0 * math.pi) - one.force) / max(abs(one.force), 1e-2),
            abs(answer.suction - one.suction),
            abs(answer.liquid_gas_area / one.area - 1.0),
            np.max(np.abs(answer.wetted_area / np.array(one.wetted) - 1.0)),
            np.max(np.abs(answer.contact_radius / np.array(one.radii) - 1.0)),
            abs(answer.surface_energy - one.energy) / one.area,
        )
        assert max(misses) < 1e-9, (question, misses)
        assert answer.sideways_stable == (one.directions_down(volume_held=False, mode=1) == 0), question
        worst = max(worst, *misses)
    print(f"seed {seed}: {count} bridges on the side of a cylinder within {worst:.1e}")


def test_bridges_on_the_side_of_a_cylinder():
    check_on_a_side(40, 4)


@pytest.mark.long
def test_sixty_bridges_on_the_side_of_a_cylinder():
    check_on_a_side(41, 60)


def test_the_force_on_a_side_is_the_slope_of_the_energy():
    pair = pl.Pair((pl.Disc(1.0), math.inf), np.deg2rad(40.0))
    five = [pl.bridge(pair, 0.3 + 1e-3 * k, volume=2.5, liquid=UNIT) for k in (-2, -1, 0, 1, 2)]
    assert all(one.wetted_area[0] > 1.2 * math.pi for one in five)
    energy, force = ([getattr(one, name) for one in five] for name in ("surface_energy", "force"))
    assert (energy[0] - 8.0 * energy[1] + 8.0 * energy[3] - energy[4]) / 0.012 == pytest.approx(force[2], rel=1e-8)
    assert (force[0] - 8.0 * force[1] + 8.0 * force[3] - force[4]) / 0.012 == pytest.approx(five[2].stiffness, rel=1e-6)


@pytest.mark.parametrize("volume", [0.3, 2.5])
def test_a_profile_begins_and_ends_on_its_solids(volume):
    solids = (pl.Disc(1.0), pl.Paraboloid(2.0))
    found = pl.bridge(pl.Pair(solids, 0.5), 0.3, volume=volume, liquid=UNIT)
    shape = found.profile(4001)
    behind = found.wetted_area[0] / (2.0 * math.pi) - 0.5 if volume > 1.0 else 0.0
    assert behind == 0.0 or behind > 0.05
    assert shape.x[0] == pytest.approx(-behind, abs=1e-12)
    assert shape.x[-1] == pytest.approx(0.3 + shape.y[-1] ** 2 / 4.0, rel=1e-9)
    turned = math.pi * np.trapezoid(shape.y**2, shape.x)
    liquid = turned - math.pi * behind - math.pi * shape.y[-1] ** 4 / 8.0
    assert liquid == pytest.approx(volume, rel=1e-5)
    assert shape.solid_y[0].max() == 1.0
    np.testing.assert_allclose(shape.solid_x[1] - 0.3, shape.solid_y[1] ** 2 / 4.0, atol=1e-12)


@pytest.mark.parametrize(
    ("solids", "volume"),
    [
        ((pl.Cone(math.radians(50.0)), 1.0), 0.1),
        ((pl.Cone(math.radians(50.0), 0.5), pl.Paraboloid(2.0)), 0.3),
        ((pl.Disc(1.0), pl.Disc(0.8, pinned=True)), 0.6),
        ((pl.Disc(1.0), math.inf), 2.5),
        ((pl.Convex(np.linspace(0.0, 2.0, 200), lambda y: 0.3 * y**2 + 0.1 * y**4), pl.Disc(1.0)), 0.2),
    ],
)
def test_a_mesh_has_the_volume_and_the_areas_of_the_bridge(solids, volume):
    found = pl.bridge(pl.Pair(solids, 0.5), 0.2, volume=volume, liquid=UNIT)
    misses = []
    for around in (60, 120):
        mesh = found.mesh(around)
        corners = mesh.points[mesh.triangles]
        normals = 0.5 * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        areas = [np.linalg.norm(normals[mesh.surface == name], axis=1).sum() for name in range(3)]
        exact = [found.liquid_gas_area, *found.wetted_area]
        liquid = mesh.surface < 3
        contained = np.linalg.det(corners[liquid]).sum() / 6.0
        assert np.linalg.norm(normals[liquid].sum(axis=0)) < 1e-10  # closed
        misses.append(np.abs(np.append(np.array(areas) / exact - 1.0, contained / volume - 1.0)).max())
    assert misses[1] < 2e-2
    assert misses[1] < 0.3 * misses[0]


def test_under_suction_a_line_slides_along_the_side_of_a_cylinder():
    pair = pl.Pair((pl.Disc(1.0), 3.0), np.deg2rad(15.0))
    held = {"suction": 0.35, "liquid": UNIT}
    gaps = np.array([0.002, 0.01, 0.02])
    found = pl.bridge(pair, gaps, **held)
    assert found.stable.all()
    assert np.all(found.wetted_area[:, 0] > math.pi)
    np.testing.assert_allclose(found.force, found.force[0], rtol=1e-10)
    np.testing.assert_allclose(np.diff(found.volume), math.pi * np.diff(gaps), rtol=1e-8)
    np.testing.assert_allclose(np.diff(found.grand_potential), found.force[0] * np.diff(gaps), rtol=1e-8)
    again = pl.bridge(pair, gaps, volume=found.volume, liquid=UNIT)
    np.testing.assert_allclose(again.suction, 0.35, rtol=1e-9)
    np.testing.assert_allclose(again.surface_energy, found.surface_energy, rtol=1e-9)
    np.testing.assert_allclose(again.wetted_area, found.wetted_area, rtol=1e-9)


def random_pair(rng):
    first, one, angle1 = random_solid(rng, rng.choice(SHAPES))
    second, other, angle2 = random_solid(rng, rng.choice([*SHAPES, "sphere", "plane"]))
    return pl.Pair((first, second), (angle1, angle2)), (one, other)


def test_a_catenoid_between_rings_ends_where_it_is_known_to():
    end = pl.rupture(pl.Pair(pl.Disc(1.0, pinned=True)), suction=0.0, liquid=UNIT)
    assert math.floor(1e7 * end.separation) == 13254868
    root = 1.19967864025773383391636984879  # of x tanh x = 1
    assert end.separation == pytest.approx(2.0 * root / math.cosh(root), rel=1e-12)


def test_a_cylinder_between_rings_breaks_as_long_as_its_circumference():
    rings = pl.Pair(pl.Disc(1.0, pinned=True))
    end = pl.rupture(rings, volume=2.0 * math.pi**2, liquid=UNIT)
    assert end.separation == pytest.approx(2.0 * math.pi, rel=1e-9)
    assert end.suction == pytest.approx(-1.0, rel=1e-9)
    assert pl.rupture(rings, volume=2.0 * math.pi**2, liquid=UNIT, limit="fold").separation > 6.5
    short = pl.bridge(rings, 2.0, volume=2.0 * math.pi, liquid=UNIT)
    assert short.stable
    assert short.force == pytest.approx(math.pi, rel=1e-12)
    assert short.suction == pytest.approx(-1.0, rel=1e-12)
    assert short.liquid_gas_area == pytest.approx(4.0 * math.pi, rel=1e-12)


@pytest.mark.parametrize("held", [{"volume": 0.05}, {"suction": 3.0}])
def test_a_plane_is_the_limit_of_a_cone(held):
    flat, ball = pl.Pair((math.inf, 1.0), (0.4, 0.2)), 1.0
    cone = pl.Pair((pl.Cone(0.5 * math.pi), ball), (0.4, 0.2))
    near = pl.Pair((pl.Cone(0.5 * math.pi - 1e-7), ball), (0.4, 0.2))
    expected = pl.bridge(flat, 0.1, **held, liquid=UNIT)
    for pair, tolerance in ((cone, 1e-12), (near, 1e-5)):
        found = pl.bridge(pair, 0.1, **held, liquid=UNIT)
        for name in ("force", "volume", "suction", "surface_energy", "stiffness"):
            assert getattr(found, name) == pytest.approx(getattr(expected, name), rel=tolerance)
    assert pl.rupture(cone, **held, liquid=UNIT).separation == pytest.approx(
        pl.rupture(flat, **held, liquid=UNIT).separation, rel=1e-10
    )


def test_a_sphere_is_the_limit_of_a_paraboloid_for_a_small_bridge():
    differences = []
    for volume in (1e-4, 1e-6, 1e-8):
        tip, ball = (
            pl.bridge(pl.Pair((solid, math.inf), 0.3), 1e-3 * volume**0.5, volume=volume, liquid=UNIT).force
            for solid in (pl.Paraboloid(1.0), 1.0)
        )
        differences.append(abs(tip / ball - 1.0))
    assert differences[-1] < 1e-4
    assert differences[0] / differences[1] == pytest.approx(10.0, rel=0.3)  # as Y²/R²


@pytest.mark.parametrize("held", [{"volume": 1e-3}, {"suction": 20.0}])
def test_a_rounded_cone_is_a_sphere_while_the_line_is_on_its_cap(held):
    cone, ball = (pl.Pair((solid, 2.0), (0.3, 0.5)) for solid in (pl.Cone(math.radians(50.0), 1.0), 1.0))
    found, expected = (pl.bridge(pair, 0.02, **held, liquid=UNIT) for pair in (cone, ball))
    assert found.contact_radius[0] < math.cos(math.radians(50.0))
    for name in ("force", "volume", "suction", "surface_energy", "stiffness", "neck_radius"):
        assert getattr(found, name) == pytest.approx(getattr(expected, name), rel=1e-10)
    assert pl.rupture(cone, **held, liquid=UNIT).separation == pytest.approx(
        pl.rupture(ball, **held, liquid=UNIT).separation, rel=1e-10
    )


def test_a_bridge_wets_the_face_of_a_disc_and_is_then_pinned_at_its_edge():
    pair = pl.Pair((pl.Disc(1.0), 1.5), (math.radians(50.0), 0.3))
    volumes = np.geomspace(1e-2, 1.4, 13)
    found = pl.bridge(pair, 0.2, volume=volumes, liquid=UNIT)
    radius = found.contact_radius[:, 0]
    assert np.all(np.diff(radius) >= -1e-12)
    assert np.max(radius) == pytest.approx(1.0, abs=1e-12)
    on_face = radius < 1.0 - 1e-9
    assert 3 < np.sum(on_face) < 12
    plane, ring = pl.Pair((math.inf, 1.5), (math.radians(50.0), 0.3)), pl.Pair((pl.Disc(1.0, pinned=True), 1.5), 0.3)
    for other, part in ((plane, on_face), (ring, ~on_face)):
        expected = pl.bridge(other, 0.2, volume=volumes[part], liquid=UNIT)
        np.testing.assert_allclose(found.force[part], expected.force, rtol=1e-10)
        np.testing.assert_allclose(found.suction[part], expected.suction, rtol=1e-9)


def test_the_force_is_the_slope_of_the_energy():
    seed, found = 5, 0
    rng = np.random.default_rng(seed)
    for i in range(20):
        pair, _ = random_pair(rng)
        held = {"volume": 10.0 ** rng.uniform(-2.0, 0.0)} if i % 2 else {"suction": 10.0 ** rng.uniform(-1.0, 1.5)}
        with quietly():
            end = pl.rupture(pair, **held, liquid=UNIT)
            if not end.exists:
                continue
            gap = rng.uniform(0.3, 0.9) * end.separation
            step = 1e-4 * end.separation
            five = [pl.bridge(pair, gap + k * step, **held, liquid=UNIT) for k in (-2, -1, 0, 1, 2)]
        if not all(one.exists for one in five):
            continue
        radii = np.array([one.contact_radius for one in five])
        if np.ptp(radii, axis=0).max() > 0.05 * radii.max():  # another bridge has less energy
            continue
        energies = [one.surface_energy if i % 2 else one.grand_potential for one in five]
        slope = (energies[0] - 8.0 * energies[1] + 8.0 * energies[3] - energies[4]) / (12.0 * step)
        stiffness = (five[0].force - 8.0 * five[1].force + 8.0 * five[3].force - five[4].force) / (12.0 * step)
        assert slope == pytest.approx(five[2].force, rel=2e-6, abs=1e-9 * abs(energies[2]) / step), (seed, i, pair)
        if not passes_a_corner(pair, radii):
            assert stiffness == pytest.approx(five[2].stiffness, rel=1e-5, abs=1e-5), (seed, i, pair)
        found += 1
    print(f"seed {seed}: {found} bridges")
    assert found > 7


@contextlib.contextmanager
def quietly():
    """Without the warning of those that are neither found nor excluded."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", pl.ConvergenceWarning)
        yield


def passes_a_corner(pair, radii):
    """Whether a line comes to an edge or to the end of a cap: the stiffness has a step there."""
    for solid, radius in zip(pair.solids, radii.T, strict=True):
        if isinstance(solid, pl.Disc) and not solid.pinned:
            corner = solid.radius
        elif isinstance(solid, pl.Cone):
            corner = solid.tip_radius * math.cos(solid.half_angle)
        else:
            continue
        if radius.min() < corner - 1e-9 and radius.max() > corner - 1e-9:
            return True
    return False


def surface_of(solid, other, radius, filling, wetted):
    """The surface of the integrator on which a line of an answer lies."""
    if not isinstance(solid, pl.Disc):
        return other
    if not solid.pinned and radius < solid.radius * (1.0 - 1e-9):
        return made.plane(other.angle)
    behind = wetted / (2.0 * math.pi * solid.radius) - 0.5 * solid.radius
    if behind > 1e-9:
        assert filling == pytest.approx(0.5 * math.pi, abs=1e-9)
        return made.side(solid.radius, other.angle, behind)
    return made.edge(solid.radius, other.angle)


def check_answer(question, pair, others, bridge, *, volume_held):
    """Whether the integrator, from one end of an answer, makes the bridge that was asked for."""
    fillings = bridge.half_filling_angle
    if np.any((fillings > 0.5 * math.pi - 1e-3) & [solid == 1.0 for solid in pair.solids]):
        return  # the integrator knows no far side of a sphere
    radius, slope, half = bridge._meridian
    each = zip(pair.solids, others, bridge.contact_radius, fillings, bridge.wetted_area, strict=True)
    ends = [surface_of(*one) for one in each]
    first = 1 if ends[1].behind else 0  # a side comes first
    way = 2 * first - 1
    turn = way * bridge.suction * half
    zeta = radius * np.exp(1j * (slope + turn)) + way * 1j * half * np.exp(0.5j * turn) * np.sinc(0.5 * turn / math.pi)
    outward = way * math.atan2(zeta.imag, zeta.real)
    start = float(bridge.contact_radius[first])
    ends = ends[::-1] if first else ends
    tries = (
        made.make(*ends, start, float(bridge.suction), outward, longest=2.1 * half / start, number=number)
        for number in range(4)
    )
    again = next((one for one in tries if one is not None and abs(one.length - 2.0 * half) < 1e-6 * half), None)
    assert again is not None, question
    size = 2.0 * half
    assert abs(again.gap - bridge.separation) < 1e-8 * size, question
    assert again.volume == pytest.approx(bridge.volume, rel=1e-8, abs=1e-9 * size**3), question
    assert again.force == pytest.approx(bridge.force / (2.0 * math.pi), rel=1e-8, abs=1e-9 * size), question
    assert again.is_outside(), question
    assert again.directions_down(volume_held=volume_held) == bridge.unstable_directions, question
    if abs(again.force) > 1e-6 * size and not slides(again):
        sideways = again.directions_down(volume_held=False, mode=1)
        assert bridge.sideways_stable == (sideways == 0), question


def check_questions(seed, count):
    rng = np.random.default_rng(seed)
    answered = silent = 0
    for i in range(count):
        pair, others = random_pair(rng)
        volume_held = bool(rng.random() < 0.5)
        held = (
            {"volume": 10.0 ** rng.uniform(-3.0, 0.5)} if volume_held else {"suction": 10.0 ** rng.uniform(-1.5, 2.0)}
        )
        gap = 10.0 ** rng.uniform(-3.0, 0.3)
        branch = "unstable" if i % 4 == 3 else "stable"
        with quietly():
            bridge = pl.bridge(pair, gap, **held, liquid=UNIT, branch=branch)
        question = (seed, i, pair, held, gap, branch)
        if bridge.exists:
            answered += 1
            assert branch == "unstable" or bridge.unstable_directions == 0, question
            check_answer(question, pair, others, bridge, volume_held=volume_held)
        elif math.isnan(bridge.force):
            silent += 1
    print(f"seed {seed}: {answered} of {count} questions answered, {silent} neither found nor excluded")
    return answered, silent


def test_every_answer_solves_the_equation():
    answered, silent = check_questions(31, 24)
    assert answered > 6
    assert silent < 6


@pytest.mark.long
def test_every_answer_of_many_solves_the_equation():
    answered, silent = check_questions(32, 500)
    assert answered > 180
    assert silent < 110


@pytest.mark.parametrize(
    ("radius", "depth", "message"),
    [
        ([0.0, 1.0, 2.0], [0.0, 1.0, 2.0], "radius: is not a row of at least four increasing distances"),
        ([0.1, 1.0, 2.0, 3.0], [0.0, 1.0, 2.0, 3.0], "radius: is not a row of at least four increasing distances"),
        ([0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 2.0], r"depth: an array of shape \(3,\) is not one depth for each of 4"),
        (np.linspace(0.0, 1.0, 50), np.sin(2.0 * np.linspace(0.0, 1.0, 50)) ** 2, "depth: is concave at radius 0.408"),
        (np.linspace(0.0, 1.0, 50), (np.linspace(0.0, 1.0, 50) - 0.3) ** 2, "depth: comes back towards the tip at"),
    ],
)
def test_a_profile_that_is_not_convex_is_refused(radius, depth, message):
    with pytest.raises(ValueError, match=message):
        pl.Convex(radius, depth)


def test_a_line_beyond_the_end_of_a_profile_is_not_answered():
    short = pl.Convex(np.linspace(0.0, 0.1, 50), lambda y: y * y)
    with pytest.warns(pl.ConvergenceWarning, match="end of a profile, which is not|neither found nor excluded"):
        found = pl.bridge(pl.Pair((short, math.inf), 0.3), 0.01, volume=0.1, liquid=UNIT)
    assert math.isnan(found.force)
    assert not found.exists
