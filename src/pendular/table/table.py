"""A table as its users see it: built, asked in SI units, saved and loaded."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf
from os import PathLike
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._version import __version__
from ..ground.check import angle, as_path, in_range, numbers, one_of, quantity, result_array, scalar
from ..ground.warn import warn
from . import binary, storage
from .arrays import ENERGY, FORCE, LIQUID, RUPTURE, STIFFNESS, evaluate
from .build import Octave, build_octave, empty_grid, join, octaves_of_rows, sample_range
from .channels import fill, known
from .curve import ForceCurve, curve_of
from .cuts import octave_of
from .holding import refuse_without_contact
from .kernels import Grid
from .measure import Bound, measure
from .polynomial import aligned, cells_from, coefficients_of
from .task import Task

__all__ = ["Table", "ToleranceWarning", "load_table", "tabulate"]

Floats = NDArray[np.float64]

_RANGES = {"suction": (1e-2, 1e8), "volume": (1e-9, 1.0)}
# Of the tolerance for one coordinate: what the coordinates do together is known afterwards.
_SHARE, _LEAST_STEP, _MOST_BUILDS = 0.3, 0.4, 7
_HOPELESS, _AIM = 30.0, 0.7  # an error over the tolerance that finer cells do not mend; what they aim at
_TOLERANCE = 1e-8
_ARRAYS = ("lines", "cuts", "rupture")
_UNITS = {"suction": "Pa", "volume": "m**3"}


def operands_of(control: Literal["suction", "volume"]) -> dict[str, str]:
    """Names of what a table is asked with, in their order, each with its unit."""
    return {"separation": "m", control: _UNITS[control], "radius1": "m", "radius2": "m", "surface_tension": "N/m"}


class ToleranceWarning(UserWarning):
    """A table does not reach the accuracy that was asked."""


@dataclass(frozen=True, eq=False)
class Table:
    """Exact bridges of one pair of contact angles as polynomials, made by :func:`tabulate`.

    Parameters
    ----------
    contact_angle : tuple of float
        θ1 and θ2, [rad].
    control : {"suction", "volume"}
        What is held constant.
    reduced : tuple of float
        Range of the reduced control, ΔpR̄/γ or V/R̄³ with R̄ = 2R1R2/(R1+R2), [-].
    radius_ratio : tuple of float
        Range of the larger radius over the smaller, [-].
    tolerance : float
        Error of the force over the force at contact that was asked, [-].
    bound : Bound
        The largest errors that a search of all cells found, with a margin, ``pendular.table.measure.SAFETY``: ``force``
        over the largest force of the bridge, that at contact unless it bulges; ``rupture`` relative; ``liquid`` of a
        volume over that at contact, of a suction over γ√(R̄/V); and how many ``bridges`` were compared.
    version : str
        Of Pendular.
    grid : Grid
        The cells; the first argument of the scalar kernels in ``pendular.table.kernels``, which compiled code may call.

    Examples
    --------
    >>> table = tabulate(0.35, reduced=(100.0, 200.0), radius_ratio=(1, 2), tolerance=1e-6)
    >>> f"{table.force([0.0, 1e-6, 1e-5], 1e5, 100e-6, 120e-6, 0.0728).round(12)}"
    '[4.4711833e-05 6.6390820e-06 0.0000000e+00]'
    """

    contact_angle: tuple[float, float]
    control: Literal["suction", "volume"]
    reduced: tuple[float, float]
    radius_ratio: tuple[float, float]
    tolerance: float
    bound: Bound
    version: str
    grid: Grid

    def force(
        self,
        separation: ArrayLike,
        control: ArrayLike,
        radius1: ArrayLike,
        radius2: ArrayLike,
        surface_tension: ArrayLike,
        *,
        out: Floats | None = None,
    ) -> Floats:
        """Attraction of two solids, exactly 0.0 from the rupture distance on.

        Parameters
        ----------
        separation : array_like
            Whole gap, [m]. Solids that overlap count as touching, as grains of a DEM code do.
        control : array_like
            Suction, [Pa], or liquid volume, [m³].
        radius1, radius2 : array_like
            Radii, [m], infinite for a plane.
        surface_tension : array_like
            [N/m].
        out : ndarray, optional
            Where to store the result: float64, contiguous, of the shape to which the arguments broadcast.

        Returns
        -------
        ndarray or float
            [N], NaN where an argument is NaN.

        Raises
        ------
        ValueError
            Where a pair or its control is outside the range of the table.
        """
        return self._ask(FORCE, out, separation, control, radius1, radius2, surface_tension)

    def volume(
        self,
        separation: ArrayLike,
        suction: ArrayLike,
        radius1: ArrayLike,
        radius2: ArrayLike,
        surface_tension: ArrayLike,
        *,
        out: Floats | None = None,
    ) -> Floats:
        """Liquid volume under suction, [m³], NaN where there is no bridge; arguments as for :meth:`force`."""
        one_of("control", self.control, ("suction",))
        return self._ask(LIQUID, out, separation, suction, radius1, radius2, surface_tension)

    def suction(
        self,
        separation: ArrayLike,
        volume: ArrayLike,
        radius1: ArrayLike,
        radius2: ArrayLike,
        surface_tension: ArrayLike,
        *,
        out: Floats | None = None,
    ) -> Floats:
        """Suction at constant volume, [Pa], NaN where there is no bridge; arguments as for :meth:`force`."""
        one_of("control", self.control, ("volume",))
        return self._ask(LIQUID, out, separation, volume, radius1, radius2, surface_tension)

    def stiffness(
        self,
        separation: ArrayLike,
        control: ArrayLike,
        radius1: ArrayLike,
        radius2: ArrayLike,
        surface_tension: ArrayLike,
        *,
        out: Floats | None = None,
    ) -> Floats:
        """Rate dF/dD with the control held, [N/m]; 0 in an overlap, NaN where there is no bridge."""
        return self._ask(STIFFNESS, out, separation, control, radius1, radius2, surface_tension)

    def energy(
        self,
        separation: ArrayLike,
        control: ArrayLike,
        radius1: ArrayLike,
        radius2: ArrayLike,
        surface_tension: ArrayLike,
        *,
        out: Floats | None = None,
    ) -> Floats:
        """Potential with F = dE/dD, [J]: minus the work that breaks the bridge, 0 from the rupture distance on."""
        return self._ask(ENERGY, out, separation, control, radius1, radius2, surface_tension)

    def rupture_distance(
        self,
        control: ArrayLike,
        radius1: ArrayLike,
        radius2: ArrayLike,
        surface_tension: ArrayLike,
        *,
        out: Floats | None = None,
    ) -> Floats:
        """Separation at which the bridge breaks, [m]: the end of its stability; 0 where there is no bridge."""
        return self._ask(RUPTURE, out, 0.0, control, radius1, radius2, surface_tension)

    def curve(self, control: float, radius1: float, radius2: float, surface_tension: float) -> ForceCurve:
        """Collapse the table to the force curve of one pair at one control, for a monodisperse packing.

        Parameters
        ----------
        control, radius1, radius2, surface_tension : float
            As for :meth:`force`.

        Returns
        -------
        ForceCurve
            Off the table by less than a tenth of its tolerance.

        Raises
        ------
        ValueError
            Where the pair or its control is outside the range of the table.
        """
        self.force(0.0, control, radius1, radius2, surface_tension)
        return curve_of(self.grid, self.tolerance, control, radius1, radius2, surface_tension)

    def save(self, path: str | PathLike[str], *, channels: Sequence[str] = ()) -> None:
        """Write the table to one file, with its version, its bounds and a checksum.

        Parameters
        ----------
        path : path
            Of the file. One that ends in ``.bridges`` is of the binary format that particle codes read without Python;
            any other is an archive of NumPy, and smaller.
        channels : sequence of str
            What a file of the binary format shall hold beside force and liquid, for the programs that read it: any of
            ``neck_radius``, ``area``, ``across_tensor`` and ``axial_tensor``, and of the half-filling angles
            ``half_filling1`` and ``half_filling2`` where the contact angles differ, else ``half_filling_mean`` and
            ``half_filling_slope``. Each makes it larger by about a half.

        Raises
        ------
        ValueError
            If a channel is not known, or not there for all bridges of the table, or the file cannot be written.
        """
        description = {
            "contact_angle": self.contact_angle,
            "control": self.control,
            "reduced": self.reduced,
            "radius_ratio": [str(ratio) for ratio in self.radius_ratio],
            "tolerance": self.tolerance,
            "bound": self.bound,
            "version": self.version,
            "cut": [self.grid.shift, self.grid.first, self.grid.cells],
            "range": [self.grid.low, self.grid.high, self.grid.least_ratio, self.grid.largest_ratio],
        }
        place = as_path("path", path)
        own = {name: getattr(self.grid, name) for name in _ARRAYS}
        arrays = own | {name: coefficients_of(getattr(self.grid, name)) for name in ("force", "liquid")}
        for channel in channels:
            one_of("channels", channel, tuple(known(self.grid.sides)))
        if len(set(channels)) < len(channels):
            raise ValueError(f"channels: {tuple(channels)!r} names one twice")
        if place.suffix == binary.SUFFIX:
            binary.save(place, description, arrays, fill(self.grid, self._task, channels))
        elif channels:
            raise ValueError(f"channels: are of files that end in {binary.SUFFIX}, not of '{place}'")
        else:
            storage.save(place, description, arrays)

    @property
    def _task(self) -> Task:
        return Task(
            self.contact_angle, self.control == "volume", *self.reduced, *self.radius_ratio, self.tolerance, 1.0
        )

    def _ask(self, asked: int, out: Floats | None, *arguments: ArrayLike) -> Floats:
        named = zip(operands_of(self.control).items(), arguments, strict=True)
        read = [numbers(name, value, unit) for (name, unit), value in named]
        shape = np.broadcast_shapes(*(array.shape for array in read))
        result = result_array(out, shape)
        # One array type for every call, hence one compilation; an operand of one element is not repeated.
        operands = tuple(
            np.require(
                array if array.size == 1 or array.shape == shape else np.broadcast_to(array, shape), None, ["C", "W"]
            ).reshape(-1)
            for array in read
        )
        evaluate(asked, self.grid, operands, result.reshape(-1))
        if np.isnan(np.sum(result)):
            self._refuse_outside(*np.broadcast_arrays(*read[1:]))
        return result[()]

    def _refuse_outside(self, control: Floats, radius1: Floats, radius2: Floats, surface_tension: Floats) -> None:
        """Name the first pair that the table does not cover; a NaN is none."""
        with np.errstate(all="ignore"):
            ratio = np.maximum(radius1, radius2) / np.minimum(radius1, radius2)
            derjaguin = 2.0 / (1.0 / radius1 + 1.0 / radius2)
            is_volume = self.control == "volume"
            reduced = control / derjaguin**3 if is_volume else control * derjaguin / surface_tension
        for name, values, (low, high) in (
            ("radius ratio", ratio, self.radius_ratio),
            (f"reduced {self.control}", reduced, self.reduced),
        ):
            outside = values[(values < low) | (values > high)]
            if outside.size:
                raise ValueError(
                    f"{name}: {outside.flat[0]:.6g} is not in [{low:.6g}, {high:.6g}], the range of the table"
                )


def tabulate(
    contact_angle: ArrayLike,
    control: Literal["suction", "volume"] = "suction",
    *,
    reduced: tuple[float, float] | None = None,
    radius_ratio: tuple[float, float] = (1.0, inf),
    tolerance: float | None = None,
) -> Table:
    r"""Tabulate the exact bridges of one pair of contact angles as polynomials.

    .. math:: \lambda^* = \sum_{ijk} c_{ijk}\, x^i y^j t^k

    in cells of the reduced control (x), of the size ratio (y) and of :math:`q = \sqrt{1 - D/D_c}` (t), in which the
    branch is smooth up to rupture.

    Parameters
    ----------
    contact_angle : float or pair of float
        On both solids, or on each, [rad].
    control : {"suction", "volume"}
        What is held constant.
    reduced : (float, float), optional
        Range of ΔpR̄/γ, (1e-2, 1e8) by default, or of V/R̄³, (1e-9, 1) by default, [-].
    radius_ratio : (float, float)
        Range of the larger radius over the smaller, [-]; infinite for a plane.
    tolerance : float, optional
        Error of the force over the force at contact, [-]; 1e-8 by default.

    Returns
    -------
    Table
        With the bound of its error in ``bound``.

    Raises
    ------
    ValueError
        For bad input, and for volumes at which some pair of the range holds no bridge at contact.

    Warns
    -----
    ToleranceWarning
        If the bound of the error is larger than what was asked.

    Notes
    -----
    **Validity.** As the exact solver. The bound on the force holds up to 1 - D/D_c = 4e-6; nearer to rupture, where the
    force falls infinitely fast, it is that of a separation off by less than 1e-9 of itself.

    Under suction solids with cos θ1 + cos θ2 <= 0 hold no bridge: the force of their table is 0, and so is the rupture
    distance.

    At constant volume and above 31°, or of a large volume from smaller angles on, the liquid between nearly equal
    spheres slides to one side before rupture, and the force is no smooth function of their ratio: a table that holds
    such pairs warns. Ask for ``radius_ratio=(1, 1)``, or for ratios from 1.02 on.

    Examples
    --------
    >>> table = tabulate(0.0, reduced=(10.0, 100.0), radius_ratio=(1, 1), tolerance=1e-6)
    >>> table.bound.force < 1e-6, table.bound.rupture < 1e-7
    (True, True)
    """
    one_of("control", control, tuple(_RANGES))
    angles = np.broadcast_to(angle("contact_angle", contact_angle), (2,))
    low, high = _range("reduced", _RANGES[control] if reduced is None else reduced, 0.0, inf)
    low_ratio, high_ratio = _range("radius_ratio", radius_ratio, 1.0, inf, "[]")
    wanted = _TOLERANCE if tolerance is None else scalar("tolerance", tolerance, "")
    in_range("tolerance", np.asarray(wanted), 1e-10, 1e-2)
    pair = float(angles[0]), float(angles[1])
    task = Task(pair, control == "volume", low, high, low_ratio, high_ratio, wanted, _SHARE)
    grid, bound = _build(task)
    reached_and_asked = (("force", bound.force, wanted), ("rupture distance", bound.rupture, 0.1 * wanted))
    for name, error, asked in reached_and_asked:
        if not error <= asked:
            warn(f"tolerance: the error of the {name} is {error:.1e}, not below {asked:.1e}", ToleranceWarning)
    return Table(pair, control, (low, high), (low_ratio, high_ratio), wanted, bound, __version__, grid)


def _build(task: Task) -> tuple[Grid, Bound]:
    """Build a table, with more cells in octaves of the control as long as their error is too large; keep the best."""
    if task.is_dry:
        return empty_grid(task), Bound(0.0, 0.0, 0.0, 0)
    if task.is_volume:
        refuse_without_contact(task)
    samples = sample_range(task)
    first = octave_of(task.low)
    shares = np.full(len(samples), _SHARE)
    octaves: list[Octave] = []
    for i, sample in enumerate(samples):
        octaves.append(build_octave(task, sample, first + i, octaves[-1] if octaves else None))
    grid = join(task, octaves)
    found = measure(grid, task, octaves_of_rows(grid, len(octaves)))
    for _ in range(1, _MOST_BUILDS):
        errors = found.errors[:, 0]  # of the force
        left = np.flatnonzero(errors > task.tolerance)
        if not left.size or errors.max() > _HOPELESS * task.tolerance:
            break
        finer = octaves.copy()
        for i in left.tolist():
            shares[i] *= max(_LEAST_STEP, _AIM * task.tolerance / errors[i])
            finer[i] = build_octave(task._replace(share=float(shares[i])), samples[i], first + i, octaves[i])
        grid = join(task, finer)
        reached = measure(grid, task, octaves_of_rows(grid, len(octaves)), left)
        better = left[reached.errors[left, 0] < errors[left]]
        for i in better.tolist():
            octaves[i] = finer[i]
        found = found.but_for(reached, better)
    return join(task, octaves), found.bound


def _range(name: str, pair: tuple[float, float], low: float, high: float, brackets: str = "()") -> tuple[float, float]:
    """Two ascending numbers."""
    values = quantity(name, pair, "", allow_inf=True)
    if values.shape != (2,) or not values[0] <= values[1]:
        raise ValueError(f"{name}: {pair!r} is not two ascending numbers")
    in_range(name, values, low, high, brackets=brackets)
    return float(values[0]), float(values[1])


def load_table(path: str | PathLike[str]) -> Table:
    """Load a table, and verify its checksum.

    Parameters
    ----------
    path : path
        Of a file written by :meth:`Table.save`, in either format; its first bytes tell which.

    Returns
    -------
    Table

    Raises
    ------
    ValueError
        If the file cannot be read, is damaged, or of another format.
    """
    place = as_path("path", path)
    found, arrays = binary.load(place) if binary.is_binary(place) else storage.load(place)
    low_ratio, high_ratio = (float(ratio) for ratio in found["radius_ratio"])
    theta1, theta2 = found["contact_angle"]
    low, high = found["reduced"]
    shift, first, cells = found["cut"]
    least, most, least_ratio, largest_ratio = found["range"]
    force, rupture, liquid, bridges = found["bound"]
    grid = Grid(
        **{name: aligned(arrays[name]) for name in _ARRAYS},
        force=cells_from(arrays["force"]),
        liquid=cells_from(arrays["liquid"]),
        shift=shift,
        first=first,
        cells=cells,
        low=least,
        high=most,
        least_ratio=least_ratio,
        largest_ratio=largest_ratio,
        sides=1 if theta1 == theta2 else 2,
        is_volume=found["control"] == "volume",
    )
    return Table(
        (theta1, theta2),
        found["control"],
        (low, high),
        (low_ratio, high_ratio),
        found["tolerance"],
        Bound(force, rupture, liquid, bridges),
        found["version"],
        grid,
    )
