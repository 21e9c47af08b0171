"""What the site shows of the program, made anew at each build: ``make`` writes it to ``docs/made``.

Tables come from the records behind them, pictures from the commands that stand beside them on the pages.
"""

import contextlib
import io
import runpy
import shlex
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import typer
from studies.paper.claims import Claim, measure
from tools import law_in_c
from tools.code_blocks import code_blocks, commands
from tools.live_bridge import fragment
from tools.site_pictures import PICTURES

from pendular import bridge, rupture
from pendular.ask.result import FIELDS
from pendular.comparison.measured import measured_errors
from pendular.front.cli import app
from pendular.front.cli import main as pendular
from pendular.front.explorer.files import write_page
from pendular.front.options import read_question
from pendular.ground.units import read
from pendular.laws import laws
from pendular.laws._registry import is_of_the_house
from pendular.show.picture import save

ROOT = Path(__file__).parents[1]


def make(docs: Path) -> None:
    """Write all parts of the site that its pages include."""
    made = docs / "made"
    made.mkdir(exist_ok=True)
    parts = {"fields": fields, "commands": command_pages, "claims": claims, "law_functions": law_functions}
    for name, part in parts.items():
        (made / f"{name}.md").write_text("\n".join(part()) + "\n", encoding="utf-8")
    (made / "live_bridge.html").write_text(fragment(), encoding="utf-8")
    for name, draw in PICTURES.items():
        draw(made / f"{name}.svg")
    for law in laws.values():
        (made / f"{law.name}.c").write_text(law_in_c.source(law), encoding="utf-8")
        if measured_errors(law).control_star.size:
            run(f"pendular compare --map {law.name} --plot {made / f'map_{law.name}.svg'}")
    with contextlib.chdir(docs):
        for page in sorted(docs.glob("**/*.md")):
            text = page.read_text(encoding="utf-8")
            for command in drawing_commands(text):
                run(command)
            for command, picture in stacking_commands(text):
                draw_stacked(command, picture)


def write_explorer(folder: Path) -> None:
    """Write the explorer page beside the others; a remark in its place where the solver cannot be made."""
    try:
        write_page(folder)
    except ValueError as error:
        folder.mkdir(exist_ok=True)
        (folder / "index.html").write_text(f"<!doctype html><title>Pendular explorer</title><p>{error}", "utf-8")


def shell_commands(text: str) -> list[str]:
    """Return all commands of a page."""
    blocks = [block for block in code_blocks(text) if block.language in ("sh", "console")]
    return [line for block in blocks for line in commands(block)]


def drawing_commands(text: str) -> list[str]:
    """Return the commands of a page that draw a picture which the page shows."""
    return [line for line in shell_commands(text) if is_shown(shlex.split(line)[-1], text)]


def is_shown(picture: str, text: str) -> bool:
    """Whether a page, of ``docs`` or of a folder below, shows a picture."""
    return f"({picture})" in text or f"(../{picture})" in text


def stacking_commands(text: str) -> list[tuple[str, str]]:
    """Return the commands of a page whose picture it shows stacked as well, for a phone, and the path of that."""
    found = [(line, f"made/{Path(shlex.split(line)[-1]).stem}_stacked.svg") for line in shell_commands(text)]
    return [(command, picture) for command, picture in found if is_shown(picture, text)]


def draw_stacked(command: str, picture: str) -> None:
    """Draw the picture of ``pendular bridge ... --plot`` with the pair above its curve."""
    words = shlex.split(command)[2:]
    options = {name[2:].replace("-", "_"): value for name, value in zip(words[::2], words[1::2], strict=True)}
    del options["plot"]
    gap = read("separation", options.pop("separation"), "m", "1um")
    question = read_question(**options)
    state, end = question.put_to(bridge, gap), question.put_to(rupture)
    save(question.draw(end, state, gap, stacked=True), Path(picture))


def run(command: str) -> None:
    """Run a command of a page, ``pendular ...`` or ``python examples/...``, in this process and without its output."""
    program, *arguments = shlex.split(command)
    with contextlib.redirect_stdout(io.StringIO()):
        if program == "python":
            run_script(ROOT / arguments[0], arguments[1:])
            return
        try:
            pendular(arguments)
        except SystemExit as end:
            if end.code:
                raise RuntimeError(f"{command}: status {end.code}") from end


def run_script(path: Path, arguments: list[str]) -> None:
    """Run a script with arguments, as from the command line."""
    before = sys.argv
    sys.argv = [str(path), *arguments]
    try:
        runpy.run_path(str(path), run_name="__main__")
    finally:
        sys.argv = before


def fields() -> Iterator[str]:
    """Table of the fields of a bridge."""
    yield from ("| field | unit | meaning |", "| --- | --- | --- |")
    for name, unit, meaning in FIELDS:
        yield f"| `{name}` | {unit.replace('^2', '²').replace('^3', '³') or '–'} | {meaning} |"


def command_pages() -> Iterator[str]:
    """Help of every command, as it prints itself."""
    for path in command_paths(typer.main.get_command(app)):
        with contextlib.redirect_stdout(io.StringIO()) as printed, contextlib.suppress(SystemExit):
            pendular([*path, "--help"])
        yield from ("", f"## {' '.join(path)}", "", "```text", printed.getvalue().strip("\n"), "```")


def command_paths(group: Any) -> Iterator[list[str]]:
    """Words that name each command; a group stands for those in it."""
    for name, command in group.commands.items():
        if hasattr(command, "commands"):
            yield from ([name, *path] for path in command_paths(command))
        else:
            yield [name]


def claims() -> Iterator[str]:
    """The audit of the article: what it says, whether it holds, and what is found."""
    for subject, audited in measure().items():
        yield from ("", f"## {subject}", "", "| | statement | found here |", "| --- | --- | --- |")
        yield from (claim_row(claim) for claim in audited)


def claim_row(claim: Claim) -> str:
    """A row of the audit."""
    found = " ".join(f"{part.removesuffix('.')}." for part in (claim.measured, claim.why, claim.better) if part)
    cells = ("holds" if claim.holds else "**fails**", f"{claim.says} *{claim.where}*", found)
    return (
        "| "
        + " | ".join(cell.replace("H*", "H\\*").replace("V*", "V\\*").replace("λ*", "λ\\*") for cell in cells)
        + " |"
    )


def law_functions() -> Iterator[str]:
    """Formulas of all laws, from their docstrings, which their records complete."""
    for law in laws.values():
        yield from ("", f"## {law.name}", "", f"{law.title}. [Errors and a map](../laws/{law.name}.md).", "")
        yield "```{eval-rst}"
        for function in (*law.kernels.values(), *law.steps):
            module = f"pendular.laws.{law.name}" if is_of_the_house(law.name) else function.__module__
            yield from (f".. currentmodule:: {module}", f".. autofunction:: {module}.{function.__name__}")
        yield "```"
