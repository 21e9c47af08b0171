// Two grains that are pulled apart: node bridge.mjs bridge.wasm w.bridges
import { readFileSync } from "node:fs";

const [modulePath, tablePath] = process.argv.slice(2);
const { instance } = await WebAssembly.instantiate(readFileSync(modulePath));
const { memory, room, open_table, force, rupture_distance } = instance.exports;

const bytes = readFileSync(tablePath);
const place = room(bytes.length);
new Uint8Array(memory.buffer).set(bytes, place);
const reason = textAt(open_table(place, bytes.length));
if (reason) throw new Error(`${tablePath}: ${reason}`);

const [small, large, suction, surfaceTension] = [50e-6, 100e-6, 14e3, 0.0728]; // [m], [m], [Pa], [N/m]
const end = rupture_distance(suction, small, large, surfaceTension);
console.log(`breaks at ${end} m`);
console.log("separation [m], force [N]");
for (let i = 0; i <= 5; i++) {
  const separation = 0.2 * i * end;
  console.log(`${separation} ${force(separation, suction, small, large, surfaceTension)}`);
}

function textAt(start) {
  const all = new Uint8Array(memory.buffer);
  return new TextDecoder().decode(all.subarray(start, all.indexOf(0, start)));
}
