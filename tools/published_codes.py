"""Formulas as they were read in published programs, and how far they are from the exact solution.

Each formula is written down anew, as coded, for two equal spheres of radius 1 and surface tension 1 unless its unit
matters; what was only read, and not calculated, is not here. ``python -m tools.conformance`` prints the table.
"""

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

import pendular as pl
from pendular.comparison.words import number

Floats = NDArray[np.float64]
Force = Callable[[float, float, float], float]  # of volume, contact angle and gap

PARTS = (0.0, 0.25, 0.6)  # of (1 + θ/2) V^(1/3), the gaps at which forces are compared
VOLUMES = (1e-3, 1e-2)  # over the cube of the radius

_GAPS = "force at D = 0, 0.25 and 0.6 of (1 + θ/2) V^(1/3)"
_UNIT = pl.Liquid(surface_tension=1.0)
_SPHERES = pl.Pair(1.0, 0.0)


class Finding(NamedTuple):
    """A formula as coded in the version that was read, and numbers that it leads to."""

    program: str
    version: str
    what: str
    shown: str  # what the numbers are
    numbers: dict[str, tuple[float, ...]]  # by the case
    is_ratio: bool = False  # the numbers are formula/exact, not (formula - exact)/exact


def findings() -> Iterator[Finding]:
    """All findings."""
    yield Finding(
        "LIGGGHTS-PFM, `cohesion capillary`",
        "2024-01",
        "fit of Willett et al. (2000) with 2.3 ln V\\* and 2.3 ln(D/(2R)) where the fit has ln V\\* and ln of half the "
        "gap over √(V/R); contact angle not used",
        _GAPS,
        _over_gaps(_liggghts_pfm, (0.0,)),
    )
    yield Finding(
        "LIGGGHTS-PUBLIC, `washino/capillary/viscous`",
        "2024-06-07",
        "law of Rabinovich et al. (2005) with R₁R₂/(R₁+R₂) where it has 2R₁R₂/(R₁+R₂); in contact without its second "
        "term",
        _GAPS,
        _over_gaps(_liggghts_washino, (0.0, 40.0)),
    )
    yield Finding(
        "MercuryDPM, Lian–Seville bridge, read in a fork",
        "commit fb0ebf1, 2024-07-26",
        "fit of Lian and Seville (2016), made for V/R³, fed with V in m³",
        "force at D = 0.02 R, θ = 0, over the exact force",
        {
            f"R = {1e3 * radius:g} mm, V\\* = {number(volume)}": (_mercury(volume, radius) / _exact(volume, 0.0, 0.02),)
            for radius in (1e-3, 1e-4)
            for volume in VOLUMES
        },
        is_ratio=True,
    )
    yield Finding(
        "StupidCFD, `LiquidBridgeBox`",
        "2018-06",
        "last coefficient of f₁ in the fit of Willett et al. (2000) −0.0029076 instead of −0.00029076",
        "force at contact",
        {
            f"θ = {angle:g}°, V\\* = {number(volume)}": (_liquid_bridge_box(volume, np.radians(angle)),)
            for angle, volume in ((40.0, 1e-4), (40.0, 1e-5), (45.0, 1e-5))
        },
    )
    yield Finding(
        "dirt_granular (Rust)",
        "0.1.4",
        "simple form of Willett et al. (2000) with R₁R₂/(R₁+R₂) where it has 2R₁R₂/(R₁+R₂)",
        _GAPS,
        _over_gaps(_dirt_granular, (0.0,)),
    )
    yield Finding(
        "ddgclib.dem (Python)",
        "2026-06-23",
        "force falling linearly from 2πγR cos θ to zero at the rupture distance of Lian et al. (1993)",
        _GAPS,
        _over_gaps(_ddgclib, (0.0,)),
    )
    yield from _yade()


def _exact(volume: float, angle: float, gap: float) -> float:
    """Exact force between two equal spheres of radius 1 at surface tension 1."""
    return float(pl.bridge(pl.Pair(1.0, angle), gap, volume=volume, liquid=_UNIT).force)


def _over_gaps(force: Force, degrees: tuple[float, ...]) -> dict[str, tuple[float, ...]]:
    """Errors of a force at all gaps, for each angle and volume."""

    def error(volume: float, angle: float, part: float) -> float:
        gap = part * (1.0 + 0.5 * angle) * volume ** (1.0 / 3.0)
        return force(volume, angle, gap) / _exact(volume, angle, gap) - 1.0

    return {
        f"θ = {degree:g}°, V\\* = {number(volume)}": tuple(error(volume, np.radians(degree), part) for part in PARTS)
        for degree in degrees
        for volume in VOLUMES
    }


def willett(log_volume: float, angle: float, log_gap: float | None, last: float = -0.00029076) -> float:
    """Fit of Willett et al. with its logarithms as given: F/(2πγR)."""
    t, x = angle, log_volume
    powers = x ** np.arange(4)
    f1 = powers @ (
        -0.44507 + 0.050832 * t - 1.1466 * t**2,
        -0.1119 - 0.000411 * t - 0.1490 * t**2,
        -0.012101 - 0.0036456 * t - 0.01255 * t**2,
        -0.0005 - 0.0003505 * t + last * t**2,
    )
    if log_gap is None:
        return float(np.exp(f1))
    f2 = powers[:3] @ (
        1.9222 - 0.57473 * t - 1.2918 * t**2,
        -0.0668 - 0.1201 * t - 0.22574 * t**2,
        -0.0013375 - 0.0068988 * t - 0.01137 * t**2,
    )
    f3 = powers @ (
        1.268 - 0.01396 * t - 0.23566 * t**2,
        0.198 + 0.092 * t - 0.06418 * t**2,
        0.02232 + 0.02238 * t - 0.009853 * t**2,
        0.0008585 + 0.001318 * t - 0.00053 * t**2,
    )
    f4 = powers[:3] @ (
        -0.010703 + 0.073776 * t - 0.34742 * t**2,
        0.03345 + 0.04543 * t - 0.09056 * t**2,
        0.0018574 + 0.004456 * t - 0.006257 * t**2,
    )
    return float(np.exp(f1 - f2 * np.exp(f3 * log_gap + f4 * log_gap**2)))


def _liggghts_pfm(volume: float, angle: float, gap: float) -> float:
    log_gap = 2.3 * np.log(0.5 * gap) if gap > 0.0 else None
    return 2.0 * np.pi * willett(2.3 * np.log(volume), 0.0, log_gap)


def _liquid_bridge_box(volume: float, angle: float) -> float:
    """Error at contact."""
    force = 2.0 * np.pi * willett(np.log(volume), angle, None, last=-0.0029076)
    return force / _exact(volume, angle, 0.0) - 1.0


def _liggghts_washino(volume: float, angle: float, gap: float) -> float:
    radius = 0.5  # R1 R2/(R1 + R2)
    if gap == 0.0:
        return float(2.0 * np.pi * radius * np.cos(angle))
    q = -1.0 + np.sqrt(1.0 + 2.0 * volume / (np.pi * radius * gap**2))
    depth, filling = 0.5 * gap * q, np.sqrt(q * gap / radius)
    pressure = np.cos(angle) / (1.0 + gap / (2.0 * depth))
    return float(2.0 * np.pi * radius * (pressure + np.sin(filling) * np.sin(filling + angle)))


def _dirt_granular(volume: float, angle: float, gap: float) -> float:
    radius = 0.5  # R1 R2/(R1 + R2)
    s = gap * np.sqrt(radius / volume)
    return float(2.0 * np.pi * radius * np.cos(angle) / (1.0 + 1.05 * s + 2.5 * s**2))


def _ddgclib(volume: float, angle: float, gap: float) -> float:
    rupture = (1.0 + 0.5 * angle) * volume ** (1.0 / 3.0)
    return float(2.0 * np.pi * np.cos(angle) * (1.0 - gap / rupture))


def _mercury(volume_star: float, radius: float) -> float:
    """Force over γR at a gap of 0.02 R and zero angle, the volume and the gap in m."""
    volume, gap = volume_star * radius**3, 0.02 * radius
    b = volume**0.26 + 0.285 * volume**0.6327
    s = gap / (volume ** (1.0 / 3.0) + 0.1 * volume ** (2.0 / 3.0))
    return float((2.0 * np.pi - 2.082 * b**0.9197) / (1.0 + 0.8438 * b**-0.724 * s + 1.3393 * b**-1.459 * s**2))


# -- the tables of YADE ----------------------------------------------------------------------------------------------


def _yade() -> Iterator[Finding]:
    table = YadeTable()
    suctions = (1.0, 10.0, 50.0, 100.0, 300.0, 1000.0)
    distances = {f"D_c at H\\* = {number(suction)}": (table.rupture_error(suction),) for suction in suctions}
    forces = {f"F at H\\* = {number(suction)}": (table.force_error(0.9, suction),) for suction in (100.0, 1000.0)}
    yield Finding(
        "YADE, `Law2_ScGeom_CapillaryPhys_Capillarity`",
        "2019-04 to 2023-08; an emulation, the tables that are shipped were not seen",
        "force from a table of 80 even separations to 0.3995 R and 350 suctions, the default of its writer; missing "
        "rows count as zeros and are blended with their neighbours",
        "rupture distance D_c, and force F at 0.9 of the exact one, θ = 0",
        distances | forces,
    )
    exact = pl.bridge(_SPHERES, 0.1, suction=1.0, liquid=_UNIT)
    yield Finding(
        "YADE, `CapillarityEngine`",
        "2022 on",
        "the one value of its check: R = 1, H\\* = 1, D/R = 0.1, θ = 0: volume 0.223176, force 3.976278",
        "volume and force",
        {"volume": (0.223176 / float(exact.volume) - 1.0,), "force": (3.976278 / float(exact.force) - 1.0,)},
    )


class YadeTable:
    """Force over 2πγR between two equal spheres at zero angle, by linear interpolation in a table of exact rows."""

    def __init__(self) -> None:
        self._gaps = np.linspace(0.0, 0.3995, 80)
        self._suctions = np.concatenate([[0.0], np.geomspace(0.002, 1493.0, 349)])
        self._forces = _exact_force(self._gaps[:, None], self._suctions)
        self._rows = np.count_nonzero(self._forces > 0.0, axis=1)

    def force_error(self, part: float, suction: float) -> float:
        """Error of the force at a part of the exact rupture distance."""
        gap = part * _exact_rupture(suction)
        return self.force(gap, suction) / float(_exact_force(gap, suction)) - 1.0

    def rupture_error(self, suction: float) -> float:
        """Error of the rupture distance."""
        return self.rupture_distance(suction) / _exact_rupture(suction) - 1.0

    def force(self, gap: float, suction: float) -> float:
        """Force from the two blocks beside a gap."""
        block = min(int(np.searchsorted(self._gaps, gap, side="right")) - 1, self._gaps.size - 2)
        below, above = (self._in_block(i, suction) for i in (block, block + 1))
        part = (gap - self._gaps[block]) / (self._gaps[block + 1] - self._gaps[block])
        return below + part * (above - below)

    def rupture_distance(self, suction: float) -> float:
        """Gap beyond which the force is zero: the first block that has no row for the suction."""
        blocks = range(self._gaps.size)
        return float(next(self._gaps[i] for i in blocks if self._in_block(i, suction) == 0.0))

    def _in_block(self, block: int, suction: float) -> float:
        """Force in a block of one gap, zero above its last row."""
        rows = slice(0, self._rows[block])
        if not self._rows[block] or suction > self._suctions[rows][-1]:
            return 0.0
        return float(np.interp(suction, self._suctions[rows], self._forces[block, rows]))


def _exact_force(gap: float | Floats, suction: float | Floats) -> Floats:
    return np.asarray(pl.bridge(_SPHERES, gap, suction=suction, liquid=_UNIT).force) / (2.0 * np.pi)


def _exact_rupture(suction: float) -> float:
    return float(pl.rupture(_SPHERES, suction=suction, liquid=_UNIT).separation)
