"""What a claim is, and the words in which a measurement is told."""

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import sample

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Claim:
    """One statement of the article and what is measured about it.

    Parameters
    ----------
    name : str
        Short key.
    where : str
        Place in the article.
    says : str
        The statement, in other words.
    measured : str
        What is found here, over which sample.
    holds : bool
        The verdict, computed from `numbers`.
    why : str
        The reason, one sentence.
    better : str
        What is better now, where the statement fails or a sharper one exists.
    numbers : dict
        The numbers behind the verdict.
    """

    name: str
    where: str
    says: str
    measured: str
    holds: bool
    why: str
    better: str = ""
    numbers: dict[str, float] = field(default_factory=dict)


def error(value: ArrayLike, exact: ArrayLike) -> Floats:
    """Relative error in per cent, where both are known."""
    return np.asarray(100.0 * (np.asarray(value) / np.asarray(exact) - 1.0))


def worst(errors: Floats) -> float:
    """The error of largest size, with its sign."""
    known = errors[np.isfinite(errors)]
    return float(known[np.argmax(np.abs(known))])


def per_angle(errors: Iterable[float]) -> dict[str, float]:
    """Numbers of the three contact angles, by name."""
    return {f"{degrees:g} deg": float(value) for degrees, value in zip(sample.ANGLES, errors, strict=True)}


def tell(numbers: dict[str, float]) -> str:
    """Per cent, by name: "-28.8 % (0°), ..."."""
    return ", ".join(f"{per_cent(value)} ({name.replace(' deg', '°')})" for name, value in numbers.items())


def per_cent(value: float) -> str:
    """An error; that of a law which has no bridge where there is one is told in words."""
    if value == -100.0:
        return "no force"
    return "less than 0.001 %" if abs(value) < 1e-3 else f"{signed(value)} %"


def signed(value: float) -> str:
    """Two or three digits with a sign."""
    return f"{value:+.3g}".replace("-", "\N{MINUS SIGN}")


def is_within(numbers: dict[str, float], limit: float) -> bool:
    """Whether no number is larger than the limit."""
    return bool(max(abs(value) for value in numbers.values()) <= limit)


def power(value: float) -> str:
    """A number as a person writes it: 25, 10³."""
    digits = str(round(np.log10(value))).translate(str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"{value:g}" if value < 100.0 else f"10{digits}"
