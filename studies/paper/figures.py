"""The twelve figures of the article, drawn anew: same panels, axes and parameters.

Where the article does not print the limits of an axis in words they are chosen so that all its curves are seen.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from pendular.ground.colours import FAINT, GRAIN, HAIR, INK

from . import sample, style
from .geometry import geometry
from .style import FORCE, PART, PRODUCT, SEPARATION, SUCTION

Floats = NDArray[np.float64]

_EXACT = ("o", "exact")
_EVERY = sample.fractions(0.22, end=0.999)  # of the rupture distance: marks
_FINE = np.sin(np.linspace(0.0, 0.5 * np.pi, 161))  # lines, dense towards rupture where they are steep


class Drawing(NamedTuple):
    """One figure of the article."""

    number: int
    title: str
    caption: str
    draw: Callable[[], Figure]

    @property
    def name(self) -> str:
        """Stem of its file."""
        return f"figure{self.number:02d}"


def closure() -> Figure:
    """Fig. 2: P against Q under suction control."""
    figure, row = style.panels(["θ = 0°", "θ = 40°"], "$Q = Y_0/Y_c$", "$P = |X_c|/Y_c$")
    suctions = (1e4, 1e5, 1e6)
    for axes, degrees in zip(row, (0.0, 40.0), strict=True):
        axes.plot([0.0, 1.0], sample.torus_line(np.array([0.0, 1.0]), degrees), color=INK, lw=1.3, zorder=4)
        for case, suction in enumerate(suctions):
            states, fold = sample.all_states(degrees, suction=suction, points=81)
            p, q = sample.scaled_shape(states)
            style.marks(axes, q[: fold + 1], p[: fold + 1], case)
            style.line(axes, q[fold:], p[fold:], case, dashed=True)
        _enlarge_stable(axes, degrees, suctions)
        axes.set(xlim=(0.0, 1.02), ylim=(0.0, None))
        style.key(
            axes,
            map(_suction, suctions),
            [("o", "exact, stable"), ("--", "exact, unstable"), ("-", "torus, Eq. (18)")],
            "lower left",
        )
    return figure


def _enlarge_stable(axes: Axes, degrees: float, suctions: Sequence[float]) -> None:
    """The corner of Fig. 2 where the stable bridges lie, each branch ending at its critical point."""
    card = axes.inset_axes((0.58, 0.52, 0.42, 0.46))
    for case, suction in enumerate(suctions):
        states, fold = sample.all_states(degrees, suction=suction, points=81)
        p, q = sample.scaled_shape(states)
        style.marks(card, q[: fold + 1 : 4], p[: fold + 1 : 4], case)
        style.line(card, q[fold:], p[fold:], case, dashed=True)
        style.point(card, q[fold], p[fold], "rupture" if case == 0 else "", (8, 6))
        if case == 0:
            low = 1.0 - 1.25 * (1.0 - q[fold])
    card.plot([0.0, 1.0], sample.torus_line(np.array([0.0, 1.0]), degrees), color=INK, lw=1.3, zorder=4)
    card.set(xlim=(low, 1.0), ylim=(0.0, sample.torus_line(low, degrees)))
    card.tick_params(labelsize=7, labelcolor=FAINT, color=HAIR, length=2)
    card.locator_params(nbins=4)
    card.spines[:].set(color=HAIR, lw=0.6)


def torus_rupture() -> Figure:
    """Fig. 3: rupture distance of the torus."""
    return _rupture_by_angle("toroidal2020", "Eq. (25)", 1e4)


def torus_force() -> Figure:
    """Fig. 4: force of the torus."""
    suctions = (1e4, 1e5)
    figure, row = style.panels([_suction(suction) for suction in suctions], SEPARATION, FORCE)
    for axes, suction in zip(row, suctions, strict=True):
        for degrees, case in ((0.0, style.ANGLES[0.0]), (40.0, style.ANGLES[40.0])):
            _exact_force(axes, case, suction, degrees)
            end = sample.law_rupture("toroidal2020", suction, degrees)
            style.line(axes, 0.5 * _FINE * end, sample.law_force("toroidal2020", _FINE * end, suction, degrees), case)
        _from_zero(axes)
        style.key_of_angles(axes, (0.0, 40.0), [_EXACT, ("-", "torus, Eqs. (26), (28)")])
    return figure


def fitted_rupture() -> Figure:
    """Fig. 5: fitted rupture distance."""
    figure = _rupture_by_angle("zhao2020", "Eq. (29)", 1.0)
    axes = figure.axes[0]
    axes.axvspan(1.0, 15.0, color=GRAIN, lw=0, zorder=0)
    axes.text(1.2, 1.9, "range of Gras et al.\n$H^* \\leq 15$", size=9, color=FAINT, va="top")
    return figure


def neck_at_contact() -> Figure:
    """Fig. 6: neck radius at contact."""
    figure, (axes,) = style.panels([""], SUCTION, "$(H^*/2)^{1/2}\\,Y_0^*(S^*=0)$", x_scale="log")
    few, many = sample.decades(1.0, 1e8, 0.1), sample.decades(1.0, 1e8, 1.0)
    for degrees, case in style.ANGLES.items():
        style.marks(axes, few, np.sqrt(0.5 * few) * _exact_neck(np.zeros(few.size), few, degrees), case)
        style.line(axes, many, np.sqrt(0.5 * many) * sample.fitted_neck(many, degrees), case)
    style.key_of_angles(axes, style.ANGLES, [_EXACT, ("-", "Eq. (30)")])
    return figure


def neck_ratio() -> Figure:
    """Fig. 7: neck radius over its value at contact."""
    figure, row = style.panels(["θ = 0°", "θ = 40°"], PART, "$Y_0^*/Y_0^*(S^*=0)$")
    for axes, degrees in zip(row, (0.0, 40.0), strict=True):
        for case, suction in enumerate(sample.SUCTIONS):
            end = sample.rupture_distance(suction, degrees)
            exact = _exact_neck(_EVERY * end, suction, degrees)
            style.marks(axes, _EVERY, exact / exact[0], case)
            fitted = sample.neck_of_force(sample.fitted_force(_FINE * end, end, suction, degrees), suction)
            style.line(axes, _FINE, fitted / sample.fitted_neck(suction, degrees), case)
        axes.set(xlim=(0.0, 1.02), ylim=(0.0, 1.04))
        style.key(axes, map(_suction, sample.SUCTIONS), [_EXACT, ("-", "Eq. (31)")], "lower left")
    return figure


def fitted_force() -> Figure:
    """Fig. 8: fitted force."""
    figure, row = style.panels(["θ = 0°", "θ = 40°"], PART, FORCE)
    for axes, degrees in zip(row, (0.0, 40.0), strict=True):
        for case, suction in enumerate(sample.SUCTIONS):
            end = sample.rupture_distance(suction, degrees)
            style.marks(axes, _EVERY, sample.force(_EVERY * end, suction, degrees), case)
            style.line(axes, _FINE, sample.fitted_force(_FINE * end, end, suction, degrees), case)
            style.line(axes, _FINE, sample.law_force("zhao2020", _FINE * end, suction, degrees), case, dashed=True)
        axes.set(xlim=(0.0, 1.02), ylim=(0.0, 1.08))
        kinds = [_EXACT, ("-", "fit, exact $S_{crit}$"), ("--", "fit, $S_{crit}$ of Eq. (29)")]
        style.key(axes, map(_suction, sample.SUCTIONS), kinds, "upper right")
    return figure


def rupture_by_ratio() -> Figure:
    """Fig. 9: rupture distance of unequal spheres."""
    laws = (("toroidal2020", "Eq. (25)", 1e4), ("zhao2020", "Eq. (29)", 1.0))
    figure, row = style.panels(["torus", "fit"], SUCTION, PRODUCT, x_scale="log")
    for axes, (law, name, low) in zip(row, laws, strict=True):
        few, many = sample.decades(low, 1e8, 0.1), sample.decades(low, 1e8, 1.0)
        for case, ratio in enumerate(sample.RATIOS):
            style.marks(axes, few, few * sample.rupture_distance(few, 40.0, ratio), case, size=8.5 - 2.0 * case)
        axes.plot(many, many * sample.law_rupture(law, many, 40.0), color=INK, lw=1.5, zorder=2)
        style.key(axes, map(_ratio, sample.RATIOS), [_EXACT, ("-", name)], "lower right")
    return figure


def force_by_ratio() -> Figure:
    """Fig. 10: force between unequal spheres."""
    laws = (("toroidal2020", "torus, Eq. (26)", 1e5), ("zhao2020", "fit, Eqs. (26), (29)-(31)", 1e2))
    figure, row = style.panels([f"torus, {_suction(1e5)}", f"fit, {_suction(1e2)}"], SEPARATION, FORCE)
    for axes, (law, name, suction) in zip(row, laws, strict=True):
        for degrees in (0.0, 40.0):
            for case, ratio in enumerate(sample.RATIOS):
                _exact_force(axes, case, suction, degrees, ratio, size=8.5 - 2.0 * case)
            end = sample.law_rupture(law, suction, degrees)
            gaps, forces = 0.5 * _FINE * end, sample.law_force(law, _FINE * end, suction, degrees)
            axes.plot(gaps, forces, color=INK, lw=1.4, zorder=4)
            axes.annotate(
                _angle(degrees),
                (gaps[80], forces[80]),
                (-6, -9),
                textcoords="offset points",
                ha="right",
                size=9,
                color=INK,
            )
        _from_zero(axes)
        style.key(axes, map(_ratio, sample.RATIOS), [_EXACT, ("-", name)])
    return figure


def volume_branches() -> Figure:
    """Fig. 11: both branches under volume control."""
    return _branches(volume=1e-6)


def suction_branches() -> Figure:
    """Fig. 12: both branches under suction control."""
    return _branches(suction=1e3)


def _branches(**control: float) -> Figure:
    """Force and both energies against the separation, one sign for each branch."""
    names = (FORCE, "$E^*_{surf}$", "$E^*_{surf+\\Delta pV}$")
    figure, row = style.panels(["force", "surface energy", "with pressure work"], SEPARATION, names)
    for case, states in reversed(list(enumerate(sample.both_branches(_FINE[:-1:4], **control)))):
        gap = 0.5 * np.asarray(states.separation)
        for axes, value in zip(
            row, (sample.force_of(states), states.surface_energy, states.grand_potential), strict=True
        ):
            style.marks(axes, gap, np.where(states.exists, value, np.nan), case)
    for axes in row:
        axes.set_xlim(left=0.0)
        style.key(axes, ("larger force: stable", "smaller force: unstable"))
    return figure


def _rupture_by_angle(law: str, name: str, low: float) -> Figure:
    """2S*_crit H* against H* for the three angles."""
    figure, (axes,) = style.panels([""], SUCTION, PRODUCT, x_scale="log")
    few, many = sample.decades(low, 1e8, 0.1), sample.decades(low, 1e8, 1.0)
    for degrees, case in style.ANGLES.items():
        style.marks(axes, few, few * sample.rupture_distance(few, degrees), case)
        style.line(axes, many, many * sample.law_rupture(law, many, degrees), case)
    place: style.Place = "center right" if low >= 1e4 else "lower right"
    style.key_of_angles(axes, style.ANGLES, [_EXACT, ("-", name)], place)
    return figure


def _exact_force(axes: Axes, case: int, suction: float, degrees: float, ratio: float = 1.0, size: float = 4.6) -> None:
    """Marks from contact to rupture."""
    gaps = _EVERY * sample.rupture_distance(suction, degrees, ratio)
    style.marks(axes, 0.5 * gaps, sample.force(gaps, suction, degrees, ratio), case, size=size)


def _exact_neck(separation: Floats, suction: Floats | float, degrees: float) -> Floats:
    return np.asarray(sample.state(separation, degrees, suction=suction).neck_radius)


def _from_zero(axes: Axes) -> None:
    axes.set_xlim(left=0.0)
    axes.set_ylim(0.0, 1.08)


def _angle(degrees: float) -> str:
    return f"θ = {degrees:g}°"


def _ratio(ratio: float) -> str:
    return f"$R_L/R_s$ = {ratio:g}"


def _suction(suction: float) -> str:
    return f"$H^*$ = {_power(suction)}"


def _power(value: float) -> str:
    return f"{value:g}" if value < 100.0 else f"$10^{{{np.log10(value):.0f}}}$"


FIGURES = (
    Drawing(
        1,
        "Geometry of a bridge between two unequal spheres",
        "An exact bridge, turned so that its neck lies at X = 0. Both contact circles lie on the same meridian Y(X), "
        "and both spheres meet it at the same contact angle.",
        geometry,
    ),
    Drawing(
        2,
        "Scaled shape under suction control",
        "The stable bridges lie close to the straight line of the torus up to their rupture, and P has no maximum "
        "there; the unstable branch (dashed) leaves the line.",
        closure,
    ),
    Drawing(
        3,
        "Rupture distance: torus",
        "The torus overestimates the rupture distance, most of all at zero contact angle; the gap closes slowly as "
        "the suction grows.",
        torus_rupture,
    ),
    Drawing(
        4,
        "Force: torus",
        "The curves agree by eye. The torus starts slightly too low at contact and holds on a little longer than the "
        "exact bridge.",
        torus_force,
    ),
    Drawing(
        5,
        "Rupture distance: fit",
        "The fit follows the exact solution over eight decades, except at its very beginning: near H* = 1 it falls "
        "clearly below the marks.",
        fitted_rupture,
    ),
    Drawing(
        6,
        "Neck radius at contact: fit",
        "One exponential in H*^(-1/2) describes the neck of touching spheres, for all three contact angles.",
        neck_at_contact,
    ),
    Drawing(
        7,
        "Neck radius against separation: fit",
        "With the exact rupture distance on the axis the fit lies on the marks, but for the last tenth at high "
        "suction, where it falls too low.",
        neck_ratio,
    ),
    Drawing(
        8,
        "Force against separation: fit",
        "With the exact rupture distance (lines) the fit agrees by eye; with that of Eq. (29), as printed (dashes), "
        "it fails at H* = 1.",
        fitted_force,
    ),
    Drawing(
        9,
        "Rupture distance of unequal spheres, θ = 40°",
        "Above H* of a hundred the four ratios cannot be told apart, so the Derjaguin radius does all the work; "
        "only near H* = 1 do they spread a little.",
        rupture_by_ratio,
    ),
    Drawing(
        10,
        "Force between unequal spheres",
        "The marks of all four ratios coincide at both suctions, and the laws for equal spheres run through them.",
        force_by_ratio,
    ),
    Drawing(
        11,
        "Both branches under volume control, V* = 10⁻⁶, θ = 0°",
        "The surface energy is least on the stable branch. With the work of pressure added the order is reversed, "
        "except at small separations, where the two branches cross.",
        volume_branches,
    ),
    Drawing(
        12,
        "Both branches under suction control, H* = 10³, θ = 0°",
        "Both energies are lower on the stable branch; that of the surface only because this suction is positive.",
        suction_branches,
    ),
)
