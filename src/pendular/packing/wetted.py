"""A wetted heap as its users see it: water, stress, and the bridges one by one."""

import math
from dataclasses import dataclass, field
from functools import cached_property
from os import PathLike

import numpy as np
from numpy.typing import NDArray

from ..ground.check import in_range, scalar
from .answers import Answers, geometry_of
from .heap import Packing
from .meetings import Meetings, meetings_of
from .neighbours import Neighbours, arms_of
from .setting import Setting
from .shape import AREA
from .solids import pore_volume_of
from .state import Book, State
from .stress import Shares, fabric_of, shares_of, stress_sum

__all__ = ["BridgesOfHeap", "TableError", "Wet"]

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class BridgesOfHeap:
    """The bridges of a heap: arrays with one row a bridge, in the order of their grains.

    A quantity that belongs to a body has a second axis of two. Bodies from the number of grains on are walls.
    """

    pairs: NDArray[np.int32]  # (n, 2), ascending
    image: NDArray[np.int32]  # (n, 3), cells between the second and its nearest image
    separation: Floats  # (n,), negative in an overlap, [m]
    normal: Floats = field(repr=False)  # (n, 3), unit vector from the first to the second
    length: Floats = field(repr=False)  # (n,), between centres, or from a centre to the wall, [m]
    _answers: Answers = field(repr=False)
    _shape: Floats = field(repr=False)

    def __len__(self) -> int:
        return len(self.separation)

    @property
    def neighbours(self) -> Neighbours:
        """Pairs, images and separations as one record."""
        return Neighbours(self.pairs, self.image, self.separation)

    @property
    def force(self) -> Floats:
        """Attraction, [N]."""
        return self._answers.force

    @property
    def volume(self) -> Floats:
        """Liquid, [m³]."""
        return self._answers.volume

    @property
    def suction(self) -> Floats:
        """Gas pressure minus liquid pressure, [Pa]."""
        return np.broadcast_to(self._answers.suction, self.separation.shape)

    @property
    def liquid_gas_area(self) -> Floats:
        """Area of the meniscus, [m²]."""
        return self._shape[:, AREA]

    @property
    def half_filling_angle(self) -> Floats:
        """Half-filling angles, (n, 2), 0 on a wall, [rad]."""
        return self._shape[:, 1:3]

    @property
    def wetted_area(self) -> Floats:
        """Wetted areas, (n, 2), [m²]."""
        return self._shape[:, 3:5]

    @property
    def capillary_tensor(self) -> Floats:
        """∫ n ⊗ n over the meniscus, (n, 2): across and along ``normal``, [m²]."""
        return self._shape[:, 5:7]

    @property
    def grand_potential(self) -> Floats:
        """Surface energy + suction x volume, [J]; in an overlap it goes on with the force of contact."""
        return self._answers.potential


@dataclass(frozen=True)
class TableError:
    """Largest error of answers from a table, found on some of the bridges, over the largest value of the heap."""

    bridges: int  # compared with the exact answer; 0 if the answers are exact themselves
    force: float
    volume: float
    liquid_gas_area: float
    grand_potential: float


@dataclass(frozen=True, eq=False, repr=False)
class Wet:
    """A wetted heap, made by :func:`wet`."""

    heap: Packing
    bridges: BridgesOfHeap
    book: Book
    suction: float  # common to all bridges, [Pa]; NaN where each keeps its own
    solid_volume: float  # of the grains, overlaps counted once, [m³]
    grain_density: float | None  # [kg/m³]
    table_error: TableError
    _setting: Setting

    @property
    def liquid_volume(self) -> float:
        """Liquid in bridges, [m³]."""
        return self.book.held

    @property
    def unheld(self) -> float:
        """Liquid that no bridge takes, [m³]."""
        return self.book.unheld

    @cached_property
    def pore_volume(self) -> float:
        """Of the cell without the grains, [m³]."""
        return pore_volume_of(self.heap, self.solid_volume)

    @property
    def porosity(self) -> float:
        """Pores over the cell."""
        return self.pore_volume / self.heap.volume

    @property
    def saturation(self) -> float:
        """Liquid in bridges over pores, S_r = Σ V/V_p."""
        return self.liquid_volume / self.pore_volume

    @property
    def water_content(self) -> float:
        """Volumetric water content, θ_w = Σ V/V."""
        return self.liquid_volume / self.heap.volume

    @property
    def mass_ratio(self) -> float:
        """Gravimetric water content, w = ρ_l Σ V/(ρ_s V_s); NaN unless both densities are given."""
        density = self._setting.liquid.density
        if density is None or self.grain_density is None:
            return math.nan
        return density * self.liquid_volume / (self.grain_density * self.solid_volume)

    @property
    def mass_fraction(self) -> float:
        """Mass of the liquid over that of liquid and grains."""
        return self.mass_ratio / (1.0 + self.mass_ratio)

    @cached_property
    def stress(self) -> Floats:
        r"""Capillary stress :math:`\frac1V \sum F l\,\mathbf n \otimes \mathbf n`, (3, 3), tension positive, [Pa]."""
        return stress_sum(self.bridges.force, self.bridges.normal, self.bridges.length) / self.heap.volume

    @cached_property
    def stress_shares(self) -> Shares:
        """Parts of the stress that liquid, menisci and grains carry, (3, 3) each, [Pa]."""
        bridges = self.bridges
        sums = shares_of(self._setting, bridges.neighbours, bridges.normal, bridges._answers, bridges._shape)
        return Shares(*(part / self.heap.volume for part in sums))

    @property
    def suction_stress(self) -> float:
        """Mean extra pressure on the grains, tr σ/3, [Pa]."""
        return float(np.trace(self.stress)) / 3.0

    @property
    def chi(self) -> float:
        """Bishop's parameter that would give the same, tr σ/(3Δp); NaN without a common suction."""
        return self.suction_stress / self.suction

    @property
    def interface_area(self) -> float:
        """Area of the menisci over the volume of the cell, [1/m]."""
        return float(np.sum(self.bridges.liquid_gas_area)) / self.heap.volume

    @property
    def coordination(self) -> float:
        """Bridges a grain."""
        return float(np.count_nonzero(self.bridges.pairs < self.heap.count)) / self.heap.count

    @property
    def contacts(self) -> float:
        """Bridges a grain whose bodies touch."""
        touching = self._setting.touching(self.bridges.separation)
        return float(np.count_nonzero(self.bridges.pairs[touching] < self.heap.count)) / self.heap.count

    @cached_property
    def fabric(self) -> Floats:
        r"""Fabric of the bridges :math:`\frac1N \sum \mathbf n \otimes \mathbf n`, (3, 3)."""
        return fabric_of(self.bridges.normal)

    @cached_property
    def meetings(self) -> Meetings:
        """Bridges that meet on a grain or on a wall."""
        bridges = self.bridges
        return meetings_of(self.heap, bridges.neighbours, bridges.normal, bridges._shape, bridges.volume)

    @property
    def is_pendular(self) -> bool:
        """Whether no bridges meet; beyond, every number is that of bridges which overlap."""
        return not self.meetings.any

    @property
    def grand_potential(self) -> float:
        """Of all bridges, [J]; the stress is its rate with the strain at fixed suction, over the volume."""
        return float(np.sum(self.bridges.grand_potential))

    @property
    def surface_energy(self) -> float:
        """Of all bridges, [J]; the stress is its rate with the strain at fixed volume, over the volume."""
        return self.grand_potential - float(np.sum(self.bridges.suction * self.bridges.volume))

    def cohesion(self, friction_angle: float) -> float:
        r"""Cohesion of Mohr and Coulomb, :math:`c = p_s \tan\varphi`, [Pa].

        Parameters
        ----------
        friction_angle : float
            φ of the dry heap, in [0, π/2), [rad].

        Returns
        -------
        float
            An estimate: the grains are pressed together by the suction stress as by a load.
        """
        angle = in_range(
            "friction_angle",
            scalar("friction_angle", friction_angle, "rad"),
            0.0,
            math.pi / 2,
            brackets="[)",
            unit="rad",
        )
        return self.suction_stress * math.tan(angle)

    @property
    def state(self) -> State:
        """What the next step takes up."""
        return State(
            self.bridges.pairs,
            self.bridges.volume,
            self.bridges.suction,
            self.unheld,
            self.heap.count + len(self.heap.walls),
        )

    def save(self, path: str | PathLike[str]) -> None:
        """Write the state to a file that :func:`load_state` reads."""
        self.state.save(path)

    def __repr__(self) -> str:
        return f"Wet({self})"

    def __str__(self) -> str:
        suction = "suctions of their own" if math.isnan(self.suction) else f"suction {self.suction:.6g} Pa"
        beyond = "" if self.is_pendular else f"; bridges meet on {100 * self.meetings.grains:.3g} % of the grains"
        return (
            f"{len(self.bridges)} bridges, {suction}, saturation {self.saturation:.6g}, "
            f"suction stress {self.suction_stress:.6g} Pa{beyond}"
        )


def bridges_of(setting: Setting, near: Neighbours, answers: Answers) -> BridgesOfHeap:
    """Bridges of the pairs that hold one."""
    normal, length = arms_of(setting.heap, near)
    shape = geometry_of(setting, near, answers)
    return BridgesOfHeap(near.pairs, near.image, near.gap, normal, length, answers._replace(shape=None), shape)
