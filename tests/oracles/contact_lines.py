r"""Bridges between contact lines that stick and slide, by small steps and by integration of the Young-Laplace equation.

Nothing here is shared with the library. In arc length the meridian obeys

.. math:: X' = \cos\phi, \quad Y' = \sin\phi, \quad \phi' = H + \cos\phi / Y, \quad V' = \pi Y^2 \cos\phi ,

integrated by the rule of Runge and Kutta for many bridges at once. Each line is tried where it was; one whose angle
lies beyond its range slides at the nearer end of it, and one that slid the wrong way is tried where it was again.

A row of ``solids`` is (k, advancing, receding angle) of both solids, of a place (ring1, ring2, angle1, angle2, H,
length), with rings measured along the solids from their apex.
"""

import numpy as np

_STEPS = 160
_MOST_NEWTON, _MOST_CHANGES = 15, 8
_DIFFERENCE, _LONGEST = 1e-7, 0.2
_PINNED, _UP, _DOWN = 0, 1, -1


def rings(curvature, reach):
    """Radius, height of the cap, and its volume, for a ring at a distance along the solid from its apex."""
    turn = curvature * reach
    small = np.abs(turn) < 1e-8
    safe = np.where(small, 1.0, curvature)
    radius = np.where(small, reach, np.sin(turn) / safe)
    height = np.where(small, 0.5 * curvature * reach**2, 2.0 * np.sin(0.5 * turn) ** 2 / safe)
    return radius, height, np.pi * height * (3.0 * radius**2 + height**2) / 6.0


def integrated(radius, slope, curvature, length, steps=_STEPS):
    """End of a meridian, (X, Y, φ, V), from a radius and a slope."""

    def rate(y):
        cosine = np.cos(y[2])
        return np.stack([cosine, np.sin(y[2]), curvature + cosine / y[1], np.pi * y[1] ** 2 * cosine])

    y = np.stack([np.zeros_like(radius), radius, slope, np.zeros_like(radius)])
    h = length / steps
    for _ in range(steps):
        a = rate(y)
        b = rate(y + 0.5 * h * a)
        c = rate(y + 0.5 * h * b)
        y = y + h / 6.0 * (a + 2.0 * b + 2.0 * c + rate(y + h * c))
    return y


def misses(solids, place, separation, held, control, steps=_STEPS):
    """Miss of the ring and the slope on the second solid, of the separation, and of what is held."""
    k1, k2 = solids[..., 0], solids[..., 3]
    ring1, ring2, angle1, angle2, curvature, length = np.moveaxis(place, -1, 0)
    radius1, height1, cap1 = rings(k1, ring1)
    radius2, height2, cap2 = rings(k2, ring2)
    slope1 = 0.5 * np.pi - k1 * ring1 - angle1
    slope2 = 0.5 * np.pi - k2 * ring2 - angle2
    x, y, phi, volume = integrated(radius1, -slope1, curvature, length, steps)
    value = volume - cap1 - cap2 if control == "volume" else curvature
    unit = np.abs(held) if control == "volume" else 1.0 / length
    return np.stack(
        [(y - radius2) / length, phi - slope2, (x - height1 - height2 - separation) / length, (value - held) / unit],
        axis=-1,
    )


def _settled(solids, place, mode, separation, held, control):
    """Newton's method: the angle of a line that stays, and the ring of one that slides, are unknown."""
    row, rest = np.arange(len(place)), np.full(len(place), 4)
    columns = np.stack([*(np.where(mode[:, i] == _PINNED, 2 + i, i) for i in (0, 1)), rest, rest + 1])
    units = np.stack(
        [place[:, 5], place[:, 5], np.ones(len(place)), np.ones(len(place)), 1.0 / place[:, 5], place[:, 5]]
    )
    scale = units[columns, row]
    for _ in range(_MOST_NEWTON):
        tried = np.repeat(place[None], 5, axis=0)
        for j in range(4):
            tried[j + 1, row, columns[j]] += _DIFFERENCE * scale[j]
        values = misses(solids, tried, separation, held, control)
        matrix = np.moveaxis((values[1:] - values[0]) / _DIFFERENCE, 0, -1)
        lost = ~np.isfinite(matrix).all((1, 2)) | ~(
            np.abs(np.linalg.det(np.where(np.isfinite(matrix), matrix, 0.0))) > 0.0
        )
        matrix[lost] = np.eye(4)
        change = np.linalg.solve(matrix, -values[0][..., None])[..., 0]
        change[lost] = np.nan
        size = np.abs(change).max(1)
        change *= np.minimum(1.0, _LONGEST / np.maximum(size, _LONGEST))[:, None]
        place[row, columns] += change.T * scale
        if not (size > 1e-11).any():
            break
    return place


def advanced(solids, place, separation, held, control):
    """One small step: the new places, and what the lines did."""
    mode = np.zeros((len(place), 2), int)
    start = place
    for _ in range(_MOST_CHANGES):
        place = start.copy()
        for i in (0, 1):
            high, low = solids[:, 1 + 3 * i], solids[:, 2 + 3 * i]
            place[:, 2 + i] = np.where(mode[:, i] == _UP, high, np.where(mode[:, i] == _DOWN, low, place[:, 2 + i]))
        place = _settled(solids, place, mode, separation, held, control)
        change = mode.copy()
        for i in (0, 1):
            high, low = solids[:, 1 + 3 * i], solids[:, 2 + 3 * i]
            free, angle, way = mode[:, i] == _PINNED, place[:, 2 + i], place[:, i] - start[:, i]
            change[free & (angle > high), i] = _UP
            change[free & (angle < low), i] = _DOWN
            change[~free & (way * mode[:, i] < 0.0), i] = _PINNED
        if (change == mode).all():
            break
        mode = change
    return place, mode
