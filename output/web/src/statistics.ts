/** Figures of a list of numbers. */

export const sorted = (values: Iterable<number>): number[] => [...values].filter(Number.isFinite).sort((a, b) => a - b);

export const mean = (values: number[]): number => values.reduce((a, b) => a + b, 0) / values.length;

export function deviation(values: number[]): number {
  const middle = mean(values);
  return values.length > 1 ? Math.sqrt(values.reduce((sum, x) => sum + (x - middle) ** 2, 0) / (values.length - 1)) : 0;
}

/** Spearman's: Pearson's of the ranks, of equal values their mean rank. */
export function rankCorrelation(x: number[], y: number[]): number {
  const a = ranks(x), b = ranks(y), middle = (x.length - 1) / 2;
  const sum = (f: (i: number) => number): number => a.reduce((total, _, i) => total + f(i), 0);
  const both = sum((i) => (a[i]! - middle) * (b[i]! - middle));
  const scale = Math.sqrt(sum((i) => (a[i]! - middle) ** 2) * sum((i) => (b[i]! - middle) ** 2));
  return scale > 0 ? both / scale : 0;
}

function ranks(values: number[]): number[] {
  const order = Array.from(values.keys()).sort((i, j) => values[i]! - values[j]!), result = new Array<number>(values.length);
  for (let first = 0; first < order.length;) {
    let next = first;
    while (next < order.length && values[order[next]!] === values[order[first]!]) ++next;
    for (let k = first; k < next; ++k) result[order[k]!] = (first + next - 1) / 2;
    first = next;
  }
  return result;
}
