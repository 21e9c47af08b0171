"""What the page shows: the options of the command line as texts, and the address that carries them."""

import re
from collections.abc import Mapping
from typing import Any, NamedTuple
from urllib.parse import quote, urlencode

from ...ground.check import one_of
from ..options import Question, read_question

__all__ = ["CONTROLS", "PLANE", "PLOTTED", "View", "address", "options", "question", "view_at"]

CONTROLS = ("suction", "volume", "humidity")
PLANE = "plane"

# What can be drawn against the separation: all that is one number.
PLOTTED = (
    "force",
    "volume",
    "suction",
    "neck_radius",
    "liquid_gas_area",
    "surface_energy",
    "grand_potential",
    "stiffness",
)

_QUANTITY = re.compile(r"([+-]?[\d.]+(?:e[+-]?\d+)?) *(\D.*)", re.IGNORECASE)


class View(NamedTuple):
    """All that a person can set on the page, as he writes it; an empty text is an option that is left out."""

    radius: str = "50 µm"
    radius2: str = "50 µm"
    contact_angle: str = "20°"
    contact_angle2: str = ""  # as the first
    liquid: str = "water"
    temperature: str = "20 °C"
    surface_tension: str = ""  # if given, instead of liquid and temperature
    control: str = "suction"
    value: str = "5 kPa"
    separation: str = "3 µm"
    plot: str = "force"
    laws: tuple[str, ...] = ()


def options(view: View) -> dict[str, str]:
    """Options by which the command line asks what a view shows.

    Examples
    --------
    >>> options(View(surface_tension="72.8 mN/m"))["surface-tension"], options(View())["temperature"]
    ('72.8mN/m', '20degC')
    """
    return {name: text if name == "liquid" else _bare(text) for name, text in _given(view).items()}


def _given(view: View) -> dict[str, str]:
    given = {"radius": view.radius, "radius2": view.radius2, "contact-angle": view.contact_angle}
    if view.contact_angle2:
        given["contact-angle2"] = view.contact_angle2
    if view.surface_tension:
        given["surface-tension"] = view.surface_tension
    else:
        given |= {"liquid": view.liquid, "temperature": view.temperature}
    return given | {view.control: view.value, "separation": view.separation}


def question(view: View) -> Question:
    """Question that a view asks; ValueError in one line for what cannot be meant."""
    given: dict[str, Any] = {name.replace("-", "_"): text for name, text in _given(view).items()}
    del given["separation"]
    return read_question(**given).of_one_value()


def address(view: View) -> str:
    """Address of a view, below that of the page.

    Examples
    --------
    >>> address(View())[:50]
    '/?radius=50um&radius2=50um&contact-angle=20&liquid'
    >>> view_at({"radius": "50um", "volume": "5pL"})[-5:-2]
    ('volume', '5 pL', '3 µm')
    """
    parameters = options(view) | {"plot": view.plot}
    if view.laws:
        parameters["laws"] = ",".join(view.laws)
    return f"/?{urlencode(parameters, quote_via=quote, safe=',/')}"


def view_at(parameters: Mapping[str, str]) -> View:
    """View of an address; ValueError for a parameter that no view has."""
    from ...laws import laws

    view, texts = View(), dict(parameters)
    held = [name for name in CONTROLS if name in texts]
    if len(held) > 1:
        raise ValueError(f"control: {' and '.join(held)} given; only one of the three can be held")
    chosen = tuple(filter(None, texts.pop("laws", "").split(",")))
    for name in chosen:
        one_of("laws", name, tuple(laws))
    one_of("plot", texts.get("plot", view.plot), PLOTTED)
    for name in held:
        view = view._replace(control=name, value=_spaced(texts.pop(name)))
    fields = {name.replace("-", "_"): text for name, text in texts.items()}
    for name in fields:
        one_of("address", name, View._fields)
    for name in ("contact_angle", "contact_angle2"):
        if fields.get(name, "")[-1:].isdigit():
            fields[name] += "°"
    return view._replace(laws=chosen, **{name: _spaced(text) for name, text in fields.items()})


def _bare(text: str) -> str:
    """Quantity as it is typed in a shell."""
    plain = text.strip().replace("µ", "u").replace("°C", "degC").removesuffix("°")
    return "".join(found.groups()) if (found := _QUANTITY.fullmatch(plain)) else plain


def _spaced(text: str) -> str:
    """Quantity as it is shown to people, the inverse of `_bare`."""
    if not (found := _QUANTITY.fullmatch(text)):
        return text
    unit = found[2].replace("degC", "°C")
    return text if unit == "°" else f"{found[1]} {'µ' + unit[1:] if unit.startswith('u') else unit}"
