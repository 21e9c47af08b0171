"""Solids as people write them, ``cone:30deg:20nm``, and in a few words."""

import math
from typing import TYPE_CHECKING

from ..ground.units import read, read_angle, show

# NumPy and all that needs it are imported by those who use it: the help is shown without.
if TYPE_CHECKING:
    from ..ask.shapes import Shape

__all__ = ["FORMS", "PLANE", "describe_solid", "read_size", "read_solid"]

PLANE = ("inf", "plane", "plate")
FORMS = "cone:30deg, cone:30deg:20nm with a round tip, paraboloid:1um, disc:1mm, disc:1mm:pinned, sphere:50um, plane"


def read_size(name: str, text: str, example: str) -> float:
    """A radius or a diameter, [m]; infinite for a plane.

    Examples
    --------
    >>> read_size("radius", "plane", "50um")
    inf
    """
    if text.strip().lower() in PLANE:
        return math.inf
    size = read(name, text, "m", example)
    if not size > 0.0:
        raise ValueError(f"{name}: {text!r} is not > 0; write it like {example}")
    return size


def read_solid(name: str, text: str) -> "float | Shape":
    """A solid: a radius, [m], or another shape.

    Examples
    --------
    >>> read_solid("solid", "disc:1mm:pinned")
    Disc(radius=0.001, pinned=True)
    >>> read_solid("solid2", "cube:1mm")
    Traceback (most recent call last):
        ...
    ValueError: solid2: 'cube:1mm' is not one of cone:30deg, cone:30deg:20nm with a round tip, paraboloid:1um, \
disc:1mm, disc:1mm:pinned, sphere:50um, plane
    """
    from ..ask.shapes import Cone, Disc, Paraboloid

    kind, *sizes = (part.strip() for part in text.split(":"))
    kind = kind.lower()
    if kind in PLANE and not sizes:
        return math.inf
    if kind == "cone" and len(sizes) in (1, 2):
        degrees = read_angle(name, sizes[0])
        if not 0.0 < degrees <= 90.0:
            raise ValueError(f"{name}: half angle {sizes[0]!r} is not in (0, 90] degrees; write it like cone:30deg")
        return Cone(math.radians(degrees), read_size(name, sizes[1], "20nm") if len(sizes) == 2 else 0.0)
    if kind == "disc" and len(sizes) == 2 and sizes[1].lower() == "pinned":
        return Disc(_finite(name, sizes[0], "1mm"), pinned=True)
    if len(sizes) == 1 and kind in ("sphere", "paraboloid", "disc"):
        size = _finite(name, sizes[0], {"sphere": "50um", "paraboloid": "1um", "disc": "1mm"}[kind])
        return size if kind == "sphere" else Paraboloid(size) if kind == "paraboloid" else Disc(size)
    raise ValueError(f"{name}: {text!r} is not one of {FORMS}")


def _finite(name: str, text: str, example: str) -> float:
    size = read_size(name, text, example)
    if math.isinf(size):
        raise ValueError(f"{name}: {text!r} is no length; write it like {example}")
    return size


def describe_solid(solid: "float | Shape") -> str:
    """A solid in a few words.

    Examples
    --------
    >>> describe_solid(50e-6), describe_solid(math.inf)
    ('sphere of radius 50 µm', 'plate')
    """
    from ..ask.shapes import Cone, Disc, Paraboloid

    if isinstance(solid, Cone):
        tip = f" and tip radius {show(solid.tip_radius, 'm', 4)}" if solid.tip_radius else ""
        return f"cone of half angle {math.degrees(solid.half_angle):.4g}°{tip}"
    if isinstance(solid, Paraboloid):
        return f"paraboloid of tip radius {show(solid.tip_radius, 'm', 4)}"
    if isinstance(solid, Disc):
        return f"{'pinned disc' if solid.pinned else 'disc'} of radius {show(solid.radius, 'm', 4)}"
    if not isinstance(solid, float):
        return repr(solid)
    return "plate" if math.isinf(solid) else f"sphere of radius {show(solid, 'm', 4)}"
