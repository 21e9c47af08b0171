// Answers of pendular_table.h in WebAssembly: node answers.mjs MODULE TABLE CONTACTS OUT ASKED...
//
// CONTACTS holds five columns of float64, OUT gets a column for each number that is asked.
import { readFileSync, writeFileSync } from "node:fs";

const [modulePath, tablePath, contactsPath, outPath, ...asked] = process.argv.slice(2);
const { instance } = await WebAssembly.instantiate(readFileSync(modulePath), {});
const { memory, malloc, size_of_table, open_bytes, ask } = instance.exports;

function copied(path) {
  const bytes = readFileSync(path);
  const place = malloc(bytes.length + 64);
  const start = place + ((64 - (place % 64)) % 64);
  new Uint8Array(memory.buffer).set(bytes, start);
  return { start, size: bytes.length };
}

const file = copied(tablePath);
const table = malloc(size_of_table());
const code = open_bytes(file.start, file.size, table);
if (code !== 0) throw new Error(`the table does not open: code ${code}`);

const contacts = copied(contactsPath);
const count = contacts.size / 40;
const columns = [0, 1, 2, 3, 4].map((i) => contacts.start + 8 * count * i);
const out = malloc(8 * count);
const answers = asked.map((number) => {
  ask(table, Number(number), count, ...columns, out);
  return Buffer.from(memory.buffer.slice(out, out + 8 * count));
});
writeFileSync(outPath, Buffer.concat(answers));
