"""The command line: a question with units is read, put to the library, and its answer shown."""

import inspect
import math
import re
import sys
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from . import __version__
from .question import Question, read_question
from .units import read, show

if TYPE_CHECKING:
    from rich.table import Table

    from .bridges import Bridge

__all__ = ["app", "main"]

_BAD_INPUT, _INTERRUPTED = 2, 130

# Where the library calls an argument otherwise than the option, and what it advises to a programmer.
_OPTIONS = {"radius[0]": "radius", "radius[1]": "radius2", "surface_tension": "surface-tension", "name": "liquid"}
_ADVICE = re.compile(r"; give (it|its numbers) to Liquid\(\.\.\.\)")

# The decorated help would first read a Markdown parser and a highlighter, which takes as long as all the rest.
app = typer.Typer(rich_markup_mode=None, add_completion=False, pretty_exceptions_enable=False)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command and leave with its exit status: 2 and one line on stderr for bad input.

    Parameters
    ----------
    arguments : sequence of str, optional
        Those of the process by default.
    """
    try:
        status = app(arguments, prog_name="pendular", standalone_mode=False)
    except typer.Abort:
        sys.exit(_INTERRUPTED)
    except ValueError as error:
        _complain(_in_terms_of_options(str(error)))
        sys.exit(_BAD_INPUT)
    except Exception as error:
        if not hasattr(error, "format_message"):  # what the option parser raises has it, whichever package holds it
            raise
        _complain(error.format_message())
        sys.exit(_BAD_INPUT)
    sys.exit(status or 0)


def _complain(message: str) -> None:
    typer.echo(f"pendular: {' '.join(message.split())}", err=True)


def _in_terms_of_options(message: str) -> str:
    name, colon, reason = message.partition(": ")
    return _OPTIONS.get(name, name) + colon + _ADVICE.sub("", reason)


def _print_version(is_wanted: bool) -> None:
    if is_wanted:
        typer.echo(f"pendular {__version__}")
        raise typer.Exit


@app.callback(
    invoke_without_command=True,
    epilog="\b\nExample:\n  pendular bridge --radius 50um --contact-angle 20 --suction 20kPa --separation 1um",
)
def _start(
    context: typer.Context,
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    """Capillary bridges between two solids, exactly."""
    if context.invoked_subcommand is None:
        typer.echo(context.get_help())


def _command(example: str) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Make a command of a function of a question and of options of its own, with all shared options before them."""

    def register(answer: Callable[..., None]) -> Callable[..., None]:
        shared = inspect.signature(read_question).parameters
        own = [p for name, p in inspect.signature(answer).parameters.items() if name != "question"]

        def command(**given: Any) -> None:
            with _warnings_in_one_line(), _compiling_shown():
                answer(read_question(**{name: given.pop(name) for name in shared}), **given)

        parameters = [p.replace(kind=p.KEYWORD_ONLY) for p in (*shared.values(), *own)]
        command.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
        command.__annotations__ = {p.name: p.annotation for p in parameters}
        command.__doc__ = answer.__doc__
        app.command(answer.__name__, epilog=f"\b\nExample:\n  pendular {answer.__name__} {example}")(command)
        return answer

    return register


@_command("--radius 50um --contact-angle 20 --suction 20kPa --separation 1um --plot bridge.svg")
def bridge(
    question: Question,
    separation: Annotated[str, typer.Option(help="Gap from surface to surface: 1um.", metavar="LENGTH")],
    branch: Annotated[str, typer.Option(help="Which of two bridges: stable, or unstable.")] = "stable",
) -> None:
    """Force, shape and energies of a bridge, and its rupture distance."""
    from . import bridges, report

    gap = read("separation", separation, "m", "1um")
    answer = question.put_to(bridges.bridge, gap, branch=branch)
    end = question.put_to(bridges.rupture)
    _draw(question, end, answer, gap)
    if question.form == "json":
        found = {**report.plain_fields(answer), "rupture_separation": end.separation}
        units = {**report.UNITS, "rupture_separation": "m"}
        typer.echo(report.json_text({**found, "units": units}))
    elif question.form == "csv":
        limit = report.Column("rupture_separation", "m", end.separation)
        typer.echo(report.csv_text([*report.columns(answer), limit]), nl=False)
    else:
        rupture_distance = (show(float(end.separation), "m"), "separation at which the bridge breaks")
        _print(question, report.state_table(answer, {"rupture distance": rupture_distance}))


@_command("--radius 50um --radius2 plane --contact-angle 50 --volume 5pL")
def rupture(question: Question) -> None:
    """Rupture distance, and the bridge as it breaks."""
    from . import bridges, report

    end = question.put_to(bridges.rupture)
    _draw(question, end)
    earlier = _instability(question, end)
    if question.form == "json":
        limit = None if earlier is None else report.plain_fields(earlier)
        typer.echo(report.json_text({**report.plain_fields(end), "stability_limit": limit, "units": report.UNITS}))
    elif question.form == "csv":
        limits = {"fold": end, "stability": earlier}
        rows = (
            [report.Column("limit", "", name), *report.columns(state)]
            for name, state in limits.items()
            if state is not None
        )
        typer.echo(report.csv_text(*rows), nl=False)
    else:
        more = {}
        if earlier is not None:
            more["stable to"] = (show(float(earlier.separation), "m"), "then the liquid slides to one of the solids")
        _print(question, report.rupture_table(end, more))


@_command("--radius 50um --radius2 5um --contact-angle 20 --humidity 90% --temperature 25degC --csv")
def curve(
    question: Question,
    points: Annotated[int, typer.Option(help="Number of states, at least 5.")] = 201,
) -> None:
    """Bridges from contact to rupture, and the unstable ones."""
    from . import bridges, report

    states, end = question.put_to(bridges.curve, points=points), question.put_to(bridges.rupture)
    _draw(question, end)
    if question.form == "json":
        typer.echo(report.json_text({**report.plain_fields(states), "units": report.UNITS}))
    elif question.form == "csv":
        typer.echo(report.csv_text(report.columns(states)), nl=False)
    else:
        _print(question, report.curve_table(states) if end.exists else "no bridge between solids apart")


@app.command(epilog="\b\nExample:\n  pendular dataset bridges.zarr --workers 2 --check")
def dataset(
    path: Annotated[Path, typer.Argument(help="Zarr store to write, or to continue: bridges.zarr.")],
    shape: Annotated[str, typer.Option(help="Half-filling angles x neck ratios.", metavar="NxM")] = "240x200",
    ratio: Annotated[list[float] | None, typer.Option(help="Size ratio; may be repeated. 1, 2, 8, 128.")] = None,
    contact_angle: Annotated[
        list[float] | None, typer.Option(help="Contact angle in degrees; may be repeated. 0, 20, 40.")
    ] = None,
    workers: Annotated[str | None, typer.Option(help="Processes, or the address of a Dask scheduler.")] = None,
    netcdf: Annotated[Path | None, typer.Option(help="Copy to a NetCDF file: bridges.nc.", metavar="FILE")] = None,
    check: Annotated[bool, typer.Option("--check", help="Print the error of its interpolation.")] = False,
) -> None:
    """Data base of bridges over half-filling angle and neck ratio."""
    from . import dataset as data
    from .report import dataset_lines

    counts = re.fullmatch(r"(\d+)x(\d+)", shape)
    if counts is None:
        raise ValueError(f"shape: {shape!r} is not of the form 240x200")
    _need_extra("data", "xarray", "zarr", "h5netcdf", "dask")
    degrees = None if contact_angle is None else [math.radians(angle) for angle in sorted(contact_angle)]
    made = data.make_dataset(
        path,
        shape=(int(counts[1]), int(counts[2])),
        size_ratio=sorted(ratio or data.PAPER_RATIOS),
        contact_angle=data.PAPER_ANGLES if degrees is None else degrees,
        workers=int(workers) if workers is not None and workers.isdigit() else workers,
        progress=True,
    )
    if netcdf is not None:
        data.save_dataset(made, netcdf)
    typer.echo(dataset_lines(made, check))


@app.command(epilog="\b\nExample:\n  pendular paper --out paper")
def paper(
    out: Annotated[Path, typer.Option(help="Folder for figures, claims.json and index.html.", metavar="DIR")],
) -> None:
    """The paper of Zhao, Kruyt and Millet: its figures drawn anew, its claims measured."""
    from rich.console import Console
    from rich.progress import Progress

    from .paper.report import write_report

    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=1.0)
        paths = write_report(out, progress=lambda done, share: bar.update(task, description=done, completed=share))
    typer.echo(f"{len(paths)} files; open {out / 'index.html'}")


def _need_extra(extra: str, *packages: str) -> None:
    """Refuse what an optional dependency is needed for, in one line."""
    missing = [package for package in packages if find_spec(package) is None]
    if missing:
        raise ValueError(f"{extra}: {', '.join(missing)} is not installed; pip install 'pendular[{extra}]'")


def _instability(question: Question, end: "Bridge") -> "Bridge | None":
    """Where the bridge loses its stability, if that is before the fold: at constant volume only."""
    from .bridges import rupture

    if "volume" not in question.control:
        return None
    first = question.put_to(rupture, limit="stability")
    # Where nothing comes first both are the same point, found along two ways.
    return first if first.separation < end.separation * (1.0 - 1e-9) else None


def _draw(question: Question, end: "Bridge", state: "Bridge | None" = None, separation: float = 0.0) -> None:
    """Draw the picture, if one is wanted."""
    if question.picture is None:
        return
    from .bridges import curve
    from .plot import figure, save

    picture = figure(
        question.pair,
        state,
        question.put_to(curve),
        end,
        separation=separation,
        instability=_instability(question, end),
        title=question.title,
        subtitle=question.subtitle,
    )
    try:
        save(picture, question.picture)
    except OSError as error:
        raise ValueError(f"plot: '{question.picture}' cannot be written: {error.strerror}") from error


def _print(question: Question, answer: "Table | str") -> None:
    """Print the question and its answer for a person."""
    from rich.console import Console

    console = Console(highlight=False, markup=False, emoji=False)
    if not console.is_terminal:
        console.width = 120  # no need to wrap for a file or another program
    console.print(question.title, style="bold")
    console.print(f"{question.subtitle}\n", style="dim")
    console.print(answer)
    if question.picture is not None:
        console.print(f"\npicture: {question.picture}", soft_wrap=True)


@contextmanager
def _warnings_in_one_line() -> Iterator[None]:
    """Print each warning of the library once, and no warning of any other."""
    from .bridges import ConvergenceWarning
    from .liquid import KelvinWarning

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("ignore")
        for category in (KelvinWarning, ConvergenceWarning):
            warnings.simplefilter("always", category)
        yield
    for message in dict.fromkeys(str(warning.message) for warning in caught):
        _complain(f"warning: {message}")


@contextmanager
def _compiling_shown() -> Iterator[None]:
    """Say on a terminal why the first run on a machine takes so long."""
    if not sys.stderr.isatty():
        yield
        return
    from numba.core import event
    from rich.console import Console

    status = Console(stderr=True).status("compiling the solver (first run only)")

    class Notice(event.Listener):
        def on_start(self, event: Any) -> None:
            status.start()

        def on_end(self, event: Any) -> None:
            status.stop()

    with event.install_listener("numba:compile", Notice()):
        yield
