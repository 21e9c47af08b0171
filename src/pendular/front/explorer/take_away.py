"""What can be taken from the page: the curve, the picture, and ways to ask the same question without it."""

import math
import shlex
from pathlib import Path
from tempfile import TemporaryDirectory

from ...ask.face import curve
from ...show.text import columns, csv_text
from .answer import Answer
from .view import options

__all__ = ["command_line", "curve_csv", "picture_svg", "python_text"]


def command_line(answer: Answer) -> str:
    """Command that prints the same answer."""
    words = ["pendular", "bridge"]
    for name, text in options(answer.view).items():
        words += [f"--{name}", text]
    return shlex.join(words)


def python_text(answer: Answer) -> str:
    """Program that prints the same force."""
    pair, liquid = answer.question.pair, answer.question.liquid
    radii = _both(*(_number(float(radius)) for radius in pair.radii))
    angles = _both(*(f"np.deg2rad({_number(math.degrees(angle))})" for angle in pair.contact_angles))
    if liquid.temperature is None:
        wetting = f"pl.Liquid(surface_tension={liquid.surface_tension!r})"
    else:
        wetting = f"pl.Liquid.named({liquid.name!r}, temperature={liquid.temperature!r})"
    ((control, value),) = answer.question.control.items()
    return f"""\
import numpy as np
import pendular as pl

pair = pl.Pair(radius={radii}, contact_angle={angles})
liquid = {wetting}
b = pl.bridge(pair, {answer.separation!r}, {control}={value!r}, liquid=liquid)
print(f"{{b.force:.6e}} N")
"""


def _both(first: str, second: str) -> str:
    return first if first == second else f"({first}, {second})"


def _number(value: float) -> str:
    return "np.inf" if math.isinf(value) else repr(float(f"{value:.15g}"))


def curve_csv(answer: Answer) -> str:
    """The states of the curve, as ``pendular curve --csv`` prints them."""
    return csv_text(columns(answer.question.put_to(curve)))


def picture_svg(answer: Answer) -> bytes:
    """The picture that ``pendular bridge --plot`` draws."""
    from ...show.picture import save

    with TemporaryDirectory() as folder:
        path = Path(folder) / "bridge.svg"
        save(answer.question.draw(answer.rupture, answer.state, answer.separation), path)
        return path.read_bytes()
