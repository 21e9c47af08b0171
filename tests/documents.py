"""Pages as tests: their Python prints what they say, their commands run and print what they show."""

import contextlib
import importlib.util
import io
import re
import shlex
import tomllib
from collections.abc import Iterable, Iterator
from pathlib import Path

from tools.code_blocks import Block, code_blocks, commands
from tools.site_parts import run_script

from pendular.front.cli import main

ROOT = Path(__file__).parents[1]


def python_runs(text: str) -> Iterator[tuple[int, list[str], list[str]]]:
    """Line, printed and promised output of each Python block of a page, run in one namespace.

    Promised is what stands behind ``print(...)  #``, or else all of the text block that follows at once.
    """
    blocks = code_blocks(text)
    namespace = {}
    for place, block in enumerate(blocks):
        if block.language != "python":
            continue
        with contextlib.redirect_stdout(io.StringIO()) as output:
            exec(compile(block.code, f"page, line {block.line}", "exec"), namespace)
        told = re.findall(r"^ *print\(.*\)  # (.+)$", block.code, re.MULTILINE)
        if not told and is_right_after(blocks[place + 1 : place + 2], block):
            told = blocks[place + 1].code.splitlines()
        yield block.line, [line.rstrip() for line in output.getvalue().splitlines()], told


def is_right_after(following: list[Block], block: Block) -> bool:
    """Whether a text block stands below a code block with nothing but an empty line between."""
    below = block.line + block.code.count("\n") + 3
    return [(text.language, text.line) for text in following] == [("text", below)]


def assert_python_prints_what_it_says(text: str) -> None:
    """Run all Python of a page."""
    for line, printed, told in python_runs(text):
        assert printed == told, f"line {line}"


def command_output(command: str) -> tuple[int, str, str]:
    """Exit status, output and errors of a ``pendular ...`` or ``python examples/...`` in this process."""
    program, *arguments = shlex.split(command)
    if program == "python":
        with contextlib.redirect_stdout(io.StringIO()) as output, contextlib.redirect_stderr(io.StringIO()) as errors:
            run_script(ROOT / arguments[0], arguments[1:])
        return 0, output.getvalue(), errors.getvalue()
    assert program == "pendular"
    with contextlib.redirect_stdout(io.StringIO()) as output, contextlib.redirect_stderr(io.StringIO()) as errors:
        try:
            main(arguments)
        except SystemExit as end:
            return int(end.code or 0), output.getvalue(), errors.getvalue()
    raise AssertionError(f"{command} did not end")


def shown(block: Block) -> Iterator[tuple[str, list[str]]]:
    """Commands of a console block, each with the output below it."""
    for part in re.split(r"^\$ ", block.code, flags=re.MULTILINE)[1:]:
        command, _, output = part.partition("\n")
        yield command, output.splitlines()


def assert_commands_do_what_they_show(text: str) -> None:
    """Run all commands of a page; those of console blocks print what stands below them."""
    for block in code_blocks(text):
        if block.language == "console":
            for command, expected in shown(block):
                status, output, errors = command_output(command)
                printed = [line.rstrip() for line in f"{output}{errors}".splitlines()]
                assert (status, printed) == (0, expected), f"line {block.line}: {command}"
        elif block.language == "sh":
            run_shell(commands(block))


def run_shell(lines: Iterable[str]) -> None:
    """Run the commands of a shell block, or see that they can be run."""
    for line in lines:
        program, *arguments = shlex.split(after_uv_run(line))
        if program == "pendular":
            status, _, errors = command_output(shlex.join([program, *arguments]))
            assert status == 0, f"{line}: {errors}"
        elif program == "python" and arguments[0] == "-m":
            assert importlib.util.find_spec(arguments[1]), line
        elif program == "python":
            with contextlib.redirect_stdout(io.StringIO()):
                run_script(ROOT / arguments[0], arguments[1:])
        else:
            assert can_be_run(program, arguments), line


def after_uv_run(line: str) -> str:
    """Command that uv starts, with whatever it installs for it."""
    return re.sub(r"^uv run (--(group|extra) \w+ )*", "", line)


def can_be_run(program: str, arguments: list[str]) -> bool:
    """Whether a command that a test should not run names what exists: a script, a development tool, this package."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    if program == "pip":
        extras = [f".[{name}]" for name in project["project"]["optional-dependencies"]]
        return arguments[0] == "install" and arguments[1] in (".", "uv", *extras)
    if program == "uv":
        return arguments[:2] == ["sync", "--group"] and arguments[2] in project["dependency-groups"]
    groups = [name for group in project["dependency-groups"].values() for name in group if isinstance(name, str)]
    tools = {re.split(r"[\[<>=]", name)[0] for name in groups} | {"lint-imports"}
    return program in tools or (ROOT / program).is_file()
