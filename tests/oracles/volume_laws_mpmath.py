"""The laws at constant volume once more, and the limits for small bridges, in the variables of their sources.

Each formula takes lengths, not reduced ones: the gap D, the volume V, one contact angle and both radii, with a surface
tension of 1. ``FORMULAS[name]`` is (force, rupture distance, rupture work), with None for what a law does not give, and
the rule by which two contact angles become one.
"""

from mpmath import acos, asin, cos, exp, inf, log, mpf, nan, pi, sin, sqrt, tan

MEAN_RADIUS = mpf(3)  # any length but 1 will do


def one_angle(theta1, theta2, *_):
    """Contact angle of a law that knows only one."""
    return theta1 if theta1 == theta2 else nan


def mean_angle(theta1, theta2):
    return (theta1 + theta2) / 2


def mean_cosine(theta1, theta2):
    return acos((cos(theta1) + cos(theta2)) / 2)


def derjaguin(R1, R2):
    return 2 / (1 / R1 + 1 / R2)


def until(rupture, D, force):
    return mpf(0) if rupture < D else force()


# --- willett2000 and the laws that use its rupture distance -----------------------------------------------------------

# Rows to be multiplied by (1, θ, θ²), one for each power of ln V*.
F1 = """-0.44507  0.050832  -1.1466
        -0.1119   -0.000411  -0.1490
        -0.012101 -0.0036456 -0.01255
        -0.0005   -0.0003505 -0.00029076"""
F2 = """1.9222 -0.57473 -1.2918
        -0.0668 -0.1201 -0.22574
        -0.0013375 -0.0068988 -0.01137"""
F3 = """1.268 -0.01396 -0.23566
        0.198 0.092 -0.06418
        0.02232 0.02238 -0.009853
        0.0008585 0.001318 -0.00053"""
F4 = """-0.010703 0.073776 -0.34742
        0.03345 0.04543 -0.09056
        0.0018574 0.004456 -0.006257"""


def polynomial(table, L, theta):
    rows = [[mpf(number) for number in row.split()] for row in table.splitlines()]
    return sum(c * theta**j * L**i for i, row in enumerate(rows) for j, c in enumerate(row))


def willett2000_rupture(V, theta, R1, R2):
    """Eq. (16)."""
    R = derjaguin(R1, R2)
    v, r = V / R**3, min(R1, R2) / max(R1, R2)
    return R * (1 + theta / 4 * (1 + r)) * (v ** (mpf(1) / 3) + (r / 2 - mpf(2) / 5) * v ** (mpf(2) / 3))


def willett2000_force(D, V, theta, R1, R2):
    R = derjaguin(R1, R2)
    f1, f2, f3, f4 = (polynomial(table, log(V / R**3), theta) for table in (F1, F2, F3, F4))

    def force():
        if D == 0:
            return 2 * pi * R * exp(f1)
        s = log(D / 2 / sqrt(V / R))
        return 2 * pi * R * exp(f1 - f2 * exp(f3 * s + f4 * s**2))

    return until(willett2000_rupture(V, theta, R1, R2), D, force)


def willett2000_simple_force(D, V, theta, R1, R2):
    """Eqs. (12) and (13)."""
    R = derjaguin(R1, R2)
    s = D / 2 / sqrt(V / R)
    force = 2 * pi * R * cos(theta) / (1 + mpf("2.1") * s + 10 * s**2)
    return until(willett2000_rupture(V, theta, R1, R2), D, lambda: force)


def willett2000_equal(V, theta, R1, R2):
    """Eq. (15)."""
    R = derjaguin(R1, R2)
    v = V / R**3
    return R * (1 + theta / 2) * (v ** (mpf(1) / 3) + mpf("0.1") * v ** (mpf(2) / 3))


def lian_seville2016_force(D, V, theta, R1, R2):
    R = derjaguin(R1, R2)
    v, rupture = V / R**3, willett2000_equal(V, theta, R1, R2)
    alpha = v ** mpf("0.26") + (mpf("0.285") - mpf("0.4594") * theta) * v ** (mpf("0.6327") + mpf("0.897") * theta)
    s = D / rupture * (1 + theta / 2 * cos(theta) * cos(alpha + theta))
    above = (2 * pi - mpf("2.082") * alpha ** mpf("0.9197")) * (
        cos(theta) - mpf("0.16") * alpha * (1 + alpha) * tan(theta)
    )
    below = 1 + mpf("0.8438") * alpha ** mpf("-0.724") * s + mpf("1.3393") * alpha ** mpf("-1.459") * s**2
    return until(rupture, D, lambda: R * above / below)


def bagheri2024_force(D, V, theta, R1, R2):
    R = derjaguin(R1, R2)
    v, rupture = V / R**3, willett2000_equal(V, theta, R1, R2)
    L, s = log(v), D / rupture
    f0 = 2 * pi * (1 - mpf("0.3823") * v ** mpf("0.2586"))
    a = mpf("0.4158") * v ** mpf("0.2835") + mpf("0.6474")
    b = mpf("-0.2087") * v ** mpf("0.3113") + mpf("2.267")
    ft = f0 * (1 - a * (sin(theta) ** b if theta else 0))
    alpha_s = mpf("-0.3319") * v ** mpf("0.4974") + mpf("0.6717") * v ** mpf("0.1995")
    beta_s = mpf("13.84") * v ** mpf("-0.3909") - mpf("12.11") * v ** mpf("-0.3945")
    alpha_t = (mpf("-0.007815") * L**2 - mpf("0.2105") * L - mpf("1.426")) * theta**3
    alpha_t += (mpf("-1.78") * v ** mpf("0.8351") + mpf("0.6669") * v ** mpf("-0.01391")) * theta + 1
    force = R * ft * (1 + alpha_s * s) / (1 + alpha_t * beta_s * alpha_s * s + alpha_t * beta_s * s**2)
    return until(rupture, D, lambda: force)


# --- lian1993, mikami1998, soulie2006 ---------------------------------------------------------------------------------


def lian1993_rupture(V, theta, R1, R2):
    return (1 + theta / 2) * V ** (mpf(1) / 3)


def mikami1998_rupture(V, theta, R1, R2):
    if max(R1, R2) == inf:
        R = min(R1, R2)
        return R * (mpf("0.95") + mpf("0.22") * theta) * (V / R**3) ** mpf("0.32")
    R = derjaguin(R1, R2)
    return R * (mpf("0.99") + mpf("0.62") * theta) * (V / R**3) ** mpf("0.34")


def mikami1998_force(D, V, theta, R1, R2):
    if theta != 0 or max(R1, R2) == inf:
        return nan
    R = derjaguin(R1, R2)
    v = V / R**3
    A, B, C = mpf("-1.1") * v ** mpf("-0.53"), mpf("-0.0082") * log(v) + mpf("0.48"), mpf("0.0018") * log(v)
    force = pi * R * (exp(A * D / R + B) + C + mpf("0.078"))
    return until(mikami1998_rupture(V, theta, R1, R2), D, lambda: force)


def soulie2006_force(D, V, theta, R1, R2):
    small, large = sorted((R1, R2))
    if large == inf:
        return nan
    v = V / large**3
    a = mpf("-1.1") * v ** mpf("-0.53")
    b = (mpf("-0.148") * log(v) - mpf("0.96")) * theta**2 - mpf("0.0082") * log(v) + mpf("0.48")
    c = mpf("0.0018") * log(v) + mpf("0.078")
    return pi * sqrt(small * large) * (c + exp(a * D / large + b))


# --- lambert2008, rabinovich2005, weigert1999 -------------------------------------------------------------------------


def lambert2008_force(D, V, theta, R1, R2):
    R = derjaguin(R1, R2)
    return 2 * pi * R * cos(theta) * (1 - D / sqrt(D**2 + 2 * V / (pi * R)))


def rabinovich2005_force(D, V, theta, R1, R2):
    """Eqs. (19), (20) and (A3)."""
    R = derjaguin(R1, R2)
    if D == 0:
        first, a = cos(theta), (2 * V / (pi * R**3)) ** (mpf(1) / 4)
    else:
        bracket = sqrt(1 + 2 * V / (pi * R * D**2)) - 1
        d = D / 2 * bracket
        first, a = cos(theta) / (1 + D / (2 * d)), sqrt(D / R * bracket)
    return 2 * pi * R * (first + sin(a) * sin(a + theta))


def weigert1999_force(D, V, theta, R1, R2):
    """Eqs. (5), (6), (15) to (17), (21) and (22)."""
    R = derjaguin(R1, R2)
    power = V / (mpf("0.12") * (2 * R) ** 3 * (1 + 6 * D / (2 * R)) * (1 + mpf("1.1") * sin(theta)))
    b = asin(power ** (mpf(1) / 4)) if power < 1 else nan
    r1 = (2 * R * (1 - cos(b)) + D) / (2 * cos(b + theta))
    r2 = R * sin(b) + r1 * (sin(b + theta) - 1)
    if not (b + theta < pi / 2 and r2 > 0):
        return nan
    return pi * R**2 * sin(b) ** 2 * (1 / r1 - 1 / r2) + 2 * pi * R * sin(b) * sin(b + theta)


# --- limits of small bridges ------------------------------------------------------------------------------------------


def contact_limit_force(D, H, theta, R1, R2):
    """4π times half the Derjaguin radius."""
    return 4 * pi * (1 / (1 / R1 + 1 / R2)) * cos(theta) if D == 0 else nan


def deboer2008_work(H, theta, R1, R2):
    R = derjaguin(R1, R2)
    return 2 * pi * R**2 * cos(theta) ** 2 / (H * R)


def deboer2008_volume_work(V, theta, R1, R2):
    return 2 * cos(theta) * sqrt(2 * pi * derjaguin(R1, R2) * V)


FORMULAS = {
    "willett2000": (willett2000_force, willett2000_rupture, None, one_angle),
    "willett2000_simple": (willett2000_simple_force, willett2000_rupture, None, one_angle),
    "lian1993": (None, lian1993_rupture, None, mean_angle),
    "mikami1998": (mikami1998_force, mikami1998_rupture, None, one_angle),
    "soulie2006": (soulie2006_force, None, None, one_angle),
    "rabinovich2005": (rabinovich2005_force, None, None, mean_angle),
    "lambert2008": (lambert2008_force, None, None, mean_cosine),
    "weigert1999": (weigert1999_force, None, None, one_angle),
    "lian_seville2016": (lian_seville2016_force, willett2000_equal, None, one_angle),
    "bagheri2024": (bagheri2024_force, willett2000_equal, None, one_angle),
    "contact_limit": (contact_limit_force, None, None, mean_cosine),
    "deboer2008": (None, None, deboer2008_work, mean_cosine),
    "deboer2008_volume": (None, None, deboer2008_volume_work, mean_cosine),
}
AT_CONSTANT_SUCTION = ("contact_limit", "deboer2008")


def of_kernel_arguments(name, quantity):
    """Formula with the arguments and unit of the kernel for the force (0), rupture (1) or rupture work (2)."""
    formula, angle = FORMULAS[name][quantity], FORMULAS[name][3]
    if formula is None:
        return None
    unit_of_control = 1 / MEAN_RADIUS if name in AT_CONSTANT_SUCTION else MEAN_RADIUS**3
    unit = (2 * pi * MEAN_RADIUS, MEAN_RADIUS, 2 * pi * MEAN_RADIUS**2)[quantity]

    def reduced(*arguments):
        *gap, control, theta1, theta2, kappa1, kappa2 = arguments
        radii = (MEAN_RADIUS / kappa if kappa else inf for kappa in (kappa1, kappa2))
        lengths = (star * MEAN_RADIUS for star in gap)
        return formula(*lengths, control * unit_of_control, angle(theta1, theta2), *radii) / unit

    return reduced
