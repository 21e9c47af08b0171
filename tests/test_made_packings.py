"""Made packings: lattices with their contacts, sieve curves met, and random heaps that are jammed."""

import numpy as np
import pytest

import pendular as pl
from pendular.packing.neighbours import find_neighbours
from pendular.packing.sieve import passing

R = 50e-6
LATTICES = {
    "simple_cubic": (1, 6, np.pi / 6),
    "body_centred_cubic": (2, 8, np.pi * 3**0.5 / 8),
    "face_centred_cubic": (4, 12, np.pi / (3 * 2**0.5)),
    "hexagonal": (4, 12, np.pi / (3 * 2**0.5)),
}


def solid_fraction(heap):
    return np.sum(4 / 3 * np.pi * heap.radii**3) / heap.volume


def contacts(heap, within):
    return find_neighbours(heap, lambda first, second: np.full(np.shape(first), within))


@pytest.mark.parametrize("kind", LATTICES)
def test_lattices(kind):
    grains, touching, solid = LATTICES[kind]
    heap = pl.lattice_packing(kind, (3, 4, 5), R)
    assert heap.count == 60 * grains
    assert solid_fraction(heap) == pytest.approx(solid, rel=1e-13)
    found = contacts(heap, 1e-9 * R)
    assert len(found.gap) == heap.count * touching // 2
    assert np.abs(found.gap).max() < 1e-14 * R
    apart = contacts(pl.lattice_packing(kind, (3, 4, 5), R, gap=1e-3 * R), 2e-3 * R).gap
    assert len(apart) == len(found.gap)
    np.testing.assert_allclose(apart, 1e-3 * R, rtol=1e-9)
    second = {"body_centred_cubic": (4 / 3**0.5 - 2) * R}
    if kind in second:  # gap 0.3094 R
        gaps = contacts(heap, 0.35 * R).gap
        assert len(gaps) == heap.count * 14 // 2
        assert gaps.max() == pytest.approx(second[kind], rel=1e-12)


def test_lattices_refused():
    for arguments, told in (
        (("cubic", 3, R), "kind: 'cubic' is not one of 'simple_cubic'"),
        (("simple_cubic", 0, R), "cells: 0.0 is not >= 1"),
        (("simple_cubic", (1, 2), R), r"cells: \(1, 2\) is not one or three"),
        (("simple_cubic", 3, -R), "radius: -5e-05 m is not > 0"),
    ):
        with pytest.raises(ValueError, match=told):
            pl.lattice_packing(*arguments)


def test_sieve_curves_are_met():
    seed = 22
    rng = np.random.default_rng(seed)
    print("seed", seed)
    for _ in range(200):
        sieves = int(rng.integers(2, 7))
        sizes = 1e-4 * np.cumprod(rng.uniform(1.1, 2.0, sieves))
        mass = np.concatenate([[0.0], np.sort(rng.uniform(0.0, 100.0, sieves - 2)), [100.0]])
        radii = pl.sieved_radii(100_000, sizes, mass)
        assert len(radii) == 100_000
        assert 2 * radii[0] > sizes[0]
        assert 2 * radii[-1] < sizes[-1]
        coarse = np.sum(2 * radii > sizes[-2])
        np.testing.assert_allclose(passing(radii, sizes), mass, atol=1e-9 + 100 / coarse)
        k = int(np.argmax(np.diff(mass)))  # between sieves the curve is straight over the logarithm
        middle = np.sqrt(sizes[k] * sizes[k + 1])
        assert passing(radii, middle) == pytest.approx(0.5 * (mass[k] + mass[k + 1]), abs=0.01 + 200 / coarse)


def test_curves_that_are_none():
    for sizes, mass, told in (
        ([1e-4, 2e-4], [0, 50, 100], "passing: 3 values for 2 sizes"),
        ([2e-4, 1e-4], [0, 100], "do not ascend"),
        ([1e-4, 2e-4], [10, 100], "goes from 10 to 100 %"),
        ([1e-6, 2e-6, 1e-3, 2e-3], [0, 50, 50, 100], r"hold none of the coarsest part; take \d+"),
    ):
        with pytest.raises(ValueError, match=told):
            pl.sieved_radii(1000, sizes, mass)


def backbone(pairs, count, least):
    """Contacts a grain among those that are held by so many or more of each other, and their share."""
    held = np.ones(count, bool)
    while True:
        among = held[pairs].all(axis=1)
        number = np.bincount(pairs[among].ravel(), minlength=count)
        if np.array_equal(held & (number >= least), held):
            return number[held].mean(), held.mean()
        held &= number >= least


def test_random_close_heaps_are_isostatic():
    heap = pl.random_packing(400, R, seed=3)
    found = contacts(heap, 0.0)
    number, held = backbone(found.pairs, heap.count, 4)
    assert 0.62 < solid_fraction(heap) < 0.65
    assert held > 0.93
    assert number == pytest.approx(6.0, abs=0.15)  # as many contacts as unknowns
    assert found.gap.min() > -3e-5 * R
    again = pl.random_packing(400, R, seed=3)
    np.testing.assert_array_equal(heap.positions, again.positions)


@pytest.mark.long
def test_friction_makes_heaps_looser():
    heap = pl.random_packing(200, R, friction=1.0, seed=5)
    assert 0.53 < solid_fraction(heap) < 0.61
    number, held = backbone(contacts(heap, 0.0).pairs, heap.count, 2)
    assert held > 0.7
    assert 3.8 < number < 5.2  # 4 at least: with friction a contact bears three components
    assert contacts(heap, 0.0).gap.min() > -3e-3 * R


def test_a_sieve_curve_is_packed():
    radii = pl.sieved_radii(500, [1e-4, 2e-4, 3e-4], [0, 40, 100])
    heap = pl.random_packing(500, radii, seed=6)
    np.testing.assert_array_equal(heap.radii, radii)
    assert solid_fraction(heap) > 0.63
    assert contacts(heap, 0.0).gap.min() > -1e-4 * radii.min()


def test_random_heaps_refused():
    for arguments, told in (
        ((10, R), "count: 10.0 is not >= 50"),
        ((60, np.ones(3)), r"radii: an array of shape \(3,\) is not one radius for each of 60"),
        ((60, -R), "radii: -5e-05 m is not > 0"),
        ((100, np.concatenate([np.ones(99), [30.0]])), r"too small for the largest radius of 30 m; take more grains"),
    ):
        with pytest.raises(ValueError, match=told):
            pl.random_packing(*arguments)
    with pytest.raises(ValueError, match=r"friction: -1.0 is not >= 0"):
        pl.random_packing(100, R, friction=-1.0)


def test_loosened_heaps_touch_nowhere():
    seed = 23
    rng = np.random.default_rng(seed)
    print("seed", seed)
    for kind in LATTICES:
        strain = float(rng.uniform(0.001, 0.1))
        heap = pl.loosened(pl.lattice_packing(kind, 4, R).repeated((1, 2, 1)), strain, seed=seed)
        assert heap.count == 128 * LATTICES[kind][0]
        gaps = contacts(heap, 4.1 * strain * R).gap
        assert 0.0 < gaps.min() < 0.5 * strain * R
        assert len(gaps) >= heap.count * LATTICES[kind][1] // 2
    with pytest.raises(ValueError, match=r"strain: 2.0 is not in \[0, 1\]"):
        pl.loosened(heap, 2.0)
