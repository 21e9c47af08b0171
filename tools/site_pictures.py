"""Pictures of the theory pages, drawn from exact bridges of equal spheres with R = γ = 1.

They are as wide as their labels can still be read on a phone.
"""

from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc

import pendular as pl
from pendular.colours import ACCENT, FAINT, GRAIN, GRAIN_EDGE, HAIR, INK, LIQUID, LIQUID_EDGE

UNIT = pl.Liquid(surface_tension=1.0)
GAP = 0.16  # of the sketch
STYLE = {
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": HAIR,
    "grid.alpha": 0.25,
    "axes.titlesize": 10,
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


def draw_one_unknown(path: Path) -> None:
    """Draw the separation against the force that is assumed, at three suctions."""
    with rc_context(STYLE):
        drawing = Figure(figsize=(5.2, 3.6), layout="constrained")
        axes = drawing.subplots()
    axes.axhline(0.0, color=INK, lw=0.8)
    for suction, width in ((1.0, 2.4), (10.0, 1.8), (100.0, 1.3)):
        curve = pl.curve(pl.Pair(1.0, np.deg2rad(20)), suction=suction, liquid=UNIT, points=801)
        force, on = curve.force / (2.0 * np.pi), curve.stable
        axes.plot(force[on], curve.separation[on], color=LIQUID_EDGE, lw=width)
        axes.plot(force[~on], curve.separation[~on], color=LIQUID_EDGE, lw=width, ls=(0, (4, 2)))
        fold = np.argmax(curve.separation)
        axes.plot(force[fold], curve.separation[fold], "o", color=ACCENT, ms=6)
        spot = (force[fold], curve.separation[fold])
        axes.annotate(f"$H^* = {suction:g}$", spot, (6, 5), textcoords="offset points", color=INK)
    axes.annotate("thick bridges:\nstable", (0.66, 0.1), color=FAINT, size=9)
    axes.annotate("thin bridges: unstable", (0.015, 0.278), color=FAINT, size=9)
    axes.set(xlabel=r"force assumed, $\lambda^* = F/2\pi\gamma\bar R$", ylabel=r"gap that follows, $D^* = D/\bar R$")
    axes.set(xlim=(0, 1), ylim=(-0.01, 0.295))
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


PICTURES = {
    "sketch": draw_sketch,
    "one_unknown": draw_one_unknown,
    "energies": draw_energies,
    "rupture_terms": draw_rupture,
}
