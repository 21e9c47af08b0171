"""The errors of all laws on one grid: measured, stored with the package, read again.

The file is written by ``python -m tools.law_errors`` and a test measures it anew. Each row is a reduced pair inside the
range that the authors of the law state; where they state none, inside the whole grid. An error is largest at the end of
a range more often than inside, so that the ends which are stated join the grid.
"""

import json
from functools import cache
from importlib.resources import files
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.warn import warn
from ..laws import Law
from ..laws.ranges import first_outside
from .sample import ControlName, Errors, exact_sample, law_errors

__all__ = ["ANGLES", "CONTROLS", "FRACTIONS", "RATIOS", "MeasuredErrors", "as_json", "measure", "measured_errors"]

Floats = NDArray[np.float64]

FRACTIONS = (0.0, 0.1, 0.3, 0.6, 0.9)  # D/D_c
CONTROLS: dict[ControlName, tuple[float, ...]] = {
    "suction": (1.0, 10.0, 100.0, 1e3, 1e4, 1e6),
    "volume": (1e-8, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1),
}
ANGLES = (0.0, 20.0, 40.0, 60.0)  # degrees
RATIOS = (1.0, 0.25, 0.0)  # smaller over larger radius, 0 for a sphere on a plane

_FILE = "measured_errors.json"
_DECIMALS = 10  # of a relative error: a change in the last digit of any coefficient is larger
_ABOUT = (
    "Relative errors of the laws of pendular against the exact solution, (law - exact)/exact: of the force at the "
    "fractions of the exact rupture distance, of the rupture distance and of the work from contact to rupture. "
    "suction_star is Δp R̄/γ, volume_star V/R̄^3, R̄ = 2 R1 R2/(R1+R2); contact_angle, in degrees, is that of both "
    "solids; smaller_over_larger is the ratio of the radii, 0 for a plane. -1: the law has no bridge where there is "
    "one; null: it says nothing. Sampled are the controls and angles of one grid that lie in the range of the law, the "
    "ends of that range, contact, and no separation beyond the last fraction: between them an error may be larger."
)


class MeasuredErrors(NamedTuple):
    """Relative errors of one law on n reduced pairs, NaN where it says nothing."""

    control: ControlName
    control_star: Floats  # (n,) H* or V*
    contact_angle: Floats  # (n,) [degrees], on both solids
    smaller_over_larger: Floats  # (n,) ratio of the radii, 0 for a plane
    errors: Errors  # force (n, 5) at `FRACTIONS`

    def chosen(self, rows: NDArray[Any]) -> "MeasuredErrors":
        """Some of the rows, by their indices or by a mask."""
        errors = Errors(*(values[rows] for values in self.errors))
        return MeasuredErrors(
            self.control, self.control_star[rows], self.contact_angle[rows], self.smaller_over_larger[rows], errors
        )

    @property
    def of_equal_spheres(self) -> "MeasuredErrors":
        """The rows of two equal spheres."""
        return self.chosen(np.flatnonzero(self.smaller_over_larger == 1.0))

    @property
    def largest(self) -> Errors:
        """Largest error of each kind, without its sign: single numbers, NaN for none."""
        return Errors(*(_largest(np.abs(values)) for values in self.errors))


def _largest(sizes: Floats) -> Floats:
    known = sizes[~np.isnan(sizes)]
    return np.asarray(known.max() if known.size else np.nan)


def measure(law: Law) -> MeasuredErrors:
    """Measure the errors of a law on the part of the grid that lies in its stated range."""
    rows = np.array([row for row in _grid(law) if not _leaves_range(law, *row)]).reshape(-1, 3)
    control_star, angle, ratio = rows.T
    with np.errstate(divide="ignore"):
        sample = exact_sample(law.control, control_star, np.radians(angle), 1.0 / ratio, FRACTIONS)
    errors = law_errors(law, sample)
    is_known = ~np.isnan(np.column_stack([errors.force, errors.rupture, errors.rupture_work]))
    speaks = np.flatnonzero(is_known.any(axis=1))
    return MeasuredErrors(law.control, control_star, angle, ratio, errors).chosen(speaks)


def _grid(law: Law) -> list[tuple[float, float, float]]:
    controls = _with_ends(CONTROLS[law.control], *law.valid[f"{law.control}_star"])
    angles = _with_ends(ANGLES, *(round(float(np.degrees(end)), _DECIMALS) for end in law.valid["contact_angle"]))
    return [(value, angle, ratio) for ratio in RATIOS for value in controls for angle in angles]


def _with_ends(steps: tuple[float, ...], low: float, high: float) -> list[float]:
    """Steps of the grid and the ends of a range, in order; an end at nothing or infinity is none."""
    return sorted({*steps, *(end for end in (low, high) if 0.0 < end < np.inf)})


def _leaves_range(law: Law, control_star: float, degrees: float, ratio: float) -> bool:
    with np.errstate(divide="ignore"):
        asked = {
            f"{law.control}_star": control_star,
            "contact_angle": np.radians(degrees),
            "size_ratio": np.divide(1.0, ratio),
        }
    return first_outside(law.valid, asked) is not None


def as_json(measured: dict[str, MeasuredErrors]) -> str:
    """Text of the file: a row a line."""
    laws = [f"    {json.dumps(name)}: [\n{_rows(errors)}\n    ]" for name, errors in measured.items()]
    head = f'  "about": {json.dumps(_ABOUT, ensure_ascii=False)},\n  "fractions": {json.dumps(FRACTIONS)},\n'
    return "{\n" + head + '  "laws": {\n' + ",\n".join(laws) + "\n  }\n}\n"


def _rows(measured: MeasuredErrors) -> str:
    rows = (
        {
            f"{measured.control}_star": float(measured.control_star[i]),
            "contact_angle": float(measured.contact_angle[i]),
            "smaller_over_larger": float(measured.smaller_over_larger[i]),
            "force": [_rounded(error) for error in measured.errors.force[i]],
            "rupture": _rounded(measured.errors.rupture[i]),
            "rupture_work": _rounded(measured.errors.rupture_work[i]),
        }
        for i in range(measured.control_star.size)
    )
    return ",\n".join(f"      {json.dumps(row)}" for row in rows)


def _rounded(error: float) -> float | None:
    return None if np.isnan(error) else round(float(error), _DECIMALS)


def measured_errors(law: Law) -> MeasuredErrors:
    """Errors of a law: the stored ones, and for a law that is not in the file, one from outside, measured once.

    Examples
    --------
    >>> from pendular.laws import laws
    >>> stored = measured_errors(laws["zhao2020"])
    >>> float((100.0 * stored.errors.force[stored.control_star == 100.0][0, 0]).round(2))
    -0.19
    """
    rows = _stored()["laws"].get(law.name)
    if rows is None:
        return _measured_now(law)

    def column(key: str) -> Floats:
        return np.array([row[key] for row in rows], dtype=np.float64)

    errors = Errors(column("force").reshape(-1, len(FRACTIONS)), column("rupture"), column("rupture_work"))
    name = f"{law.control}_star"
    return MeasuredErrors(law.control, column(name), column("contact_angle"), column("smaller_over_larger"), errors)


@cache
def _measured_now(law: Law) -> MeasuredErrors:
    try:
        return measure(law)
    except Exception as error:  # of someone else's code
        warn(UserWarning(f"law {law.name!r} is not measured, as it fails: {type(error).__name__}: {error}"))
    none = np.empty(0)
    return MeasuredErrors(law.control, none, none, none, Errors(np.empty((0, len(FRACTIONS))), none, none))


@cache
def _stored() -> Any:
    return json.loads((files(__package__) / _FILE).read_text("utf-8"))
