"""The explorer page without a browser: addresses, sliders, pictures to scale, and what can be taken away."""

import contextlib
import io
import json
import math
import random
import re
import shlex
import socket
import urllib.parse

import numpy as np
import pytest

import pendular as pl
from pendular.front.cli import main
from pendular.front.explorer.answer import answer_to
from pendular.front.explorer.curve_chart import curve_chart, law_style
from pendular.front.explorer.fragments import error_cells, headline, numbers
from pendular.front.explorer.pair_picture import pair_svg
from pendular.front.explorer.take_away import command_line, curve_csv, picture_svg, python_text
from pendular.front.explorer.track import Track, held_instead, track_of, value_of, written
from pendular.front.explorer.view import PLOTTED, View, address, view_at

SEED = 4
PLACES = {name: place for place, name in enumerate(pl.laws)}

VIEWS = {
    "as it starts": View(),
    "two spheres": View(radius2="5 µm", contact_angle="20", contact_angle2="0.5 rad", separation="0.1 µm"),
    "sphere on a plane": View(radius2="plane", contact_angle2="60°", control="volume", value="5000 um^3"),
    "humid": View(radius="10um", control="humidity", value="90 %", separation="0 m", temperature="25 degC"),
    "ethanol": View(liquid="ethanol", value="2 kPa", plot="volume", laws=("zhao2020", "pendular2026")),
    "given tension": View(surface_tension="50 mN/m", separation="-1 µm"),
    "bulge": View(contact_angle="80°", control="volume", value="300 pL", separation="30 µm"),
    "beyond rupture": View(separation="9 µm"),
    "no bridge apart": View(contact_angle="100°"),
    "a name of two words": View(liquid="ethylene glycol", plot="stiffness"),
}


@pytest.fixture(params=VIEWS)
def view(request):
    return VIEWS[request.param]


def parameters(text: str) -> dict[str, str]:
    return dict(urllib.parse.parse_qsl(urllib.parse.urlsplit(text).query, strict_parsing=True))


def said(arguments: list[str]) -> str:
    """What the command prints."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out), pytest.raises(SystemExit) as end:
        main(arguments)
    assert end.value.code == 0
    return out.getvalue()


def test_an_address_gives_back_the_same_answer(view):
    shown, sent = answer_to(view), answer_to(view_at(parameters(address(view))))
    assert sent.state.force == shown.state.force
    assert sent.separation == shown.separation
    assert sent.question.control == shown.question.control
    assert (sent.view.plot, sent.view.laws) == (view.plot, view.laws)
    assert address(sent.view) == address(view)


@pytest.mark.parametrize(
    ("query", "words"),
    [
        ({"radius": "50"}, "radius: '50' has no unit; write it like 50um"),
        ({"colour": "blue"}, "address: 'colour' is not one of"),
        ({"suction": "1kPa", "volume": "1pL"}, "control: suction and volume given"),
        ({"laws": "zhao2020,mine"}, "laws: 'mine' is not one of"),
        ({"plot": "entropy"}, "plot: 'entropy' is not one of"),
        ({"liquid": "wather"}, "'wather' is not a known liquid"),
    ],
)
def test_an_address_with_a_mistake_is_refused_in_one_line(query, words):
    with pytest.raises(ValueError, match=re.escape(words)) as error:
        answer_to(view_at(query))
    assert "\n" not in str(error.value)


def test_the_command_line_gives_the_same_force(view):
    program, *arguments = shlex.split(command_line(answer_to(view)))
    assert program == "pendular"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("sys.stderr", io.StringIO())  # warnings of the humid one
        found = json.loads(said([*arguments, "--json"]))
    assert found["force"] == pytest.approx(answer_to(view).state.force, rel=1e-12)


@pytest.mark.filterwarnings("ignore::pendular.KelvinWarning")
def test_the_program_gives_the_same_force(view):
    names: dict = {}
    with contextlib.redirect_stdout(io.StringIO()) as out:
        exec(python_text(answer_to(view)), names)
    exact = answer_to(view).state.force
    assert names["b"].force == pytest.approx(exact, rel=1e-12)
    assert out.getvalue() == f"{names['b'].force:.6e} N\n"


def test_the_saved_curve_is_that_of_the_command():
    answer = answer_to(VIEWS["sphere on a plane"])
    arguments = shlex.split(command_line(answer))[2:]
    at = arguments.index("--separation")
    assert curve_csv(answer) == said(["curve", *arguments[:at], *arguments[at + 2 :], "--csv"])


def test_the_saved_picture_is_that_of_the_command(tmp_path):
    answer = answer_to(VIEWS["ethanol"])
    said([*shlex.split(command_line(answer))[1:], "--plot", str(tmp_path / "bridge.svg")])
    assert picture_svg(answer) == (tmp_path / "bridge.svg").read_bytes()


def test_positions_and_values_of_sliders_are_inverse():
    print(f"seed {SEED}")
    rng = random.Random(SEED)
    for name in ("radius", "contact_angle", "temperature", "surface_tension", "suction", "humidity", "volume"):
        track = track_of(name, answer_to(View()))
        values = [track.value(position) for position in range(track.steps + 1)]
        assert (values[0], values[-1]) == pytest.approx((track.low, track.high), rel=1e-12)
        assert np.all(np.diff(values) > 0.0)
        position = rng.uniform(0.0, track.steps)
        assert track.position(track.value(position)) == pytest.approx(position, abs=1e-6)


def test_logarithmic_sliders_step_by_equal_ratios():
    track = Track(1.0, 1e4, 8, "logarithmic")
    assert [track.value(position) for position in (0, 2, 4)] == pytest.approx([1.0, 10.0, 100.0])
    dry = Track(0.9, 0.999, 4, "complement")
    assert [dry.value(position) for position in (0, 2, 4)] == pytest.approx([0.9, 0.99, 0.999])


def test_what_a_slider_writes_is_read_as_its_value(view):
    answer = answer_to(view)
    for name in ("radius", "contact_angle", "temperature", "separation"):
        track = track_of(name, answer)
        value = track.value(2 * track.steps // 3)
        liquid = {"surface_tension": "", "control": "suction", "value": "5 kPa"} if name == "temperature" else {}
        again = answer_to(view._replace(**{name: written(name, value, 6)}, **liquid))
        assert value_of(name, again) == pytest.approx(value, rel=1e-5)


@pytest.mark.parametrize("control", ["suction", "volume", "humidity"])
def test_another_control_holds_the_same_bridge(control):
    before = answer_to(View())
    value = written(control, held_instead(control, before), 8)
    after = answer_to(View(control=control, value=value))
    assert after.state.force == pytest.approx(before.state.force, rel=1e-6)


def coordinates(svg: str, name: str) -> list[np.ndarray]:
    """Points of the shapes of one kind, before the small card."""
    picture = svg.partition("<g ")[0]
    found = re.findall(rf'class="{name}" points="([^"]*)"', picture)
    return [np.array([tuple(map(float, point.split(","))) for point in points.split()]) for points in found]


@pytest.mark.parametrize("name", ["as it starts", "two spheres", "sphere on a plane", "bulge"])
def test_the_pair_is_drawn_to_scale(name):
    answer = answer_to(VIEWS[name])
    svg, state = pair_svg(answer), answer.state
    first, _ = coordinates(svg, "meniscus")
    left, right = coordinates(svg, "measure")
    along, across = (1, 0) if VIEWS[name].radius2 == "plane" else (0, 1)
    gap = abs(right[0, along] - left[0, along])
    scale = gap / answer.separation
    rims = np.sort(np.abs(first[[0, -1], across]))
    assert rims == pytest.approx(np.sort(scale * state.contact_radius), rel=0.02 / gap)  # coordinates have two decimals
    bar = float(re.search(r'class="bar" d="M([-\d.]+) [-\d.]+H([-\d.]+)"', svg)[2]) - float(
        re.search(r'class="bar" d="M([-\d.]+)', svg)[1]
    )
    length = re.search(r'text-anchor="middle">([\d.]+) (.m)</text>(?=<g|</svg)', svg)
    metres = float(length[1]) * {"µm": 1e-6, "nm": 1e-9}[length[2]]
    assert bar / metres == pytest.approx(scale, rel=0.02)


def test_the_view_stays_while_the_separation_changes():
    bars = {
        re.search(r'class="bar" d="([^"]*)"', pair_svg(answer_to(View(separation=f"{d} µm"))))[1] for d in (0, 4, 8)
    }
    assert len(bars) == 1


@pytest.mark.parametrize("plotted", PLOTTED)
def test_the_chart_holds_both_branches(plotted):
    answer = answer_to(View(plot=plotted))
    figure = curve_chart(answer, PLACES)
    unit = figure["layout"]["yaxis"]["title"]["text"]
    unstable, stable = figure["data"][:2]
    exact = pl.curve(answer.question.pair, suction=5e3, liquid=answer.question.liquid, points=121)
    here = np.asarray(exact.stable)
    ratio = np.asarray(stable["y"])[here][1:-1] / np.asarray(getattr(exact, plotted))[here][1:-1]
    assert ratio == pytest.approx(np.full(ratio.size, ratio[0]), rel=1e-9), unit
    assert np.isfinite(unstable["y"]).sum() > 50
    low, high = figure["layout"]["yaxis"]["range"]
    assert low < high
    assert low <= 0.0 <= high


def test_a_law_is_laid_over_the_force_with_its_error():
    view = View(laws=("zhao2020", "willett2000"))
    answer = answer_to(view)
    figure = curve_chart(answer, PLACES)
    drawn = {line["name"]: line for line in figure["data"] if "name" in line}
    assert set(drawn) == set(view.laws)
    held = {"suction": 5e3, "liquid": answer.question.liquid}
    by_name = {one.law.name: one for one in answer.laws}
    for name in view.laws:
        law = pl.bridge(answer.question.pair, 3e-6, method=name, **held).force
        exact = pl.bridge(answer.question.pair, 3e-6, **held).force
        assert by_name[name].force_error == pytest.approx(law / exact - 1.0, rel=1e-9)
        assert f"{100.0 * by_name[name].force_error:+.2g}".replace("-", "\u2212") in error_cells(by_name[name])
        x, y = np.asarray(drawn[name]["x"]), np.asarray(drawn[name]["y"])
        assert np.interp(3.0, x, y) == pytest.approx(1e6 * law, rel=1e-3)
    assert math.isnan(by_name["willett2000"].rupture_error)  # it is known at constant volume only


def test_a_law_outside_its_range_says_why():
    cells = {one.law.name: error_cells(one) for one in answer_to(View()).laws}
    assert "H* = 3.437; the law is for \u2265 1e4</span>" in cells["toroidal2020"]
    assert "outside" not in cells["zhao2020"]
    # A curve that is laid over may leave the range where the state does not.
    drawn = answer_to(View(control="volume", value="1 pL", laws=("pendular2026",)))
    assert {one.law.name: one.outside for one in drawn.laws}["pendular2026"] == ""


def test_a_law_that_does_not_cover_the_solids_says_so_and_is_not_drawn():
    answer = answer_to(View(contact_angle2="40°", laws=("zhao2020", "pendular2026")))
    told = {one.law.name: one.outside for one in answer.laws}
    assert told["zhao2020"].endswith("is not covered by 'zhao2020'; its force is for equal angles only")
    assert told["pendular2026"] == ""
    assert [line["name"] for line in curve_chart(answer, PLACES)["data"] if "name" in line] == ["pendular2026"]
    for one in answer.laws:
        assert one.outside or not math.isnan(one.force_error) or "force" not in one.law.gives


def test_a_state_of_overlapping_solids_lies_within_the_axes():
    answer = answer_to(View(separation="-1 µm"))
    layout = curve_chart(answer, PLACES)["layout"]
    for axis, value in (("xaxis", -1.0), ("yaxis", 1e6 * float(answer.state.force))):
        low, high = layout[axis]["range"]
        assert low < value < high


def test_every_law_of_the_registry_has_its_row_and_its_own_line():
    assert [one.law.name for one in answer_to(View()).laws] == list(pl.laws)
    assert len({law_style(place) for place in PLACES.values()}) == len(pl.laws)


def test_where_there_is_no_bridge_it_says_so():
    beyond, apart = answer_to(VIEWS["beyond rupture"]), answer_to(VIEWS["no bridge apart"])
    assert "no bridge at this separation" in headline(beyond)
    assert "7.675 µm" in headline(beyond)
    assert "no bridge between solids apart" in headline(apart)
    assert "neck radius" not in numbers(beyond)
    assert curve_chart(apart, PLACES)["data"] == []
    assert "no bridge at a separation of 9 µm" in pair_svg(beyond)


def test_warnings_of_the_library_are_told_and_not_raised():
    notices = answer_to(View(control="humidity", value="50 %", separation="0.2 nm")).notices
    assert any("Kelvin equation is doubtful below 4 nm" in notice for notice in notices)


def test_a_port_in_use_is_refused_in_one_line(capsys):
    with socket.create_server(("127.0.0.1", 0)) as taken, pytest.raises(SystemExit) as end:
        main(["explore", "--no-browser", "--port", str(taken.getsockname()[1])])
    assert end.value.code == 2
    words = capsys.readouterr().err
    assert re.fullmatch(r"pendular: port: \d+ of 127\.0\.0\.1 cannot be used: .*; choose another\n", words)


def test_two_plates_are_shown():
    plates = View(
        radius="plane", radius2="plane", contact_angle="40°", control="volume", value="1 µL", separation="400 µm"
    )
    answer = answer_to(plates)
    assert answer.state.force == pytest.approx(8.7492e-4, rel=1e-4)
    assert "Two plates" in pair_svg(answer)
    slider = track_of("volume", answer)
    assert slider.low < 1e-9 < slider.high
    with pytest.raises(ValueError, match="two planes in contact leave no room for liquid"):
        answer_to(plates._replace(separation="0 µm"))
    with pytest.raises(ValueError, match="suction: holds no stable bridge between two planes"):
        answer_to(plates._replace(control="suction", value="20 kPa"))
