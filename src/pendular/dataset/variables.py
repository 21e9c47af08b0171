"""What the data base holds: its coordinates and variables, their names, units and meaning, and how they are computed.

All lengths are over the Derjaguin radius R, γ is 1 (stars).
"""

from collections.abc import Iterable, Sequence
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ground.check import angle, in_range, instance, quantity
from ..ground.rows import over_rows
from .grid import GridPoint, Solids, grid_range

if TYPE_CHECKING:
    import xarray as xr

Floats = NDArray[np.float64]
Coordinates = dict[str, Floats]  # by name, in the order of the dimensions

PAIR_DIMS = ("size_ratio", "contact_angle")
DIMS = (*PAIR_DIMS, "half_filling_angle", "neck_ratio")
_LARGEST_FILLING = np.deg2rad(60.0)
_DECADES = 5.0  # of half-filling angle: down to the rupture at H* = 2e7
_CROWDING = 3.0  # 1 - Q is the power of an even spacing: at H* = 1e6 a bridge at contact has 1 - Q = 7e-4
_POINTS_PER_TASK = 2**12  # of a thread

COORDINATES = {
    "size_ratio": ("1", "radius of the larger sphere over that of the smaller one", "R_L/R_s"),
    "contact_angle": ("rad", "contact angle on both spheres", "theta"),
    "half_filling_angle": ("rad", "half-filling angle of the smaller sphere", "delta_s"),
    "neck_ratio": ("1", "neck radius over contact radius on the smaller sphere", "Y0/Ycs"),
}

# In the order of GridPoint: name, power of the Derjaguin radius in the unit, meaning, symbol of the paper.
LABELS = (
    ("suction_star", "1/R", "suction over surface tension", "H*"),
    ("force_star", "R", "capillary force over 2 pi gamma, attraction positive", "lambda*"),
    ("gap_small_star", "R", "distance of the neck from the smaller sphere", "S_s*"),
    ("gap_large_star", "R", "distance of the neck from the larger sphere", "S_L*"),
    ("half_separation_star", "R", "half the gap between the spheres, negative in an overlap", "S*"),
    ("volume_small_star", "R^3", "liquid between the neck and the smaller sphere", "V_s*"),
    ("volume_large_star", "R^3", "liquid between the neck and the larger sphere", "V_L*"),
    ("volume_star", "R^3", "liquid volume", "V*"),
    ("area_small_star", "R^2", "liquid-gas area between the neck and the smaller sphere", "A_s*"),
    ("area_large_star", "R^2", "liquid-gas area between the neck and the larger sphere", "A_L*"),
    ("wetted_area_small_star", "R^2", "liquid-solid area on the smaller sphere", "A_ls,s*"),
    ("wetted_area_large_star", "R^2", "liquid-solid area on the larger sphere", "A_ls,L*"),
    ("half_filling_angle_large", "", "half-filling angle of the larger sphere", "delta_L"),
    ("surface_energy_star", "gamma R^2", "surface energy against dry solids", "E_surf*"),
    ("grand_potential_star", "gamma R^2", "surface energy + suction x volume", "E_surf* + H* V*"),
)

VARIABLES = tuple(name for name, *_ in LABELS)


def coordinates(shape: tuple[int, int], size_ratio: ArrayLike, contact_angle: ArrayLike) -> Coordinates:
    """Coordinates of the data base."""
    counts = in_range("shape", quantity("shape", shape, ""), 8.0).astype(int)
    if counts.shape != (2,):
        raise ValueError(f"shape: {shape} is not a pair (half-filling angles, neck ratios)")
    ratios = in_range("size_ratio", np.atleast_1d(quantity("size_ratio", size_ratio, "")), 1.0)
    angles = np.atleast_1d(angle("contact_angle", contact_angle))
    in_range("contact_angle", angles, 0.0, 0.5 * np.pi, brackets="[)", unit="rad")
    for name, values in (("size_ratio", ratios), ("contact_angle", angles)):
        if values.ndim > 1 or np.any(np.diff(values) <= 0.0):
            raise ValueError(f"{name}: {values.tolist()} is not an increasing list")
    fillings = _LARGEST_FILLING * 10.0 ** (_DECADES * (np.linspace(0.0, 1.0, counts[0]) - 1.0))
    neck_ratios = 1.0 - np.linspace(1.0, 0.0, counts[1]) ** _CROWDING
    return dict(zip(DIMS, (ratios, angles, fillings, neck_ratios), strict=True))


def curvatures(size_ratio: float) -> tuple[float, float]:
    """1/R_s and 1/R_L in units of the Derjaguin radius."""
    return 2.0 * size_ratio / (1.0 + size_ratio), 2.0 / (1.0 + size_ratio)


def solids_of(size_ratio: float, contact_angle: float) -> Solids:
    """Two spheres of one contact angle."""
    small, large = curvatures(size_ratio)
    return Solids(small, contact_angle, large, contact_angle)


def compute(size_ratio: float, contact_angle: float, fillings: Floats, neck_ratios: Floats) -> Floats:
    """All variables of some rows of a pair."""
    values = np.empty((len(GridPoint._fields), fillings.size, neck_ratios.size))
    solids, count = solids_of(size_ratio, contact_angle), fillings.size * neck_ratios.size
    over_rows(grid_range, count, _POINTS_PER_TASK, fillings, neck_ratios, solids, values)
    return values


def attributes_of(label: Sequence[str]) -> dict[str, str]:
    """Attributes of a variable that has this label."""
    unit, long_name, symbol = label
    return {"units": unit or "rad", "long_name": long_name, "symbol": symbol}


def provenance() -> dict[str, str]:
    """What the whole says of itself."""
    return {
        "title": "Capillary bridges between two spheres",
        "source": f"pendular {version('pendular')}",
        "references": "C.-F. Zhao, N. P. Kruyt, O. Millet, Powder Technology 360 (2020) 622-634, Section 2.3",
        "equations": "H and lambda from Eq. 10, S and V from Eq. 12, E_surf and E_surf + H V from Eqs. 13 and 14, "
        "solutions of Eq. 8 in Carlson's elliptic integrals",
        "reduction": "R is the Derjaguin radius 2 R_s R_L/(R_s + R_L), gamma the surface tension; "
        "units name what a variable is divided by",
        "comment": "NaN where no bridge has its neck between the contact circles, and at Y0/Ycs = 0 and 1; "
        "the contact circle on the larger sphere is that of the smaller filling angle",
    }


def labelled(grid: Coordinates, arrays: Iterable[Any]) -> "xr.Dataset":
    """Dataset of arrays in the order of the variables."""
    import xarray as xr

    variables = {
        name: (DIMS, array, attributes_of(label)) for (name, *label), array in zip(LABELS, arrays, strict=True)
    }
    axes = {name: (name, values, attributes_of(COORDINATES[name])) for name, values in grid.items()}
    return xr.Dataset(variables, axes, provenance())


def check_dataset(dataset: object, name: str = "dataset", place: str = "it") -> None:
    """Refuse what is no data base of this kind."""
    import xarray as xr

    instance(name, dataset, xr.Dataset)
    held = dataset.variables  # type: ignore[attr-defined]
    for variable in (*DIMS, *VARIABLES):
        if variable not in held:
            raise ValueError(f"{name}: {place} lacks {variable}, and is no data base of make_dataset")
