"""A root between two places; SciPy has many more, and weighs a hundred megabytes."""

from collections.abc import Callable

__all__ = ["root_between"]


def root_between(function: Callable[[float], float], low: float, high: float, tolerance: float) -> float:
    """Place where a function changes its sign, by bisection or, where it is trusted, inverse parabola.

    Parameters
    ----------
    function : callable
        Of one number; it may jump over zero.
    low, high : float
        The function has different signs there.
    tolerance : float
        Width of the interval that is enough; rounding sets the least.

    Returns
    -------
    float
        The end, of an interval so narrow, at which the function is nearer to zero.

    References
    ----------
    .. [1] Chandrupatla, Advances in Engineering Software 28 (1997) 145, doi:10.1016/S0965-9978(96)00051-8.

    Examples
    --------
    >>> round(root_between(lambda x: x * x - 2.0, 0.0, 2.0, 1e-15), 12)
    1.414213562373
    """
    a, b, share = high, low, 0.5
    at_a, at_b = function(a), function(b)
    if at_a * at_b > 0.0:
        raise ValueError(f"low, high: the function has one sign at {low:g} and {high:g}")
    while True:
        x = a + share * (b - a)
        at_x = function(x)
        if (at_x > 0.0) == (at_a > 0.0):
            c, at_c = a, at_a
        else:
            c, b, at_c, at_b = b, a, at_b, at_a
        a, at_a = x, at_x
        best, at_best = (a, at_a) if abs(at_a) < abs(at_b) else (b, at_b)
        least = (2.0 * abs(best) * 1.2e-16 + 0.5 * tolerance) / abs(b - a) if b != a else 1.0
        if least > 0.5 or at_best == 0.0:
            return best
        xi, phi = (a - b) / (c - b), (at_a - at_b) / (at_c - at_b)
        if phi * phi < xi and (1.0 - phi) ** 2 < 1.0 - xi:
            share = at_a / (at_b - at_a) * at_c / (at_b - at_c)
            share += (c - a) / (b - a) * at_a / (at_c - at_a) * at_b / (at_c - at_b)
        else:
            share = 0.5
        share = min(1.0 - least, max(least, share))
