"""Liquids against the tables of IAPWS, CoolProp and handbooks; the Kelvin equation against its own limits."""

import dataclasses
import math
import re
import subprocess
import sys
import warnings

import numpy as np
import pint
import pytest
from hypothesis import given
from hypothesis import strategies as st

import pendular.ask.liquid
from pendular.ask.kept_liquids import density_at, kept_liquids, tension_at
from pendular.ask.liquid import (
    KelvinWarning,
    Liquid,
    _identify,
    _tabulated,
    humidity_from_suction,
    suction_from_humidity,
    warn_kelvin,
)

LIBRARY = pytest.mark.needs("liquids")  # thermo and chemicals, with all liquids that are not kept
UNITS = pint.UnitRegistry()
WATER = Liquid.water(293.15)
EPSILON = sys.float_info.epsilon


def refused(message: str):
    """Expect a ValueError of exactly this one line."""
    return pytest.raises(ValueError, match=f"^{re.escape(message)}$")


# -- the record ------------------------------------------------------------------------------------------------------


def test_surface_tension_alone_makes_a_liquid():
    liquid = Liquid(surface_tension=0.0728)
    assert liquid == Liquid(0.0728)
    assert dataclasses.astuple(liquid)[1:] == (None,) * 5


def test_a_liquid_is_frozen_and_hashable():
    assert len({Liquid(0.0728), Liquid(0.0728), Liquid(0.03)}) == 2
    with pytest.raises(dataclasses.FrozenInstanceError):
        WATER.surface_tension = 1.0


def test_quantities_with_units_become_si_floats():
    liquid = Liquid(72.8 * UNITS.mN / UNITS.m, 1.0 * UNITS.g / UNITS.cm**3, temperature=UNITS.Quantity(20, "degC"))
    assert type(liquid.surface_tension) is float
    assert dataclasses.astuple(liquid) == pytest.approx((0.0728, 1000.0, None, 293.15, None, None))


@pytest.mark.parametrize(
    ("numbers", "message"),
    [
        ({"surface_tension": 0.0}, "surface_tension: 0.0 N/m is not > 0"),
        ({"surface_tension": -0.07}, "surface_tension: -0.07 N/m is not > 0"),
        ({"surface_tension": math.nan}, "surface_tension: nan N/m is not a number"),
        ({"surface_tension": math.inf}, "surface_tension: inf N/m is not finite"),
        ({"surface_tension": None}, "surface_tension: None is not a real number"),
        ({"surface_tension": "72.8 mN/m"}, "surface_tension: '72.8 mN/m' is not a real number"),
        (
            {"surface_tension": [0.07, 0.06]},
            "surface_tension: an array of shape (2,) is given where one number is needed",
        ),
        ({"surface_tension": 1 * UNITS.Pa}, "surface_tension: a quantity in pascal is not one in N/m"),
        ({"surface_tension": 0.07, "density": -1.0}, "density: -1.0 kg/m**3 is not > 0"),
        ({"surface_tension": 0.07, "molar_mass": True}, "molar_mass: True is not a real number"),
        ({"surface_tension": 0.07, "temperature": 0}, "temperature: 0.0 K is not > 0"),
        ({"surface_tension": 0.07, "molar_volume": -1.8e-5}, "molar_volume: -1.8e-05 m**3/mol is not > 0"),
        (
            {"surface_tension": 0.07, "molar_volume": 1.8e-5, "density": 998.0},
            "molar_volume: given together with density; it stands for density and molar_mass",
        ),
    ],
)
def test_bad_numbers_are_refused(numbers, message):
    with refused(message):
        Liquid(**numbers)


# -- water -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("celsius", "millinewton_per_metre"),
    [
        (0.01, 75.6463),
        (10.0, 74.2210),
        (20.0, 72.7361),
        (25.0, 71.9722),
        (30.0, 71.1942),
        (40.0, 69.5963),
        (60.0, 66.2383),
        (100.0, 58.9119),
    ],
)
def test_water_surface_tension_is_that_of_iapws(celsius, millinewton_per_metre):
    assert 1e3 * Liquid.water(273.15 + celsius).surface_tension == pytest.approx(millinewton_per_metre, abs=6e-5)


def test_water_surface_tension_falls_to_zero_at_the_critical_point():
    tension = [Liquid.water(t).surface_tension for t in np.linspace(273.15, 647.0, 40)]
    assert np.all(np.diff(tension) < 0)
    assert 0 < Liquid.water(647.0959).surface_tension < 1e-8


def test_water_density_is_that_of_iapws():
    # the first two by the table of SR1-86(1992) for the saturated liquid, the last by IAPWS-95
    assert Liquid.water(273.16).density == pytest.approx(999.789, abs=6e-4)
    assert Liquid.water(373.1243).density == pytest.approx(958.365, abs=6e-4)
    assert Liquid.water(647.0959).density == pytest.approx(322.0, rel=0.02)
    assert WATER.density == pytest.approx(998.1618, rel=5e-6)
    assert WATER.density == pytest.approx(998.2072, rel=5e-5)  # under one atmosphere
    assert Liquid.water(277.13).density > max(Liquid.water(275.0).density, Liquid.water(279.5).density)


def test_water_gas_constant_is_that_of_the_paper():
    assert 8.314462618 / WATER.molar_mass == pytest.approx(461.5, abs=0.05)


@pytest.mark.parametrize(
    ("temperature", "message"),
    [
        (20.0, "temperature: 20.0 K is not in [273.15, 647.096); 20 degrees Celsius are 293.15 K"),
        (253.15, "temperature: 253.15 K is not in [273.15, 647.096)"),
        (647.096, "temperature: 647.096 K is not in [273.15, 647.096)"),
        (math.nan, "temperature: nan K is not a number"),
        ([280.0, 290.0], "temperature: an array of shape (2,) is given where one number is needed"),
        (1.0 * UNITS.m, "temperature: a quantity in meter is not one in K"),
    ],
)
def test_water_outside_its_range_is_refused(temperature, message):
    with refused(message):
        Liquid.water(temperature)


# -- other liquids ---------------------------------------------------------------------------------------------------

# At 20 degC: surface tension (mN/m) and density (kg/m3), each with its relative tolerance.
AT_20_CELSIUS = [
    # CoolProp 8.0.0, an independent program with the same correlations
    # (its densities are equations of state; those that are kept are correlations of handbooks)
    ("n-dodecane", 25.390, 2e-4, 749.4, 2.5e-3),
    ("decane", 23.860, 2e-4, 730.3, 2.5e-3),
    ("octane", 21.662, 2e-4, 702.5, 2.5e-3),
    ("hexane", 18.405, 2e-4, 659.3, 2.5e-3),
    ("cyclohexane", 25.024, 2e-4, 778.6, 2.5e-3),
    ("ethanol", 22.367, 2e-4, 789.3, 2.5e-3),
    ("toluene", 28.521, 2e-4, 866.8, 2.5e-3),
    ("benzene", 28.871, 2e-4, 878.8, 2.5e-3),
    pytest.param("octamethylcyclotetrasiloxane", 18.400, 2e-4, 956.4, 2e-4, marks=LIBRARY),
    # Jasper, J. Phys. Chem. Ref. Data 1 (1972) 841; densities from handbooks from here on
    ("ethylene glycol", 48.43, 2e-3, 1113.5, 2e-3),
    ("isopropanol", 21.322, 4e-3, 785.5, 2e-3),
    # Adamson and Gast, Physical Chemistry of Surfaces (1997); thermo has lower values for mercury
    pytest.param("DMSO", 43.54, 1e-3, 1101.0, 2e-3, marks=LIBRARY),
    pytest.param("mercury", 486.5, 2.5e-2, 13546.0, 2e-3, marks=LIBRARY),
    # Handbooks, between 63.4 and 64
    ("glycerol", 63.7, 1e-2, 1261.3, 2e-3),
]


@pytest.mark.parametrize(("name", "tension", "tension_tolerance", "density", "density_tolerance"), AT_20_CELSIUS)
def test_named_liquids_agree_with_references(name, tension, tension_tolerance, density, density_tolerance):
    liquid = Liquid.named(name, 293.15)
    assert 1e3 * liquid.surface_tension == pytest.approx(tension, rel=tension_tolerance)
    assert liquid.density == pytest.approx(density, rel=density_tolerance)


@pytest.mark.parametrize(
    ("name", "kilogram_per_mole"), [("n-dodecane", 0.17033), ("decane", 0.14228), ("ethanol", 0.04607)]
)
def test_molar_mass_is_in_kilograms(name, kilogram_per_mole):
    assert Liquid.named(name).molar_mass == pytest.approx(kilogram_per_mole, abs=6e-6)


def test_glycerol_has_no_bend_at_the_end_of_its_data():
    """The refit that thermo prefers falls by 0.45 mN/m per kelvin at 20 degC, five times the slope of any handbook."""
    tension = [1e3 * Liquid.named("glycerol", t).surface_tension for t in (293.15, 294.15)]
    assert tension[1] - tension[0] == pytest.approx(-0.09, abs=0.03)


def test_water_by_name_is_water():
    for name in ("water", "H2O", "7732-18-5"):
        assert Liquid.named(name, 300.0) == Liquid.water(300.0)


def test_the_name_shows_what_was_understood():
    assert Liquid.named("glycerin").name == "glycerol"
    assert Liquid.named("64-17-5").name == "ethanol"


def test_density_is_absent_beyond_its_data():
    assert Liquid.named("octane", 600.0, surface_tension=0.01).density is None


@LIBRARY
def test_density_is_absent_where_there_are_no_data():
    assert Liquid.named("squalane").density is None


@pytest.mark.parametrize(
    ("name", "message"),
    [
        *(
            pytest.param(name, f"name: {told}", marks=LIBRARY)
            for name, told in {
                "ethanl": "'ethanl' is not a known liquid; did you mean ethanol or methanol or ethane?",
                "glyzerol": "'glyzerol' is not a known liquid; did you mean glycerol?",
                "xyzzy": "'xyzzy' is not a known liquid; make Liquid(surface_tension=...)",
                "sucrose": "no surface tension is known for sucrose; pass surface_tension=...",
            }.items()
        ),
        ("", "name: '' is not the name of a liquid"),
        (7, "name: 7 is not the name of a liquid"),
    ],
)
def test_unknown_liquids_are_refused(name, message):
    with refused(message):
        Liquid.named(name)


POLYMERS = (
    *("PDMS", "PEG", "PEG 400", "PEG-200", "PEO", "PVP", "PVA", "PIB", "PPG", "PMMA", "silicone oil", "silicon oil"),
    *("silicone", "dimethicone", "carbowax", "macrogol", "polymer", "polystyrene", "polyethylene", "polyisobutylene"),
    *("polyethylene glycol", "poly(ethylene glycol)", "polydimethyl siloxane", "Polydimethylsiloxane"),
)
NOT_ONE = ("oil", "mineral oil", "glycol", "salt water", "sea water", "seawater", "brine", "alcohol", "ether", "spirit")


@pytest.mark.parametrize("name", POLYMERS)
def test_a_polymer_is_not_what_it_is_made_of(name):
    with refused(f"name: {name!r} is a polymer, of which there are no data; make Liquid(surface_tension=...)"):
        Liquid.named(name)


@pytest.mark.parametrize("name", NOT_ONE)
def test_a_mixture_or_a_kind_of_substance_is_not_one_of_them(name):
    with refused(f"name: {name!r} is not one substance; write which, or make Liquid(surface_tension=...)"):
        Liquid.named(name)


@LIBRARY
@pytest.mark.parametrize(
    ("name", "found", "number"),
    [
        ("63148-62-9", "octamethyltrisiloxane", "107-51-7"),  # the number of PDMS
        ("viscasil 5m", "octamethyltrisiloxane", "107-51-7"),  # a silicone oil
        ("lutrol", "ethylene glycol", "107-21-1"),  # polyethylene glycols
        ("t-stuff", "hydrogen peroxide", "7722-84-1"),  # its solution, a fuel
        ("C2H6O", "dimethyl ether", "115-10-6"),  # or ethanol
        ("C6H14", "hexane", "110-54-3"),  # or one of its isomers
        ("80", "mercury", "7439-97-6"),  # the number of the element
        ("R125", "2-chloro-4-nitrobenzonitrile", "28163-00-0"),  # a refrigerant in the tables
        ("butene", "1-butene", "106-98-9"),  # cis-2-butene in the tables
    ],
)
def test_a_name_of_several_substances_is_refused_with_what_was_found(name, found, number):
    with refused(
        f"name: {name!r} may be something else than {found}, CAS {number}, which was found; "
        "write that name or number, or make Liquid(surface_tension=...)"
    ):
        Liquid.named(name)


@LIBRARY
@pytest.mark.parametrize("name", ["milk", "wine", "honey", "air", "sugar", "blood", "diesel", "ink", "PVOH 20"])
def test_what_the_data_do_not_know_is_refused(name):
    with pytest.raises(ValueError, match=f"^name: '{name}' is (not a known liquid|a polymer)"):
        Liquid.named(name)


@LIBRARY
@pytest.mark.parametrize(
    ("name", "number"),
    [
        *((name, "7732-18-5") for name in ("water", " Water ", "H2O", "7732-18-5")),
        *((name, "56-81-5") for name in ("glycerol", "glycerin", "glycerine", "propane-1,2,3-triol")),
        *(
            (name, "107-21-1")
            for name in ("ethylene glycol", "1,2-ethanediol", "ethane-1,2-diol", "monoethylene glycol", "107-21-1")
        ),
        *((name, "112-40-3") for name in ("dodecane", "n-dodecane", "N-DODECANE")),
        *((name, "64-17-5") for name in ("ethanol", "ethyl alcohol")),
        *((name, "67-63-0") for name in ("isopropanol", "2-propanol", "propan-2-ol")),
        *((name, "71-36-3") for name in ("1-butanol", "butanol", "butan-1-ol")),
        *((name, "7439-97-6") for name in ("mercury", "Hg")),
        *((name, "7789-20-0") for name in ("heavy water", "D2O")),
        *(("toluene", "108-88-3"), ("toluol", "108-88-3"), ("benzene", "71-43-2"), ("benzol", "71-43-2")),
        *(("hexane", "110-54-3"), ("n-hexane", "110-54-3"), ("decane", "124-18-5"), ("1-octanol", "111-87-5")),
        *(("hexadecane", "544-76-3"), ("cyclohexane", "110-82-7"), ("acetone", "67-64-1"), ("DMSO", "67-68-5")),
        *(("diethyl ether", "60-29-7"), ("styrene", "100-42-5"), ("propylene glycol", "57-55-6")),
        *(("FC-72", "355-42-0"), ("octamethyltrisiloxane", "107-51-7"), ("bromine", "7726-95-6")),
    ],
)
def test_a_name_in_use_means_its_substance(name, number):
    assert _identify(name).CASs == number


@LIBRARY
def test_most_liquids_with_data_are_found_by_the_name_in_the_tables():
    names = _tabulated()
    found = 0
    for name, numbers in names.items():
        try:
            number = _identify(name).CASs
        except ValueError:
            continue
        found += 1
        assert number in numbers or name == _identify(name).common_name.lower(), name
    assert found > 0.9 * len(names)


def test_a_measured_surface_tension_takes_the_place_of_the_known_one():
    soapy = Liquid.water(293.15, surface_tension=0.0523)
    assert soapy == dataclasses.replace(WATER, surface_tension=0.0523)
    assert Liquid.named("water", surface_tension=0.0523) == soapy
    clean = Liquid.named("glycerol", surface_tension=0.0634)
    assert clean == dataclasses.replace(Liquid.named("glycerol"), surface_tension=0.0634)
    with refused("surface_tension: -1.0 N/m is not > 0"):
        Liquid.named("ethanol", surface_tension=-1.0)


@pytest.mark.parametrize(
    ("name", "temperature", "message"),
    [
        ("water", 1000.0, "temperature: 1000.0 K is not in [273.15, 647.096)"),
        ("acetone", 400.0, "temperature of acetone: 400.0 K is not in [182.06, 353.15)"),
        pytest.param("nitrogen", 293.15, "temperature of nitrogen: 293.15 K is not in [64.8, 120.24)", marks=LIBRARY),
        ("ethanol", -5.0, "temperature: -5.0 K is not > 0"),
        ("ethanol", [290.0], "temperature: an array of shape (1,) is given where one number is needed"),
    ],
)
def test_temperatures_outside_the_data_are_refused(name, temperature, message):
    with refused(message):
        Liquid.named(name, temperature)


@pytest.mark.parametrize("name", [row[0] for row in AT_20_CELSIUS if isinstance(row, tuple) and len(row) == 5])
def test_no_value_is_extrapolated(name):
    for temperature in (1.0, 5000.0):
        with pytest.raises(
            ValueError, match=r"^temperature of .+ K is not in \[.+\)(; 20 degrees Celsius are 293.15 K)?$"
        ):
            Liquid.named(name, temperature)


@LIBRARY
def test_a_substance_without_data_is_taken_with_a_measured_tension():
    assert Liquid.named("sucrose", surface_tension=0.08).surface_tension == 0.08
    clean = Liquid.named("mercury", surface_tension=0.4865)
    assert clean == dataclasses.replace(Liquid.named("mercury"), surface_tension=0.4865)


# -- the liquids that are kept ---------------------------------------------------------------------------------------


@LIBRARY
@pytest.mark.parametrize("kept", kept_liquids(), ids=lambda liquid: liquid.name)
def test_what_is_kept_is_what_the_library_has(kept):
    from thermo.interface import SurfaceTension
    from thermo.volume import VolumeLiquid

    tension = SurfaceTension(CASRN=kept.cas)
    method = {"mulero": "REFPROP", "vdi": "VDI_PPDS"}[kept.tension.law]
    assert (kept.tension.low, kept.tension.high) == pytest.approx(tension.T_limits[method])
    for kelvin in np.linspace(kept.tension.low, kept.tension.high, 7)[:-1]:
        assert tension_at(kept, kelvin) == pytest.approx(tension.calculate(kelvin, method), rel=1e-9)
    density = VolumeLiquid(CASRN=kept.cas)
    method = {"perry": "DIPPR_PERRY_8E", "vdi": "VDI_PPDS"}[kept.density.law]
    for kelvin in np.linspace(kept.density.low, kept.density.high, 7)[1:-1]:
        assert density_at(kept, kelvin) == pytest.approx(kept.molar_mass / density.calculate(kelvin, method), rel=1e-4)
    # which takes the molar masses of the Heat Atlas, of four digits; and near to what the library itself prefers
    low, high = density.T_limits[density.method]
    for kelvin in np.linspace(max(low, 273.15), min(high, 373.15), 9):
        best = kept.molar_mass / density.calculate(kelvin, density.method)
        assert density_at(kept, kelvin) == pytest.approx(best, rel=2.5e-3)


@LIBRARY
@pytest.mark.parametrize("kept", kept_liquids(), ids=lambda liquid: liquid.name)
def test_each_name_that_is_kept_is_in_use(kept):
    for name in (kept.name, kept.cas, *kept.other_names):
        assert Liquid.named(name).name == kept.name
        if name not in ("MeOH", "EtOH", "IPA", "DCM"):  # of which the library is not sure
            assert _identify(name).CASs == kept.cas


@pytest.fixture
def without_library(monkeypatch):
    """As if thermo and chemicals were not installed."""
    monkeypatch.setattr(pendular.ask.liquid, "find_spec", lambda name: None)


@pytest.mark.usefixtures("without_library")
@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("mercury", ""),
        ("ethanl", "did you mean ethanol or methanol? Otherwise "),
        ("glyzerol", "did you mean glycerol? Otherwise "),
    ],
)
def test_a_liquid_that_is_not_kept_names_what_brings_it(name, hint):
    with refused(
        f"name: {name!r} is not among the 31 liquids that come with pendular; {hint}pip install 'pendular[liquids]' "
        "brings some hundred more, or make Liquid(surface_tension=...)"
    ):
        Liquid.named(name)


@pytest.mark.usefixtures("without_library")
@pytest.mark.parametrize("name", ["water", " Water ", "ethanol", "Glycerin", "n-Hexane", "67-64-1", "ethylene glycol"])
def test_the_commonest_need_no_library(name):
    liquid = Liquid.named(name)
    assert 0.0 < suction_from_humidity(0.9, liquid) < 2e7


def test_import_costs_no_library():
    heavy = ("thermo", "chemicals", "pint", "pandas", "scipy")
    program = f"import sys, pendular.ask.liquid; print([m for m in {heavy} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


# -- the Kelvin equation ---------------------------------------------------------------------------------------------

# Water at 20 degC: humidity, 1/H (nm), suction (MPa), H* for R = 0.1 mm and for 1 um, dH*/H* by 0.1 % RH; each printed
# value with half a unit of its last digit.
KELVIN_TABLE = [
    (0.5, (0.777, 5e-4), (93.6, 0.05), (1.287e5, 50.0), (1287.0, 0.5), (0.0029, 5e-5)),
    (0.8, (2.414, 5e-4), (30.1, 0.05), (4.143e4, 5.0), (414.0, 0.5), (0.0056, 5e-5)),
    (0.9, (5.112, 5e-4), (14.2, 0.05), (1.956e4, 5.0), (196.0, 0.5), (0.0105, 5e-5)),
    (0.95, (10.50, 5e-3), (6.93, 5e-3), (9524.0, 0.5), (95.2, 0.05), (0.0205, 5e-5)),
    (0.99, (53.59, 5e-3), (1.357, 5e-4), (1866.0, 0.5), (18.7, 0.05), (0.101, 5e-4)),
    (0.999, (538.3, 0.05), (0.135, 5e-4), (185.8, 0.05), (1.86, 5e-3), (1.00, 5e-3)),
    (0.9999, (5385.0, 0.5), (0.0135, 5e-5), (18.6, 0.05), (0.186, 5e-4), (10.0, 5e-2)),
]


@pytest.mark.parametrize(("humidity", "radius", "suction", "star_coarse", "star_fine", "conditioning"), KELVIN_TABLE)
def test_kelvin_equation_reproduces_the_table(humidity, radius, suction, star_coarse, star_fine, conditioning):
    computed = suction_from_humidity(humidity, WATER)
    curvature = computed / WATER.surface_tension
    step = 1e-3 * (1.0 - humidity)
    slope = (suction_from_humidity(humidity + step, WATER) - suction_from_humidity(humidity - step, WATER)) / (2 * step)
    for value, (printed, half_digit) in (
        (1e9 / curvature, radius),
        (1e-6 * computed, suction),
        (1e-4 * curvature, star_coarse),
        (1e-6 * curvature, star_fine),
        (1e-3 * abs(slope) / computed, conditioning),
    ):
        # 1e-4 more: the table takes the density under one atmosphere and R_v = 461.526 J/(kg K).
        assert value == pytest.approx(printed, abs=half_digit + 1e-4 * printed)


def test_suction_of_the_paper():
    """Equation (15) with R_v = 461.5 J/(kg K), as the paper prints it."""
    liquid = Liquid(0.0728, density=998.2, molar_mass=0.018016, temperature=293.15)
    assert suction_from_humidity(0.9, liquid) == pytest.approx(-998.2 * 461.5 * 293.15 * math.log(0.9), rel=1e-4)


@given(st.floats(min_value=1e-300, max_value=1.0, exclude_max=True))
def test_humidity_survives_the_round_trip(humidity):
    back = humidity_from_suction(suction_from_humidity(humidity, WATER), WATER)
    # exp turns the rounding of its argument, ln h, into a relative error
    assert abs(back - humidity) <= 4 * EPSILON * humidity * (1.0 - math.log(humidity))


@given(st.floats(min_value=1.0, max_value=1e10))
def test_suction_survives_the_round_trip(suction):
    """To the digits that a double keeps of 1 - h."""
    back = suction_from_humidity(humidity_from_suction(suction, WATER), WATER)
    kelvin_pressure = suction_from_humidity(math.exp(-1), WATER)
    assert back == pytest.approx(suction, rel=8 * EPSILON, abs=2 * EPSILON * kelvin_pressure)


def test_no_suction_means_saturation():
    assert humidity_from_suction(0.0, WATER) == 1.0
    assert suction_from_humidity(1.0 - EPSILON, WATER) == pytest.approx(135.0e6 * EPSILON, rel=1e-3)


def test_shapes_and_units_pass_through():
    grid = np.array([[0.5, 0.9], [0.99, 0.2]])
    suction = suction_from_humidity(grid, WATER)
    assert suction.shape == (2, 2)
    np.testing.assert_allclose(humidity_from_suction(suction, WATER), grid, rtol=1e-14)
    assert suction_from_humidity(90.0 * UNITS.percent, WATER) == suction_from_humidity(0.9, WATER)
    assert humidity_from_suction(1.0 * UNITS.MPa, WATER) == humidity_from_suction(1e6, WATER)
    assert isinstance(suction_from_humidity(0.9, WATER), float)


def test_a_molar_volume_stands_for_density_and_molar_mass():
    other = Liquid(0.05, temperature=WATER.temperature, molar_volume=WATER.molar_mass / WATER.density)
    assert suction_from_humidity(0.5, other) == suction_from_humidity(0.5, WATER)
    assert humidity_from_suction(1e6, other) == humidity_from_suction(1e6, WATER)
    cubic_centimetres = Liquid(0.05, molar_volume=18 * UNITS.cm**3 / UNITS.mol)
    assert cubic_centimetres.molar_volume == pytest.approx(18e-6, rel=1e-15)


def test_temperature_may_be_given_once():
    oil = Liquid(0.02, density=900.0, molar_mass=0.3)
    warm = dataclasses.replace(oil, temperature=310.0)
    assert suction_from_humidity(0.5, oil, 310.0) == suction_from_humidity(0.5, warm)
    assert suction_from_humidity(0.5, warm, temperature=310.0) == suction_from_humidity(0.5, warm)
    with refused("temperature: 350.0 K is not 310.0 K, for which the liquid was made"):
        suction_from_humidity(0.5, warm, 350.0)
    with refused("temperature: -1.0 K is not > 0"):
        humidity_from_suction(1e6, oil, -1.0)


@pytest.mark.parametrize(
    ("humidity", "message"),
    [
        (1.2, "humidity: 1.2 is not in (0, 1); 50 % are 0.5, and saturation is a suction of 0"),
        ([0.5, 1.0], "humidity[1]: 1.0 is not in (0, 1); 50 % are 0.5, and saturation is a suction of 0"),
        (0.0, "humidity: 0.0 is not in (0, 1)"),
        (math.nan, "humidity: nan is not a number"),
        ("90 %", "humidity: '90 %' is not a real number"),
        (1 * UNITS.Pa, "humidity: a quantity in pascal is not a pure number"),
    ],
)
def test_bad_humidity_is_refused(humidity, message):
    with refused(message):
        suction_from_humidity(humidity, WATER)


@pytest.mark.parametrize(
    ("suction", "message"),
    [
        (-1.0, "suction: -1.0 Pa is not >= 0"),
        ([1e3, math.inf], "suction[1]: inf Pa is not finite"),
        (5 * UNITS.um, "suction: a quantity in micrometer is not one in Pa"),
        (None, "suction: None is not a real number"),
    ],
)
def test_bad_suction_is_refused(suction, message):
    with refused(message):
        humidity_from_suction(suction, WATER)


@pytest.mark.parametrize(
    ("liquid", "message"),
    [
        (
            Liquid(0.0728),
            "liquid: it lacks density and molar_mass (or molar_volume), temperature, needed for humidity; "
            "give it to Liquid(...)",
        ),
        (
            dataclasses.replace(WATER, molar_mass=None),
            "liquid: water lacks molar_mass (or molar_volume), needed for humidity; give it to Liquid(...)",
        ),
        (
            Liquid(0.028, molar_mass=0.4228, temperature=293.15, name="squalane"),
            "liquid: squalane lacks density (or molar_volume), needed for humidity; give it to Liquid(...)",
        ),
    ],
)
def test_humidity_needs_a_whole_liquid(liquid, message):
    for convert in (suction_from_humidity, humidity_from_suction):
        with refused(message):
            convert(0.5, liquid)


# -- warnings --------------------------------------------------------------------------------------------------------

CURVED = "curvature radius down to 2 nm: the Kelvin equation is doubtful below 4 nm"
LOOSE = "an uncertainty of 0.1 % RH changes the force by up to 25 %: control the suction or the volume instead"


@pytest.mark.parametrize(
    ("radius", "change", "message"),
    [
        (2e-9, 0.01, CURVED),
        ([1e-7, 2e-9, 3e-9, math.nan], [0.0, 0.1, -0.05, math.nan], CURVED),
        (5e-9, -0.25, LOOSE),
        ([2e-9, 1e-6], [0.01, 0.25], f"{CURVED}; {LOOSE}"),
    ],
)
def test_one_warning_a_call_names_the_worst(radius, change, message):
    with pytest.warns(KelvinWarning) as caught:
        warn_kelvin(radius, change)
    assert [str(w.message) for w in caught] == [message]
    assert caught[0].filename == __file__


@pytest.mark.parametrize(
    ("radius", "change"), [(4e-9, 0.1), ([math.inf, math.nan], [math.nan, 0.0]), (np.full(3, math.nan), math.nan)]
)
def test_sound_bridges_and_absent_ones_do_not_warn(radius, change):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warn_kelvin(radius, change)
