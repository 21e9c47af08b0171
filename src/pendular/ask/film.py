"""Adsorbed films: solids that are a little thicker, and the gap at which films are replaced by a bridge."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ground.check import in_range, plain, quantity
from .face import bridge, rupture
from .liquid import Liquid
from .pair import Pair, PerSolid, check_pair, has_planes
from .problem import control_of

__all__ = ["Filmed", "condensation_separation", "film_thickness", "filmed"]

Floats = NDArray[np.float64]

_MOST_STEPS = 60
_SETTLED = 1e-13  # relative change of a separation that is none


class Filmed(NamedTuple):
    """Solids with films, as solids that are thicker.

    ``pl.bridge(found.pair, separation - found.shift, ...)`` is the bridge between the films.
    """

    pair: Pair
    shift: float | Floats  # thickness of both films, by which the gap is narrower, [m]


def film_thickness(suction: ArrayLike, hamaker_constant: ArrayLike) -> float | Floats:
    r"""Thickness of an adsorbed film under a suction, by van der Waals' disjoining pressure.

    .. math:: \Delta p = \frac{A}{6\pi t^3}

    Parameters
    ----------
    suction : array_like
        Δp, [Pa], > 0.
    hamaker_constant : array_like
        A, [J], > 0: that of solid and gas across the liquid, counted positive where it thickens the film; 1e-21 to
        1e-19 J. Authors differ in its sign, and some write A for A/(6π).

    Returns
    -------
    float or ndarray
        t, [m].

    Raises
    ------
    ValueError
        For bad input.

    Notes
    -----
    **Validity.** Liquids that wet the solid, without retardation, below some 5 nm; not for films of a few molecules.
    For a humidity take :func:`suction_from_humidity`.

    References
    ----------
    .. [1] B. V. Derjaguin, N. V. Churaev, V. M. Muller, Surface Forces, Consultants Bureau, New York 1987, chapter 2.

    Examples
    --------
    >>> print(f"{1e9 * film_thickness(14.2e6, 1e-20):.3f} nm")
    0.334 nm
    """
    pressure = in_range("suction", quantity("suction", suction, "Pa"), 0.0, brackets="()", unit="Pa")
    constant = quantity("hamaker_constant", hamaker_constant, "J")
    in_range("hamaker_constant", constant, 0.0, brackets="()", unit="J")
    thickness: float | Floats = plain(np.cbrt(constant / (6.0 * np.pi * pressure)))
    return thickness


def filmed(pair: Pair, thickness: PerSolid) -> Filmed:
    """Solids with adsorbed films: spheres of radius R + t, planes as they are, in a gap that is narrower by both films.

    Parameters
    ----------
    pair : Pair
        Spheres or planes.
    thickness : array_like or tuple of two
        t, [m], >= 0, below a tenth of the smaller radius; a tuple gives the two solids apart.

    Returns
    -------
    Filmed
        The thicker pair, and the shift of the separation.

    Raises
    ------
    ValueError
        For bad input, and for solids of other shapes.

    Notes
    -----
    **Validity.** The film is taken as a part of the solid that keeps its thickness up to the meniscus: for t much less
    than the radius of curvature of the meniscus. The volume is that of the bridge without the films. The zone where
    both go over into each other, and the force between the films, are left out.

    Examples
    --------
    >>> pair, shift = filmed(Pair((1e-6, np.inf)), 2e-9)
    >>> print(f"{pair.radii[0]:.4g} m, gap narrower by {shift:.1g} m")
    1.002e-06 m, gap narrower by 4e-09 m
    """
    check_pair(pair)
    both = thickness if isinstance(thickness, tuple) else (thickness, thickness)
    if len(both) != 2:
        raise ValueError(f"thickness: a tuple of {len(both)} is not a pair (first solid, second solid)")
    first, second = pair.radii
    smaller = float(np.min(np.minimum(first, second)))
    films = []
    for solid, one in enumerate(both):
        name = f"thickness[{solid}]" if isinstance(thickness, tuple) else "thickness"
        films.append(in_range(name, quantity(name, one, "m"), 0.0, 0.1 * smaller, brackets="[)", unit="m"))
    return Filmed(Pair((first + films[0], second + films[1]), pair.contact_angle), plain(films[0] + films[1]))


def condensation_separation(
    pair: Pair,
    *,
    suction: ArrayLike | None = None,
    humidity: ArrayLike | None = None,
    liquid: Liquid,
    thickness: PerSolid | None = None,
    hamaker_constant: ArrayLike | None = None,
) -> float | Floats:
    r"""Separation below which a bridge is the state of least energy: that at which it costs as much as none.

    .. math:: \Omega(D - t_1 - t_2) = 0, \qquad D \leftarrow D + \frac{W}{F}(A_1 + A_2), \quad W = \frac{A}{12\pi t^2}

    Parameters
    ----------
    pair : Pair
        Two spheres, or a sphere and a plane.
    suction, humidity : array_like
        One of the two, as for :func:`bridge`; the suction > 0.
    liquid : Liquid
        As for :func:`bridge`.
    thickness : array_like or tuple of two, optional
        Of adsorbed films, [m], as for :func:`filmed`.
    hamaker_constant : array_like, optional
        A, [J], in its place: both films as :func:`film_thickness` has them. Films that such forces hold have an energy
        of their own, W; each square metre that a bridge replaces sets it free.

    Returns
    -------
    float or ndarray
        [m]; NaN where not even solids in contact hold a bridge of an energy below zero.

    Raises
    ------
    ValueError
        For bad input, and for two planes, between which no bridge is stable at a suction.

    Notes
    -----
    **Validity.** As :func:`filmed`; the energy of the films to the first order, for W much less than γ. A bridge
    between this separation and that of rupture lives on, but has a higher energy than the films. One that is not there
    waits for a fluctuation, at the latest until the films touch. With W it may come to lie beyond the rupture of
    :func:`filmed` solids, which knows no W. Between large spheres it tends to 2γ/Δp + 3t, the
    distance between planes that Derjaguin found.

    References
    ----------
    .. [1] B. V. Derjaguin, Acta Physicochimica URSS 12 (1940) 181.

    Examples
    --------
    >>> tip = Pair((1e-6, np.inf))
    >>> for constant in (None, 1e-20):
    ...     gap = condensation_separation(tip, suction=14.2e6, liquid=Liquid(0.072), hamaker_constant=constant)
    ...     print(f"{1e9 * gap:.3f} nm")
    8.038 nm
    9.039 nm
    """
    check_pair(pair)
    if has_planes(pair):
        raise ValueError("pair: two planes hold no stable bridge at a suction; a sphere is needed")
    control = control_of(suction, None, humidity, liquid)
    pressure = in_range(control.name, control.value, 0.0, brackets="()", unit="Pa")
    if thickness is not None and hamaker_constant is not None:
        raise ValueError("thickness: given together with hamaker_constant; one of the two is needed")
    energy: float | Floats = 0.0
    if hamaker_constant is not None:
        thickness = film_thickness(pressure, hamaker_constant)
        energy = 0.5 * pressure * thickness
    thick, shift = filmed(pair, 0.0 if thickness is None else thickness)
    gap = np.zeros_like(np.asarray(rupture(thick, suction=pressure, liquid=liquid).separation))
    # the energy rises with the separation by a force that falls: Newton's method comes from below
    for _ in range(_MOST_STEPS):
        found = bridge(thick, gap, suction=pressure, liquid=liquid)
        with np.errstate(invalid="ignore", divide="ignore"):
            step = -np.asarray(found.grand_potential) / np.asarray(found.force)
        step = np.where(np.isfinite(step) & ((gap > 0.0) | (step > 0.0)), step, 0.0)
        gap = gap + step
        if np.all(np.abs(step) <= _SETTLED * gap):
            break
    found = bridge(thick, gap, suction=pressure, liquid=liquid)
    with np.errstate(invalid="ignore", divide="ignore"):
        freed = energy * np.sum(found.wetted_area, axis=-1) / found.force
    answer: float | Floats = plain(np.where(gap > 0.0, gap + shift + freed, np.nan))
    return answer
