"""Every claim of the article that is audited, measured over a sample of a given density."""

from collections.abc import Callable, Iterator

from .branch_claims import branch_claims
from .claim import Claim
from .force_claims import force_claims
from .rupture_claims import rupture_claims
from .setting_claims import setting_claims
from .torus_claims import torus_claims

__all__ = ["Claim", "measure"]

SUBJECTS: dict[str, Callable[[float], Iterator[Claim]]] = {
    "Rupture distance": rupture_claims,
    "Force": force_claims,
    "Toroidal theory": torus_claims,
    "Stable branches": branch_claims,
    "Setting": setting_claims,
}


def measure(density: float = 1.0) -> dict[str, tuple[Claim, ...]]:
    """Measure all claims.

    Parameters
    ----------
    density : float
        Share of the full sample, in (0, 1]; the ends of every range are kept.

    Returns
    -------
    dict
        Claims by subject.

    Examples
    --------
    >>> first = measure(0.05)["Rupture distance"][0]
    >>> first.where, first.holds
    ('Section 3.2, Fig. 3', True)
    """
    return {subject: tuple(claims(density)) for subject, claims in SUBJECTS.items()}
