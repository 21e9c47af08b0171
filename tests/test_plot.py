"""Pictures: to scale, with every label readable, for pairs and bridges of all kinds and sizes."""

import functools
import itertools
import math
import re

import numpy as np
import pytest
from matplotlib.patches import Polygon

import pendular as pl
from pendular.show.picture import figure, save

WATER = pl.Liquid.water()
PLANE = math.inf


def pair(radius, degrees) -> pl.Pair:
    return pl.Pair(radius=radius, contact_angle=tuple(np.deg2rad(degrees)))


# Pair, separation, control.
CASES = {
    "equal spheres": (pair((50e-6, 50e-6), (20, 20)), 1e-6, {"suction": 20e3}),
    "sphere on a plate": (pair((50e-6, PLANE), (20, 60)), 1e-6, {"suction": 20e3}),
    "plate below": (pair((PLANE, 50e-6), (20, 60)), 1e-6, {"volume": 50e-15}),
    "ratio ten": (pair((50e-6, 5e-6), (20, 20)), 0.2e-6, {"suction": 50e3}),
    "bulging": (pair((50e-6, 50e-6), (80, 80)), 30e-6, {"volume": 300e-15}),
    "repulsive": (pair((50e-6, 50e-6), (80, 80)), 1e-6, {"volume": 50e-15}),
    "nanometres": (pair((50e-6, 50e-6), (20, 20)), 0.2e-9, {"suction": 93.5e6}),
    "nanometres on a plate": (pair((50e-6, PLANE), (20, 60)), 0.5e-9, {"suction": 69e6}),
    "sliding": (pair((50e-6, 50e-6), (60, 60)), 15e-6, {"volume": 10e-15}),
    "two ends": (pair((50e-6, 50e-6), (16.4, 90.9)), 60e-6, {"volume": 1.26e-12}),
    "beyond rupture": (pair((50e-6, 50e-6), (20, 20)), 5e-6, {"suction": 20e3}),
    "close to rupture": (pair((50e-6, 50e-6), (20, 20)), 3.25e-6, {"suction": 20e3}),
    "overlap": (pair((50e-6, 50e-6), (20, 20)), -2e-6, {"suction": 20e3}),
    "no bridge at all": (pair((50e-6, 50e-6), (100, 100)), 1e-6, {"suction": 20e3}),
}


@functools.cache
def drawn(name: str, *, with_state: bool = True, stacked: bool = False):
    solids, separation, control = CASES[name]
    held = {**control, "liquid": WATER}
    end, curve = pl.rupture(solids, **held), pl.curve(solids, **held)
    first = pl.rupture(solids, **held, end="lower")
    state = pl.bridge(solids, separation, **held) if with_state else None
    lower_end = first if first.exists else None
    title = "A title of this length"
    return figure(solids, state, curve, end, separation=separation, lower_end=lower_end, title=title, stacked=stacked)


@pytest.fixture(params=itertools.product(CASES, (False, True)), ids=lambda case: f"{case[0]}{' stacked' * case[1]}")
def picture(request):
    name, stacked = request.param
    drawing = drawn(name, stacked=stacked)
    drawing.draw_without_rendering()
    return drawing


def test_labels_are_inside_the_picture_and_apart(picture):
    edge = picture.bbox
    for axes in picture.axes:
        boxes = [text.get_window_extent() for text in axes.texts if text.get_text()]
        assert all(edge.x0 <= box.x0 and box.x1 <= edge.x1 and edge.y0 <= box.y0 and box.y1 <= edge.y1 for box in boxes)
        assert not any(one.overlaps(other) for one, other in itertools.combinations(boxes, 2))


def test_the_meniscus_ends_on_the_solids(picture):
    """Solids and meniscus come from different formulas; to scale, they meet."""
    axes = picture.axes[0]
    outlines = [patch.get_xy() for patch in axes.patches if isinstance(patch, Polygon)][-2:]
    menisci = [line.get_xydata() for line in axes.lines if line.get_linewidth() == 2.0 and len(line.get_xydata()) > 2]
    for meniscus, (solid, outline) in itertools.product(menisci, enumerate(outlines)):
        tip = meniscus[-solid]
        if np.abs(tip).max() < 1.0:
            assert distance_to_line(tip, outline) < 1e-3


def distance_to_line(point, corners) -> float:
    starts, steps = corners[:-1], np.diff(corners, axis=0)
    lengths = np.maximum(np.sum(steps**2, axis=1), 1e-300)
    along = np.clip(np.sum((point - starts) * steps, axis=1) / lengths, 0.0, 1.0)
    return float(np.min(np.hypot(*(starts + along[:, None] * steps - point).T)))


def test_distance_to_line_is_measured():
    assert distance_to_line(np.array([0.5, 0.25]), np.array([[0.0, 0.0], [1.0, 0.0]])) == 0.25


@pytest.mark.parametrize(
    "name", ["equal spheres", "sphere on a plate", "plate below", "ratio ten", "overlap", "bulging"]
)
def test_the_gap_has_the_length_that_the_scale_bar_tells(name):
    axes = drawn(name).axes[0]
    (bar,) = (line.get_xdata() for line in axes.lines if line.get_linewidth() == 2.0 and line.get_xdata().size == 2)
    told = next(text.get_text() for text in axes.texts if re.fullmatch(r"[125]0* µm", text.get_text()))
    first, second = (line.get_xydata() for line in axes.lines if line.get_linewidth() == 0.6)
    metres_per_unit = 1e-6 * float(told.split()[0]) / np.ptp(bar)
    assert np.abs(second - first).max() * metres_per_unit == pytest.approx(abs(CASES[name][1]), rel=1e-9)
    assert axes.get_aspect() == 1.0


def test_the_curve_tells_force_and_rupture_distance():
    texts = [text.get_text() for text in drawn("equal spheres").axes[1].texts]
    assert texts == ["rupture\n3.313 µm", "15.07 µN at 1 µm", "stable", "unstable"]


def test_rupture_is_where_the_liquid_slides_to_one_side():
    assert "rupture\n32.07 µm" in [text.get_text() for text in drawn("sliding").axes[1].texts]


def test_where_the_stable_bridges_begin_is_told():
    assert "begins at 10.74 µm" in [text.get_text() for text in drawn("two ends").axes[1].texts]


def test_without_a_state_the_pair_ruptures():
    drawing = drawn("equal spheres", with_state=False)
    assert [text.get_text() for text in drawing.axes[1].texts] == ["rupture\n3.313 µm", "stable", "unstable"]
    assert "$D$ = 3.313 µm" in [text.get_text() for text in drawing.axes[0].texts]


def test_a_far_smaller_bridge_is_shown_with_the_pair_from_afar():
    (card,) = drawn("equal spheres").axes[0].child_axes
    assert len(card.lines) == 2
    assert not drawn("bulging").axes[0].child_axes


def test_the_same_picture_has_the_same_bytes(tmp_path):
    for name in ("one.svg", "two.svg"):
        save(drawn.__wrapped__("equal spheres"), tmp_path / name)
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "two.svg").read_bytes()
