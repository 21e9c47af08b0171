r"""Axisymmetric bridges between two solids, straight from the Young-Laplace equation, to any number of digits.

Nothing here is shared with the library. The meridian obeys, in arc length ``s``,

.. math:: X' = \cos\phi, \quad Y' = \sin\phi, \quad \phi' = H + \cos\phi / Y .

For :math:`\zeta = Y e^{i\phi}` this is the linear equation :math:`\zeta' = i (1 + H \zeta)`, hence

.. math:: \zeta(s) = \zeta_1 e^{iHs} + (e^{iHs} - 1)/H .

An arc starts at the contact circle on solid 1, runs for a length ``s`` and must arrive on solid 2 at the contact angle.
Lengths, volume and areas are integrals along that one arc, by tanh-sinh quadrature on the pieces between its extrema:
necks and bulges inside or outside, inflections, cylinders and half-immersed spheres are no special cases.

Surface tension is 1: ``suction`` is H, the axial force is ``2 pi force`` (force is the lambda of the literature).
Every function takes its arithmetic from the bridge: `EXACT` has 40 digits, `DOUBLE` is fast and serves to follow
branches and to check numbers that are printed with a few digits.
"""

from dataclasses import dataclass, replace
from functools import cache
from itertools import pairwise
from typing import Any, NamedTuple

from mpmath import MPContext, fp
from mpmath.calculus.quadrature import TanhSinh

EXACT = MPContext()
EXACT.dps = 40
DOUBLE = fp

_FINEST_LEVEL = 11


class Solid(NamedTuple):
    """A sphere, or a plane (infinite radius), with its contact angle in radians."""

    radius: float
    angle: float


class Contact(NamedTuple):
    """The contact circle on a solid and the cap it cuts off."""

    radius: Any
    filling_angle: Any
    slope: Any
    cap_height: Any
    cap_volume: Any
    wetted_area: Any


@dataclass(frozen=True)
class Bridge:
    """An arc of a surface of constant mean curvature between two solids.

    Attributes
    ----------
    ctx : mpmath context
        `EXACT` or `DOUBLE`.
    solids : tuple of Solid
    reach : tuple
        Distance from the apex of each solid to its contact circle, along the solid: R delta, on a plane the radius.
    suction : number
        H, gas minus liquid pressure over surface tension.
    length : number
        Of the meridian between the contact circles.
    """

    ctx: Any
    solids: tuple[Solid, Solid]
    reach: tuple[Any, Any]
    suction: Any
    length: Any

    @property
    def symmetric(self) -> bool:
        """Equal solids with equal contact circles: the arc is its own mirror image."""
        return self.solids[0] == self.solids[1] and self.reach[0] == self.reach[1]

    @property
    def cylindrical(self) -> bool:
        """The circle on which 1 + H zeta turns has shrunk to rounding."""
        return abs(1 + self.suction * self.start) < self.ctx.mpf(2) ** (8 - self.ctx.prec)

    @property
    def contacts(self) -> tuple[Contact, Contact]:
        """Both contact circles."""
        return tuple(contact(self.ctx, solid, reach) for solid, reach in zip(self.solids, self.reach, strict=True))

    @property
    def start(self):
        """Y exp(i phi) at contact 1, in the direction of travel: the slope out of the liquid changes its sign."""
        first = contact(self.ctx, self.solids[0], self.reach[0])
        return first.radius * self.ctx.expj(-first.slope)

    @property
    def force(self):
        """Axial force over 2 pi, constant along the meridian; taken at contact 1."""
        first = contact(self.ctx, self.solids[0], self.reach[0])
        return _axial_force(self.ctx, first, self.suction)


class State(NamedTuple):
    """What a bridge amounts to; `neck_radius` is negative where the meridian belongs to a nodoid's outer arc."""

    gap: Any
    volume: Any
    force: Any
    area: Any
    wetted_areas: tuple[Any, Any]
    neck_radius: Any
    neck_inside: bool
    bulge_inside: bool
    energy: Any
    n11: Any
    n33: Any


def contact(ctx, solid: Solid, reach) -> Contact:
    """Contact circle at a distance `reach` from the apex, measured along the solid."""
    k, angle = 1 / ctx.mpf(solid.radius), ctx.mpf(solid.angle)
    delta = k * reach
    radius = reach * ctx.sinc(delta)
    chord = reach * ctx.sinc(delta / 2)
    height = k * chord**2 / 2
    return Contact(
        radius=radius,
        filling_angle=delta,
        slope=ctx.pi / 2 - delta - angle,
        cap_height=height,
        cap_volume=ctx.pi * height * (3 * radius**2 + height**2) / 6,
        wetted_area=ctx.pi * chord**2,
    )


def _axial_force(ctx, circle: Contact, suction):
    return circle.radius * ctx.cos(circle.slope) + suction * circle.radius**2 / 2


def point(ctx, start, suction, s):
    """Zeta a length `s` after `start`; (exp(iHs) - 1)/H is written so that it holds at H = 0."""
    half = suction * s / 2
    return start * ctx.expj(2 * half) + 1j * s * ctx.sinc(half) * ctx.expj(half)


def extrema(bridge: Bridge) -> tuple[list, list]:
    """Arc lengths of the necks and of the bulges strictly inside the arc.

    1 + H zeta turns at the rate H on a circle of radius q; necks lie at the phase 0, bulges at pi.
    """
    ctx, suction = bridge.ctx, bridge.suction
    start = bridge.start
    if bridge.cylindrical:
        return [], []
    if suction == 0:
        places = ([-start.imag], [])
    else:
        phase = ctx.atan2(suction * start.imag, 1 + suction * start.real)
        places = tuple([(turn * ctx.pi - phase) / suction for turn in turns] for turns in ((-2, 0, 2), (-3, -1, 1, 3)))
    return tuple([s for s in found if 0 < s < bridge.length] for found in places)


@cache
def _rule(ctx) -> TanhSinh:
    return TanhSinh(ctx)


def _piece(ctx, densities, a, b) -> list:
    """Integrals of all densities from a to b, doubling the nodes until they are stable to the working precision.

    The last density is left out of the test: the squared axial normal is mere rounding on a cylinder, and as smooth as
    the others elsewhere.
    """
    middle, half = (a + b) / 2, (b - a) / 2
    tolerance = ctx.mpf(2) ** (9 - ctx.prec)
    sums = sizes = None
    for level in range(1, _FINEST_LEVEL):
        nodes = _rule(ctx).get_nodes(-1, 1, level, ctx.prec)
        terms = [[weight * value for value in densities(middle + half * x)] for x, weight in nodes]
        added = [ctx.fsum(column) for column in zip(*terms, strict=True)]
        added_sizes = [ctx.fsum(column, absolute=True) for column in zip(*terms, strict=True)]
        if sums is None:
            sums, sizes = added, added_sizes
            continue
        # A level halves the step: twice the mean of the new nodes is what the old ones said of the integral.
        changes = [abs(new - old) for new, old in zip(added, sums, strict=True)]
        sums = [new + old for new, old in zip(added, sums, strict=True)]
        sizes = [new + old for new, old in zip(added_sizes, sizes, strict=True)]
        if all(change <= tolerance * size for change, size in zip(changes[:-1], sizes[:-1], strict=True)):
            return [total * half / 2**level for total in sums]
    raise ArithmeticError("the quadrature along the meridian did not converge")


def arc_integrals(bridge: Bridge) -> list:
    """Length along the axis, volume of revolution, area, and n33, the integral of the squared axial normal."""
    ctx, start, suction = bridge.ctx, bridge.start, bridge.suction

    def densities(s):
        zeta = point(ctx, start, suction, s)
        y = abs(zeta)
        return zeta.real / y, ctx.pi * zeta.real * y, 2 * ctx.pi * y, 2 * ctx.pi * zeta.imag**2 / y

    necks, bulges = extrema(bridge)
    ends = [ctx.zero, *sorted(necks + bulges), bridge.length]
    pieces = [_piece(ctx, densities, a, b) for a, b in pairwise(ends)]
    return [ctx.fsum(column) for column in zip(*pieces, strict=True)]


def state(bridge: Bridge) -> State:
    """Evaluate everything that is known of a bridge."""
    ctx = bridge.ctx
    first, second = bridge.contacts
    span, revolution, area, n33 = arc_integrals(bridge)
    force = bridge.force
    necks, bulges = extrema(bridge)
    wetted = (first.wetted_area, second.wetted_area)
    adhesion = ctx.fsum(ctx.cos(ctx.mpf(solid.angle)) * a for solid, a in zip(bridge.solids, wetted, strict=True))
    return State(
        gap=span - first.cap_height - second.cap_height,
        volume=revolution - first.cap_volume - second.cap_volume,
        force=force,
        area=area,
        wetted_areas=wetted,
        neck_radius=2 * force / (1 + abs(1 + bridge.suction * bridge.start)),
        neck_inside=bool(necks),
        bulge_inside=bool(bulges),
        energy=area - adhesion,
        n11=(area - n33) / 2,
        n33=n33,
    )


def landings(ctx, solid: Solid, suction, force) -> list:
    """Find the contact circles of a surface on a solid, the smaller filling angle first, as distances from the apex.

    With x = k cot(delta), the force at the contact is a quadratic in x: force x^2 - sin(angle) x = k cos(angle) + H/2 -
    k^2 force. Its second root is written as a product to keep its digits.
    """
    k, angle = 1 / ctx.mpf(solid.radius), ctx.mpf(solid.angle)
    sine = ctx.sin(angle)
    product = k * ctx.cos(angle) + suction / 2 - k * k * force
    discriminant = sine**2 + 4 * force * product
    if discriminant < 0:
        return []
    larger = sine + ctx.sqrt(discriminant)
    cotangents = [larger / (2 * force), -2 * product / larger]
    if k == 0:
        return sorted(1 / x for x in cotangents if x > 0)
    return sorted(ctx.atan2(k, x) / k for x in cotangents)


def _arc_length(ctx, suction, start, end):
    """Shortest way along the surface from one of its points to another, in the direction of travel; None if none."""
    # Imaginary and real part of (1 + H end) conj(1 + H start), the first over H.
    turned = (end - start).imag + suction * (end * start.conjugate()).imag
    if suction == 0:
        return turned if turned > 0 else None
    turn = ctx.atan2(suction * turned, ((1 + suction * end) * (1 + suction * start).conjugate()).real)
    if turn * suction < 0:
        turn += 2 * ctx.pi * ctx.sign(suction)
    return turn / suction


def connect(ctx, solids, suction, reach, second_reach=None) -> Bridge | None:
    """Bridge of given suction that leaves solid 1 at a given contact circle.

    Parameters
    ----------
    solids : tuple of Solid
    suction, reach : number
    second_reach : number, optional
        Rough position of the contact circle on solid 2; the nearer of the two possible ones is taken. Without it, the
        smaller one, and for equal solids the mirror image of the first.

    Returns
    -------
    Bridge or None
        None if the surface does not meet solid 2 at its contact angle.
    """
    suction, reach = ctx.mpf(suction), ctx.mpf(reach)
    bridge = Bridge(ctx, solids, (reach, reach), suction, ctx.zero)
    mirrored = second_reach is None or abs(second_reach - reach) <= 1e-9 * reach
    if not (solids[0] == solids[1] and mirrored):
        choices = landings(ctx, solids[1], suction, bridge.force)
        if not choices:
            return None
        chosen = choices[0] if second_reach is None else min(choices, key=lambda r: abs(r - second_reach))
        bridge = replace(bridge, reach=(reach, chosen))
    second = bridge.contacts[1]
    length = _arc_length(ctx, suction, bridge.start, second.radius * ctx.expj(second.slope))
    return None if length is None else replace(bridge, length=length)


def cylinder(ctx, solid: Solid, length) -> Bridge:
    """Cylindrical bridge of given length between two equal spheres, where the phase says nothing."""
    reach = (ctx.pi / 2 - ctx.mpf(solid.angle)) * ctx.mpf(solid.radius)
    return Bridge(ctx, (solid, solid), (reach, reach), -1 / contact(ctx, solid, reach).radius, ctx.mpf(length))


class Gradient(NamedTuple):
    """Derivatives with respect to relative changes of reach 1, suction (times length), length and reach 2.

    The two `closure` rows vanish on equilibria; they hold the tangents of the solution set.
    """

    closure: list
    suction: list
    gap: list
    volume: list
    force: list


def closure(bridge: Bridge) -> list:
    """How far the end of the arc is from its contact on solid 2; for a mirror image, from its own mirror plane."""
    ctx = bridge.ctx
    if bridge.symmetric:
        return [point(ctx, bridge.start, bridge.suction, bridge.length / 2).imag, ctx.zero]
    second = bridge.contacts[1]
    missed = point(ctx, bridge.start, bridge.suction, bridge.length) - second.radius * ctx.expj(second.slope)
    return [missed.real, missed.imag]


def _central_difference(ctx, function, x, scale) -> list:
    # Truncation and rounding balance at the cube root of the precision; both are then below 1e-24 in EXACT.
    step = scale * ctx.mpf(2) ** (-ctx.prec // 3)
    return [(up - down) / (2 * step) * scale for up, down in zip(function(x + step), function(x - step), strict=True)]


def gradient(bridge: Bridge) -> Gradient:
    """First derivatives of a bridge in the coordinates (reach 1, suction, length, reach 2), which are never singular.

    At a fold, at a cylinder or where the two contact circles of a solid merge, (force, suction) or (reach, suction)
    fail as coordinates; these four with two closure conditions do not.
    """
    ctx, length = bridge.ctx, bridge.length
    reach = bridge.reach
    symmetric = bridge.symmetric
    first, second = bridge.contacts

    def along(varied: Bridge) -> list:
        axial, revolution, *_ = arc_integrals(varied)
        aim = length / 2 if symmetric else length
        zeta = point(ctx, varied.start, varied.suction, aim)
        return [zeta.real, zeta.imag, axial, revolution, varied.force]

    by_reach = _central_difference(ctx, lambda r: along(replace(bridge, reach=(r, reach[1]))), reach[0], reach[0])
    by_suction = _central_difference(ctx, lambda h: along(replace(bridge, suction=h)), bridge.suction, 1 / length)
    end = point(ctx, bridge.start, bridge.suction, length)
    spin = 1j * (1 + bridge.suction * (point(ctx, bridge.start, bridge.suction, length / 2) if symmetric else end))
    rim = ctx.cos(second.filling_angle) - 1j * second.radius / ctx.mpf(bridge.solids[1].radius)
    rim *= ctx.expj(second.slope)
    caps = [reach_i * ctx.sin(c.filling_angle) for reach_i, c in zip(reach, (first, second), strict=True)]
    axial_rate = end.real / abs(end)
    if symmetric:
        closures = [[by_reach[1], by_suction[1], spin.imag * length / 2, ctx.zero], [-1, ctx.zero, ctx.zero, 1]]
    else:
        closures = [
            [by_reach[0], by_suction[0], spin.real * length, -rim.real * reach[1]],
            [by_reach[1], by_suction[1], spin.imag * length, -rim.imag * reach[1]],
        ]
    disc = ctx.pi * second.radius**2
    return Gradient(
        closure=closures,
        suction=[ctx.zero, 1 / length, ctx.zero, ctx.zero],
        gap=[by_reach[2] - caps[0], by_suction[2], axial_rate * length, -caps[1]],
        volume=[
            by_reach[3] - ctx.pi * first.radius**2 * caps[0],
            by_suction[3],
            disc * axial_rate * length,
            -disc * caps[1],
        ],
        force=[by_reach[4], by_suction[4], ctx.zero, ctx.zero],
    )


def force_slopes(bridge: Bridge, control: str) -> tuple:
    """Differentiate the force (over 2 pi) by the gap at fixed control, and by the control at fixed gap.

    Parameters
    ----------
    control : "suction" or "volume"
    """
    ctx, slopes = bridge.ctx, gradient(bridge)
    rows = [*slopes.closure, getattr(slopes, control), slopes.gap]
    scales = [max(abs(value) for value in row) for row in rows]
    matrix = ctx.matrix([[value / scale for value in row] for row, scale in zip(rows, scales, strict=True)])
    by_gap = ctx.lu_solve(matrix, ctx.matrix([0, 0, 0, 1 / scales[3]]))
    by_control = ctx.lu_solve(matrix, ctx.matrix([0, 0, 1 / scales[2], 0]))
    return ctx.fdot(slopes.force, by_gap), ctx.fdot(slopes.force, by_control)


def antisymmetric_mode_is_stable(bridge: Bridge) -> bool:
    """Whether a bridge between equal solids withstands the mirror-breaking axisymmetric mode at fixed volume."""
    ctx = bridge.ctx
    circle = bridge.contacts[0]
    angle = ctx.mpf(bridge.solids[0].angle)
    if bridge.cylindrical:
        # The neutral mode there is sin(x/Y); elsewhere it is the translation along the axis.
        return bridge.length / 2 < circle.radius * (ctx.pi - angle)
    bracket = ctx.sin(2 * circle.filling_angle + angle) + bridge.suction * circle.radius * ctx.cos(circle.filling_angle)
    necks, bulges = extrema(bridge)
    # The mirror plane itself holds an extremum; a second one means another half wave.
    return len(necks) + len(bulges) == 1 and ctx.sign(circle.slope) * bracket > 0
