"""Claims about the algebra of the torus: coefficients, roots, β, and the relation of P and Q."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from pendular.laws import toroidal2020

from . import sample
from .claim import Claim, error, is_within, per_angle, signed, tell, worst

Floats = NDArray[np.float64]
_ANGLES = np.array(sample.ANGLES)[:, None]
_HALF_GAP = np.vectorize(toroidal2020.half_gap, otypes=[float])
_CONTACT_RADIUS = np.vectorize(toroidal2020.contact_radius, otypes=[float])
_DISCRIMINANT = np.vectorize(toroidal2020.quartic_discriminant, otypes=[float])


def torus_claims(density: float) -> Iterator[Claim]:
    """Measure the statements about the toroidal theory."""
    yield _coefficients(density)
    yield _cubic(density)
    yield _quartic(density)
    yield _without_fourth_power(density)
    yield _series(density)
    yield _closure(density)
    yield _maximum_of_p()


def _coefficients(density: float) -> Claim:
    degrees = np.linspace(0.0, 40.0, sample.count(80, density) + 1)
    scaled = sample.quartic(1e-5, 1e4, degrees) / 1e4
    numbers = {
        "smallest K4/H*": float(scaled[:, 0].min()),
        "largest K4/H*": float(scaled[:, 0].max()),
        "smallest K3/H*": float(scaled[:, 1].min()),
        "largest K3/H*": float(scaled[:, 1].max()),
    }
    return Claim(
        "coefficients",
        "Section 3.3",
        "0 < K4/H* ≤ 1 and -4 ≤ K3/H* < -2 for 0 ≤ θ ≤ 40°.",
        f"K4/H* from {numbers['smallest K4/H*']:.3f} to {numbers['largest K4/H*']:.3f}, K3/H* from "
        f"{numbers['smallest K3/H*']:.3f} to {numbers['largest K3/H*']:.3f}",
        numbers["smallest K4/H*"] > 0.0
        and numbers["largest K4/H*"] <= 1.0
        and numbers["smallest K3/H*"] >= -4.0
        and numbers["largest K3/H*"] < -2.0,
        "Both ratios are functions of the angle alone, so the range of θ is all there is to check.",
        numbers=numbers,
    )


def _cubic(density: float) -> Claim:
    suctions = sample.decades(1e4, 1e8, 0.25 * density)
    part = np.append(sample.fractions(0.2 * density), [0.999, 0.9999])
    ends = 0.5 * sample.law_rupture("toroidal2020", suctions, _ANGLES)
    has_three = _cubic_discriminant(sample.quartic(part * ends[..., None], suctions[:, None], _ANGLES[..., None])) > 0.0
    first = np.where(has_three.all(axis=(0, 1)), 2.0, part).min()
    numbers = {"sample with three real roots": float(has_three.mean()), "first failure, S/S_crit": float(first)}
    return Claim(
        "cubic_roots",
        "Section 3.3, Eq. (27)",
        "The cubic has three unequal real roots.",
        f"{100.0 * has_three.mean():.1f} % of the sample (H* from 10⁴ to 10⁸, three angles, S up to the S_crit of "
        f"Eq. 25); one real root only from S/S_crit = {first:.4g} on, in {int((~has_three).any(axis=-1).sum())} of "
        f"{has_three[..., 0].size} cases",
        bool(has_three.all()),
        "Eq. (25) is the leading term of the fold of the quartic; where it lies beyond the fold of the cubic the last "
        "sliver below rupture has no torus.",
        "The quartic solved by its own discriminant, or the exact fold.",
        numbers,
    )


def _cubic_discriminant(coefficients: Floats) -> Floats:
    """Discriminant of the quartic without its fourth power: positive with three different real roots."""
    _, a, b, c, d = np.moveaxis(coefficients, -1, 0)
    return np.asarray(18.0 * a * b * c * d - 4.0 * b**3 * d + (b * c) ** 2 - 4.0 * a * c**3 - 27.0 * (a * d) ** 2)


def _quartic(density: float) -> Claim:
    suctions = sample.decades(1e4, 1e8, 0.25 * density)
    ends = _fold_of_quartic(suctions)
    counts = {part: _physical_roots(part * ends, suctions) for part in (0.5, 0.9, 0.999, 1.001, 1.1)}
    real = _real_roots(sample.quartic(0.9 * ends, suctions, _ANGLES))
    numbers = {f"physical roots at {part:g} S_crit": float(found.mean()) for part, found in counts.items()}
    numbers["real roots at 0.9 S_crit"] = float(real.mean())
    return Claim(
        "quartic_roots",
        "Section 3.2, Appendix B",
        "The quartic has four real roots, two of which are physical; they merge at rupture, beyond which none is left.",
        "Roots that are bridges (Y_c > 0, on Eq. 23), mean over H* from 10⁴ to 10⁸ and three angles: "
        + ", ".join(f"{found.mean():.3g} at {part:g} S_crit" for part, found in counts.items())
        + f"; real roots: {real.mean():.3g}",
        bool(np.all(real == 4) and all(np.all(found == (2 if part < 1.0 else 0)) for part, found in counts.items())),
        "Squaring Eq. (22) adds two roots that are no bridges; S_crit is here the zero of the discriminant itself.",
        numbers=numbers,
    )


def _fold_of_quartic(suctions: Floats) -> Floats:
    """Half gap at which the discriminant vanishes, by bisection around Eq. (25)."""
    middle = 0.5 * sample.law_rupture("toroidal2020", suctions, _ANGLES)
    low, high = 0.8 * middle, 1.25 * middle
    for _ in range(60):
        middle = 0.5 * (low + high)
        is_below = _DISCRIMINANT(middle, suctions, np.deg2rad(_ANGLES)) > 0.0
        low, high = np.where(is_below, middle, low), np.where(is_below, high, middle)
    return middle


def _roots(coefficients: Floats) -> NDArray[np.complex128]:
    """Roots of polynomials, from the highest power down on the last axis: eigenvalues of companion matrices."""
    degree = coefficients.shape[-1] - 1
    matrices = np.zeros((*coefficients.shape[:-1], degree, degree))
    matrices[..., 0, :] = -coefficients[..., 1:] / coefficients[..., :1]
    matrices[..., np.arange(1, degree), np.arange(degree - 1)] = 1.0
    return np.asarray(np.linalg.eigvals(matrices).astype(complex))


def _is_real(roots: NDArray[np.complex128]) -> NDArray[np.bool_]:
    return np.asarray(np.abs(roots.imag) <= 1e-7 * np.abs(roots))


def _real_roots(coefficients: Floats) -> NDArray[np.intp]:
    return np.asarray(np.count_nonzero(_is_real(_roots(coefficients)), axis=-1))


def _physical_roots(half_gap: Floats, suctions: Floats) -> NDArray[np.intp]:
    """Number of roots that are contact radii of a torus with that half gap."""
    roots = _roots(sample.quartic(half_gap, suctions, _ANGLES))
    return np.asarray(np.count_nonzero(_is_on_torus(roots, half_gap, suctions, np.deg2rad(_ANGLES)), axis=-1))


def _is_on_torus(
    roots: NDArray[np.complex128], half_gap: Floats, suctions: Floats, angles: Floats
) -> NDArray[np.bool_]:
    """Which roots of Eq. (24) are contact radii that Eq. (23) knows too."""
    gaps = _HALF_GAP(roots.real, suctions[..., None], angles[..., None])
    is_same = np.abs(gaps - half_gap[..., None]) <= 1e-5 * half_gap.max(axis=-1, keepdims=True)[..., None]
    return np.asarray(_is_real(roots) & (roots.real > 0.0) & is_same)


def _without_fourth_power(density: float) -> Claim:
    """Eq. (28) against the largest root of the whole quartic."""
    suctions = sample.decades(1e4, 1e8, 0.25 * density)
    ends, part = _fold_of_quartic(suctions)[..., None], sample.fractions(0.2 * density)
    gaps, suctions = part * ends, suctions[:, None]
    roots = _roots(sample.quartic(gaps, suctions, _ANGLES[..., None]))
    on_torus = _is_on_torus(roots, gaps, suctions, np.deg2rad(_ANGLES)[..., None])
    largest = np.max(np.where(on_torus, roots.real, 0.0), axis=-1)
    given = _CONTACT_RADIUS(gaps, suctions, np.deg2rad(_ANGLES)[..., None])
    numbers = per_angle(worst(errors) for errors in error(given, largest))
    return Claim(
        "cubic_for_quartic",
        "Section 3.3, Eqs. (27), (28)",
        "The fourth power can be left out, and the trigonometric root is the physical one (read as: Y_c within 1 %).",
        f"Eq. (28) against the thick root of Eq. (24), H* from 10⁴ to 10⁸, up to 0.99 S_crit: {tell(numbers)}",
        is_within(numbers, 1.0),
        "The contact radius is small; next to rupture, where two roots are about to merge, the change counts most.",
        numbers=numbers,
    )


def _series(density: float) -> Claim:
    tangents = np.geomspace(1e-3, 1e-2, sample.count(20, density))
    degrees = np.degrees(np.arctan(tangents))
    rest = np.abs(sample.beta("torus", degrees) - sample.beta("series", degrees))
    order = float(np.polyfit(np.log(tangents), np.log(rest), 1)[0])
    at_40 = worst(error(sample.beta("series", 40.0), sample.beta("torus", 40.0)))
    return Claim(
        "beta_series",
        "Appendix B, Eq. (36)",
        "Eq. (36) is the Taylor expansion of β of the torus in T, up to third order.",
        f"What it leaves of (27/32)(1 + sin θ)²/cos θ falls as T^{order:.2f}; at 40° it is {signed(at_40)} %",
        order > 3.9,
        "The term of third order is zero, so that the three printed ones are the expansion up to it.",
        "The closed form of the torus costs no more; the exact coefficient is better than either.",
        {"order of the rest": order, "40 deg": at_40},
    )


def _closure(density: float) -> Claim:
    part = sample.fractions(density, end=1.0)
    suctions = np.array([1e4, 1e5, 1e6])[:, None]
    numbers = {}
    for degrees in (0.0, 40.0):
        gaps = part * sample.rupture_distance(suctions, degrees) * (1.0 - 1e-9)
        p, q = sample.scaled_shape(sample.state(gaps, degrees, suction=suctions))
        numbers[f"{degrees:g} deg"] = worst(error(sample.torus_line(q, degrees), p))
    return Claim(
        "closure",
        "Section 3.1, Fig. 2",
        "Under suction control the torus represents P(Q) of the stable bridges well, at small and large separation "
        "(read as: within the 2 % that its figure can show).",
        f"Largest error of P by Eq. (18), H* = 10⁴ to 10⁶, contact to rupture: {tell(numbers)}",
        is_within(numbers, 2.0),
        "Up to rupture the stable bridges at high suction stay near Q = 1, where the meridian is nearly a circle.",
        "The semi-analytic theory (law asymptotic) adds the second curvature along the arc.",
        numbers,
    )


def _maximum_of_p() -> Claim:
    numbers = {}
    for degrees in sample.ANGLES:
        states, fold = sample.all_states(degrees, volume=1e-6, points=401)
        gap, (p, _) = np.asarray(states.separation), sample.scaled_shape(states)
        numbers[f"{degrees:g} deg"] = float(error(gap[np.argmax(p)], gap[fold]))
    return Claim(
        "maximum_of_p",
        "Section 3.1",
        "Under volume control the critical point is the maximum of P(Q).",
        f"Separation at the largest P against the fold, V* = 10⁻⁶: {tell(numbers)}",
        is_within(numbers, 0.5),
        "At fixed volume the gap is P times a contact radius that changes too, so its maximum is not that of P.",
        "pendular.rupture(volume=...) follows the branch itself, to the end of stability or to the fold.",
        numbers,
    )
