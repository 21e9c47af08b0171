"""Write the reference cases and the known deviations: ``python -m tools.conformance`` (some minutes).

``docs/conformance/bridges.csv`` holds exact bridges for other programs to test against, ``docs/conformance/README.md``
tells how, and what formulas as coded in published programs give.
"""

from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from tools.conformance_cases import TENSION, Question, cases, solve
from tools.published_codes import Finding, findings

from pendular.comparison.words import percent

FOLDER = Path(__file__).parents[1] / "docs" / "conformance"
TABLE = FOLDER / "bridges.csv"
PAGE = FOLDER / "README.md"

COLUMNS = {
    "case": "number of the row",
    "control": "what is held while the solids move apart: suction or volume; the other one is an answer",
    "radius1 [m]": "of the first solid",
    "radius2 [m]": "of the second solid, inf for a plane",
    "contact_angle1 [rad]": "on the first solid, through the liquid",
    "contact_angle2 [rad]": "on the second solid",
    "surface_tension [N/m]": "between liquid and gas",
    "separation [m]": "whole gap from surface to surface",
    "suction [Pa]": "gas pressure minus liquid pressure; negative for some bulging bridges",
    "volume [m^3]": "of the liquid",
    "force [N]": "on either solid, attraction positive",
    "rupture_distance [m]": "separation up to which the bridge is stable at the control that is held: the fold or, for "
    "a volume between equal solids of 0.7 rad and more, the point before it where the liquid slides to one side",
}

HEAD = """\
# Exact capillary bridges, to test other programs with: solutions of the Young-Laplace equation without gravity, on the
# branch that begins at contact. Inputs are exact as written, answers have 15 correct digits. docs/conformance/README.md
"""

INTRODUCTION = """\
# Conformance

## Reference cases

[`bridges.csv`](bridges.csv) holds {count} exact bridges, {suction} at constant suction and {volume} at constant volume:
equal and unequal spheres and spheres on a plane, equal and unequal contact angles from 0 to 1.2 rad, reduced suctions
from 0.1 to 1e5 and reduced volumes from 1e-6 to 0.1, each at contact, half way and at 0.99 of the rupture distance. Any
program may use them. Inputs are short decimal numbers; answers are solutions of the Young–Laplace equation in 40 digits
by `tests/oracles/young_laplace.py`, rounded to 15. Lines that begin with `#` are comments.

| column | meaning |
| --- | --- |
{columns}

```python
import csv

with open("docs/conformance/bridges.csv", encoding="utf-8") as file:
    cases = list(csv.DictReader(line for line in file if not line.startswith("#")))
print(len(cases), cases[0]["force [N]"])  # {count} {first}
```

`uv run --group test pytest tests/test_conformance.py -s -k library` prints how near the solver of this library comes. A
program that uses a closed form cannot come nearer than that form: the errors of the published ones are in
[laws.md](../laws.md).
Both files are written by `uv run python -m tools.conformance`.

## Formulas as coded

Some formulas, as they were read in published programs, differ from their source or lead to large errors. They are
listed so that users can check the version they run. Each was written down anew as coded in the version named and
compared with the exact solution for two equal spheres (`tools/published_codes.py`); none of the programs was run for
this table. Other versions may differ, and corrections are welcome. Errors are (formula − exact)/exact.

| program | version read | what was read | number | errors |
| --- | --- | --- | --- | --- |
"""


def row_of(numbered: tuple[int, tuple[Question, float]]) -> str:
    """Line of the table for one case."""
    number, (question, separation) = numbered
    answer = solve(question, separation)
    inputs = [*question.radii, *question.angles, TENSION, separation]
    held = {"suction": answer.suction, "volume": answer.volume, question.control: None}
    values = [repr(question.held) if value is None else digits(value) for value in held.values()]
    answers = [digits(answer.force), digits(answer.rupture_distance)]
    return ",".join([str(number), question.control, *map(repr, inputs), *values, *answers])


def digits(value: object) -> str:
    """Number of mpmath with 15 digits."""
    return f"{float(value):.14e}"  # type: ignore[arg-type]


def table(rows: list[str]) -> str:
    """Text of the file of cases."""
    return HEAD + "\n".join([",".join(COLUMNS), *rows]) + "\n"


def page() -> str:
    """Text of the page."""
    controls = [question.control for question, _ in cases()]
    columns = "\n".join(f"| `{name}` | {meaning} |" for name, meaning in COLUMNS.items())
    counts = {control: controls.count(control) for control in ("suction", "volume")}
    first = digits(solve(*next(cases())).force)
    told = INTRODUCTION.format(count=len(controls), columns=columns, first=first, **counts)
    return told + "".join(lines())


def lines() -> Iterator[str]:
    """Lines of the table of findings."""
    for finding in findings():
        cells = [finding.program, finding.version, finding.what, finding.shown, in_words(finding)]
        yield f"| {' | '.join(cells)} |\n"


def in_words(finding: Finding) -> str:
    """Numbers of a finding, a case a line."""
    signed = not finding.is_ratio
    words = {case: [percent(one, signed=signed) for one in numbers] for case, numbers in finding.numbers.items()}
    return "<br>".join(f"{case}: {' / '.join(errors)}" for case, errors in words.items())


def main() -> None:
    """Write both files."""
    FOLDER.mkdir(exist_ok=True)
    PAGE.write_text(page(), encoding="utf-8")
    with ProcessPoolExecutor() as pool:
        rows = list(pool.map(row_of, enumerate(cases(), 1), chunksize=3))  # a chunk shares its rupture distance
    TABLE.write_text(table(rows), encoding="utf-8")


if __name__ == "__main__":
    main()
