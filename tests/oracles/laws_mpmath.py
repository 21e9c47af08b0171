"""The published laws once more, in 40 digits, transcribed from the articles by the most direct route.

Nothing is shared with the compiled kernels: coefficients stand as decimal strings, roots are found by mpmath, the
quartic of Zhao, Kruyt and Millet (2020) is derived here by clearing the square root of their Eq. (23), and the
equilibrium of two half bridges is solved for their contact radii. The laws at constant volume stand in
`volume_laws_mpmath`. ``ORACLES[name]`` holds force, rupture, rupture work and damping of a law, None where the law does
not give it, with the arguments of its kernels; NaN where the law has no answer.
"""

from typing import Any, NamedTuple

from mpmath import acos, asin, cbrt, cos, diff, exp, findroot, isnan, log, matrix, mp, mpf, nan, pi, sin, sqrt, tan

from oracles.volume_laws_mpmath import FORMULAS, of_kernel_arguments, one_angle

# Zhao et al. (2020), Appendices B and C: rows to be multiplied by (T², T, 1), T = tan θ.
EQ_37 = (("-0.236", "-0.120", "-1.358"), ("0.239", "0.111", "0.458"))
EQ_38 = (("-0.151", "-0.015", "0.850"), ("0.302", "0.038", "1.217"), ("0.012", "-0.017", "0.152"))
EQ_39 = (("-0.0015", "0.0001", "0.0019"), ("0.0347", "-0.0142", "0.0021"), ("-0.1165", "0.0311", "0.6087"))
EQ_40 = (("-0.0016", "0.0006", "0.0026"), ("0.0330", "-0.0201", "-0.0365"), ("-0.0949", "0.0674", "0.0088"))
ZHAO2020 = {"37": EQ_37, "38": EQ_38, "39": EQ_39, "40": EQ_40}


def in_40_digits(function):
    """Let a law be asked with floats, whose digits are taken as exact; None stays None."""
    return function and mp.workdps(40)(lambda *numbers, **options: function(*map(mpf, numbers), **options))


def gorge_force(neck_radius, H):
    """Zhao et al. (2020), Eq. (26)."""
    return neck_radius + H * neck_radius**2 / 2


# --- zhao2020 ---------------------------------------------------------------------------------------------------------


def fitted(table, theta):
    return matrix([[mpf(number) for number in row] for row in table]) * matrix([tan(theta) ** 2, tan(theta), 1])


def zhao2020_rupture(H, *solids, tables=ZHAO2020):
    theta = one_angle(*solids)
    c1, c2 = fitted(tables["37"], theta)
    series = 1 + c1 / cbrt(H) + c2 / cbrt(H) ** 2
    return 2 / H / sqrt(tan(theta) ** 2 + 1) * series if series > 0 else nan


def zhao2020_force(D, H, *solids, rupture=None, tables=ZHAO2020):
    theta = one_angle(*solids)
    fraction = D / (rupture or zhao2020_rupture(H, *solids, tables=tables))
    if isnan(fraction) or fraction > 1:
        return fraction * 0
    p1, p2, p3 = fitted(tables["38"], theta)
    logarithms = matrix([[log(H) ** 2, log(H), 1]])
    A = (logarithms * fitted(tables["39"], theta))[0]
    B = (logarithms * fitted(tables["40"], theta))[0]
    at_contact = sqrt(2 / H) * (p1 * exp(-p2 / sqrt(H)) + p3)
    neck_radius = at_contact * (1 + A * (sqrt(1 - fraction) - 1) + B * fraction)
    return gorge_force(neck_radius, H) if neck_radius > 0 else nan


# --- toroidal2020 -----------------------------------------------------------------------------------------------------


def toroidal2020_neck_radius(Y, H, T):
    """Eq. (22)."""
    return -1 / H + sqrt(2 * Y * (T + Y) / (H * sqrt(T**2 + 1)) + 1 / H**2 + Y**2)


def toroidal2020_half_gap(Y, H, T):
    """Eq. (23)."""
    a = sqrt(T**2 + 1) + T
    return a * Y - Y**2 / 2 - a * toroidal2020_neck_radius(Y, H, T)


def toroidal2020_quartic(S, H, T):
    """Coefficients of the contact radius, highest power first, up to a common factor.

    With a = √(T²+1) + T, Eq. (23) says Y - Y²/(2a) + e = Y0 + 1/H with e = 1/H - S/a; by Eq. (22) the square of the
    right side is 2Y(T+Y)/(H√(T²+1)) + 1/H² + Y².
    """
    r = sqrt(T**2 + 1)
    a = r + T
    e = 1 / H - S / a
    return [1 / (4 * a**2), -1 / a, -e / a - 2 / (H * r), 2 * e - 2 * T / (H * r), e**2 - 1 / H**2]


def real_roots(coefficients):
    """Find the real roots as eigenvalues of the companion matrix, highest power first."""
    degree = len(coefficients) - 1
    companion = matrix(degree)
    for i in range(degree):
        companion[0, i] = -coefficients[i + 1] / coefficients[0]
    for i in range(1, degree):
        companion[i, i - 1] = 1
    roots, _ = mp.eig(companion)
    return sorted(root.real for root in roots if abs(root.imag) < mpf(10) ** -30)


def toroidal2020_rupture(H, *solids):
    """Eqs. (35) and (36)."""
    T = tan(one_angle(*solids))
    beta = mpf(27) / 32 + mpf(27) / 16 * T + mpf(81) / 64 * T**2
    alpha = 1 - cbrt(beta / H) if beta < H else nan
    return 2 * alpha / sqrt(T**2 + 1) / H


def toroidal2020_force(D, H, *solids):
    """Force of the thick bridge, the largest of three real roots; a single real root belongs to no bridge."""
    T = tan(one_angle(*solids))
    rupture = toroidal2020_rupture(H, *solids)
    if isnan(rupture) or rupture < D:
        return rupture * 0
    roots = real_roots(toroidal2020_quartic(D / 2, H, T)[1:])
    return gorge_force(toroidal2020_neck_radius(roots[-1], H, T), H) if len(roots) == 3 else nan


# --- asymptotic_rupture -----------------------------------------------------------------------------------------------


def area(phi):
    return (phi + sin(phi) * cos(phi)) / 2


def cubic(phi):
    return -(24 * phi * cos(2 * phi) + 12 * phi + 4 * sin(2 * phi) + 5 * sin(4 * phi)) / 64


def asymptotic_rupture_rupture(H, theta1, theta2, kappa1, kappa2):
    sides = ((theta1, kappa1), (theta2, kappa2))
    mean = sum(area(pi / 2 - theta) for theta, _ in sides) / 2
    third = sum(
        sin(theta) ** 2 * (kappa + 3 * area(pi / 2 - theta) / (2 * mean)) + cubic(pi / 2 - theta) / mean
        for theta, kappa in sides
    )
    series = cos(theta1) + cos(theta2) - 3 * cbrt(mean**2 / H) + third / H
    return series / H if series > 0 else nan


# --- asymptotic -------------------------------------------------------------------------------------------------------


def contact_radius(force, H, theta, kappa):
    """Radius at which a surface of curvature H and force λ meets a solid of curvature κ at the angle θ."""

    def excess(Y):
        return Y * sin(asin(kappa * Y) + theta) + H * Y**2 / 2 - force

    return findroot(excess, sqrt(2 * force / H) / 2)


def half_gap(force, H, theta, kappa):
    Y = contact_radius(force, H, theta, kappa)
    delta = asin(kappa * Y)
    phi = pi / 2 - delta - theta
    r = H * Y + cos(phi)
    X = (sin(phi) - area(phi) / r + (cubic(phi) + area(phi) * cos(phi) ** 2) / r**3) / H
    return X - (2 * sin(delta / 2) ** 2 / kappa if kappa else 0)


def gap(force, H, theta1, theta2, kappa1, kappa2):
    return half_gap(force, H, theta1, kappa1) + half_gap(force, H, theta2, kappa2)


def asymptotic_fold(H, theta1, theta2, kappa1, kappa2):
    """Force at which the gap is largest, searched from its value for H → ∞ downwards."""
    mean = (area(pi / 2 - theta1) + area(pi / 2 - theta2)) / 2
    start = cbrt(mean**2 / H) / 2
    return findroot(lambda f: diff(lambda g: gap(g, H, theta1, theta2, kappa1, kappa2), f), (start, start * 0.95))


def asymptotic_rupture_of_pair(H, *solids):
    return gap(asymptotic_fold(H, *solids), H, *solids)


def asymptotic_force(D, H, *solids):
    fold = asymptotic_fold(H, *solids)
    if gap(fold, H, *solids) < D:
        return mpf(0)
    upper = (cos(solids[0]) + cos(solids[1])) / 2
    return findroot(lambda f: gap(f, H, *solids) - D, (fold, upper), solver="anderson", tol=mpf(10) ** -50)


PENDULAR2026_COEFFICIENTS = ("0.494", "0.75", "0.42")


def pendular2026(separation, suction, angle1, angle2, kappa1, kappa2):
    """The law in 60 digits, from the formulas of its docstring and the trigonometric root of its cubic."""
    with mp.workdps(60):
        d, h, t1, t2, k1, k2 = map(mpf, (separation, suction, angle1, angle2, kappa1, kappa2))
        a1, a2, a3 = map(mpf, PENDULAR2026_COEFFICIENTS)

        def moment(t):
            return (pi / 2 - t + sin(t) * cos(t)) / 2

        def third(t, kappa, mean):
            p = pi / 2 - t
            g3 = -(24 * p * cos(2 * p) + 12 * p + 4 * sin(2 * p) + 5 * sin(4 * p)) / 64
            return sin(t) ** 2 * (kappa + 3 * moment(t) / (2 * mean)) + g3 / mean

        a, c = (moment(t1) + moment(t2)) / 2, (cos(t1) + cos(t2)) / 2
        rho = a / c
        k, big_c = 3 * rho / 2, rho / 2 * (third(t1, k1, a) + third(t2, k2, a))
        x = (1 + a * h) ** (-mpf(1) / 3)
        w = 9 / (16 + 8 * x) - a1 * (1 - rho**5)
        rupture = 2 * a * c * x**3 / (1 + k * x + k**2 * x**2 + (k**3 - 1 - big_c) * x**3 + w * x**4)
        if d > rupture:
            return rupture, mpf(0)
        y_f = a * x**2 / (1 + x + x**2) * (1 + a2 * (1 - rho) * x**2)
        m_f = 1 + h * y_f
        s = sqrt((1 + a3 * (1 - rho) * x**3) * (rupture - d) / 3)
        p = 1 + (h * s / m_f) ** 2  # y³ - 3py + 2 = 0, largest root
        y = 2 * sqrt(p) * cos(acos(-(p ** -mpf("1.5"))) / 3)
        y_0 = (m_f * y - 1) / h if h else y_f + s
        return rupture, y_0 + h * y_0**2 / 2


# --- pitois2000 -------------------------------------------------------------------------------------------------------


def pitois2000_damping(D, V, theta1, theta2, kappa1, kappa2):
    """Pitois et al. (2000), the lubrication force less what the liquid beyond the edge of the bridge would add."""
    return 3 * pi / (2 * D) * (1 - 1 / sqrt(1 + 2 * V / (pi * D**2))) ** 2 if D > 0 else nan


class Oracle(NamedTuple):
    """What a law gives, in 40 digits."""

    force: Any = None
    rupture: Any = None
    rupture_work: Any = None
    damping: Any = None


ORACLES = {
    "zhao2020": Oracle(in_40_digits(zhao2020_force), in_40_digits(zhao2020_rupture)),
    "toroidal2020": Oracle(in_40_digits(toroidal2020_force), in_40_digits(toroidal2020_rupture)),
    "asymptotic_rupture": Oracle(None, in_40_digits(asymptotic_rupture_rupture)),
    "pendular2026": Oracle(
        lambda *point: float(pendular2026(*point)[1]), lambda *pair: float(pendular2026(0, *pair)[0])
    ),
    "pitois2000": Oracle(damping=in_40_digits(pitois2000_damping)),
    "asymptotic": Oracle(in_40_digits(asymptotic_force), in_40_digits(asymptotic_rupture_of_pair)),
} | {name: Oracle(*(in_40_digits(of_kernel_arguments(name, i)) for i in range(3))) for name in FORMULAS}
