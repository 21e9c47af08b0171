"""The command for heaps of grains."""

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from ...ground.units import read, read_fraction, show
from ...ground.warn import warn
from ..options import describe_liquid, read_contact_angle, read_form, read_liquid
from ._app import app, compiling_shown, print_page, save_picture, warnings_in_one_line

if TYPE_CHECKING:
    from ...ask.liquid import Liquid
    from ...packing.heap import Packing
    from ...packing.wetted import Wet

__all__ = ["packing"]

_AMOUNTS = ("saturation", "water_content", "mass_ratio")
_LATTICES = {"sc": "simple_cubic", "bcc": "body_centred_cubic", "fcc": "face_centred_cubic", "hcp": "hexagonal"}
_RANDOM = {"loose": 0.5, "close": 0.0}  # friction while it is made
_MADE = (*_RANDOM, *_LATTICES)
_LARGE = 5e-3  # radius from which gravity outdoes bridges, [m]
_USUAL_RADIUS = "50um"
_USUAL_SUCTION = 10.0  # ΔpR/γ
_USUAL_RANGE = (0.5, 500.0)


def _text(help_text: str, kind: str) -> Any:
    return typer.Option(help=help_text, metavar=kind)


@app.command(
    epilog="\b\nExample:\n"
    "  pendular packing --contact-angle 20 --retention 0.1kPa 100kPa --plot r.svg\n"
    "  pendular packing dump.lammpstrj --unit mm --suction 2kPa --stress --out state.vtu"
)
def packing(
    file: Annotated[
        Path | None,
        typer.Argument(help="Grains of another program: dump, data, YADE text, VTK, CSV; if not given, made ones."),
    ] = None,
    unit: Annotated[str | None, _text("Length that the file's 1 means: mm.", "UNIT")] = None,
    radius: Annotated[str | None, _text("Of grains that a file has none for, or of made ones: 50um.", "LENGTH")] = None,
    made: Annotated[
        str, _text("Grains without a file: loose or close (random), sc, bcc, fcc or hcp.", "KIND")
    ] = "loose",
    count: Annotated[int, typer.Option(help="Grains of a made random heap.")] = 500,
    contact_angle: Annotated[str, _text("Contact angle: 20 or 20deg, 0.35rad.", "ANGLE")] = "0",
    retention: Annotated[
        tuple[str, str] | None, _text("Curves between two suctions: 0.1kPa 100kPa.", "PRESSURE PRESSURE")
    ] = None,
    points: Annotated[int, typer.Option(help="Suctions of these curves, at least 2.")] = 40,
    suction: Annotated[str | None, _text("Held constant: gas minus liquid pressure, 2kPa,", "PRESSURE")] = None,
    humidity: Annotated[str | None, _text("or relative humidity, 90%,", "FRACTION")] = None,
    saturation: Annotated[str | None, _text("or liquid over pores, 2%,", "FRACTION")] = None,
    water_content: Annotated[str | None, _text("or liquid over the whole volume, 1%,", "FRACTION")] = None,
    mass_ratio: Annotated[str | None, _text("or mass of liquid over that of grains, 1%.", "FRACTION")] = None,
    grain_density: Annotated[str | None, _text("For masses: 2500kg/m^3.", "DENSITY")] = None,
    path: Annotated[Literal["drying", "wetting"], _text("How it got there: drying, wetting.", "PATH")] = "drying",
    film: Annotated[str | None, _text("Gap up to which grains count as touching: 10nm.", "LENGTH")] = None,
    condensation: Annotated[bool, typer.Option(help="Whether bridges also form by condensation.")] = True,
    liquid: Annotated[str | None, _text("Liquid: ethanol; if not given, water.", "NAME")] = None,
    temperature: Annotated[str | None, _text("Of the liquid: 25degC; if not given, 20degC.", "TEMPERATURE")] = None,
    surface_tension: Annotated[str | None, _text("Measured: 72.8mN/m.", "TENSION")] = None,
    friction_angle: Annotated[str | None, _text("Of the dry heap, for its cohesion: 30.", "ANGLE")] = None,
    stress: Annotated[bool, typer.Option("--stress", help="Print the whole stress and its shares.")] = False,
    method: Annotated[Literal["auto", "exact", "table"], _text("auto, exact or table.", "METHOD")] = "auto",
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON, in SI units.")] = False,
    as_csv: Annotated[bool, typer.Option("--csv", help="Print CSV, in SI units.")] = False,
    plot: Annotated[Path | None, _text("Draw the curves, or grains and bridges: r.svg, .png or .pdf.", "FILE")] = None,
    out: Annotated[Path | None, _text("Write grains and bridges: state.vtu, .vtp, .csv or .nc.", "FILE")] = None,
) -> None:
    """Water and stress of a heap of grains, at a suction or along its retention curves."""
    form = read_form(as_json, as_csv, plot)
    controls = {
        "suction": None if suction is None else read("suction", suction, "Pa", "2kPa"),
        "humidity": None if humidity is None else read_fraction("humidity", humidity),
        "saturation": None if saturation is None else read_fraction("saturation", saturation),
        "water_content": None if water_content is None else read_fraction("water-content", water_content),
        "mass_ratio": None if mass_ratio is None else read_fraction("mass-ratio", mass_ratio),
    }
    given = {name: value for name, value in controls.items() if value is not None}
    if retention is not None and given:
        raise ValueError(f"retention: given together with {next(iter(given))}; one of the two is needed")
    if retention is not None and out is not None:
        raise ValueError("out: writes one state; give it with suction, humidity or an amount")
    degrees = read_contact_angle("contact-angle", contact_angle)
    wetting = read_liquid(liquid, temperature, surface_tension, None, is_humid=humidity is not None)
    density = None if grain_density is None else read("grain-density", grain_density, "kg/m^3", "2500kg/m^3")
    gap = 0.0 if film is None else read("film", film, "m", "10nm")
    with warnings_in_one_line(), compiling_shown():
        heap, name = _heap(file, unit, radius, made, count)
        title = f"{name}, contact angle {degrees:.4g}°"
        angle = math.radians(degrees)
        if retention is not None:
            _tell_curves(heap, angle, wetting, retention, points, gap, condensation, method, form, plot, title)
            return
        from ...packing.wet import wet

        held: dict[str, Any] = given or {"suction": _usual_suction(heap, wetting)}
        w = wet(
            heap, angle, **held, liquid=wetting, path=path, formation_distance=gap, condensation=condensation,
            grain_density=density, method=method,
        )  # fmt: skip
        slope = None if friction_angle is None else math.radians(read_contact_angle("friction-angle", friction_angle))
        _tell_state(w, wetting, form, plot, title, path, stress, slope)
        if out is not None:
            from ...codes.grains.writing import write_packing

            write_packing(out, heap, w.bridges)


def _heap(file: Path | None, unit: str | None, radius: str | None, made: str, count: int) -> "tuple[Packing, str]":
    """Grains of a file, or made ones, and what they are."""
    import numpy as np

    from ...packing.heap import PackingWarning

    if file is not None:
        from ...codes.grains.reading import read_packing

        size = None if radius is None else read("radius", radius, "m", _USUAL_RADIUS)
        heap = read_packing(file, unit=unit, radius=size)
        if unit is None and float(np.median(heap.radii)) > _LARGE:
            warn(f"unit: grains have a radius of {_range(heap)}; if not, say what the file's 1 means", PackingWarning)
        return heap, f"{file.name}, {heap.count} grains of radius {_range(heap)}"
    if unit is not None:
        raise ValueError("unit: has no effect without a file")
    size = read("radius", radius or _USUAL_RADIUS, "m", _USUAL_RADIUS)
    if made in _LATTICES:
        from ...packing.lattice import lattice_packing

        heap = lattice_packing(_LATTICES[made], 4, size)
    elif made in _RANDOM:
        from ...packing.random_packing import random_packing

        heap = random_packing(count, size, friction=_RANDOM[made])
    else:
        raise ValueError(f"made: {made!r} is not one of {', '.join(_MADE)}")
    solid = float(np.sum(4.0 / 3.0 * math.pi * heap.radii**3)) / heap.volume
    return heap, f"Made heap ({made}), {heap.count} grains of radius {_range(heap)}, solid fraction {solid:.4f}"


def _range(heap: "Packing") -> str:
    low, high = float(heap.radii.min()), float(heap.radii.max())
    return show(low, "m", 4) if high <= low * (1 + 1e-12) else f"{show(low, 'm', 3)} to {show(high, 'm', 3)}"


def _usual_suction(heap: "Packing", liquid: "Liquid") -> float:
    import numpy as np

    return float(f"{_USUAL_SUCTION * liquid.surface_tension / float(np.median(heap.radii)):.2g}")


def _tell_curves(
    heap: "Packing",
    angle: float,
    liquid: "Liquid",
    ends: tuple[str, str],
    points: int,
    film: float,
    condensation: bool,
    method: Literal["auto", "exact", "table"],
    form: str,
    plot: Path | None,
    title: str,
) -> None:
    """Follow the heap along its curves, and show them."""
    import numpy as np
    from rich.console import Console
    from rich.progress import Progress

    from ...packing.pictures import draw_retention
    from ...packing.report import curves_csv, curves_json, curves_table
    from ...packing.retention import retention_of
    from ...packing.setting import setting_of

    low, high = sorted(read("retention", end, "Pa", "0.1kPa") for end in ends)
    if not 0.0 < low < high:
        raise ValueError(f"retention: {ends[0]} and {ends[1]} are not two different suctions > 0")
    if points < 2:
        raise ValueError(f"points: {points} is not >= 2")
    setting = setting_of(heap, angle, liquid, film, condensation, method)
    console = Console(stderr=True)
    with Progress(console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task("suctions", total=1.0)
        curves = retention_of(
            setting, np.geomspace(low, high, points), None, lambda share: bar.update(task, completed=share)
        )
    if plot is not None:
        save_picture(draw_retention(curves, title, describe_liquid(liquid)), plot)
    if form == "json":
        typer.echo(curves_json(curves))
    elif form == "csv":
        typer.echo(curves_csv(curves), nl=False)
    else:
        print_page(title, describe_liquid(liquid), curves_table(curves), plot)


def _tell_state(
    w: "Wet",
    liquid: "Liquid",
    form: str,
    plot: Path | None,
    title: str,
    path: str,
    stress: bool,
    friction_angle: float | None,
) -> None:
    """Show one state of a heap."""
    from ...packing.limit import limit_of
    from ...packing.pictures import draw_heap
    from ...packing.report import state_csv, state_json, state_table

    if plot is not None:
        save_picture(draw_heap(w, title, describe_liquid(liquid)), plot)
    if form == "csv":
        typer.echo(state_csv(w), nl=False)
        return
    limit = limit_of(w._setting, path == "drying")
    if form == "json":
        typer.echo(state_json(w, limit, friction_angle))
    else:
        page = state_table(w, limit, stress, friction_angle)
        print_page(title, f"{describe_liquid(liquid)}  ·  {path}", page, plot)
