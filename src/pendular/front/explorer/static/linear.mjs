// Small symmetric matrices, and the normal distribution: what a fit needs of algebra and statistics.

const MOST_SWEEPS = 60;
const TINY = 1e-300;

/** Eigenvalues in rising order and their vectors, by Jacobi's rotations; `vectors[k]` belongs to `values[k]`. */
export function eigenOf(matrix) {
  const size = matrix.length;
  const a = matrix.map((row) => [...row]);
  const v = identity(size);
  for (let sweep = 0; sweep < MOST_SWEEPS; sweep++) {
    let off = 0;
    for (let i = 0; i < size; i++) for (let j = 0; j < i; j++) off += a[i][j] ** 2;
    if (off < TINY) break;
    for (let p = 0; p < size; p++) for (let q = p + 1; q < size; q++) rotate(a, v, p, q);
  }
  const order = a.map((_, i) => i).sort((i, j) => a[i][i] - a[j][j]);
  return { values: order.map((i) => a[i][i]), vectors: order.map((i) => v.map((row) => row[i])) };
}

export const identity = (size) =>
  Array.from({ length: size }, (_, i) => Array.from({ length: size }, (__, j) => +(i === j)));

function rotate(a, v, p, q) {
  if (a[p][q] === 0) return;
  const cotangent = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const t = (cotangent < 0 ? -1 : 1) / (Math.abs(cotangent) + Math.hypot(cotangent, 1));
  const c = 1 / Math.hypot(t, 1);
  const s = t * c;
  for (let k = 0; k < a.length; k++) [a[k][p], a[k][q]] = [c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]];
  for (let k = 0; k < a.length; k++) [a[p][k], a[q][k]] = [c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]];
  for (const row of v) [row[p], row[q]] = [c * row[p] - s * row[q], s * row[p] + c * row[q]];
}

/** Solution for a positive definite matrix, by Cholesky's factors; undefined where it is none. */
export function solvePositive(matrix, right) {
  const size = right.length;
  const lower = matrix.map((row) => [...row]);
  for (let j = 0; j < size; j++) {
    for (let k = 0; k < j; k++) lower[j][j] -= lower[j][k] ** 2;
    if (!(lower[j][j] > 0)) return undefined;
    lower[j][j] = Math.sqrt(lower[j][j]);
    for (let i = j + 1; i < size; i++) {
      for (let k = 0; k < j; k++) lower[i][j] -= lower[i][k] * lower[j][k];
      lower[i][j] /= lower[j][j];
    }
  }
  const x = [...right];
  for (let i = 0; i < size; i++) {
    for (let k = 0; k < i; k++) x[i] -= lower[i][k] * x[k];
    x[i] /= lower[i][i];
  }
  for (let i = size - 1; i >= 0; i--) {
    for (let k = i + 1; k < size; k++) x[i] -= lower[k][i] * x[k];
    x[i] /= lower[i][i];
  }
  return x;
}

export const dotOf = (one, other) => one.reduce((sum, value, i) => sum + value * other[i], 0);

/** Products of the columns of a matrix with each other. */
export const squareOf = (columns) => columns.map((one) => columns.map((other) => dotOf(one, other)));

export function medianOf(values) {
  const sorted = [...values].sort((one, other) => one - other);
  const middle = sorted.length >> 1;
  return sorted.length % 2 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
}

/** Probability that a standard normal number is below z; its digits hold in the far tail. */
export function normalBelow(z) {
  const x = Math.abs(z) / Math.SQRT2;
  const tail = 0.5 * (x < 2 ? 1 - erfBySeries(x) : erfcByFraction(x));
  return z < 0 ? tail : 1 - tail;
}

function erfBySeries(x) {
  let [term, sum] = [x, x];
  for (let n = 1; Math.abs(term) > 1e-17 * Math.abs(sum); n++) {
    term *= (-x * x) / n;
    sum += term / (2 * n + 1);
    if (x === 0) break;
  }
  return (2 / Math.sqrt(Math.PI)) * sum;
}

/** erfc by its continued fraction, which has all digits from x = 2 on in so many steps. */
function erfcByFraction(x) {
  let fraction = x;
  for (let n = 60; n > 0; n--) fraction = x + (0.5 * n) / fraction;
  return Math.exp(-x * x) / Math.sqrt(Math.PI) / fraction;
}

/** The standard normal number below which another is with a probability. */
export function normalQuantile(probability) {
  let [low, high] = [-40, 40];
  for (let i = 0; i < 80; i++) {
    const middle = 0.5 * (low + high);
    if (normalBelow(middle) < probability) low = middle;
    else high = middle;
  }
  return 0.5 * (low + high);
}
