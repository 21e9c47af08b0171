"""Write ``docs/laws.md``, a page for each law and the pictures: ``python -m tools.law_pages``.

Everything on the pages comes from the records of the laws, from the docstrings of their formulas and from their stored
errors, which ``python -m tools.law_errors`` measures; the pictures are those of ``pendular compare``.
"""

import inspect
import re
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

import pendular as pl
from pendular.comparison import plots
from pendular.comparison.measured import FRACTIONS, MeasuredErrors, measured_errors
from pendular.comparison.tables import NOT_MEASURED
from pendular.comparison.words import SYMBOLS, limit_words, number, percent, size_words
from pendular.front.options import read_question
from pendular.laws import Law, laws
from pendular.show.picture import save

DOCS = Path(__file__).parents[1] / "docs"
PAGE = DOCS / "laws.md"
PAGES = DOCS / "laws"  # one for each law

ANGLES = ("0", "20", "40")
HELD = {"volume": "1pL", "suction": "20kPa"}
USED = {  # by programs, as read in their sources or manuals from 2015 to 2026, not all of it as published
    "willett2000": "YADE, `Law2_ScGeom_ViscElCapPhys_Basic`; MercuryDPM in a fork; LIGGGHTS-PFM with other logarithms",
    "willett2000_simple": "YADE, MercuryDPM, dirt_granular",
    "lian1993": "MercuryDPM, LIGGGHTS, MUSEN, ddgclib, prism, for the rupture distance, in most with one angle",
    "lian_seville2016": "MercuryDPM",
    "soulie2006": "YADE, LIGGGHTS-PUBLIC (`easo`), CapDEM",
    "rabinovich2005": "YADE, LIGGGHTS-PUBLIC (`washino`)",
    "lambert2008": "YADE, prism",
    "weigert1999": "YADE",
    "mikami1998": "EDEM, MUSEN",
    "bagheri2024": "MercuryDPM in a fork, phydrax",
}
SHORT = {"force": "F", "rupture": "D_c", "rupture_work": "W", "damping": "c"}
MATH = re.compile(r"^( *)\.\. math::(.*(?:\n(?:\1 +.*| *)$)*)", re.MULTILINE)  # and what is indented below it
RADIUS, WATER = 50e-6, 0.0728  # of the example [m], [N/m]


def in_words(numbers: Sequence[float]) -> str:
    """Numbers in a row of text."""
    *first, last = (f"{number:g}" for number in numbers)
    return f"{', '.join(first)} and {last}"


INTRODUCTION = f"""\
# Laws

Closed forms for capillary bridges, side by side with the exact solution of the Young–Laplace equation. This page is
written by `uv run python -m tools.law_pages` from the records in `pendular.laws` and from errors that `uv run python -m
tools.law_errors` measures; a test compares both with the code. Each law has a page, with its formula, source, errors
and a map of them; `pendular laws NAME` prints the same.

- Errors are (law − exact)/exact, of the force F at parts of the exact rupture distance D_c, of D_c itself, and of the
  work W from contact to rupture. “No bridge”: the law has none where there is one; a dash: it says nothing. The damping
  c is that of solids that move, and is not compared.
- H\\* = Δp R̄/γ is the reduced suction, V\\* = V/R̄³ the reduced volume, R̄ = 2 R₁R₂/(R₁+R₂), θ the contact angle on both
  solids, D the whole gap.
- A range is that of the authors where they state one, else the one in which the law was measured; the range says which.

## All laws

Largest errors between equal spheres, inside the range of the law. They are those of a sample: the controls and angles
on the page of the law, the ends of the stated range among them, and for the force contact and
{in_words(FRACTIONS[1:])} of the rupture distance. Between two points of the sample an error may be a little
larger, beyond the last it grows.

"""

SIDE_BY_SIDE = f"""
## Side by side

Two equal spheres of 50 µm with water between them, at a volume of 1 pL and at a suction of 20 kPa: the forces over the
exact one, and their errors. A law of the other control is asked with the exact suction or volume of each state, so that
only its own error is seen; a law of suction control knows only states that their suction would hold. Errors are drawn,
and the largest is sought, up to {pl.comparison.one_pair.UP_TO:g} of the rupture distance, and for a law of suction
control up to that part of the rupture distance at the suction of the state.

"""

CONTENTS = """\
```{toctree}
:hidden:
:glob:

laws/*
```
"""


def pictures() -> Iterator[tuple[str, str]]:
    """Name of each picture and the command that draws it."""
    for control, value in HELD.items():
        for angle in ANGLES:
            name = f"laws_{control}_{angle}.svg"
            yield name, f"pendular compare --radius 50um --contact-angle {angle} --{control} {value} --plot {name}"


def draw(folder: Path) -> None:
    """Draw all pictures into a folder."""
    for control, value in HELD.items():
        for angle in ANGLES:
            question = read_question("50um", contact_angle=angle, **{control: value})
            found = pl.compare(question.pair, **question.control, liquid=question.liquid)
            drawing = plots.comparison_figure(found, title=question.title, subtitle=question.subtitle)
            save(drawing, folder / f"laws_{control}_{angle}.svg")


def page() -> str:
    """Text of the page."""
    parts = [INTRODUCTION, *map(line, summary()), SIDE_BY_SIDE]
    parts += [f"`{command}`\n\n![{alternative(name)}](images/{name}){{.wide}}\n\n" for name, command in pictures()]
    parts += [CONTENTS]
    return "".join(parts).rstrip() + "\n"


def alternative(picture: str) -> str:
    """What a picture shows, for those who do not see it."""
    _, control, angle = picture.removesuffix(".svg").split("_")
    return f"Forces by all laws and their errors at constant {control} and a contact angle of {angle}°"


def line(cells: list[str]) -> str:
    """Line of a table."""
    return f"| {' | '.join(cells)} |\n"


def rule(count: int, words: int = 1) -> list[str]:
    """Line under the head of a table: the first columns are words, the others numbers."""
    return ["---"] * words + ["---:"] * (count - words)


def summary() -> Iterator[list[str]]:
    """Table of all laws."""
    yield ["law", "held", "gives", "F", "D_c", "W", "range"]
    yield [*rule(6, words=3), "---"]
    for law in laws.values():
        errors = [percent(float(error), signed=False) for error in measured_errors(law).of_equal_spheres.largest]
        given = ",\N{NO-BREAK SPACE}".join(SHORT[name] for name in law.gives)
        yield [f"[`{law.name}`](laws/{law.name}.md)", law.control, given, *errors, in_symbols(law.valid_text)]


def law_page(law: Law) -> str:
    """All about one law."""
    facts = {
        "Held": f"{law.control}; gives {' and '.join(law.gives).replace('_', ' ')}",
        "Range": f"{in_symbols(law.valid_text)} ({stated_range(law)})",
        "Two angles": law.angle_rule,
        "Two sizes": law.size_rule,
        "Reference": law.reference + (f", [doi:{law.doi}](https://doi.org/{law.doi})" if law.doi else ""),
        "Equations": law.equations,
        "Provenance": law.provenance,
        "Used in": used_in(law),
    }
    told = [f"- {name}: {fact}\n" for name, fact in facts.items() if fact]
    told += [f"- Erratum: {in_symbols(erratum)}\n" for erratum in law.errata]
    head = f"# {law.name}\n\n{law.title}.\n\n## Formula\n\n"
    formulas = "".join(f"```{{math}}\n{formula}\n```\n\n" for formula in typeset(law))
    text = f"As `pendular laws {law.name}` prints it:\n\n```text\n{law.formula}\n```\n\n{''.join(told)}\n"
    functions = (
        f"[What each symbol is, and the functions](../reference/law_functions.md#{law.name.replace('_', '-')}).\n\n"
    )
    return (head + formulas + text + functions + example(law) + in_c(law) + "".join(errors(law))).rstrip() + "\n"


def used_in(law: Law) -> str:
    """Programs that have a law, and where it is told what they make of it."""
    if law.name not in USED:
        return "no particle code that was read; here by `method=`, `pendular compare`, and the functions below"
    return (
        f"{USED[law.name]}; what they make of it stands with [conformance](../conformance/README.md#formulas-as-coded)"
    )


def in_c(law: Law) -> str:
    """The law in C, which the site makes of its kernels."""
    return f"""\
## In C

Translated from the functions of Python by `python -m tools.law_in_c {law.name}`; a test compiles it and compares both
on thousands of questions. For the exact answer in C there are [a library](../c_library.md) and
[a header](../c_header.md).

```{{literalinclude}} ../made/{law.name}.c
:language: c
```

"""


def typeset(law: Law) -> Iterator[str]:
    """Formulas of a law for a typesetter, from the docstrings of its functions; each once."""
    found = (MATH.findall(inspect.getdoc(function) or "") for function in (*law.kernels.values(), *law.steps))
    yield from dict.fromkeys(inspect.cleandoc(formula).strip() for formulas in found for _, formula in formulas)


def example(law: Law) -> str:
    """How to ask a law beside the exact answer, for a pair of its sample; nothing for one that gives only a work."""
    if law.gives in (("rupture_work",), ("damping",)):
        return ""
    measured = measured_errors(law).of_equal_spheres
    known = np.flatnonzero(np.isfinite(first_errors(law, measured)))
    if not known.size:
        return ""
    row = known[known.size // 2]
    angle, control = float(measured.contact_angle[row]), float(measured.control_star[row])
    held = float(f"{control * WATER / RADIUS if law.control == 'suction' else control * RADIUS**3:.3g}")
    asked = re.sub(r"e\+?0*", "e", f"{held:g}").replace("e-0", "e-")
    pair, water = pl.Pair(RADIUS, np.deg2rad(angle)), pl.Liquid(surface_tension=WATER)
    question = {law.control: held, "liquid": water}
    if "force" in law.gives:
        call, unit = f"pl.bridge(pair, 0.0, {law.control}={asked}, liquid=water", "force:.4g} N"
        answers = [pl.bridge(pair, 0.0, **question, method=method).force for method in (law.name, "exact")]
    else:
        call, unit = f"pl.rupture(pair, {law.control}={asked}, liquid=water", "separation:.4g} m"
        answers = [pl.rupture(pair, **question, method=method).separation for method in (law.name, "exact")]
    told = [f"{answer:.4g} {unit[-1]}" for answer in answers]
    return f"""\
## In Python

Two spheres of {1e6 * RADIUS:g} µm and {angle:g}°, by the law and exactly:

```python
import numpy as np

import pendular as pl

pair = pl.Pair({1e6 * RADIUS:g}e-6, np.deg2rad({angle:g}))
water = pl.Liquid(surface_tension={WATER:g})
by_law = {call}, method="{law.name}")
exact = {call})
print(f"{{by_law.{unit}, {{exact.{unit}")  # {", ".join(told)}
```

"""


def first_errors(law: Law, measured: MeasuredErrors) -> np.ndarray:
    """Errors of the first quantity that a law gives, at contact; a row a pair."""
    found = np.asarray(getattr(measured.errors, law.gives[0]))
    return found[:, 0] if found.ndim == 2 else found


def errors(law: Law) -> Iterator[str]:
    """Measured errors: a map, and tables."""
    yield "## Errors\n\n"
    measured = measured_errors(law)
    if not measured.control_star.size:
        yield f"{NOT_MEASURED}\n"
        return
    yield f"`pendular compare --map {law.name} --plot map.svg`\n\n"
    yield f"![Error of {law.name} over {law.control} and contact angle](../made/map_{law.name}.svg)\n\n"
    yield "Between equal spheres, in the signs of [all laws](../laws.md):\n\n"
    yield from map(line, error_table(law, measured))
    if np.any(measured.smaller_over_larger < 1.0):
        yield "\nLargest error over all angles:\n\n"
        yield from map(line, size_table(law, measured))


def in_symbols(text: str) -> str:
    """Text of a record with the symbols of the page in place of the names of variables."""
    return text.replace("suction_star", "H\\*").replace("volume_star", "V\\*")


def stated_range(law: Law) -> str:
    """Limits of the variables, as far as they are restricted."""
    symbols = {"suction_star": "H\\*", "volume_star": "V\\*", "contact_angle": "θ", "size_ratio": "size ratio"}
    limits = ((symbols.get(name), limit_words(name, *ends)) for name, ends in law.valid.items())
    return ", ".join(f"{symbol} {words}" for symbol, words in limits if symbol)


def error_table(law: Law, measured: MeasuredErrors) -> Iterator[list[str]]:
    """Errors between equal spheres, a row a pair."""
    parts = {
        "force": [f"F at {part:g} D_c" for part in FRACTIONS],
        "rupture": ["D_c"],
        "rupture_work": ["W"],
    }
    heads = [head for name in law.gives for head in parts[name]]
    yield [SYMBOLS[law.control].replace("*", "\\*"), "θ", *heads]
    yield rule(2 + len(heads), words=0)
    equal = measured.of_equal_spheres
    for i in range(equal.control_star.size):
        errors = np.concatenate([np.atleast_1d(getattr(equal.errors, name)[i]) for name in law.gives])
        yield [
            number(equal.control_star[i]),
            f"{equal.contact_angle[i]:g}°",
            *(percent(float(error)) for error in errors),
        ]


def size_table(law: Law, measured: MeasuredErrors) -> Iterator[list[str]]:
    """Largest errors over all angles, for each pair of sizes."""
    ratios = list(dict.fromkeys(measured.smaller_over_larger.tolist()))
    heads = [f"{size_words(ratio)}, {SHORT[name]}" for ratio in ratios for name in law.gives]
    yield [SYMBOLS[law.control].replace("*", "\\*"), *heads]
    yield rule(1 + len(heads), words=0)
    for control in dict.fromkeys(measured.control_star.tolist()):
        cells = []
        for ratio in ratios:
            chosen = (measured.control_star == control) & (measured.smaller_over_larger == ratio)
            largest = measured.chosen(chosen).largest._asdict()
            cells += [percent(float(largest[name]), signed=False) for name in law.gives]
        yield [number(control), *cells]


def main() -> None:
    """Write pages and pictures."""
    draw(DOCS / "images")
    PAGE.write_text(page(), encoding="utf-8")
    PAGES.mkdir(exist_ok=True)
    for old in PAGES.glob("*.md"):
        old.unlink()
    for law in laws.values():
        (PAGES / f"{law.name}.md").write_text(law_page(law), encoding="utf-8")


if __name__ == "__main__":
    main()
