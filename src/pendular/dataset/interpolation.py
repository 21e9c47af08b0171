"""Forces and rupture distances by interpolation of the data base, as the paper found them, and their error."""

from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..exact.batch import RUPTURE, STABLE, answer
from ..exact.equations import SUCTION, VOLUME
from ..exact.follow import FOLDS
from ..exact.state import State
from ..ground.check import angle, broadcast, in_range, one_of, quantity, whole_number
from ..ground.compile import compiled
from .grid import Sheet, interpolate_range, longest_rises
from .store import damage_told
from .variables import PAIR_DIMS, check_dataset, curvatures, solids_of

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["interpolate", "interpolate_rupture", "interpolation_error"]

Floats = NDArray[np.float64]
Control = Literal["suction", "volume"]
Order = Literal["linear", "cubic"]


def interpolate(
    dataset: "xr.Dataset",
    control: Control,
    value_star: ArrayLike,
    separation_star: ArrayLike,
    size_ratio: ArrayLike,
    contact_angle: ArrayLike,
    *,
    order: Order = "cubic",
) -> Floats:
    r"""Force on the stable branch by interpolation of a data base.

    .. math:: \lambda^*(H^*, S^*) \quad\text{or}\quad \lambda^*(V^*, S^*), \qquad F = 2\pi\gamma\bar R\,\lambda^*

    Parameters
    ----------
    dataset : xarray.Dataset
        The data base.
    control : {"suction", "volume"}
        What is held constant.
    value_star : array_like
        Suction times the Derjaguin radius over the surface tension, or liquid volume over its cube, [-].
    separation_star : array_like
        Whole gap over the Derjaguin radius, [-]; twice the paper's S*.
    size_ratio, contact_angle : array_like
        Pair, as in `make_dataset`, [-] and [rad]: only the values of the data base.
    order : {"linear", "cubic"}
        Of the interpolation, along the lines of the grid and from line to line.

    Returns
    -------
    ndarray or float
        λ*, [-], of the common shape: exactly 0.0 beyond rupture, NaN where the data base does not reach.

    Raises
    ------
    ValueError
        For bad input, or a pair that the data base does not hold.

    Notes
    -----
    Over the half-filling angle and the neck ratio a curve of equal H or V is cut by the lines of the grid, each at most
    once. On these points S has one maximum, the rupture; on the thick side of it S is inverted for λ.

    **Validity.** Measured by `interpolation_error`. The fold at constant volume of unequal spheres of 40° has the other
    contact circle on the larger sphere and is not in the data base: NaN there.

    Examples
    --------
    >>> from pendular import make_dataset
    >>> data = make_dataset(size_ratio=1.0, contact_angle=0.0)
    >>> interpolate(data, "suction", 100.0, [0.0, 0.01, 0.02], 1.0, 0.0).round(4)
    array([0.948 , 0.4177, 0.    ])
    """
    check_dataset(dataset)
    values, gaps, ratios, angles = broadcast(
        value_star=quantity("value_star", value_star, ""),
        separation_star=quantity("separation_star", separation_star, ""),
        size_ratio=quantity("size_ratio", size_ratio, ""),
        contact_angle=angle("contact_angle", contact_angle),
    )
    return _interpolate(dataset, control, values, gaps, ratios, angles, order)[0]


def interpolate_rupture(
    dataset: "xr.Dataset",
    control: Control,
    value_star: ArrayLike,
    size_ratio: ArrayLike,
    contact_angle: ArrayLike,
    *,
    order: Order = "cubic",
) -> Floats:
    """Rupture distance by interpolation of a data base: the largest separation at a suction or a volume.

    Parameters
    ----------
    dataset, control, value_star, size_ratio, contact_angle, order
        As for `interpolate`.

    Returns
    -------
    ndarray or float
        Whole gap at rupture over the Derjaguin radius, [-]; NaN where the data base does not show the fold.

    Raises
    ------
    ValueError
        For bad input, or a pair that the data base does not hold.

    Examples
    --------
    >>> from pendular import make_dataset
    >>> data = make_dataset(size_ratio=1.0, contact_angle=0.0)
    >>> print(f"{interpolate_rupture(data, 'suction', 100.0, 1.0, 0.0):.6f}")
    0.014589
    """
    check_dataset(dataset)
    values, ratios, angles = broadcast(
        value_star=quantity("value_star", value_star, ""),
        size_ratio=quantity("size_ratio", size_ratio, ""),
        contact_angle=angle("contact_angle", contact_angle),
    )
    return _interpolate(dataset, control, values, np.zeros(values.shape), ratios, angles, order)[1]


def interpolation_error(
    dataset: "xr.Dataset", *, samples: int = 100, order: Order = "cubic", seed: int = 0
) -> "xr.Dataset":
    """Error of the interpolated data base against the exact solution, measured.

    Parameters
    ----------
    dataset : xarray.Dataset
        The data base.
    samples : int
        Random bridges for each pair and control: 1 <= H* <= 1e6 or 1e-12 <= V* <= 1e-2, evenly in the logarithm,
        from contact to 0.99 of the rupture distance.
    order : {"linear", "cubic"}
        Of the interpolation.
    seed : int
        Of the random numbers.

    Returns
    -------
    xarray.Dataset
        For each control and pair the largest and the median relative error of the force, the largest one of the
        rupture distance (NaN where the data base shows no fold), and the share of bridges within the data base.

    Examples
    --------
    >>> from pendular import make_dataset
    >>> table = interpolation_error(make_dataset(size_ratio=1.0, contact_angle=0.0), samples=50)
    >>> bool((table.largest_force_error < 1e-4).all())
    True
    """
    import xarray as xr

    check_dataset(dataset)
    count = whole_number("samples", samples, 1)
    one_of("order", order, ("linear", "cubic"))
    generator = np.random.default_rng(whole_number("seed", seed, 0))
    controls: tuple[Control, ...] = ("suction", "volume")
    coords = {"control": list(controls), **{name: dataset[name] for name in PAIR_DIMS}}
    names = ("largest_force_error", "median_force_error", "largest_rupture_error", "share_inside")
    errors = np.empty((*(len(values) for values in coords.values()), len(names)))
    for i, j, k in np.ndindex(errors.shape[:3]):
        pair = float(dataset["size_ratio"][j]), float(dataset["contact_angle"][k])
        errors[i, j, k] = _errors(dataset, controls[i], pair, count, order, generator)
    attributes = {"samples": samples, "order": order, "seed": seed, "separations": "contact to 0.99 of rupture"}
    variables = {name: (list(coords), errors[..., i]) for i, name in enumerate(names)}
    return xr.Dataset(variables, coords, attributes)


def _interpolate(
    dataset: "xr.Dataset",
    control: Control,
    values: Floats,
    gaps: Floats,
    ratios: Floats,
    angles: Floats,
    order: Order,
) -> tuple[Floats, Floats]:
    """Forces and rupture distances, pair by pair."""
    one_of("control", control, ("suction", "volume"))
    one_of("order", order, ("linear", "cubic"))
    if control == "volume":
        in_range("value_star", values, 0.0, brackets="()")
    forces, ruptures = np.empty((2, values.size))
    ratio_index = _match(dataset, "size_ratio", ratios)
    angle_index = _match(dataset, "contact_angle", angles)
    for i, j in np.unique(np.column_stack([ratio_index, angle_index]), axis=0):
        chosen = (ratio_index == i) & (angle_index == j)
        count = int(np.count_nonzero(chosen))
        force, rupture = np.empty((2, count))
        nodes = 2 if order == "linear" else 4
        value, gap = values.ravel()[chosen], gaps.ravel()[chosen]
        compiled(interpolate_range)(_sheet(dataset, i, j), control == "volume", value, gap, nodes, force, rupture)
        forces[chosen], ruptures[chosen] = force, rupture
    return forces.reshape(values.shape)[()], ruptures.reshape(values.shape)[()]


def _match(dataset: "xr.Dataset", name: str, values: Floats) -> NDArray[np.intp]:
    """Index of each value in a coordinate that must hold it."""
    held = dataset[name].to_numpy()
    wanted = values.ravel()
    index: NDArray[np.intp] = np.argmin(np.abs(wanted[:, None] - held), axis=1)
    strange = np.flatnonzero(~np.isclose(held[index], wanted, rtol=1e-9, atol=1e-9))
    if strange.size:
        raise ValueError(f"{name}: {wanted[strange[0]]:.10g} is not in the data base, which holds {held.tolist()}")
    return index


def _rises(table: Floats) -> NDArray[np.int64]:
    spans = np.empty((len(table), 2), np.int64)
    compiled(longest_rises)(table, spans)
    return spans


def _sheet(dataset: "xr.Dataset", ratio: int, angle: int) -> Sheet:
    """Tables of one pair along both families of lines."""
    pair = dataset.isel(size_ratio=ratio, contact_angle=angle)
    names = ("suction_star", "half_separation_star", "volume_star", "force_star")
    with damage_told("dataset", "it"):
        suctions, halves, volumes, forces = (np.ascontiguousarray(pair[name].to_numpy()) for name in names)
    volumes_across = np.ascontiguousarray(volumes.T)
    with np.errstate(invalid="ignore", divide="ignore"):
        log_volumes_across = np.log(volumes_across)
    return Sheet(
        curvatures(float(pair["size_ratio"]))[0],
        float(pair["contact_angle"]),
        pair["half_filling_angle"].to_numpy(),
        pair["neck_ratio"].to_numpy(),
        2.0 * halves,
        -volumes,
        _rises(suctions),
        _rises(-volumes),
        np.ascontiguousarray(2.0 * halves.T),
        log_volumes_across,
        np.ascontiguousarray(forces.T),
        _rises(log_volumes_across),
    )


def _errors(
    dataset: "xr.Dataset",
    control: Control,
    pair: tuple[float, float],
    samples: int,
    order: Order,
    generator: np.random.Generator,
) -> tuple[float, float, float, float]:
    """Largest and median error of the force, largest one of the rupture distance, share of bridges inside."""
    low, high = (0.0, 6.0) if control == "suction" else (-12.0, -2.0)
    values = 10.0 ** generator.uniform(low, high, samples)
    exact_ruptures = _exact("separation", RUPTURE, control, np.zeros(samples), values, pair)
    gaps = exact_ruptures * generator.uniform(0.0, 0.99, samples)
    exact_forces = _exact("force", STABLE, control, gaps, values, pair)
    forces = interpolate(dataset, control, values, gaps, *pair, order=order)
    ruptures = interpolate_rupture(dataset, control, values, *pair, order=order)
    force_errors = np.abs(forces / exact_forces - 1.0)
    rupture_errors = np.abs(ruptures / exact_ruptures - 1.0)
    inside = np.isfinite(force_errors)
    median = float(np.median(force_errors[inside])) if inside.any() else np.nan
    return np.fmax.reduce(force_errors), median, np.fmax.reduce(rupture_errors), float(inside.mean())


def _exact(field: str, asked: int, control: Control, gaps: Floats, values: Floats, pair: tuple[float, float]) -> Floats:
    """One field of the exact solution."""
    questions = np.column_stack([gaps, values, np.tile(solids_of(*pair), (gaps.size, 1))])
    states, _ = answer(asked, VOLUME if control == "volume" else SUCTION, questions, FOLDS)
    return states[:, State._fields.index(field)]
