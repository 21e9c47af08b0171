"""The code blocks of Markdown pages, for the tests that run them and for the build that draws with them."""

import re
from typing import NamedTuple

_FENCE = re.compile(r"^(?P<fence>`{3,})(?P<language>[\w-]+)\n(?P<code>.*?)^(?P=fence)$", re.MULTILINE | re.DOTALL)


class Block(NamedTuple):
    """A code block: its language, its text and the line on which it begins."""

    language: str
    code: str
    line: int


def code_blocks(text: str) -> list[Block]:
    """Blocks with a language, in order; those of a directive, like ``{include}``, are no code."""
    found = _FENCE.finditer(text)
    return [Block(match["language"], match["code"], text.count("\n", 0, match.start()) + 1) for match in found]


def section(text: str, heading: str) -> str:
    """What stands under a heading of the second level."""
    (found,) = re.findall(rf"^## {heading}\n(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)
    return found


def commands(block: Block) -> list[str]:
    """Commands of a shell block, a line each; of a console block those after a prompt."""
    lines = block.code.replace("\\\n", " ").splitlines()
    if block.language == "console":
        return [line.removeprefix("$ ") for line in lines if line.startswith("$ ")]
    return [line for line in lines if line.strip() and not line.startswith("#")]
