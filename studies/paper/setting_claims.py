"""Claims about the setting: which bridges, soils and humidities a reduced suction stands for."""

from collections.abc import Iterator

import numpy as np

from pendular import Liquid, suction_from_humidity

from . import sample
from .claim import Claim, error, signed, worst

_GAMMA, _GAS_CONSTANT = 0.0728, 461.5  # of water, as printed below Eqs. (1) and (15), [N/m] and [J/(kg K)]
_GRAIN = 74e-6  # printed mean size of soil grains, [m]
_PENDULAR_LIMIT = np.deg2rad(30.0)  # half-filling angle at which the bridges of three touching spheres meet


def setting_claims(density: float) -> Iterator[Claim]:
    """Measure the statements about volumes, necks, humidity and soils."""
    yield _volume_at_100(density)
    yield _neck_inside()
    yield _humidity()
    yield _humidity_control()
    yield _soil(density)


def _volume_at_100(density: float) -> Claim:
    suctions = sample.decades(10.0, 1e3, 8.0 * density)
    numbers = {}
    for place, states in (
        ("contact", [sample.state(0.0, degrees, suction=suctions) for degrees in sample.ANGLES]),
        ("rupture", [sample.end_of(degrees, suction=suctions) for degrees in sample.ANGLES]),
    ):
        for degrees, state in zip(sample.ANGLES, states, strict=True):
            size = np.cbrt(np.asarray(state.volume))
            numbers[f"{place}, {degrees:g} deg"] = float(
                np.exp(np.interp(-np.log(0.1), -np.log(size), np.log(suctions)))
            )
    largest = float(np.cbrt(np.max(sample.state(0.0, sample.ANGLES, suction=100.0).volume)))
    told = ", ".join(f"{value:.3g} ({key.replace(' deg', '°')})" for key, value in numbers.items())
    return Claim(
        "volume_and_suction",
        "Sections 5.1, 5.2 and 6",
        "H* ≥ 10² corresponds to V*^(1/3) ≤ 0.1, and the reverse (read as: to a factor of two in H*).",
        f"V*^(1/3) is at most {largest:.3f} at H* = 10²; it equals 0.1 at H* = {told}",
        largest <= 0.1 and min(numbers.values()) >= 50.0,
        "At one suction the volume still depends on the separation; H* ≥ 10² is enough for a small volume, but "
        "far from needed near rupture.",
        "Each bridge of the library tells its own volume.",
        {**numbers, "V*^(1/3) at H* = 100": largest},
    )


def _neck_inside() -> Claim:
    angles, ratios = np.array(sample.ANGLES)[:, None], np.array(sample.RATIOS)
    states = sample.state(0.0, angles, ratios, suction=1.0)
    inside, filling = np.asarray(states.neck_inside), np.degrees(states.half_filling_angle[..., 0])
    outside = [f"ratio {ratios[j]:g}, {angles[i, 0]:g}°" for i, j in np.argwhere(~inside)]
    beyond = int(np.count_nonzero(filling > 60.0))
    return Claim(
        "neck_inside",
        "Section 2.1, Fig. 1; Section 2.3",
        "The meridian has its neck between the two contact circles (and half-filling angles up to 60° are enough).",
        f"On the article's own grid, at H* = 1 and contact, the neck lies outside for {', '.join(outside) or 'none'}; "
        f"{beyond} of {filling.size} bridges have a half-filling angle above 60° (up to {filling.max():.0f}°)",
        bool(inside.all()) and beyond == 0,
        "Where δ + θ exceeds 90° on the smaller sphere the profile widens monotonically from it to the larger one.",
        "The exact solver knows no neck to be assumed; the field neck_inside tells.",
        {"outside": float((~inside).sum()), "largest half-filling angle": float(filling.max())},
    )


def _humidity() -> Claim:
    """Eq. (16) with the printed constants, worked out here, against the library."""
    humidity, radius, water = np.array([0.5, 0.8, 0.9, 0.99, 0.999]), 1e-4, Liquid.water()
    density, temperature = np.asarray(water.density, float), np.asarray(water.temperature, float)
    printed = -density * _GAS_CONSTANT * temperature / _GAMMA * radius * np.log(humidity)
    ours = np.asarray(suction_from_humidity(humidity, water)) * radius / water.surface_tension
    numbers = {"largest difference": worst(error(printed, ours))}
    return Claim(
        "kelvin",
        "Section 2.5, Eqs. (15), (16)",
        "H* = -(ρ R_v T/γ) R̄ ln h relates humidity and reduced suction.",
        f"R̄ = 0.1 mm, water at 20 °C: H* = {ours[0]:.0f}, {ours[2]:.0f}, {ours[-1]:.0f} at h = 0.5, 0.9, 0.999; with "
        f"the printed constants {signed(numbers['largest difference'])} %",
        abs(numbers["largest difference"]) < 0.5,
        "The printed surface tension is a rounded one; nothing else differs.",
        numbers=numbers,
    )


def _humidity_control() -> Claim:
    water, step = Liquid.water(), 1e-3
    numbers = {}
    for humidity in (0.5, 0.9, 0.99, 0.998):
        low, high = np.asarray(suction_from_humidity([humidity - 0.5 * step, humidity + 0.5 * step], water))
        numbers[f"h = {humidity:g}"] = 100.0 * float(low - high) / float(suction_from_humidity(humidity, water))
    told = ", ".join(f"{value:.2g} % ({key})" for key, value in numbers.items())
    return Claim(
        "humidity_control",
        "Section 1",
        "Near saturation humidity cannot set the reduced suction accurately (read as: 0.1 % of humidity moves it by "
        "10 % or more at h = 0.99).",
        f"A step of 0.1 % in humidity changes H* by {told}",
        numbers["h = 0.99"] >= 10.0,
        "dH*/H* = dh/(h |ln h|), which grows without bound as h goes to 1.",
        "pendular.bridge(humidity=...) warns where this spoils the force.",
        numbers,
    )


def _soil(density: float) -> Claim:
    suctions = sample.decades(0.1, 100.0, 8.0 * density)
    numbers = {}
    for degrees in sample.ANGLES:
        filling = sample.state(0.0, degrees, suction=suctions).half_filling_angle[..., 0]
        numbers[f"{degrees:g} deg"] = float(np.exp(np.interp(-_PENDULAR_LIMIT, -filling, np.log(suctions))))
    pressure = {f"H* = {h:.3g}": h * _GAMMA / (0.5 * _GRAIN) / 1e3 for h in (numbers["0 deg"], 100.0)}
    told = ", ".join(f"{value:.2g} ({key.replace(' deg', '°')})" for key, value in numbers.items())
    return Claim(
        "soil",
        "Section 1",
        "For a granular soil with grains of 74 µm the reduced suction is larger than about 10².",
        f"Touching spheres are pendular from H* = {told} on; for such grains H* = 10² means "
        f"{pressure['H* = 100']:.0f} kPa, and the pendular regime at θ = 0 begins at "
        f"{next(iter(pressure.values())):.0f} kPa",
        min(numbers.values()) >= 100.0,
        "The grain size alone fixes no suction: between drainage of the pores and 10² lies more than a decade of "
        "ordinary soil suctions, where the laws for H* ≥ 10² do not apply.",
        "The exact solution covers all of it.",
        {**numbers, "kPa at H* = 100": pressure["H* = 100"]},
    )
