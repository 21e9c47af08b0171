"""Measure the errors of all laws and store them in the package: ``python -m tools.law_errors``.

The file feeds ``pendular laws`` and ``docs/laws.md``; a test measures it anew and compares.
"""

from pathlib import Path

import pendular.comparison
from pendular.comparison.measured import as_json, measure
from pendular.laws import laws

OUTPUT = Path(pendular.comparison.__file__).with_name("measured_errors.json")


def main() -> None:
    """Write the file."""
    measured = {name: measure(law) for name, law in laws.items()}
    OUTPUT.write_text(as_json(measured), encoding="utf-8")
    rows = sum(errors.control_star.size for errors in measured.values())
    print(f"{len(measured)} laws, {rows} rows: {OUTPUT.name}")  # noqa: T201


if __name__ == "__main__":
    main()
