"""Grains that push each other apart until they rest: the compiled part of making a random packing."""

import math

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel

__all__ = ["LOOSE", "SETTLED", "STALE", "TIRED", "settle"]

Floats = NDArray[np.float64]

TIRED, SETTLED, LOOSE, STALE = range(
    4
)  # out of steps; at rest under load; no load is left; neighbours must be looked up

# Of FIRE [1]: steps, mixing of velocity and force, and how they change.
_FIRST_STEP, _LONGEST_STEP = 0.1, 0.25  # of sqrt(mass / stiffness)
_MIXING, _LESS_MIXING, _LONGER, _SHORTER, _PATIENCE = 0.1, 0.99, 1.1, 0.5, 5
_TANGENTIAL = 2.0 / 7.0  # stiffness over the normal one
_INERTIA = 0.4  # of a sphere over mass and radius squared


@kernel
def settle(
    positions: Floats,
    radii: Floats,
    masses: Floats,
    pairs: NDArray[np.int32],
    springs: Floats,
    friction: float,
    tolerance: float,
    loose: float,
    skin: float,
    steps: int,
) -> tuple[int, int, float]:
    """Move grains of a periodic unit cell downhill, with friction in their contacts, until one of four ends.

    Parameters
    ----------
    positions : ndarray, (grains, 3)
        Centres, changed in place, in lengths of the cell.
    radii, masses : ndarray, (grains,)
        Radii in lengths of the cell; masses in any unit.
    pairs : ndarray, (pairs, 2)
        Those that may touch before a grain has moved by half the skin.
    springs : ndarray, (pairs, 3)
        Tangential springs of the contacts, changed in place.
    friction : float
        Largest tangential over normal force.
    tolerance : float
        Largest mean force left on a grain over the mean force of a contact.
    loose : float
        Overlaps a grain, over the mean radius, below which no load is left.
    skin : float
        Path of two grains together that makes the pairs stale.
    steps : int
        At most.

    Returns
    -------
    end, steps, overlap : int, int, float
        One of the four ends, steps done, mean overlap of contacts.

    Notes
    -----
    Linear springs of stiffness one; velocities by FIRE [1]_, of centres and of spins.

    References
    ----------
    .. [1] E. Bitzek et al., Phys. Rev. Lett. 97 (2006) 170201, doi 10.1103/PhysRevLett.97.170201.
    """
    count, axes = radii.size, 6 if friction > 0.0 else 3  # without it nothing turns a grain
    start = positions.copy()
    motion, force = np.zeros((count, 6)), np.zeros((count, 6))  # of spins: times the radius, and over it
    mean_radius = radii.mean()
    ease = _ease(masses)
    step, mixing, downhill = _FIRST_STEP, _MIXING, 0
    overlap = 0.0
    for done in range(steps):
        contacts, total = _forces(positions, motion, radii, pairs, springs, friction, step, force)
        overlap = total / max(1, contacts)
        if total < loose * count * mean_radius:
            return LOOSE, done, overlap
        power, speed, push, left = 0.0, 0.0, 0.0, 0.0
        for i in range(count):
            for k in range(axes):
                power += force[i, k] * motion[i, k]
                speed += motion[i, k] ** 2
                pull = force[i, k] * ease[i, k // 3]
                push += pull**2
                left += force[i, k] ** 2
        if math.sqrt(left / count) < tolerance * overlap:
            return SETTLED, done, overlap
        if power > 0.0:
            downhill += 1
            if downhill > _PATIENCE:
                step, mixing = min(step * _LONGER, _LONGEST_STEP), mixing * _LESS_MIXING
        else:
            downhill, step, mixing = 0, step * _SHORTER, _MIXING
            motion[:] = 0.0
            speed = 0.0
        turn = mixing * math.sqrt(speed / push) if push > 0.0 else 0.0
        farthest = 0.0
        for i in range(count):
            for k in range(axes):
                pull = force[i, k] * ease[i, k // 3]
                motion[i, k] = (1.0 - mixing) * motion[i, k] + (turn + step) * pull
            path = 0.0
            for k in range(3):
                positions[i, k] += step * motion[i, k]
                path += (positions[i, k] - start[i, k]) ** 2
            farthest = max(farthest, path)
        if 2.0 * math.sqrt(farthest) > skin:
            return STALE, done + 1, overlap
    return TIRED, steps, overlap


@kernel
def _ease(masses: Floats) -> Floats:
    """One over the mass and over the inertia of each grain, (grains, 2)."""
    ease = np.empty((masses.size, 2))
    for i in range(masses.size):
        ease[i, 0], ease[i, 1] = 1.0 / masses[i], 1.0 / (_INERTIA * masses[i])
    return ease


@kernel
def _forces(
    positions: Floats,
    motion: Floats,
    radii: Floats,
    pairs: NDArray[np.int32],
    springs: Floats,
    friction: float,
    step: float,
    force: Floats,
) -> tuple[int, float]:
    """Forces and torques on all grains; number of contacts and sum of their overlaps."""
    force[:] = 0.0
    contacts, total = 0, 0.0
    for row in range(pairs.shape[0]):
        i, j = pairs[row, 0], pairs[row, 1]
        x, y, z = _branch(positions, i, j)
        reach = radii[i] + radii[j]
        square = x * x + y * y + z * z
        if square >= reach * reach:
            if friction > 0.0:
                springs[row] = 0.0
            continue
        distance = math.sqrt(square)
        overlap = reach - distance
        contacts += 1
        total += overlap
        x, y, z = x / distance, y / distance, z / distance
        force[i, 0] -= overlap * x
        force[i, 1] -= overlap * y
        force[i, 2] -= overlap * z
        force[j, 0] += overlap * x
        force[j, 1] += overlap * y
        force[j, 2] += overlap * z
        if friction > 0.0:
            _rub(i, j, x, y, z, overlap, motion, springs[row], friction, step, force)
    return contacts, total


@kernel
def _branch(positions: Floats, i: int, j: int) -> tuple[float, float, float]:
    """Vector to the nearest image of the second centre."""
    x = positions[j, 0] - positions[i, 0]
    y = positions[j, 1] - positions[i, 1]
    z = positions[j, 2] - positions[i, 2]
    return x - math.floor(x + 0.5), y - math.floor(y + 0.5), z - math.floor(z + 0.5)


@kernel
def _rub(
    i: int,
    j: int,
    x: float,
    y: float,
    z: float,
    overlap: float,
    motion: Floats,
    spring: Floats,
    friction: float,
    step: float,
    force: Floats,
) -> None:
    """Tangential force and torques of a contact: a spring in its plane that slides at the friction."""
    a = motion[i, 3] + motion[j, 3]
    b = motion[i, 4] + motion[j, 4]
    c = motion[i, 5] + motion[j, 5]
    u = motion[j, 0] - motion[i, 0] - (b * z - c * y)
    v = motion[j, 1] - motion[i, 1] - (c * x - a * z)
    w = motion[j, 2] - motion[i, 2] - (a * y - b * x)
    u, v, w = spring[0] + step * u, spring[1] + step * v, spring[2] + step * w
    along = u * x + v * y + w * z
    u, v, w = u - along * x, v - along * y, w - along * z
    length, longest = math.sqrt(u * u + v * v + w * w), friction * overlap / _TANGENTIAL
    if length > longest:
        u, v, w = u * longest / length, v * longest / length, w * longest / length
    spring[0], spring[1], spring[2] = u, v, w
    u, v, w = _TANGENTIAL * u, _TANGENTIAL * v, _TANGENTIAL * w
    force[i, 0] += u
    force[i, 1] += v
    force[i, 2] += w
    force[j, 0] -= u
    force[j, 1] -= v
    force[j, 2] -= w
    a, b, c = y * w - z * v, z * u - x * w, x * v - y * u  # torque over radius, the same on both
    for grain in (i, j):
        force[grain, 3] += a
        force[grain, 4] += b
        force[grain, 5] += c
