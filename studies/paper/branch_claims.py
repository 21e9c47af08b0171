"""Claims about the two branches and their energies (Section 2.4, Appendix A)."""

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pendular import Bridge

from . import sample
from .claim import Claim

Bools = NDArray[np.bool_]
_ANGLES = np.array(sample.ANGLES)[:, None, None]


def branch_claims(density: float) -> Iterator[Claim]:
    """Measure the statements about energies, volumes and areas of the branches."""
    part = np.linspace(0.05, 0.99, sample.count(20, density))
    under_suction = _pair_of_branches(part, suction=np.array([1.0, 10.0, 1e3, 1e5])[:, None])
    under_volume = _pair_of_branches(part, volume=np.array([1e-6, 1e-4, 1e-2])[:, None])
    yield _surface_under_volume(under_volume)
    yield _potential_under_suction(under_suction)
    yield _surface_under_suction(under_suction)
    yield _surface_under_pressure()
    yield _potential_under_volume(under_volume)
    yield _size_under_suction(under_suction)


def _pair_of_branches(part: Any, **control: Any) -> tuple[Bridge, Bridge]:
    return sample.both_branches(part, _ANGLES, **control)


def _lower(states: tuple[Bridge, Bridge], quantity: str) -> Bools:
    """Whether the stable bridge has the smaller value, wherever both bridges exist."""
    stable, unstable = states
    both = np.asarray(stable.exists) & np.asarray(unstable.exists)
    is_lower = np.asarray(getattr(stable, quantity) < getattr(unstable, quantity), bool)
    return np.asarray(is_lower[both])


def _share(found: Bools) -> dict[str, float]:
    return {"share of the sample": float(found.mean()), "sample": float(found.size)}


def _told(found: Bools, sampled: str) -> str:
    return f"In {int(found.sum())} of {found.size} cases ({sampled})"


_SUCTIONS = "H* = 1, 10, 10³, 10⁵, three angles, 0.05 to 0.99 of the rupture distance"
_VOLUMES = "V* = 10⁻⁶, 10⁻⁴, 10⁻², three angles, 0.05 to 0.99 of the fold, where both branches exist"


def _surface_under_volume(states: tuple[Bridge, Bridge]) -> Claim:
    found = _lower(states, "surface_energy")
    return Claim(
        "surface_energy_volume",
        "Section 2.4, Appendix A, Fig. 11b",
        "Under volume control the stable branch has the smaller surface energy.",
        _told(found, _VOLUMES),
        bool(found.all()),
        "At fixed volume the surface energy is the potential: its derivative along the gap is the force, which is "
        "larger on the stable branch, and the two meet at the fold.",
        numbers=_share(found),
    )


def _potential_under_suction(states: tuple[Bridge, Bridge]) -> Claim:
    found = _lower(states, "grand_potential")
    return Claim(
        "potential_suction",
        "Section 2.4, Appendix A, Fig. 12c",
        "Under suction control the stable branch has the smaller E_surf + Δp V.",
        _told(found, _SUCTIONS),
        bool(found.all()),
        "At fixed suction this is the potential, whatever the sign of the suction.",
        numbers=_share(found),
    )


def _surface_under_suction(states: tuple[Bridge, Bridge]) -> Claim:
    found = _lower(states, "surface_energy")
    return Claim(
        "surface_energy_suction",
        "Appendix A, Fig. 12b",
        "Under suction control the stable branch has the smaller surface energy as well (the first opposite "
        "criterion), within H* ≥ 1.",
        _told(found, _SUCTIONS),
        bool(found.all()),
        "True, but only because Δp > 0: near the fold the difference of E_surf is -Δp times that of the volumes.",
        "Compare E_surf + Δp V, the potential of this control.",
        _share(found),
    )


def _surface_under_pressure() -> Claim:
    states = sample.both_branches(0.98, suction=-0.5)
    (thick, thin) = states
    numbers = {
        "stable E_surf": float(thick.surface_energy),
        "unstable E_surf": float(thin.surface_energy),
        "stable potential": float(thick.grand_potential),
        "unstable potential": float(thin.grand_potential),
    }
    return Claim(
        "surface_energy_criterion",
        "Section 6, Appendix A",
        "The minimum of the surface energy is a criterion for the stable branch under suction control.",
        f"H* = -0.5, θ = 0, 0.98 of the rupture distance: E_surf = {numbers['stable E_surf']:.6f} (stable) and "
        f"{numbers['unstable E_surf']:.6f} (unstable); with Δp V {numbers['stable potential']:.6f} and "
        f"{numbers['unstable potential']:.6f}",
        numbers["stable E_surf"] < numbers["unstable E_surf"],
        "Near the fold the difference of E_surf has the sign of -Δp, so for Δp < 0 it picks the unstable branch.",
        "E_surf + Δp V at fixed suction picks the right one for either sign.",
        numbers,
    )


def _potential_under_volume(states: tuple[Bridge, Bridge]) -> Claim:
    found = ~_lower(states, "grand_potential")
    return Claim(
        "potential_volume",
        "Appendix A, Fig. 11c",
        "Under volume control E_surf + Δp V is larger on the stable branch, so no criterion (the second opposite one).",
        _told(found, _VOLUMES),
        bool(found.all()),
        "True near rupture, where the suctions of the branches differ by the square root of the distance to it; far "
        "below, the stable branch is lower in this energy too. As a criterion it is useless either way.",
        "E_surf at fixed volume.",
        _share(found),
    )


def _size_under_suction(states: tuple[Bridge, Bridge]) -> Claim:
    volume, area = ~_lower(states, "volume"), ~_lower(states, "liquid_gas_area")
    numbers = {"share with larger volume": float(volume.mean()), "share with larger area": float(area.mean())}
    return Claim(
        "size_suction",
        "Appendix A",
        "Under suction control the stable branch has the larger volume and the larger surface area.",
        f"Larger volume in {int(volume.sum())}, larger liquid-gas area in {int(area.sum())} of {volume.size} cases "
        f"({_SUCTIONS})",
        bool(volume.all() and area.all()),
        "The volume is the derivative of the potential along the suction, and the stable branch is the thick one.",
        numbers=numbers,
    )
