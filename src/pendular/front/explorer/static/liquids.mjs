// Liquids that are kept, by the correlations of the records; and the Kelvin equation between humidity and suction.

import { RECORDS } from "./records.mjs";

const plain = (name) => name.toLowerCase().replaceAll(/[\s-]/g, "");

/** Names of all liquids that are known here. */
export const liquidNames = () => ["water", ...RECORDS.liquids.map(({ name }) => name)];

/** A liquid at a temperature in kelvin. */
export function liquidNamed(name, kelvin) {
  if (plain(name) === "water") return water(kelvin);
  const kept = RECORDS.liquids.find((one) =>
    [one.name, one.cas, ...one.otherNames].some((own) => plain(own) === plain(name)),
  );
  if (!kept)
    throw new RangeError(`liquid: '${name}' is not a known liquid; take one of the list, or give its surface tension`);
  const { tension, density } = kept;
  inRange(`temperature of ${kept.name}`, kelvin, tension.low, tension.high);
  const known = kelvin >= density.low && kelvin <= density.high;
  return {
    name: kept.name,
    surfaceTension: LAWS_OF_TEMPERATURE[tension.law](tension.numbers, kelvin, kept.molarMass),
    density: known ? LAWS_OF_TEMPERATURE[`${density.law} density`](density.numbers, kelvin, kept.molarMass) : undefined,
    molarMass: kept.molarMass,
    temperature: kelvin,
  };
}

function inRange(name, kelvin, low, high) {
  if (!(kelvin >= low && kelvin < high)) throw new RangeError(`${name}: ${kelvin} K is not in [${low}, ${high}) K`);
}

// IAPWS R1-76(2014) and SR1-86(1992)
function water(kelvin) {
  const { critical, criticalDensity, freezing, molarMass, tension, density } = RECORDS.water;
  inRange("temperature", kelvin, freezing, critical);
  const tau = 1 - kelvin / critical;
  const [size, power, linear] = tension;
  return {
    name: "water",
    surfaceTension: size * tau ** power * (1 + linear * tau),
    density: criticalDensity * (1 + density.reduce((sum, [b, n]) => sum + b * tau ** n, 0)),
    molarMass,
    temperature: kelvin,
  };
}

const LAWS_OF_TEMPERATURE = {
  mulero([critical, ...numbers], kelvin) {
    const tau = 1 - kelvin / critical;
    let sum = 0;
    for (let i = 0; i < numbers.length; i += 2) sum += numbers[i] * tau ** numbers[i + 1];
    return sum;
  },
  vdi([critical, a, b, c, d, e], kelvin) {
    const reduced = kelvin / critical;
    return a * (1 - reduced) ** (b + reduced * (c + reduced * (d + reduced * e)));
  },
  "vdi density"([critical, least, a, b, c, d], kelvin) {
    const tau = 1 - kelvin / critical;
    return least + a * tau ** 0.35 + b * tau ** (2 / 3) + c * tau + d * tau ** (4 / 3);
  },
  "perry density": ([c1, c2, c3, c4], kelvin, molarMass) => (molarMass * c1) / c2 ** (1 + (1 - kelvin / c3) ** c4),
};

function kelvinPressure(liquid) {
  if (!liquid.density)
    throw new RangeError(
      `liquid: ${liquid.name ?? "it"} lacks density and molar_mass, needed for humidity; name the liquid`,
    );
  return (RECORDS.gasConstant * liquid.temperature * liquid.density) / liquid.molarMass;
}

export const suctionFromHumidity = (humidity, liquid) => -kelvinPressure(liquid) * Math.log(humidity);
export const humidityFromSuction = (suction, liquid) => Math.exp(-suction / kelvinPressure(liquid));
