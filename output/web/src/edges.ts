/** Edges half-way between places; the outer ones as far out. */
export function edgesAround(places: ArrayLike<number>): number[] {
  const p = Array.from(places), n = p.length;
  if (n === 1) return [p[0]! - 0.5, p[0]! + 0.5];
  const middles = p.slice(1).map((x, i) => (x + p[i]!) / 2);
  return [2 * p[0]! - middles[0]!, ...middles, 2 * p[n - 1]! - middles[n - 2]!];
}
