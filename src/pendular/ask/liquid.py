"""Liquids, their surface tension against temperature, and the Kelvin equation between humidity and suction."""

import difflib
import math
import re
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ground.check import in_range, instance, quantity, scalar
from ..ground.warn import warn
from .kept_liquids import (
    WATER_CRITICAL_TEMPERATURE,
    WATER_MOLAR_MASS,
    KeptLiquid,
    density_at,
    kept_liquids,
    tension_at,
    water_density,
    water_tension,
)

__all__ = [
    "KelvinWarning",
    "Liquid",
    "humidity_from_suction",
    "suction_from_humidity",
    "warn_kelvin",
]

# Curvature radius 1/H below which the continuum Kelvin equation is doubtful, [m]. Verified by experiment down to
# 4 nm for organic liquids and untested below it for water (Fisher, Gamble and Middlehurst, Nature 290 (1981) 575);
# "accurate for menisci with d >= 8 nm", d the diameter of a cylindrical meniscus, 1/H = d/2 (Yang et al.,
# Nature 588 (2020) 250, doi 10.1038/s41586-020-2978-1).
DOUBTFUL_CURVATURE_RADIUS = 4e-9

# Humidity uncertainty against which the force is judged, [-]: 0.1 % RH, already better than a common sensor. By
# dH/H = dh/(h |ln h|) it moves the suction by 10 % at h = 0.99 and by 100 % at h = 0.999.
HUMIDITY_UNCERTAINTY = 1e-3

# Relative change of the force by that uncertainty above which humidity no longer controls the force, [-].
LARGE_FORCE_CHANGE = 0.1

GAS_CONSTANT = 8.31446261815324  # exact, [J/(mol K)]

# Ordinary water freezes at 273.15 K under one atmosphere, 0.01 K below its triple point; the IAPWS formulas are
# smooth there (R1-76 holds down to 248 K) and 0 degC is a temperature people ask for.
WATER_FREEZING_POINT = 273.15
WATER_CAS = "7732-18-5"

# Sources of surface tension in the order of trust; the library's own choice serves what neither covers. "REFPROP" are
# the recommended correlations of Mulero et al. (2012), of which thermo prefers a refitted polynomial. The curves of the
# VDI Heat Atlas come next because some of thermo's refits bend at the end of their data: glycerol at 20 degC is 64.1
# mN/m by VDI, 65.5 by the refit and 63.4 to 64 in handbooks.
TRUSTED_METHODS = ("REFPROP", "VDI_PPDS")


_HOTTEST_IN_CELSIUS = 100.0  # of what is likely to have been typed

_OPTIONAL_UNITS = {"density": "kg/m**3", "molar_mass": "kg/mol", "temperature": "K", "molar_volume": "m**3/mol"}

_CAS_NUMBER = re.compile(r"\d{2,7}-\d\d-\d")

# Keys of names as _key makes them. A polymer is chains of many lengths and has no entry of its own in the data; the
# abbreviations may have a number of its length or viscosity behind them.
_POLYMER = re.compile(
    r"\(?poly|silicone|siliconoil|simeth?icone?|dimeth?icone?|macrogol|carbowax|povidone|(methyl|ethyl|nitro)?cellulose"
    r"|(pdms|peg|peo|pom|ppg|ppo|pvp|pva|pvac|pvoh|pvc|pvdf|pib|paa|pam|pan|pao|pmma|ptfe|pfpe|pla|pet|psu?|pcl)\d*$"
)

# Words for mixtures and for kinds of substances, some of which the data take for one of them.
_SEVERAL = {
    *("alcohol", "brine", "crudeoil", "ether", "glycol", "methylatedspirit", "mineraloil", "oil", "paraffin"),
    *("paraffinoil", "rubbingalcohol", "saltwater", "seawater", "spirit", "spirits", "vegetableoil", "whitespirit"),
}

# Other names in use of substances among whose synonyms are their polymers.
_EVERYDAY = {
    *("1,2ethanediol", "benzol", "ethane1,2diol", "glycerin", "glycerine", "monoethyleneglycol", "propyleneglycol"),
}


class KelvinWarning(UserWarning):
    """Humidity is asked to fix a force where the Kelvin equation is doubtful or badly conditioned."""


@dataclass(frozen=True)
class Liquid:
    """A liquid at one temperature.

    Parameters
    ----------
    surface_tension : float
        γ against its vapour or air, [N/m], > 0.
    density : float, optional
        ρ, [kg/m³], > 0; needed for humidity only.
    molar_mass : float, optional
        M, [kg/mol], > 0; needed for humidity only.
    temperature : float, optional
        T, [K], > 0; needed for humidity only.
    name : str, optional
        For messages and pictures.
    molar_volume : float, optional
        V_m = M/ρ, [m³/mol], > 0; serves humidity in the place of density and molar mass.

    Raises
    ------
    ValueError
        If a number is not one finite number > 0, or the molar volume is given beside density or molar mass.

    Examples
    --------
    >>> Liquid(surface_tension=0.0728).surface_tension
    0.0728
    >>> brine = Liquid(surface_tension=0.0808, molar_volume=16.9e-6, temperature=298.15)
    >>> print(f"{suction_from_humidity(0.7, brine):.4g} Pa")
    5.232e+07 Pa
    >>> Liquid.named("n-dodecane").name
    'dodecane'
    """

    surface_tension: float
    density: float | None = None
    molar_mass: float | None = None
    temperature: float | None = None
    name: str | None = None
    molar_volume: float | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "surface_tension", _positive("surface_tension", self.surface_tension, "N/m"))
        for field, unit in _OPTIONAL_UNITS.items():
            value = getattr(self, field)
            if value is not None:
                object.__setattr__(self, field, _positive(field, value, unit))
        for field in ("density", "molar_mass"):
            if self.molar_volume is not None and getattr(self, field) is not None:
                raise ValueError(f"molar_volume: given together with {field}; it stands for density and molar_mass")

    @classmethod
    def water(cls, temperature: float = 293.15, *, surface_tension: float | None = None) -> Self:
        r"""Ordinary water by the IAPWS formulations, on the saturation line.

        .. math:: \gamma = 0.2358\, \tau^{1.256} (1 - 0.625\, \tau)\ \mathrm{N/m}, \qquad
           \tau = 1 - T / 647.096\,\mathrm{K} \qquad \text{(IAPWS R1-76)}

        Parameters
        ----------
        temperature : float
            T, [K], from 273.15 to below the critical point, 647.096.
        surface_tension : float, optional
            γ, [N/m], where it was measured, as of water with a surfactant; else that of the formula.

        Returns
        -------
        Liquid
            With the density of the saturated liquid by IAPWS SR1-86.

        Raises
        ------
        ValueError
            If the temperature is outside this range.

        Notes
        -----
        **Validity.** R1-76 states its own uncertainty as about 0.5 % below 100 °C. The density is within 7e-6 of
        IAPWS-95 below 100 °C, 4e-4 up to 620 K and 2e-3 above. Under one atmosphere that at 20 °C is 998.207 instead
        of 998.158 kg/m³, 5e-5 more.

        References
        ----------
        .. [1] IAPWS R1-76(2014), Revised Release on Surface Tension of Ordinary Water Substance;
           N. B. Vargaftik, B. N. Volkov, L. D. Voljak, J. Phys. Chem. Ref. Data 12 (1983) 817.
           doi 10.1063/1.555688.
        .. [2] IAPWS SR1-86(1992), Revised Supplementary Release on Saturation Properties of Ordinary Water Substance;
           W. Wagner, A. Pruß, J. Phys. Chem. Ref. Data 22 (1993) 783. doi 10.1063/1.555926.

        Examples
        --------
        >>> water = Liquid.water(temperature=293.15)
        >>> round(1e3 * water.surface_tension, 4), round(water.density, 4)
        (72.7361, 998.1581)
        >>> Liquid.water(surface_tension=0.0523).surface_tension
        0.0523
        """
        kelvin = _in_kelvin(
            "temperature", scalar("temperature", temperature, "K"), WATER_FREEZING_POINT, WATER_CRITICAL_TEMPERATURE
        )
        return cls(
            surface_tension=water_tension(kelvin) if surface_tension is None else surface_tension,
            density=water_density(kelvin),
            molar_mass=WATER_MOLAR_MASS,
            temperature=kelvin,
            name="water",
        )

    @classmethod
    def named(cls, name: str, temperature: float = 293.15, *, surface_tension: float | None = None) -> Self:
        """Pure liquid on its saturation line: one of the commonest 31, or of the data of thermo and chemicals.

        Water and thirty liquids more, `pendular.ask.kept_liquids`, need nothing else; some hundred more come with
        ``pip install 'pendular[liquids]'``.

        Parameters
        ----------
        name : str
            Common or systematic name, or CAS number, of one substance.
        temperature : float
            T, [K], inside the range of the liquid's surface tension data.
        surface_tension : float, optional
            γ, [N/m], where it was measured; else that of the data.

        Returns
        -------
        Liquid
            Under its common name, which shows what was understood; ``density`` is None where no data cover the
            temperature.

        Raises
        ------
        ValueError
            If the liquid is unknown (with close names), needs the packages that are not installed, has no surface
            tension data, or none at this temperature; and for a polymer, a mixture, or a name that the data give to
            several substances.

        Notes
        -----
        **Validity.** Surface tension by Mulero et al. [1]_ (115 liquids), else by the VDI Heat Atlas [2]_, else what
        thermo recommends. At 20 °C within 0.02 % of CoolProp for alkanes, ethanol, cyclohexane, toluene and benzene,
        within 0.4 % of Jasper [3]_ for ethylene glycol and isopropanol, about 1 % for glycerol. Mercury is 475.6 mN/m,
        2.2 % below the 486.5 of handbooks for a clean surface: where that matters, pass the measured value.
        Densities of the liquids that are kept are within 0.25 % of CoolProp from 0 to 100 °C, those of the others
        within 0.02 %.

        References
        ----------
        .. [1] A. Mulero, I. Cachadiña, M. I. Parra, J. Phys. Chem. Ref. Data 41 (2012) 043105.
           doi 10.1063/1.4768782.
        .. [2] VDI Heat Atlas, 2nd edition, Springer, 2010. doi 10.1007/978-3-540-77877-6.
        .. [3] J. J. Jasper, J. Phys. Chem. Ref. Data 1 (1972) 841. doi 10.1063/1.3253106.

        Examples
        --------
        >>> ethanol = Liquid.named("ethanol", temperature=293.15)
        >>> round(1e3 * ethanol.surface_tension, 2), round(ethanol.density)
        (22.37, 790)
        """
        chemical = _look_up(name)
        if isinstance(chemical, str):
            return cls.water(temperature, surface_tension=surface_tension)
        kelvin = _positive("temperature", temperature, "K")
        if isinstance(chemical, KeptLiquid):
            span, reach = chemical.tension, chemical.density
            if surface_tension is None:
                _in_kelvin(f"temperature of {chemical.name}", kelvin, span.low, span.high)
                surface_tension = tension_at(chemical, kelvin)
            density = density_at(chemical, kelvin) if reach.low <= kelvin <= reach.high else None
            return cls(surface_tension, density, chemical.molar_mass, kelvin, chemical.name)
        return cls(
            surface_tension=_surface_tension(chemical, kelvin) if surface_tension is None else surface_tension,
            density=_density(chemical, kelvin),
            molar_mass=1e-3 * chemical.MW,
            temperature=kelvin,
            name=chemical.common_name,
        )


def suction_from_humidity(
    humidity: ArrayLike, liquid: Liquid, temperature: float | None = None
) -> np.float64 | NDArray[np.float64]:
    r"""Suction in equilibrium with a relative humidity, by the Kelvin equation.

    .. math:: \Delta p = -\rho\, R_v T \ln h, \qquad R_v = R/M \qquad \text{(Zhao et al. 2020, Eqs. 15-16)}

    Parameters
    ----------
    humidity : array_like
        Relative humidity h = p_v / p_sat of the liquid's own vapour, [-], in (0, 1).
    liquid : Liquid
        With density and molar mass, or molar volume.
    temperature : float, optional
        T, [K], for a liquid that was made without one.

    Returns
    -------
    float or ndarray
        Δp = p_gas - p_liquid, [Pa], > 0, of the shape of ``humidity``.

    Raises
    ------
    ValueError
        If a humidity is outside (0, 1) or the liquid lacks a property.

    Notes
    -----
    **Validity.** Ideal vapour, incompressible liquid. h refers to the flat liquid under the same gas pressure; against
    the pure-vapour p_sat the suction of water at 20 °C and 1 atm is 0.099 MPa higher, as much as Δp itself at
    h = 0.999. Doubtful where γ/Δp is below 4 nm (water at 20 °C: h < 0.87), see `warn_kelvin`.

    References
    ----------
    .. [1] C.-F. Zhao, N. P. Kruyt, O. Millet, Powder Technology 360 (2020) 622.
    .. [2] L. R. Fisher, R. A. Gamble, J. Middlehurst, Nature 290 (1981) 575. doi 10.1038/290575a0.

    Examples
    --------
    >>> print(f"{suction_from_humidity(0.9, Liquid.water()):.4g} Pa")
    1.423e+07 Pa
    """
    hint = "50 % are 0.5, and saturation is a suction of 0"
    h = in_range("humidity", quantity("humidity", humidity, ""), 0.0, 1.0, brackets="()", high_hint=hint)
    # log loses nothing near h = 1: h itself is exact input there, and log is correct to its last digit.
    return -_kelvin_pressure(liquid, temperature) * np.log(h)


def humidity_from_suction(
    suction: ArrayLike, liquid: Liquid, temperature: float | None = None
) -> np.float64 | NDArray[np.float64]:
    r"""Relative humidity in equilibrium with a suction, the inverse of `suction_from_humidity`.

    .. math:: h = \exp\!\left(-\frac{\Delta p}{\rho\, R_v T}\right) \qquad \text{(Zhao et al. 2020, Eq. 15)}

    Parameters
    ----------
    suction : array_like
        Δp = p_gas - p_liquid, [Pa], >= 0.
    liquid : Liquid
        With density and molar mass, or molar volume.
    temperature : float, optional
        T, [K], for a liquid that was made without one.

    Returns
    -------
    float or ndarray
        h, [-], of the shape of ``suction``; exactly 1 at zero suction.

    Raises
    ------
    ValueError
        If a suction is negative or the liquid lacks a property.

    Notes
    -----
    **Validity.** As for `suction_from_humidity`. Next to h = 1 a double keeps 1 - h to 1e-16 only, so that suctions
    below about 10 kPa come back with fewer than 12 digits.

    References
    ----------
    .. [1] C.-F. Zhao, N. P. Kruyt, O. Millet, Powder Technology 360 (2020) 622.

    Examples
    --------
    >>> print(f"{humidity_from_suction(1.357e6, Liquid.water()):.4f}")
    0.9900
    """
    p = in_range("suction", quantity("suction", suction, "Pa"), 0.0, unit="Pa")
    return np.exp(-p / _kelvin_pressure(liquid, temperature))


def warn_kelvin(curvature_radius: ArrayLike, relative_force_change: ArrayLike) -> None:
    """Issue at most one `KelvinWarning` for bridges whose force was fixed by a humidity.

    Parameters
    ----------
    curvature_radius : array_like
        1/H = γ/Δp, [m]; NaN, where there is no bridge, is passed over.
    relative_force_change : array_like
        dF/F by a change of 0.1 % RH, [-], either sign; NaN is passed over.

    Notes
    -----
    **Validity.** The limits are ``DOUBTFUL_CURVATURE_RADIUS`` and ``LARGE_FORCE_CHANGE``; their sources stand there.

    Examples
    --------
    >>> import warnings
    >>> with warnings.catch_warnings(record=True) as caught:
    ...     warnings.simplefilter("always")
    ...     warn_kelvin([2e-9, 1e-7], 0.05)
    >>> print(caught[0].message)
    curvature radius down to 2 nm: the Kelvin equation is doubtful below 4 nm
    """
    radius, change = np.asarray(curvature_radius), np.abs(relative_force_change)
    # Comparisons with NaN are false: what has no bridge drops out here.
    doubtful = radius[radius < DOUBTFUL_CURVATURE_RADIUS]
    loose = change[change > LARGE_FORCE_CHANGE]
    reasons = []
    if doubtful.size:
        reasons.append(
            f"curvature radius down to {1e9 * doubtful.min():.3g} nm: "
            f"the Kelvin equation is doubtful below {1e9 * DOUBTFUL_CURVATURE_RADIUS:g} nm"
        )
    if loose.size:
        reasons.append(
            f"an uncertainty of {100 * HUMIDITY_UNCERTAINTY:g} % RH changes the force by up to "
            f"{100 * loose.max():.3g} %: control the suction or the volume instead"
        )
    if reasons:
        warn("; ".join(reasons), KelvinWarning)


def _positive(name: str, value: object, unit: str) -> float:
    return in_range(name, scalar(name, value, unit), 0.0, brackets="()", unit=unit)


def _in_kelvin(name: str, kelvin: float, low: float, high: float) -> float:
    """Temperature in a range, where a low one was rather meant in degrees Celsius."""
    hint = "20 degrees Celsius are 293.15 K" if kelvin <= _HOTTEST_IN_CELSIUS else ""
    return in_range(name, kelvin, low, high, brackets="[)", unit="K", low_hint=hint)


def _kelvin_pressure(liquid: Liquid, temperature: float | None) -> float:
    """R T / V_m, the suction at which the humidity is 1/e, [Pa]."""
    instance("liquid", liquid, Liquid)
    kelvin, volume = _temperature_of(liquid, temperature), _molar_volume(liquid)
    if volume is None or kelvin is None:
        missing = []
        if volume is None:
            lacking = [field for field in ("density", "molar_mass") if getattr(liquid, field) is None]
            missing.append(f"{' and '.join(lacking)} (or molar_volume)")
        if kelvin is None:
            missing.append("temperature")
        told = ", ".join(missing)
        raise ValueError(f"liquid: {liquid.name or 'it'} lacks {told}, needed for humidity; give it to Liquid(...)")
    return GAS_CONSTANT * kelvin / volume


def _molar_volume(liquid: Liquid) -> float | None:
    if liquid.density is None or liquid.molar_mass is None:
        return liquid.molar_volume
    return liquid.molar_mass / liquid.density


def _temperature_of(liquid: Liquid, given: float | None) -> float | None:
    """Return the liquid's own temperature, or the given one if it has none; two that differ are refused."""
    if given is None:
        return liquid.temperature
    kelvin = _positive("temperature", given, "K")
    # Surface tension and density belong to the liquid's own temperature: no answer would be right for both.
    if liquid.temperature not in (None, kelvin):
        raise ValueError(f"temperature: {kelvin} K is not {liquid.temperature} K, for which the liquid was made")
    return kelvin


def _look_up(name: str) -> Any:
    """Liquid of a name: "water", a kept one, or an entry of the chemicals package."""
    found = (_kept().get(name.strip()) or _kept().get(_key(name))) if isinstance(name, str) else None
    if found is not None:
        return found
    chemical = _identify(name)
    return _kept().get(chemical.CASs, chemical)


@cache
def _kept() -> dict[str, "KeptLiquid | str"]:
    """What is kept, by the keys of its names and by its CAS numbers."""
    known: dict[str, KeptLiquid | str] = {_key(name): "water" for name in ("water", "H2O")}
    known[WATER_CAS] = "water"
    for liquid in kept_liquids():
        known |= {_key(name): liquid for name in (liquid.name, *liquid.other_names)}
        known[liquid.cas] = liquid
    return known


def _refuse_without_data(name: str) -> None:
    """Refuse a liquid that is not kept, where the packages with all the others are not installed."""
    if find_spec("thermo") and find_spec("chemicals"):
        return
    known = ["water", *(one for liquid in kept_liquids() for one in (liquid.name, *liquid.other_names))]
    close = difflib.get_close_matches(name.lower(), known, cutoff=0.7)
    hint = f"did you mean {' or '.join(close)}? Otherwise " if close else ""
    raise ValueError(
        f"name: {name!r} is not among the {len(kept_liquids()) + 1} liquids that come with pendular; {hint}"
        "pip install 'pendular[liquids]' brings some hundred more, or make Liquid(surface_tension=...)"
    )


def _identify(name: str) -> Any:
    """Entry of the chemicals package for a name: CASs, MW [g/mol], common_name."""
    if not isinstance(name, str) or not name.strip():  # chemicals takes an empty name for vanadium
        raise ValueError(f"name: {name!r} is not the name of a liquid")
    key = _key(name)
    if _POLYMER.match(key):
        raise ValueError(f"name: {name!r} is a polymer, of which there are no data; make Liquid(surface_tension=...)")
    if key in _SEVERAL:
        raise ValueError(f"name: {name!r} is not one substance; write which, or make Liquid(surface_tension=...)")
    _refuse_without_data(name)
    from chemicals import search_chemical

    try:
        found = search_chemical(name)
    except ValueError:
        close = difflib.get_close_matches(name.lower(), set(_tabulated()) - {name.lower()}, cutoff=0.7)
        hint = f"did you mean {' or '.join(close)}?" if close else "make Liquid(surface_tension=...)"
        raise ValueError(f"name: {name!r} is not a known liquid; {hint}") from None
    if not _is_sure(found, name):
        raise ValueError(
            f"name: {name!r} may be something else than {found.common_name}, CAS {found.CASs}, which was found; "
            "write that name or number, or make Liquid(surface_tension=...)"
        )
    return found


def _is_sure(found: Any, name: str) -> bool:
    """Whether a name belongs to the substance that was found for it, and to no other.

    The synonyms, of PubChem, have names of products, and those of polymers among the names of what they are made of:
    PDMS is one of octamethyltrisiloxane. A sum formula finds any of its isomers.
    """
    if _CAS_NUMBER.fullmatch(name.strip()):
        return bool(name.strip() == found.CASs)  # numbers of polymers, too, are among the synonyms
    key = _key(name)
    if key in (_key(found.common_name), _key(found.iupac_name)):
        return True
    if key in _tabulated_keys():
        return found.CASs in _tabulated_keys()[key]
    synonyms = {_key(synonym) for synonym in found.synonyms}
    has_polymers = any(_POLYMER.match(synonym) for synonym in synonyms)
    return key in synonyms and (not has_polymers or key in _EVERYDAY)


def _key(name: str) -> str:
    """Name without what is written in several ways: case, spaces and hyphens."""
    return re.sub(r"[\s‐-―-]", "", name.lower())


@cache
def _tabulated() -> dict[str, set[str]]:
    """Names in the tables of surface tension, in small letters, with the CAS numbers they stand for."""
    from chemicals import interface as data

    numbers: dict[str, set[str]] = {}
    for table in (data.sigma_data_Mulero_Cachadina, data.sigma_data_VDI_PPDS_11, data.sigma_data_Jasper_Lange):
        for number, name in zip(table.index, table.iloc[:, 0], strict=True):
            numbers.setdefault(name.strip().lower(), set()).add(number)
    return numbers


@cache
def _tabulated_keys() -> dict[str, set[str]]:
    """The same by the keys of the names."""
    numbers: dict[str, set[str]] = {}
    for name, some in _tabulated().items():
        numbers.setdefault(_key(name), set()).update(some)
    return numbers


def _surface_tension(chemical: Any, kelvin: float) -> float:
    from thermo.interface import SurfaceTension

    data = SurfaceTension(CASRN=chemical.CASs)
    method = next((method for method in TRUSTED_METHODS if method in data.all_methods), data.method)
    if method is None:
        raise ValueError(f"name: no surface tension is known for {chemical.common_name}; pass surface_tension=...")
    low, high = data.T_limits[method]  # the upper end is often the critical point, where it vanishes
    _in_kelvin(f"temperature of {chemical.common_name}", kelvin, low, high)
    return float(data.calculate(kelvin, method))


def _density(chemical: Any, kelvin: float) -> float | None:
    from thermo.volume import VolumeLiquid

    data = VolumeLiquid(CASRN=chemical.CASs)
    low, high = data.T_limits.get(data.method, (math.inf, -math.inf))
    if not low <= kelvin <= high:  # thermo would extrapolate
        return None
    return float(1e-3 * chemical.MW / data.calculate(kelvin, data.method))
