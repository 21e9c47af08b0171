"""A field of the page: a label, a text with its unit, a slider, and the line that says what is wrong."""

from collections.abc import Callable
from typing import NamedTuple

from nicegui import ui

__all__ = ["Field", "Thumb"]


class Thumb(NamedTuple):
    """Where the thumb of a slider belongs, for the browser."""

    slider: str  # its id
    steps: int
    position: int
    text: str  # for those who hear the page


class Field:
    """A label, a text and, if it can be slid, a slider; who listens hears of what a person does, not of the page.

    Parameters
    ----------
    label : str
        Name of the quantity.
    on_text : callable
        Told the text when it is complete: by Enter, or on leaving the field.
    on_slide : callable, optional
        Told the position of the slider while it moves; without one there is no slider.
    suggestions : list of str, optional
        Words to complete the text with.
    """

    def __init__(
        self,
        label: str,
        on_text: Callable[[str], None],
        on_slide: Callable[[int], None] | None = None,
        suggestions: list[str] | None = None,
    ) -> None:
        self._on_text, self._name = on_text, label
        self._known = ""  # the last text that was shown or reported
        self._is_refused = False
        self._slider: ui.element | None = None
        self.root = ui.element("div").classes("field")
        with self.root:
            self._label = ui.html(label, sanitize=False, tag="label")
            self._text = ui.input(autocomplete=suggestions)
            self._text.props("dense outlined hide-bottom-space spellcheck=false autocapitalize=off")
            self._text.on("blur", self._finish).on("keydown.enter", self._finish)
            self._label.props(f"for={self._text.html_id}")
            if on_slide is not None:
                self._slider = _slider(on_slide).props(f'aria-label="{label}"')
            self._wrong = ui.label().classes("wrong").props("role=alert")
            self._wrong.set_visibility(False)

    def show(self, text: str) -> None:
        """Show what was accepted; but a refused text stays until it is corrected."""
        if not self._is_refused:
            self._known = text
            self._text.set_value(text)

    def thumb(self, position: float, steps: int) -> Thumb | None:
        """Place of the thumb, if there is a slider and what it shows was accepted."""
        if self._slider is None or self._is_refused:
            return None
        return Thumb(self._slider.html_id, steps, round(position), self._known)

    def rename(self, label: str) -> None:
        """Give the field another name."""
        if label == self._name:
            return
        self._name = label
        self._label.set_content(label)
        if self._slider is not None:
            self._slider.props["aria-label"] = label

    def refuse(self, text: str, message: str) -> None:
        """Say why a text was not accepted, and keep it."""
        self._is_refused = True
        self._known = text
        self._text.set_value(text)
        self._text.props("error aria-invalid=true")
        self._wrong.set_text(message)
        self._wrong.set_visibility(True)

    def accept(self) -> None:
        """Take back what `refuse` said."""
        if self._is_refused:
            self._is_refused = False
            self._text.props(remove="error aria-invalid")
            self._wrong.set_visibility(False)

    def _finish(self) -> None:
        text = (self._text.value or "").strip()
        if self._is_refused or text != self._known:
            self._known = text
            self._on_text(text)


def _slider(on_slide: Callable[[int], None]) -> ui.element:
    """The browser's own slider, whose keyboard, touch and speech work everywhere.

    Its position is no property of the element: the page would set it back to where it was a moment ago while it is
    being dragged. See `slideTo` in page.js.
    """
    slider = ui.element("input").props("type=range min=0 max=1000 step=1")
    tell = "(event) => report(emit, event.target.valueAsNumber)"
    return slider.on("input", lambda event: on_slide(int(event.args)), js_handler=tell)
