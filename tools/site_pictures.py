"""Pictures of the theory pages, drawn from exact bridges of equal spheres with R = γ = 1.

They are as wide as their labels can still be read on a phone.
"""

from pathlib import Path

import numpy as np
from matplotlib import colormaps, rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Rectangle

import pendular as pl
from pendular.exact.algebra import Four
from pendular.exact.meridian import lay_meridian
from pendular.ground.colours import ACCENT, FAINT, GRAIN, GRAIN_EDGE, HAIR, INK, LIQUID, LIQUID_EDGE
from pendular.show.picture import draw_pair

UNIT = pl.Liquid(surface_tension=1.0)
GAP = 0.16  # of the sketch
STYLE = {  # of axes that have a layout of their own: as pendular.ground.look dresses all others
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": HAIR,
    "axes.labelcolor": FAINT,
    "axes.titlesize": 10,
    "axes.titlecolor": INK,
    "xtick.color": HAIR,
    "ytick.color": HAIR,
    "xtick.labelcolor": FAINT,
    "ytick.labelcolor": FAINT,
    "xtick.labelsize": 9,
    "ytick.labelsize": 9,
    "legend.frameon": False,
    "svg.fonttype": "path",
}


def draw_sketch(path: Path) -> None:
    """Draw a bridge with its angles and lengths."""
    angle = np.deg2rad(30)
    bridge = pl.bridge(pl.Pair(1.0, angle), GAP, suction=0.3, liquid=UNIT)
    shape = bridge.profile(401)
    drawing = Figure(figsize=(5.2, 3.4), layout="constrained")
    axes = drawing.subplots()
    axes.set(aspect="equal", xlim=(-1.1, 0.98), ylim=(-0.36, 1.0))
    axes.axis("off")
    axes.fill_between(shape.x, -shape.y, shape.y, color=LIQUID, lw=0)
    for solid in (0, 1):
        x, y = shape.solid_x[solid], shape.solid_y[solid]
        axes.fill_between(x, -y, y, color=GRAIN, ec=GRAIN_EDGE, lw=1.2)
    for side in (1, -1):
        axes.plot(shape.x, side * shape.y, color=LIQUID_EDGE, lw=2)
    axes.axhline(0.0, color=HAIR, lw=0.8, ls=(0, (8, 3, 2, 3)))
    _mark_left(axes, shape, float(bridge.half_filling_angle[0]), angle)
    _mark_right(axes, shape, bridge)
    drawing.savefig(path)


def _mark_left(axes: Axes, shape: pl.Profile, filling: float, angle: float) -> None:
    """Radius, half-filling angle and contact angle."""
    centre, contact = np.array([-1.0, 0.0]), np.array([shape.x[0], shape.y[0]])
    axes.plot(*np.column_stack([centre, contact]), color=INK, lw=1)
    axes.plot(*centre, "o", color=INK, ms=3)
    axes.annotate("$R$", (centre + contact) / 2, (-3, 7), textcoords="offset points", ha="center")
    axes.add_patch(Arc(centre, 0.5, 0.5, theta1=0, theta2=np.rad2deg(filling), color=INK))
    axes.annotate(r"$\delta$", centre + 0.31 * np.array([np.cos(filling / 2), np.sin(filling / 2)]), va="center")
    tangent = np.array([np.sin(filling), -np.cos(filling)])  # along the solid, into the liquid
    axes.plot(*np.column_stack([contact - 0.3 * tangent, contact + 0.34 * tangent]), color=ACCENT, lw=1)
    along = filling + angle  # the surface leaves the solid at this angle to the vertical
    surface = np.array([np.sin(along), -np.cos(along)])
    axes.plot(*np.column_stack([contact, contact + 0.34 * surface]), color=ACCENT, lw=1)
    low, high = np.rad2deg([filling, along]) - 90
    axes.add_patch(Arc(contact, 0.5, 0.5, theta1=low, theta2=high, color=ACCENT))
    middle = filling + angle / 2
    axes.annotate(r"$\theta$", contact + 0.18 * np.array([np.sin(middle), -np.cos(middle)]), color=ACCENT, va="center")


def _mark_right(axes: Axes, shape: pl.Profile, bridge: pl.Bridge) -> None:
    """Separation, neck radius and contact radius."""
    arrow = {"arrowstyle": "<->", "color": INK, "shrinkA": 0, "shrinkB": 0, "lw": 1}
    neck, end, contact = GAP / 2, shape.x[-1], float(bridge.contact_radius[1])
    axes.annotate("", (neck, 0.0), (neck, float(bridge.neck_radius)), arrowprops=arrow)
    axes.annotate("$Y_0$", (neck + 0.01, 0.04))
    axes.annotate("", (end, 0.0), (end, contact), arrowprops=arrow)
    axes.annotate("$Y_c$", (end + 0.02, contact / 2), va="center")
    axes.annotate("", (0.0, -0.12), (GAP, -0.12), arrowprops=arrow)
    axes.annotate("$D$", (GAP / 2, -0.15), ha="center", va="top")
    axes.annotate("", (0.52, -0.2), (0.84, -0.2), arrowprops={"arrowstyle": "->", "color": ACCENT, "lw": 2})
    axes.annotate("$F$", (0.87, -0.2), color=ACCENT, va="center")
    axes.annotate("suction\n" r"$\Delta p = p_{gas} - p_{liquid}$", (neck, 0.86), ha="center", color=FAINT)


def draw_four_numbers(path: Path) -> None:
    """Draw a bridge of two unequal solids with its four numbers, and its meridian in the plane of ζ."""
    pair = pl.Pair((1.0, 0.7), (np.deg2rad(20.0), np.deg2rad(70.0)))
    bridge = pl.bridge(pair, 0.45, volume=0.5, liquid=UNIT)
    radius, slope, length = bridge._meridian
    z = Four(np.log(radius), slope, np.log(length), bridge.suction * length)
    with rc_context(STYLE):
        drawing = Figure(figsize=(5.2, 6.4), layout="constrained")
        upper, lower = drawing.subplots(2, 1, height_ratios=(1, 1))
    _draw_middle(upper, bridge, z)
    _draw_circle(lower, z)
    drawing.savefig(path)


def _draw_middle(axes: Axes, bridge: pl.Bridge, z: Four) -> None:
    """Draw a bridge with the middle of its meridian."""
    shape = bridge.profile(401)
    half, step = 200, 12
    spot = np.array([shape.x[half], shape.y[half]])
    axes.set(aspect="equal", xlim=(-0.75, 1.2), ylim=(-0.12, 0.95))
    axes.axis("off")
    axes.fill_between(shape.x, 0.0, shape.y, color=LIQUID, lw=0)
    for solid in (0, 1):
        x, y = shape.solid_x[solid], shape.solid_y[solid]
        axes.fill_between(x, 0.0, y, color=GRAIN, ec=GRAIN_EDGE, lw=1.2)
    axes.plot(shape.x, shape.y, color=LIQUID_EDGE, lw=2.4)
    axes.axhline(0.0, color=HAIR, lw=0.8, ls=(0, (8, 3, 2, 3)))
    arrow = {"arrowstyle": "<->", "color": INK, "shrinkA": 0, "shrinkB": 0, "lw": 1}
    axes.annotate("", (spot[0], 0.0), tuple(spot), arrowprops=arrow)
    axes.annotate("$Y_m$", (spot[0] + 0.02, 0.42 * spot[1]), size=12)
    reach = 0.34
    axes.plot([spot[0], spot[0] + reach], [spot[1]] * 2, color=FAINT, lw=1)
    tangent = reach * np.array([np.cos(z.slope), np.sin(z.slope)])
    axes.plot(*np.column_stack([spot, spot + tangent]), color=ACCENT, lw=1.4)
    low, high = sorted((0.0, np.rad2deg(z.slope)))
    axes.add_patch(Arc(spot, 0.5, 0.5, theta1=low, theta2=high, color=ACCENT))
    axes.annotate(
        r"$\varphi_m$", (spot[0] + reach + 0.02, spot[1] + 0.5 * tangent[1]), color=ACCENT, size=12, va="center"
    )
    along = np.column_stack([np.gradient(shape.x), np.gradient(shape.y)])
    out = 0.06 * np.column_stack([-along[:, 1], along[:, 0]]) / np.hypot(*along.T)[:, None]
    line = np.column_stack([shape.x, shape.y]) - out
    for part, where in ((slice(step, half - step), half // 2), (slice(half + step, 401 - step), 3 * half // 2)):
        axes.plot(*line[part].T, color=FAINT, lw=1, ls=(0, (2, 2)))
        axes.annotate(r"$\ell$", line[where] - 0.9 * out[where], ha="center", va="center", size=12)
    axes.plot(*spot, "o", color=INK, ms=6)
    axes.set_title("middle of the meridian, and half its length")


def _draw_circle(axes: Axes, z: Four) -> None:
    """Draw a meridian in the plane of ζ, where it is an arc of a circle."""
    curvature = z.turn / np.exp(z.log_length)
    centre = -1.0 / curvature
    whole, part = np.linspace(0.0, 2.0 * np.pi, 361), np.linspace(-1.0, 1.0, 201)
    middle = np.exp(z.log_radius + 1j * z.slope)
    size = abs(middle - centre)
    axes.plot(centre + size * np.cos(whole), size * np.sin(whole), color=HAIR, lw=1, ls=(0, (4, 3)))
    zeta = centre + (middle - centre) * np.exp(1j * z.turn * part)
    axes.plot(zeta.real, zeta.imag, color=LIQUID_EDGE, lw=2.4)
    for end in (zeta[0], zeta[-1]):
        axes.plot([centre, end.real], [0.0, end.imag], color=FAINT, lw=0.9)
        axes.plot(end.real, end.imag, "o", color=LIQUID_EDGE, ms=5)
    axes.plot(middle.real, middle.imag, "o", color=INK, ms=6)
    axes.plot(centre, 0.0, "+", color=INK, ms=9)
    axes.set(aspect="equal", xlabel=r"$Y\cos\varphi$", ylabel=r"$Y\sin\varphi$")
    axes.axhline(0.0, color=INK, lw=0.8)
    axes.axvline(0.0, color=INK, lw=0.8)
    for crossing, name, place in ((centre - size, "neck", -6), (centre + size, "bulge", 6)):
        axes.plot(crossing, 0.0, "o", mfc="white", mec=FAINT, ms=5)
        spot = {"xytext": (place, 6), "textcoords": "offset points", "ha": "right" if place < 0 else "left"}
        axes.annotate(name, (crossing, 0.0), color=FAINT, **spot)
    axes.set_xlim(right=centre + 1.45 * size)
    axes.annotate("$-1/H$", (centre, 0.0), (6, -16), textcoords="offset points")
    axes.annotate(r"turned by $2\omega$", (centre, 0.0), (4, 12), textcoords="offset points", color=FAINT)
    axes.annotate(r"$\zeta_m$", (middle.real, middle.imag), (8, -2), textcoords="offset points", size=12)
    axes.set_title(r"the same meridian as $\zeta = Y e^{i\varphi}$: an arc of a circle")


SHAPES = (
    (0.7, "neck, $H > 0$"),
    (0.0, "catenoid"),
    (-0.45, "neck, $H < 0$"),
    (-0.9, "cylinder"),
    (-1.35, "bulge"),
    (-1.8, "sphere"),
)


def draw_one_turn(path: Path) -> None:
    """Draw meridians of one middle and one length at six turns, and their arcs in the plane of ζ."""
    shades = [colormaps["viridis"](share) for share in np.linspace(0.0, 0.9, len(SHAPES))]
    with rc_context(STYLE):
        drawing = Figure(figsize=(5.2, 7.6), layout="constrained")
        upper, lower = drawing.subplots(2, 1, height_ratios=(1, 1.1))
    length, part = 0.9, np.linspace(-1.0, 1.0, 201)
    for (turn, name), shade in zip(SHAPES, shades, strict=True):
        place, radius = np.empty((2, 201))
        z = Four(0.0, 0.0, np.log(length), turn)
        lay_meridian(z, place, radius)
        upper.plot(place - place[100], radius, color=shade, lw=2.2)
        rotor = np.exp(1j * turn * part)
        step = 1j * length * part * np.exp(0.5j * turn * part) * np.sinc(0.5 * turn * part / np.pi)
        zeta = rotor + step
        lower.plot(zeta.real, zeta.imag, color=shade, lw=2.2, marker="o" if turn == -length else None, ms=7)
        label = rf"{name}, $\omega = {turn:g}$"
        upper.plot([], [], color=shade, lw=2.2, label=label)
    upper.plot(0.0, 1.0, "o", color=INK, ms=6)
    upper.axhline(0.0, color=INK, lw=0.8)
    upper.set(aspect="equal", xlim=(-0.95, 0.95), ylim=(0.0, 1.6), xlabel="along the axis", ylabel="radius $Y$")
    upper.set_title(r"$Y_m = 1$, $\varphi_m = 0$, $\ell = 0.9$, and six turns")
    lower.axhline(0.0, color=INK, lw=0.8)
    lower.axvline(0.0, color=INK, lw=0.8)
    whole = np.exp(2j * np.pi * np.linspace(0.0, 1.0, 201))  # on the circle of a sphere lies the origin
    lower.plot(0.5 + 0.5 * whole.real, 0.5 * whole.imag, color=shades[-1], lw=0.9, ls=(0, (4, 3)))
    lower.set(aspect="equal", xlabel=r"$Y\cos\varphi$", ylabel=r"$Y\sin\varphi$", xlim=(-0.8, 2.2))
    drawing.legend(*upper.get_legend_handles_labels(), loc="outside lower center", ncols=2, frameon=False)
    drawing.savefig(path)


def draw_ladder(path: Path) -> None:
    """Draw the four rungs: what is held and what is free on each."""
    bridge = pl.bridge(pl.Pair(1.0, np.deg2rad(40.0)), 0.25, volume=0.2, liquid=UNIT)
    shape = bridge.profile(201)
    rungs = (
        ("$d_0$: both rings held,\nliquid from a reservoir", (True, True), True),
        ("$d_1$: one ring free", (False, True), True),
        ("$d_2$: both rings free", (False, False), True),
        ("$d_3$: liquid shut in", (False, False), False),
    )
    drawing = Figure(figsize=(5.2, 4.9), layout="constrained")
    for axes, (title, held, is_open) in zip(drawing.subplots(2, 2).ravel(), rungs, strict=True):
        axes.set(aspect="equal", xlim=(-0.55, 0.8), ylim=(-0.86, 0.72))
        axes.axis("off")
        axes.set_title(title, size=10)
        axes.fill_between(shape.x, -shape.y, shape.y, color=LIQUID, lw=0)
        for solid in (0, 1):
            x, y = shape.solid_x[solid], shape.solid_y[solid]
            axes.fill_between(x, -y, y, color=GRAIN, ec=GRAIN_EDGE, lw=1.2)
        for side in (1, -1):
            axes.plot(shape.x, side * shape.y, color=LIQUID_EDGE, lw=2)
            for end, is_held in zip((0, -1), held, strict=True):
                _mark_ring(axes, shape, end, side, is_held)
        if is_open:
            axes.plot([0.125, 0.125], [-0.72, 0.0], color=LIQUID_EDGE, lw=4, solid_capstyle="butt")
            axes.add_patch(Rectangle((-0.15, -0.84), 0.55, 0.14, fc=LIQUID, ec=LIQUID_EDGE, lw=1.2))
    drawing.savefig(path)


def _mark_ring(axes: Axes, shape: pl.Profile, end: int, side: int, is_held: bool) -> None:
    """Mark a contact circle: a nail where it is held, arrows along the solid where it may slide."""
    spot = np.array([shape.x[end], side * shape.y[end]])
    if is_held:
        axes.plot(*spot, "s", color=INK, ms=8)
        return
    centre = np.array([-1.0 if end == 0 else 1.25, 0.0])
    along = np.array([-(spot - centre)[1], (spot - centre)[0]])
    arrow = {"arrowstyle": "<->", "color": ACCENT, "shrinkA": 0, "shrinkB": 0, "lw": 2}
    axes.annotate("", tuple(spot - 0.17 * along), tuple(spot + 0.17 * along), arrowprops=arrow)


def draw_two_ends(path: Path) -> None:
    """Draw the force of a large drop on a wetted and an unwetted sphere: stable between two folds."""
    pair, volume = pl.Pair(1.0, (np.deg2rad(16.4), np.deg2rad(90.9))), 10.1
    curve = pl.curve(pair, volume=volume, liquid=UNIT, points=801)
    low, high = (pl.rupture(pair, volume=volume, liquid=UNIT, end=end) for end in ("lower", "upper"))
    gaps = low.separation + np.linspace(0.0, 0.5, 501) ** 2, np.linspace(1.1, float(curve.separation[-1]), 65)
    beyond = [pl.bridge(pair, gap, volume=volume, liquid=UNIT, branch="unstable") for gap in gaps]
    with rc_context(STYLE):
        drawing = Figure(figsize=(5.2, 6.2), layout="constrained")
        grid = drawing.add_gridspec(2, 3, height_ratios=(0.8, 2.0))
        axes = drawing.add_subplot(grid[1, :])
    axes.axhline(0.0, color=INK, lw=0.8)
    half = 400
    axes.plot(curve.separation[: half + 1], curve.force[: half + 1], color=LIQUID_EDGE, lw=2.4)
    pushes = np.r_[curve.force[: half + 1] < 0.0, False][: half + 1]
    axes.plot(curve.separation[: half + 1][pushes], curve.force[: half + 1][pushes], color=ACCENT, lw=3.4)
    dashes = {"color": LIQUID_EDGE, "lw": 1.6, "ls": (0, (4, 2))}
    axes.plot(curve.separation[half:], curve.force[half:], **dashes)
    for thin in beyond:
        axes.plot(thin.separation[thin.exists], thin.force[thin.exists], **dashes)
    for end in (low, high):
        axes.plot(end.separation, end.force, "o", color=ACCENT, ms=7, zorder=3)
    axes.annotate("lower end $D_{min}$:\nthe drop swallows\nthe wetted sphere", (0.34, -0.62), color=INK, size=9)
    axes.annotate("rupture $D_c$", (high.separation, high.force), (8, -3), textcoords="offset points", size=9)
    axes.annotate("stable", (0.62, 0.95), color=LIQUID_EDGE, size=10)
    axes.annotate("pushes,\nslips sideways", (0.03, 0.12), color=ACCENT, size=9)
    axes.set(xlabel="separation $D/R$", ylabel=r"force $F/\gamma R$", xlim=(0.0, 2.55), ylim=(-0.8, 2.0))
    for column, (gap, title) in enumerate(
        ((low.separation, "$D_{min}$"), (1.0, "$D = R$"), (high.separation, "$D_c$"))
    ):
        card = drawing.add_subplot(grid[0, column])
        state = (low, pl.bridge(pair, gap, volume=volume, liquid=UNIT), high)[column]
        _draw_card(card, state, f"{title}")
    drawing.savefig(path)


def _draw_card(axes: Axes, state: pl.Bridge, title: str) -> None:
    """Draw a pair and its bridge, small."""
    shape = state.profile(301)
    middle = 0.5 * float(state.separation)
    axes.set(aspect="equal", xlim=(middle - 3.1, middle + 3.1), ylim=(-1.75, 1.75))
    axes.axis("off")
    axes.set_title(title, size=10)
    axes.fill(np.r_[shape.x, shape.x[::-1]], np.r_[shape.y, -shape.y[::-1]], color=LIQUID, lw=0)
    for solid in (0, 1):
        x, y = shape.solid_x[solid], shape.solid_y[solid]
        axes.fill(np.r_[x, x[::-1]], np.r_[y, -y[::-1]], color=GRAIN, ec=GRAIN_EDGE, lw=1)
    for side in (1, -1):
        axes.plot(shape.x, side * shape.y, color=LIQUID_EDGE, lw=1.6)


def draw_pitchfork(path: Path) -> None:
    """Draw how far the liquid has slid against the separation, and rupture against the difference of the radii."""
    angle, volume = np.deg2rad(40.0), 8e-3
    with rc_context(STYLE):
        drawing = Figure(figsize=(5.2, 7.0), layout="constrained")
        upper, lower = drawing.subplots(2, 1, height_ratios=(1.25, 1))
    equal = pl.Pair(1.0, angle)
    dashes = (0, (4, 2))
    fork, fold = (
        float(pl.rupture(equal, volume=volume, liquid=UNIT, limit=limit).separation) for limit in ("stability", "fold")
    )
    slid = pl.curve(equal, volume=volume, liquid=UNIT, points=401)
    aside = np.abs(slid.contact_radius[200:, 1] - slid.contact_radius[200:, 0])
    upper.plot([0.0, fork], [0.0, 0.0], color=LIQUID_EDGE, lw=2.4)
    upper.plot([fork, fold], [0.0, 0.0], color=LIQUID_EDGE, lw=1.6, ls=dashes)
    for side in (1, -1):
        upper.plot(slid.separation[200:], side * aside, color=LIQUID_EDGE, lw=1.6, ls=dashes)
    for difference in (1e-3, 1e-2):
        curve = pl.curve(pl.Pair((1.0, 1.0 + difference), angle), volume=volume, liquid=UNIT, points=401)
        aside = curve.contact_radius[:, 1] - curve.contact_radius[:, 0]
        upper.plot(curve.separation[:201], aside[:201], color=ACCENT, lw=1.5)
        upper.plot(curve.separation[200:], aside[200:], color=ACCENT, lw=1.2, ls=dashes)
        spot = (float(curve.separation[200]), float(aside[200]))
        upper.plot(*spot, "o", color=ACCENT, ms=5)
        upper.annotate(
            f"$R_2 = {1.0 + difference:g} R_1$",
            spot,
            (0.2722, 2.2 * spot[1] + 0.004),
            color=ACCENT,
            arrowprops={"arrowstyle": "-", "color": ACCENT, "lw": 0.7},
        )
    upper.plot(fork, 0.0, "o", color=LIQUID_EDGE, ms=6)
    upper.plot(fold, 0.0, "s", color=LIQUID_EDGE, ms=5)
    upper.annotate("pitchfork", (fork, 0.0), (-8, -16), textcoords="offset points", ha="right", color=LIQUID_EDGE)
    upper.annotate("fold", (fold, 0.0), (0, 9), textcoords="offset points", ha="center", color=LIQUID_EDGE)
    upper.set(xlim=(0.255, 0.2775), ylim=(-0.05, 0.05))
    upper.set(xlabel="separation $D/R$", ylabel="difference of the contact radii $/R$")
    differences = np.geomspace(1e-8, 0.1, 29)
    ends = pl.rupture(pl.Pair((1.0, 1.0 + differences), angle), volume=volume, liquid=UNIT).separation
    lower.loglog(differences, fork - ends, color=ACCENT, lw=2)
    lower.loglog(differences, 0.018 * differences ** (2 / 3), color=INK, lw=0.9, ls=dashes)
    lower.annotate("slope 2/3", (1e-5, 3e-6), color=INK)
    lower.set(xlabel="relative difference of the radii", ylabel="rupture distance lost $/R$")
    drawing.savefig(path)


def draw_energies(path: Path) -> None:
    """Draw the potential of each control against the separation, along both branches."""
    with rc_context(STYLE):
        drawing = Figure(figsize=(5.2, 6.4), layout="constrained")
        upper, lower = drawing.subplots(2, 1)
    pair = pl.Pair(1.0, 0.0)
    suction = pl.curve(pair, suction=10.0, liquid=UNIT, points=801)
    volume = pl.curve(pair, volume=0.01, liquid=UNIT, points=801)
    for axes, curve, value in ((upper, suction, suction.grand_potential), (lower, volume, volume.surface_energy)):
        on = curve.stable
        axes.axhline(0.0, color=INK, lw=0.8)
        axes.plot(curve.separation[on], value[on], color=LIQUID_EDGE, lw=2.2, label="stable")
        axes.plot(curve.separation[~on], value[~on], color=LIQUID_EDGE, lw=1.4, ls=(0, (4, 2)), label="unstable")
        fold = np.argmax(curve.separation)
        axes.plot(curve.separation[fold], value[fold], "o", color=ACCENT, ms=6)
        axes.set(xlabel=r"separation $D^*$")
    upper.set(title=r"suction held, $H^* = 10$: grand potential $\Omega^*$")
    lower.set(title=r"volume held, $V^* = 0.01$: surface energy $E^*$")
    upper.legend()
    drawing.savefig(path)


def draw_rupture(path: Path) -> None:
    """Draw the error of the asymptotic rupture distance, term by term, and of the torus."""
    with rc_context(STYLE):
        drawing = Figure(figsize=(5.2, 3.6), layout="constrained")
        axes = drawing.subplots()
    suction = np.geomspace(1.0, 1e6, 121)
    pair = pl.Pair(1.0, 0.0)
    exact = pl.rupture(pair, suction=suction, liquid=UNIT).separation
    arc = np.pi / 4.0  # A(0)
    terms = np.array([np.full(121, 2.0), -3.0 * arc ** (2 / 3) * suction ** (-1 / 3), 0.75 / suction])
    for count, name, width in ((1, "one term", 0.9), (2, "two terms", 1.6), (3, "three terms", 2.4)):
        error = np.abs(terms[:count].sum(axis=0) / suction / exact - 1.0)
        axes.loglog(suction, 100.0 * error, color=LIQUID_EDGE, lw=width, label=name)
    in_range = suction >= pl.laws["toroidal2020"].valid["suction_star"][0]
    torus = pl.rupture(pair, suction=suction[in_range], liquid=UNIT, method="toroidal2020").separation
    error = 100.0 * np.abs(torus / exact[in_range] - 1.0)
    axes.loglog(suction[in_range], error, color=ACCENT, lw=1.6, ls=(0, (4, 2)), label="torus, Eq. (25)")
    axes.set(xlabel=r"reduced suction $H^*$", ylabel="error of the rupture distance (%)", ylim=(1e-6, 1e3))
    axes.legend()
    drawing.savefig(path)


def draw_worn(path: Path) -> None:
    """Draw a bridge below an indenter of its own profile."""
    radius = np.linspace(0.0, 20e-6, 400)
    blunt = pl.Convex(radius, lambda y: 5e-6 * (y / 20e-6) ** 4 + 2e-6 * (y / 20e-6) ** 2)
    pair = pl.Pair((blunt, np.inf), contact_angle=0.3)
    bridge = pl.bridge(pair, 1e-6, suction=50e3, liquid=pl.Liquid.water())
    drawing = Figure(figsize=(5.2, 3.88))
    draw_pair(drawing.add_axes((0.0, 0.0, 1.0, 1.0)), pair, bridge, 1e-6)
    drawing.savefig(path)


def draw_contact_lines(path: Path) -> None:
    """Draw one bridge pulled apart with free lines of both angles, with hysteresis, and with pinned lines."""
    with rc_context(STYLE):
        drawing = Figure(figsize=(5.2, 3.8), layout="constrained")
        axes = drawing.subplots()
    advancing, receding = np.deg2rad(60.0), np.deg2rad(30.0)
    gaps = np.concatenate([np.linspace(0.16, 0.02, 60), np.linspace(0.02, 0.4, 400)[1:]])
    held = {"volume": 8e-3, "liquid": UNIT}
    slides = {"contact_line": "hysteresis", "advancing_angle": advancing, "receding_angle": receding}
    paths = {
        "hysteresis, 60° and 30°": (pl.path(pl.Pair(1.0, advancing), gaps, **slides, **held), LIQUID_EDGE, 2.4, "-"),
        "pinned": (pl.path(pl.Pair(1.0, advancing), gaps, contact_line="pinned", **held), ACCENT, 1.8, "-"),
        "free, 60°": (pl.path(pl.Pair(1.0, advancing), gaps, **held), INK, 1.2, (0, (4, 2))),
        "free, 30°": (pl.path(pl.Pair(1.0, receding), gaps, **held), FAINT, 1.2, (0, (1, 1.5))),
    }
    for name, (found, colour, width, style) in paths.items():
        on = found.exists
        end = found.rupture
        x, y = np.append(found.separation[on], end.separation), np.append(found.force[on], end.force)
        axes.plot(x, y, color=colour, lw=width, ls=style, label=name)
        axes.plot(end.separation, end.force, "o", color=colour, ms=5)
    axes.axhline(0.0, color=INK, lw=0.8)
    axes.set(xlabel="separation $D^*$", ylabel=r"force $F/(\gamma R)$")
    axes.legend()
    drawing.savefig(path)


PICTURES = {
    "worn": draw_worn,
    "sketch": draw_sketch,
    "four_numbers": draw_four_numbers,
    "one_turn": draw_one_turn,
    "ladder": draw_ladder,
    "two_ends": draw_two_ends,
    "pitchfork": draw_pitchfork,
    "energies": draw_energies,
    "rupture_terms": draw_rupture,
    "contact_lines": draw_contact_lines,
}
