"""What all commands share: how they are made, how they end, and how they print."""

import inspect
import os
import sys
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ... import __version__
from ...ground.files import in_one_line
from ..options import Question, in_terms_of_options, read_question

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.console import RenderableType

__all__ = [
    "app",
    "compiling_shown",
    "help_if_alone",
    "main",
    "need_extra",
    "print_answer",
    "print_page",
    "question_command",
    "save_picture",
    "warnings_in_one_line",
]

_NOT_WRITTEN, _BAD_INPUT, _INTERRUPTED = 1, 2, 130
_FORMS = ("as_json", "as_csv", "plot")

# The decorated help would first read a Markdown parser and a highlighter, which takes as long as all the rest.
app = typer.Typer(
    rich_markup_mode=None,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command and leave with its exit status: 2 and one line on stderr for bad input, 1 for a full disk.

    Parameters
    ----------
    arguments : sequence of str, optional
        Those of the process by default.
    """
    if "numpy" not in sys.modules:  # no command has matrices for the threads of its BLAS, which turn idly for a while
        os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    try:
        status = app(arguments, prog_name="pendular", standalone_mode=False)
        sys.stdout.flush()
    except typer.Abort:
        sys.exit(_INTERRUPTED)
    except ValueError as error:
        _complain(in_terms_of_options(str(error)))
        sys.exit(_BAD_INPUT)
    except OSError as error:
        _drop_output()
        if not isinstance(error, BrokenPipeError):  # a reader that has enough, like head, is no error to speak of
            _complain(f"{error.filename or 'output'}: {error.strerror or error}")
        sys.exit(_NOT_WRITTEN)
    except Exception as error:
        if not hasattr(error, "format_message"):  # what the option parser raises has it, whichever package holds it
            raise
        _complain(_what_is_missing(error) or error.format_message())
        sys.exit(_BAD_INPUT)
    sys.exit(status or 0)


def _what_is_missing(error: Any) -> str:
    """What an option that was not given is and how it is written, by its help; empty for any other error."""
    option = getattr(error, "param", None)
    if option is None or not type(error).__name__.startswith("Missing"):
        return ""
    name = max(option.opts, key=len).lstrip("-")
    return f"{name}: missing; {option.help[:1].lower()}{option.help[1:].removesuffix('.')}"


def _drop_output() -> None:
    """Let the interpreter find no output to write as it ends, which would fail once more."""
    with suppress(OSError, ValueError):  # no file stands behind it
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _complain(message: str) -> None:
    typer.echo(f"pendular: {' '.join(message.split())}", err=True)


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
    help_if_alone(context)


def help_if_alone(context: typer.Context) -> None:
    """Show the help of a group that was called without one of its commands."""
    if context.invoked_subcommand is None:
        typer.echo(context.get_help())


def question_command(
    example: str,
    *,
    takes_sweeps: bool = False,
    has_other_uses: bool = False,
    to_file_of: typer.Typer | None = None,
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Make a command of a function of a question and of options of its own, with all shared options before them.

    Without ``takes_sweeps`` the question has one value of its control.
    The function of a command with other uses is given the shared options as they are, to be read if it needs them. A
    command that writes a file, of a group of commands, has no form of the answer.
    """

    def register(answer: Callable[..., None]) -> Callable[..., None]:
        shared = dict(inspect.signature(read_question).parameters)
        own = list(inspect.signature(answer).parameters.values())[1:]
        if to_file_of is not None:
            shared = {name: option for name, option in shared.items() if name not in _FORMS}
        name = answer.__name__.replace("_", "-")
        group, path = (app, name) if to_file_of is None else (to_file_of, f"{to_file_of.info.name} {name}")

        def asked(options: dict[str, Any]) -> Question:
            question = read_question(**options)
            return question if takes_sweeps else question.of_one_value()

        def command(**given: Any) -> None:
            options = {option: given.pop(option) for option in shared}
            with warnings_in_one_line(), compiling_shown():
                answer(options if has_other_uses else asked(options), **given)

        parameters = [p.replace(kind=p.KEYWORD_ONLY) for p in (*shared.values(), *own)]
        command.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
        command.__annotations__ = {p.name: p.annotation for p in parameters}
        command.__doc__ = answer.__doc__
        group.command(name, epilog=f"\b\nExample:\n  pendular {path} {example}")(command)
        return answer

    return register


def save_picture(drawing: "Figure", path: Path) -> None:
    """Write a picture, or say in one line why it cannot be written."""
    from ...show.picture import save

    with in_one_line("plot", path):
        save(drawing, path)


def print_answer(question: Question, answer: "RenderableType") -> None:
    """Print the question and its answer for a person."""
    print_page(question.title, question.subtitle, answer, question.picture)


def print_page(title: str, subtitle: str, answer: "RenderableType", picture: Path | None = None) -> None:
    """Print an answer for a person under two lines that tell what it is."""
    from rich.console import Console

    console = Console(highlight=False, markup=False, emoji=False)
    if not console.is_terminal:
        console.width = 120  # no need to wrap for a file or another program
    console.print(title, style="bold")
    console.print(f"{subtitle}\n", style="dim")
    console.print(answer)
    if picture is not None:
        console.print(f"\npicture: {picture}", soft_wrap=True)


def need_extra(extra: str, *packages: str) -> None:
    """Refuse what an optional dependency is needed for, in one line."""
    missing = [package for package in packages if find_spec(package) is None]
    if missing:
        raise ValueError(f"{extra}: {', '.join(missing)} is not installed; pip install 'pendular[{extra}]'")


@contextmanager
def warnings_in_one_line() -> Iterator[None]:
    """Print each warning of the library once, and no warning of any other."""
    from ...ask.face import ConvergenceWarning
    from ...ask.liquid import KelvinWarning
    from ...fitting.fitting import FitWarning
    from ...packing.heap import PackingWarning

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("ignore")
        for category in (KelvinWarning, ConvergenceWarning, FitWarning, PackingWarning):
            warnings.simplefilter("always", category)
        yield
    for message in dict.fromkeys(str(warning.message) for warning in caught):
        _complain(f"warning: {message}")


@contextmanager
def compiling_shown() -> Iterator[None]:
    """Say on a terminal why the first run on a machine takes so long."""
    if not sys.stderr.isatty():
        yield
        return
    from rich.console import Console

    from ...ground.native import notices

    console = Console(stderr=True)
    notices.append(lambda: console.status("compiling the solver, once on this machine: most of a minute"))
    try:
        yield
    finally:
        notices.pop()
