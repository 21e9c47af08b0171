"""Carlson's symmetric elliptic integrals, the two that a meridian needs, from one duplication sequence."""

import math

from .._jit import kernel

# The truncated series below err by about spread^8.
_SPREAD = 0.01
_MAX_DUPLICATIONS = 600  # every step divides the spread by four: enough for any pair of doubles


@kernel
def carlson_fd(x: float, y: float, z: float) -> tuple[float, float]:
    r"""Carlson's integrals of the first and second kind, :math:`R_F(x,y,z)` and :math:`R_D(x,y,z)`.

    .. math:: R_F = \tfrac12 \int_0^\infty \frac{dt}{\sqrt{(t+x)(t+y)(t+z)}}, \qquad
              R_D = \tfrac32 \int_0^\infty \frac{dt}{(t+z)\sqrt{(t+x)(t+y)(t+z)}}

    Parameters
    ----------
    x, y : float
        Non-negative arguments, at most one of them zero.
    z : float
        Positive argument, the distinguished one of :math:`R_D`.

    Returns
    -------
    rf, rd : float
        Both integrals; relative error a few units in the last place.

    Notes
    -----
    The two share their arguments, hence every square root of the duplication. Series: DLMF 19.36.1-2.

    References
    ----------
    .. [1] B. C. Carlson, Numer. Algorithms 10 (1995) 13, doi 10.1007/BF02198293.

    Examples
    --------
    >>> rf, rd = carlson_fd(1.0, 2.0, 3.0)
    >>> round(rf, 12), round(rd, 12)
    (0.726945935469, 0.290460281029)
    """
    weight = 1.0
    tail = 0.0
    for _ in range(_MAX_DUPLICATIONS):
        mean = (x + y + z) / 3.0
        if max(abs(mean - x), abs(mean - y), abs(mean - z)) < _SPREAD * mean:
            break
        root_x, root_y, root_z = math.sqrt(x), math.sqrt(y), math.sqrt(z)
        shift = root_x * (root_y + root_z) + root_y * root_z
        tail += weight / (root_z * (z + shift))
        weight *= 0.25
        x = 0.25 * (x + shift)
        y = 0.25 * (y + shift)
        z = 0.25 * (z + shift)

    mean = (x + y + z) / 3.0
    dx, dy = 1.0 - x / mean, 1.0 - y / mean
    dz = -dx - dy
    e2 = dx * dy - dz * dz
    e3 = dx * dy * dz
    rf = (
        1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0 - 3.0 * e2 * e3 / 44.0
        - 5.0 * e2 * e2 * e2 / 208.0 + 3.0 * e3 * e3 / 104.0 + e2 * e2 * e3 / 16.0
    ) / math.sqrt(mean)  # fmt: skip

    mean = (x + y + 3.0 * z) / 5.0
    dx, dy = 1.0 - x / mean, 1.0 - y / mean
    dz = -(dx + dy) / 3.0
    xy, zz = dx * dy, dz * dz
    e2 = xy - 6.0 * zz
    e3 = (3.0 * xy - 8.0 * zz) * dz
    e4 = 3.0 * (xy - zz) * zz
    e5 = xy * zz * dz
    rd = (
        1.0 - 3.0 * e2 / 14.0 + e3 / 6.0 + 9.0 * e2 * e2 / 88.0 - 3.0 * e4 / 22.0 - 9.0 * e2 * e3 / 52.0
        + 3.0 * e5 / 26.0 - e2 * e2 * e2 / 16.0 + 3.0 * e3 * e3 / 40.0 + 3.0 * e2 * e4 / 20.0
        + 45.0 * e2 * e2 * e3 / 272.0 - 9.0 * (e3 * e4 + e2 * e5) / 68.0
    ) * weight / (mean * math.sqrt(mean)) + 3.0 * tail  # fmt: skip
    return rf, rd
