"""Records of laws that contradict themselves, or from which a question could not be answered, are refused."""

import inspect
from typing import TYPE_CHECKING

from ._symbols import arguments

if TYPE_CHECKING:
    from ._record import Law

__all__ = ["refuse_contradictions"]


def refuse_contradictions(law: "Law") -> None:
    """Refuse a record from which a question could not be answered."""
    if not (isinstance(law.name, str) and law.name.isidentifier() and law.name == law.name.lower()):
        raise _refusal(law, "name", "it is not made of lower-case letters, digits and underscores")
    if law.control not in ("suction", "volume"):
        raise _refusal(law, "control", f"{law.control!r} is not one of 'suction', 'volume'")
    if not law.gives:
        raise _refusal(
            law, "functions", "none of force_star, rupture_star, rupture_work_star and damping_star is given"
        )
    if set(law.solids) != set(law.gives):
        raise _refusal(law, "solids", f"given are those of {list(law.solids)}, the law gives {list(law.gives)}")
    for quantity, kernel in law.kernels.items():
        names = arguments(quantity, law.control)
        try:
            inspect.signature(kernel).bind(*names)
        except (TypeError, ValueError):
            raise _refusal(law, f"{quantity}_star", f"it does not take ({', '.join(names)})") from None
    _refuse_ranges(law)


def _refuse_ranges(law: "Law") -> None:
    """Refuse ranges that are missing, or not of the variables and within their limits."""
    limits = {variable.name: variable for variable in law.variables}
    for name in (f"{law.control}_star", "contact_angle"):
        if name not in limits or name not in law.valid:
            raise _refusal(law, "valid" if name in limits else "variables", f"{name} is missing")
    for name, (low, high) in law.valid.items():
        if name not in limits:
            raise _refusal(law, "valid", f"{name} is not among the variables")
        if not limits[name].low <= low <= high <= limits[name].high:
            raise _refusal(law, "valid", f"{name} from {low:g} to {high:g} is not a range in its hard limits")


def _refusal(law: "Law", name: str, said: str) -> ValueError:
    return ValueError(f"{name} of law {law.name!r}: {said}")
