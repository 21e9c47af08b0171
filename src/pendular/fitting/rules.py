"""The numbers of the method, in one place: the page fits by them as well, in a browser.

Lengths are over the length of the curve and forces over the largest of it, where nothing else is said.
"""

import math
from typing import Any, Literal

__all__ = [
    "AT_BOUND",
    "BOUND_MET",
    "CLEAR_JUMP",
    "FARTHEST",
    "FARTHEST_LINEAR",
    "FARTHEST_OFFSET",
    "FAR_BEYOND",
    "FEW",
    "FIRST_ERROR",
    "HUMIDITIES",
    "INSIDE",
    "INSTRUMENT",
    "JUST_TOUCHING",
    "LEAST_ERROR",
    "LEAST_LEFT",
    "LEAST_ROOM",
    "LIKELY",
    "LOSSES",
    "MOST_ROUNDS",
    "NEARLY",
    "NEAR_ZERO",
    "NOT_FIXED",
    "OF_MEDIAN",
    "OF_UNIFORM",
    "PLANES_APART",
    "POLISH",
    "SAME",
    "SCAN",
    "SEED",
    "SETTLED",
    "SINGULAR",
    "SLIGHT",
    "SPREAD",
    "STARTS",
    "STEEP",
    "STEP",
    "STRAIGHT",
    "SURE",
    "TOUCHING",
    "UNITS",
    "VALLEY",
    "WETS",
    "Loss",
]

# What may be free, and its unit.
UNITS = {
    "contact_angle": "rad",
    "contact_angle1": "rad",
    "contact_angle2": "rad",
    "volume": "m^3",
    "suction": "Pa",
    "humidity": "",
    "surface_tension": "N/m",
    "radius": "m",
    "radius1": "m",
    "radius2": "m",
    "offset": "m",
    "force_zero": "N",
    "force_scale": "",
    "base_slope": "N/m",
    "evaporation_rate": "m^3/s",
}
INSTRUMENT = {"offset": 0.0, "force_zero": 0.0, "force_scale": 1.0, "base_slope": 0.0, "evaporation_rate": 0.0}

# Where a value may lie.
FARTHEST = 1e3  # of a positive number from its guess, as a factor
FARTHEST_LINEAR, FARTHEST_OFFSET = 100.0, 10.0  # in the scale of a linear one
JUST_TOUCHING = 0.99  # of the deepest overlap, to which an offset may go
HUMIDITIES = (1e-6, 1.0 - 1e-12)
PLANES_APART = 1e-3  # separation of two planes, to which one may go
BOUND_MET = 1e-6  # of the width between two bounds
WETS = 1.0 - 1e-12  # cosine of an angle of nothing
STRAIGHT = math.pi * (1.0 - 1e-9)  # largest contact angle
INSIDE = 1.01  # factor from the ends of the domain of the solver, for differences

# The curve.
STEEP = 100.0  # force over length, by which a curve beyond the rupture of its model is judged
CLEAR_JUMP = 6.0  # drop of the force over the median of drops that is a rupture
OF_UNIFORM = math.sqrt(12.0)
STEP = 1e-4  # of a variable, for rates by differences
TOUCHING = 1e-3  # way beyond rupture that is none
LEAST_LEFT = 1e-3  # of a volume that evaporates

# The search.
Loss = Literal["linear", "soft_l1", "huber", "cauchy"]
LOSSES: dict[Loss, float] = {
    "linear": 1.0,
    "soft_l1": 1.5,
    "huber": 1.345,
    "cauchy": 2.385,
}  # errors that count in full
STARTS, SEED = 5, 20360
SPREAD = {"log": 1.5, "humidity": 1.5, "linear": 0.1}  # of starts, in the variable
FEW = 12  # points on which starts are tried
NEARLY, SLIGHT = 3.0, 20.0  # times the least loss, and more, up to which another place may be the best on all points
SAME = 0.03  # difference of the variables of two places that are one
SCAN: dict[str, Any] = {"xtol": 1e-4, "ftol": 1e-4, "gtol": 1e-6, "max_nfev": 15}
POLISH: dict[str, Any] = {"xtol": 1e-9, "ftol": 1e-11, "gtol": 1e-10, "max_nfev": 200}

# Errors of the forces that their residuals tell.
MOST_ROUNDS, SETTLED = 20, 1e-3  # of the error
FIRST_ERROR, LEAST_ERROR = 0.02, 1e-12
OF_MEDIAN = 1.4826  # standard deviation of normal numbers over the median of their sizes

# Errors of what is found.
VALLEY = 0.98  # correlation from which on the data hardly tell two unknowns apart
SINGULAR = 1e-5  # singular value of scaled columns, over the largest, that is rounding and differences
LEAST_ROOM = 0.05  # of a difference, in standard errors
NOT_FIXED = 1e-2  # part of an unknown in a direction in which nothing changes, from which on it is not fixed
NEAR_ZERO = 2.0  # standard errors of a cosine within which an angle may be 0
AT_BOUND = 1e-2  # standard errors of a cosine that is at its bound
FAR_BEYOND = 5.0  # standard errors of a cosine beyond it
LIKELY, SURE = 0.6827, 0.95
