r"""The commonest liquids, kept here with the numbers of published correlations, so that they need no library.

``kept_liquids.csv`` names the law of each number. Surface tension, [N/m], is by Mulero et al. [1]_ or the VDI Heat
Atlas [2]_, with :math:`\tau = 1 - T/T_c`:

.. math:: \gamma = \sum_i \sigma_i \tau^{n_i}, \qquad \gamma = A\,(1 - T_r)^{B + C T_r + D T_r^2 + E T_r^3}

and the density of the saturated liquid, [kg/m³], by the VDI Heat Atlas or Perry's Handbook [3]_:

.. math:: \rho = \rho_c + A\tau^{0.35} + B\tau^{2/3} + C\tau + D\tau^{4/3}, \qquad
          \rho/M = C_1 / C_2^{1 + (1 - T/C_3)^{C_4}}

Water is by the releases of IAPWS: surface tension R1-76(2014) and saturated density SR1-86(1992) [4]_.

References
----------
.. [1] A. Mulero, I. Cachadiña, M. I. Parra, J. Phys. Chem. Ref. Data 41 (2012) 043105. doi 10.1063/1.4768782.
.. [2] VDI Heat Atlas, 2nd edition, Springer, 2010. doi 10.1007/978-3-540-77877-6.
.. [3] D. W. Green, R. H. Perry, Perry's Chemical Engineers' Handbook, 8th edition, McGraw-Hill, 2007.
.. [4] W. Wagner, A. Pruß, J. Phys. Chem. Ref. Data 22 (1993) 783. doi 10.1063/1.555926.
"""

import csv
from functools import cache
from importlib.resources import files
from typing import NamedTuple

__all__ = [
    "WATER_CRITICAL_DENSITY",
    "WATER_CRITICAL_TEMPERATURE",
    "WATER_DENSITY",
    "WATER_MOLAR_MASS",
    "WATER_TENSION",
    "Correlation",
    "KeptLiquid",
    "density_at",
    "kept_liquids",
    "tension_at",
    "water_density",
    "water_tension",
]

WATER_CRITICAL_TEMPERATURE = 647.096  # [K]
WATER_MOLAR_MASS = 0.018015268  # [kg/mol], of IAPWS
WATER_TENSION = (0.2358, 1.256, -0.625)  # R1-76: size, exponent and linear term
WATER_CRITICAL_DENSITY = 322.0  # [kg/m³]
WATER_DENSITY = (  # SR1-86, Eq. (2): coefficients and exponents
    (1.99274064, 1.0 / 3.0),
    (1.09965342, 2.0 / 3.0),
    (-0.510839303, 5.0 / 3.0),
    (-1.75493479, 16.0 / 3.0),
    (-45.5170352, 43.0 / 3.0),
    (-6.74694450e5, 110.0 / 3.0),
)


class Correlation(NamedTuple):
    """A law of temperature with its numbers and its range."""

    law: str
    numbers: tuple[float, ...]
    low: float  # [K]
    high: float


class KeptLiquid(NamedTuple):
    """One of the liquids that are kept."""

    name: str
    cas: str
    other_names: tuple[str, ...]
    molar_mass: float  # [kg/mol]
    tension: Correlation  # [N/m]
    density: Correlation  # [kg/m³]


@cache
def kept_liquids() -> tuple[KeptLiquid, ...]:
    """All of them, in the order of the file.

    Examples
    --------
    >>> [liquid.name for liquid in kept_liquids()][:3]
    ['methanol', 'ethanol', '1-propanol']
    """
    text = files(__package__).joinpath("kept_liquids.csv").read_text("utf-8")
    return tuple(_read(row) for row in csv.DictReader(text.splitlines()))


def _read(row: dict[str, str]) -> KeptLiquid:
    def correlation(quantity: str) -> Correlation:
        numbers = tuple(map(float, row[f"{quantity}_numbers"].split()))
        return Correlation(
            row[f"{quantity}_law"], numbers, float(row[f"{quantity}_from"]), float(row[f"{quantity}_to"])
        )

    others = tuple(filter(None, row["other_names"].split(";")))
    mass = float(row["molar_mass"])
    return KeptLiquid(row["name"], row["cas"], others, mass, correlation("tension"), correlation("density"))


def tension_at(liquid: KeptLiquid, kelvin: float) -> float:
    """Surface tension at a temperature, [N/m].

    Examples
    --------
    >>> print(f"{1e3 * tension_at(kept_liquids()[1], 293.15):.2f} mN/m")
    22.37 mN/m
    """
    critical, *numbers = liquid.tension.numbers
    tau = 1.0 - kelvin / critical
    if liquid.tension.law == "mulero":
        return float(sum(sigma * tau**n for sigma, n in zip(numbers[::2], numbers[1::2], strict=True)))
    a, b, c, d, e = numbers
    reduced = kelvin / critical
    return float(a * tau ** (b + reduced * (c + reduced * (d + reduced * e))))


def density_at(liquid: KeptLiquid, kelvin: float) -> float:
    """Density of the saturated liquid at a temperature, [kg/m³].

    Examples
    --------
    >>> print(f"{density_at(kept_liquids()[1], 293.15):.1f} kg/m3")
    790.2 kg/m3
    """
    if liquid.density.law == "perry":
        c1, c2, c3, c4 = liquid.density.numbers
        return float(liquid.molar_mass * c1 / c2 ** (1.0 + (1.0 - kelvin / c3) ** c4))
    critical, least, a, b, c, d = liquid.density.numbers
    tau = 1.0 - kelvin / critical
    return float(least + a * tau**0.35 + b * tau ** (2.0 / 3.0) + c * tau + d * tau ** (4.0 / 3.0))


def water_tension(kelvin: float) -> float:
    """Surface tension of water, IAPWS R1-76(2014), [N/m].

    Examples
    --------
    >>> print(f"{1e3 * water_tension(293.15):.4f} mN/m")
    72.7361 mN/m
    """
    tau = 1.0 - kelvin / WATER_CRITICAL_TEMPERATURE
    size, exponent, linear = WATER_TENSION
    return float(size * tau**exponent * (1.0 + linear * tau))


def water_density(kelvin: float) -> float:
    """Density of saturated liquid water, IAPWS SR1-86(1992), [kg/m³].

    Examples
    --------
    >>> print(f"{water_density(293.15):.3f} kg/m3")
    998.158 kg/m3
    """
    tau = 1.0 - kelvin / WATER_CRITICAL_TEMPERATURE
    return float(WATER_CRITICAL_DENSITY * (1.0 + sum(b * tau**n for b, n in WATER_DENSITY)))
