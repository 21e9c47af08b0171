"""What the commands that tabulate bridges are asked, and the table that they carry elsewhere."""

import math
import warnings
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from ..options import read_contact_angle
from ._app import compiling_shown

if TYPE_CHECKING:
    from ...table import Table

__all__ = ["Angle", "Ratios", "SecondAngle", "Volumes", "tabulated"]

Range = tuple[float, float]

Angle = Annotated[str, typer.Option(help="Contact angle: 20 or 20deg, 0.35rad.", metavar="ANGLE")]
SecondAngle = Annotated[
    str | None, typer.Option(help="Contact angle on the second solid, if another: 60.", metavar="ANGLE")
]
Volumes = Annotated[
    Range | None,
    typer.Option(
        "--reduced-volume",
        "--volume",
        help="Or hold the volume: range of volume / cube of mean radius.",
        metavar="MIN MAX",
    ),
]
Ratios = Annotated[Range, typer.Option(help="Range of larger over smaller radius.", metavar="MIN MAX")]


def tabulated(
    contact_angle: str,
    contact_angle2: str | None,
    suctions: Range | None,
    volumes: Range | None,
    ratios: Range,
    tolerance: float | None,
) -> "Table":
    """Table of what was asked; the bounds of its errors are for the command to tell."""
    second = contact_angle if contact_angle2 is None else contact_angle2
    angles = tuple(
        math.radians(read_contact_angle(name, text))
        for name, text in (("contact-angle", contact_angle), ("contact-angle2", second))
    )
    if volumes is not None and suctions is not None:
        raise ValueError("reduced-volume: given together with reduced-suction; one of the two is held")
    control: Literal["suction", "volume"] = "suction" if volumes is None else "volume"
    with compiling_shown(), warnings.catch_warnings():
        from ...table import ToleranceWarning, tabulate
        from ...table.task import refuse_dry

        if control == "suction":
            refuse_dry((angles[0], angles[1]))
        warnings.simplefilter("ignore", ToleranceWarning)
        return tabulate(angles, control, reduced=volumes or suctions, radius_ratio=ratios, tolerance=tolerance)
