"""The page itself: what stands where, and what a change of one thing changes elsewhere."""

import json
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from html import escape
from typing import Any

from nicegui import run, ui

from ...laws import Law
from ..options import in_terms_of_options
from .answer import Answer, answer_to
from .curve_chart import curve_chart, law_style
from .field import Field, Thumb
from .fragments import error_cells, headline, numbers, paragraphs
from .pair_picture import pair_svg
from .take_away import command_line, curve_csv, picture_svg, python_text
from .track import held_instead, track_of, value_of, written
from .view import CONTROLS, PLANE, PLOTTED, View, address, view_at

__all__ = ["Explorer"]

_ADDRESS_INTERVAL = 0.5  # s; browsers refuse more than a few changes of the address a second
_BY_NAME, _GIVEN = "by name", "surface tension"
_LIQUIDS = ["water", "ethanol", "glycerol", "ethylene glycol", "isopropanol", "acetone", "toluene", "mercury"]
_SYMBOLS = (
    "H* = Δp R̄/γ is the reduced suction, V* = V/R̄³ the reduced volume, D* = D/R̄ the reduced separation, "
    "R̄ = 2R₁R₂/(R₁ + R₂), θ the contact angle."
)


class Explorer:
    """One person's page, as its address wants it; a change that the library refuses leaves all but its field alone."""

    def __init__(self, parameters: Mapping[str, str]) -> None:
        wrong = []
        try:
            self._answer = answer_to(view_at(parameters))
        except ValueError as error:
            wrong = [f"This address cannot be shown: {in_terms_of_options(str(error))}."]
            self._answer = answer_to(View())
        self._fields: dict[str, Field] = {}
        self._places = {law.law.name: place for place, law in enumerate(self._answer.laws)}
        self._is_showing = False
        self._written_address = ""
        self._lay_out_pair()
        with ui.element("div").classes("settings"):
            self._lay_out_control()
            self._lay_out_solids()
            self._lay_out_liquid()
        self._lay_out_curve()
        self._lay_out_numbers()
        self._lay_out_laws()
        self._lay_out_downloads()
        self._show(self._answer)
        self._notices.set_content(paragraphs([*wrong, *self._answer.notices]))
        ui.timer(_ADDRESS_INTERVAL, self._write_address)

    # Layout

    def _lay_out_pair(self) -> None:
        with _panel("pair"):
            self._pair = ui.html(sanitize=False).classes("picture")
            self._headline = ui.html(sanitize=False).classes("tiles")

    def _lay_out_curve(self) -> None:
        with _panel("curve"):
            with ui.element("div").classes("title"):
                named = {name: name.replace("_", " ").capitalize() for name in PLOTTED}
                self._plotted = ui.select(
                    named, label="Quantity", on_change=lambda event: self._choose(plot=event.value)
                ).props("dense outlined options-dense")
                ui.html("against separation", sanitize=False, tag="h2")
            self._chart = ui.plotly({"data": [], "layout": {}})
            self._chart.props('role=img aria-label="The quantity against the separation, both branches"')

    def _lay_out_control(self) -> None:
        with _panel("control", "Held constant"):
            self._control = ui.toggle(list(CONTROLS), on_change=lambda event: self._hold(event.value))
            self._control.props('no-caps unelevated spread aria-label="What is held constant"')
            self._add_field("value", "")
            self._add_field("separation", "Separation")
            self._notices = ui.html(sanitize=False).classes("notices").props("role=status")

    def _lay_out_solids(self) -> None:
        with _panel("solids", "Solids"):
            self._add_field("radius", "Radius 1")
            self._is_plane = ui.switch("Solid 2 is a plane", on_change=lambda event: self._flatten(event.value))
            self._is_plane.props("dense")
            self._add_field("radius2", "Radius 2")
            self._add_field("contact_angle", "Contact angle 1")
            self._is_same = ui.switch("Same contact angle on both", on_change=lambda event: self._equalise(event.value))
            self._is_same.props("dense")
            self._add_field("contact_angle2", "Contact angle 2")

    def _lay_out_liquid(self) -> None:
        with _panel("liquid", "Liquid"):
            self._source = ui.toggle([_BY_NAME, _GIVEN], on_change=lambda event: self._give_liquid(event.value))
            self._source.props('no-caps unelevated spread aria-label="How the liquid is given"')
            self._fields["liquid"] = Field("Liquid", lambda text: self._change("liquid", liquid=text), None, _LIQUIDS)
            self._add_field("temperature", "Temperature")
            self._add_field("surface_tension", "Surface tension")

    def _add_field(self, name: str, label: str) -> None:
        self._fields[name] = Field(
            label, lambda text: self._change(name, **{name: text}), lambda position: self._slide(name, position)
        )

    def _lay_out_numbers(self) -> None:
        with _panel("numbers", "The bridge in numbers"):
            self._numbers = ui.html(sanitize=False, tag="table")

    def _lay_out_laws(self) -> None:
        self._ticks: dict[str, ui.checkbox] = {}
        self._errors: dict[str, ui.html] = {}
        with _panel("laws", "Laws beside the exact answer"):
            for held in ("suction", "volume"):
                with ui.element("div").classes("law"):
                    ui.html(f"At constant {held}", sanitize=False, tag="h3")
                    columns = '<span class="error">force, %</span><span class="error">rupture, %</span>'
                    ui.html(columns, sanitize=False).classes("errors")
                for answer in self._answer.laws:
                    if answer.law.control == held:
                        self._lay_out_law(answer.law)
            ui.html(_SYMBOLS, sanitize=False, tag="p").classes("symbols")

    def _lay_out_law(self, law: Law) -> None:
        name = law.name
        with ui.element("div").classes("law"):
            breakable = name.replace("_", "_\u200b")  # at the end of a narrow line
            tick = ui.checkbox(breakable, on_change=lambda: self._choose(laws=self._ticked())).props("dense")
            tick.tooltip(f"{law.title}. {law.reference}").set_enabled("force" in law.gives)
            line = _swatch(*law_style(self._places[name])) if "force" in law.gives else ""
            ui.html(line, sanitize=False).classes("swatch")
            self._ticks[name] = tick
            self._errors[name] = ui.html(sanitize=False).classes("errors")

    def _lay_out_downloads(self) -> None:
        with _panel("take", "Take it with you"):
            with ui.element("div").classes("buttons"):
                for label, save in (
                    ("Curve, CSV", self._save_curve),
                    ("Picture, SVG", self._save_picture),
                    ("Program, Python", self._save_program),
                ):
                    ui.button(label, on_click=save).props("no-caps outline dense")
            self._command = _code("On the command line")
            self._program = _code("In Python")

    # What a person does

    def _ticked(self) -> tuple[str, ...]:
        return tuple(name for name, tick in self._ticks.items() if tick.value)

    def _slide(self, name: str, position: int) -> None:
        kind = self._answer.view.control if name == "value" else name
        value = track_of(kind, self._answer).value(position)
        self._change(name, **{name: written(kind, value, 4 if name == "separation" else 3)})

    def _hold(self, control: str) -> None:
        if not self._is_showing:
            try:
                value = held_instead(control, self._answer)
            except ValueError as error:  # a liquid without density knows no humidity
                self._refuse("value", self._answer.view.value, error)
                return
            self._fields["value"].accept()
            self._change("value", control=control, value=written(control, value, 5))

    def _flatten(self, is_plane: bool) -> None:
        self._choose("radius2", radius2=PLANE if is_plane else self._answer.view.radius)

    def _equalise(self, is_same: bool) -> None:
        self._choose("contact_angle2", contact_angle2="" if is_same else self._answer.view.contact_angle)

    def _give_liquid(self, source: str) -> None:
        tension = written("surface_tension", self._answer.question.liquid.surface_tension, 4)
        self._choose("surface_tension", surface_tension=tension if source == _GIVEN else "")

    def _choose(self, field: str = "value", **changes: Any) -> None:
        if not self._is_showing:
            self._change(field, **changes)

    # What follows from it

    def _change(self, field: str, **changes: Any) -> None:
        """Show another view, or say at a field why it cannot be shown."""
        view = self._answer.view._replace(**changes)
        try:
            answer = answer_to(view)
        except ValueError as error:
            self._refuse(field, str(getattr(view, field)), error)
            return
        self._fields[field].accept()
        self._show(answer)

    def _refuse(self, field: str, text: str, error: ValueError) -> None:
        self._fields[field].refuse(text, in_terms_of_options(str(error)))
        _place([])
        self._show_choices(self._answer.view)

    def _show(self, answer: Answer) -> None:
        self._answer = answer
        self._pair.set_content(pair_svg(answer))
        self._chart.update_figure(curve_chart(answer, self._places))
        self._headline.set_content(headline(answer))
        self._notices.set_content(paragraphs(answer.notices))
        self._numbers.set_content(numbers(answer))
        for law in answer.laws:
            if law.law.name in self._errors:  # not one that was registered after the page was laid out
                self._errors[law.law.name].set_content(error_cells(law))
        self._command.set_content(escape(command_line(answer)))
        self._program.set_content(escape(python_text(answer)))
        self._show_choices(answer.view)
        self._show_fields(answer)

    def _show_choices(self, view: View) -> None:
        """Set switches, menus and ticks, and hide the fields that have no meaning beside them."""
        self._is_showing = True
        self._control.set_value(view.control)
        self._plotted.set_value(view.plot)
        self._is_plane.set_value(view.radius2 == PLANE)
        self._is_same.set_value(not view.contact_angle2)
        self._source.set_value(_GIVEN if view.surface_tension else _BY_NAME)
        for name, tick in self._ticks.items():
            tick.set_value(name in view.laws)
        self._is_showing = False
        self._fields["value"].rename(view.control.capitalize())
        self._fields["radius2"].root.set_visibility(view.radius2 != PLANE)
        self._fields["contact_angle2"].root.set_visibility(bool(view.contact_angle2))
        for name in ("liquid", "temperature"):
            self._fields[name].root.set_visibility(not view.surface_tension)
        self._fields["surface_tension"].root.set_visibility(bool(view.surface_tension))

    def _show_fields(self, answer: Answer) -> None:
        view, thumbs = answer.view, []
        for name, field in self._fields.items():
            if not field.root.visible:
                continue
            field.show(getattr(view, name))
            if name != "liquid":
                kind = view.control if name == "value" else name
                track = track_of(kind, answer)
                thumbs.append(field.thumb(track.position(value_of(kind, answer)), track.steps))
        _place(thumbs)

    def _write_address(self) -> None:
        now = address(self._answer.view)
        if now != self._written_address:
            self._written_address = now
            ui.navigate.history.replace(now)

    # Downloads

    def _save_curve(self) -> None:
        ui.download.content(curve_csv(self._answer), "curve.csv", "text/csv")

    async def _save_picture(self) -> None:
        drawn = await run.io_bound(picture_svg, self._answer)
        if drawn is not None:  # as it is where the server was stopped meanwhile
            ui.download.content(drawn, "bridge.svg", "image/svg+xml")

    def _save_program(self) -> None:
        ui.download.content(python_text(self._answer), "bridge.py", "text/x-python")


def _place(thumbs: Iterable[Thumb | None]) -> None:
    """Place the thumbs of sliders, which ends an answer to the browser."""
    ui.run_javascript(f"slideTo({json.dumps([thumb for thumb in thumbs if thumb is not None])})")


@contextmanager
def _panel(name: str, title: str = "") -> Iterator[None]:
    """Part of the page with a heading, placed by its name."""
    with ui.element("section").classes(f"panel {name}"):
        if title:
            ui.html(title, sanitize=False, tag="h2")
        yield


def _code(title: str) -> ui.html:
    """Text to copy, with a button that does."""
    with ui.element("div").classes("title"):
        ui.html(title, sanitize=False, tag="h3")
        button = ui.button("Copy").props(f'no-caps flat dense aria-label="Copy: {title}"')
    text = ui.html(sanitize=False, tag="pre").props("tabindex=0")
    button.on("click", js_handler=f"(event) => copyText('{text.html_id}', event.currentTarget)")
    return text


def _swatch(colour: str, dash: str) -> str:
    """Piece of the line by which a law is drawn."""
    dashes = {"solid": "", "dot": "2 3", "dashdot": "7 3 2 3", "longdash": "9 4"}[dash]
    return (
        '<svg viewBox="0 0 28 6" aria-hidden="true">'
        f'<path d="M1 3H27" stroke="{colour}" stroke-width="2.4" stroke-dasharray="{dashes}"/></svg>'
    )
