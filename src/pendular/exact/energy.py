"""Energies of a bridge from its areas: what is least at a given volume, and at a given suction."""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def surface_energy(liquid_gas_area: Floats, wetted_area: Floats, contact_angle: Floats) -> Floats:
    """E/γ = A_lg - Σ cos θ A_ls, zero for dry and separate solids; the solids lie on the last axis."""
    return liquid_gas_area - np.sum(np.cos(contact_angle) * wetted_area, axis=-1)


def grand_potential(energy: Floats, curvature: Floats, volume: Floats) -> Floats:
    """Ω/γ = E/γ + H V; its derivatives at fixed H and at fixed D are F/γ and V."""
    return energy + curvature * volume
