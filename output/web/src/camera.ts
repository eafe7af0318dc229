/** A view in parallel projection, turned about the machine's upward axis. */

export type Vec = [number, number, number];

export const dot = (a: Vec, b: Vec): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vec, b: Vec): Vec =>
  [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const sum = (...terms: [number, Vec][]): Vec =>
  [0, 1, 2].map((i) => terms.reduce((s, [f, v]) => s + f * v[i]!, 0)) as Vec;

export class Camera {
  azimuth = 36.9;
  elevation = 26.4;
  /** World height of half the view. */
  scale = 1;
  focus: Vec = [0, 0, 0];
  private readonly across: Vec;
  private readonly back: Vec;

  /** `up` along an axis; with x up, z points right, else x: as output/picture.h has it. */
  constructor(private readonly up: Vec) {
    this.across = up[0] === 0 ? [1, 0, 0] : [0, 0, 1];
    this.back = cross(up, this.across);
  }

  get towards(): Vec {
    const a = (this.azimuth * Math.PI) / 180, e = (this.elevation * Math.PI) / 180;
    return sum([Math.cos(e) * Math.sin(a), this.across], [-Math.cos(e) * Math.cos(a), this.back], [Math.sin(e), this.up]);
  }

  /** Of the picture: to the right, and upwards. */
  get axes(): {right: Vec; above: Vec} {
    const a = (this.azimuth * Math.PI) / 180;
    const right = sum([Math.cos(a), this.across], [Math.sin(a), this.back]);
    return {right, above: cross(this.towards, right)};
  }

  turn(right: number, above: number): void {
    this.azimuth -= right;
    this.elevation = Math.max(-89, Math.min(89, this.elevation + above));
  }

  /** By parts of the view's height. */
  shift(right: number, above: number): void {
    const axes = this.axes;
    this.focus = sum([1, this.focus], [-2 * this.scale * right, axes.right], [-2 * this.scale * above, axes.above]);
  }

  /** Fills the view, but for a margin, with these points (x, y, z, x, …). */
  fit(points: ArrayLike<number>, aspect: number): void {
    const {right, above} = this.axes;
    let [left, rightmost, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
    const middle: Vec = [0, 0, 0];
    for (let i = 0; i < points.length; i += 3) {
      const p: Vec = [points[i]!, points[i + 1]!, points[i + 2]!];
      const x = dot(p, right), y = dot(p, above);
      left = Math.min(left, x); rightmost = Math.max(rightmost, x);
      low = Math.min(low, y); high = Math.max(high, y);
    }
    this.scale = 0.56 * Math.max(high - low, (rightmost - left) / aspect) || 1;
    this.focus = sum([1, middle], [(left + rightmost) / 2, right], [(low + high) / 2, above]);
  }

  /** Where a point is in a view of this size, in pixels from its upper left. */
  project(p: Vec, width: number, height: number): [number, number] {
    const {right, above} = this.axes;
    const offset = sum([1, p], [-1, this.focus]), perPixel = (2 * this.scale) / height;
    return [width / 2 + dot(offset, right) / perPixel, height / 2 - dot(offset, above) / perPixel];
  }

  /** The point of the plane through the focus under a pixel. */
  unproject(x: number, y: number, width: number, height: number): Vec {
    const {right, above} = this.axes, perPixel = (2 * this.scale) / height;
    return sum([1, this.focus], [(x - width / 2) * perPixel, right], [(height / 2 - y) * perPixel, above]);
  }
}

/** How far along `direction` from `origin` the ray meets a triangle; NaN if it does not (Möller & Trumbore 1997). */
function meeting(origin: Vec, direction: Vec, p: ArrayLike<number>, a: number, b: number, c: number): number {
  const e1: Vec = [p[b]! - p[a]!, p[b + 1]! - p[a + 1]!, p[b + 2]! - p[a + 2]!];
  const e2: Vec = [p[c]! - p[a]!, p[c + 1]! - p[a + 1]!, p[c + 2]! - p[a + 2]!];
  const h = cross(direction, e2), determinant = dot(e1, h);
  if (Math.abs(determinant) < 1e-15) return NaN;
  const s: Vec = [origin[0] - p[a]!, origin[1] - p[a + 1]!, origin[2] - p[a + 2]!];
  const u = dot(s, h) / determinant;
  if (u < 0 || u > 1) return NaN;
  const q = cross(s, e1), v = dot(direction, q) / determinant;
  return v < 0 || u + v > 1 ? NaN : dot(e2, q) / determinant;
}

export interface Hit {
  triangle: number;
  distance: number;
}

/** The triangle that is met farthest along the direction: looking back along it, the one in front. */
export function farthestHit(origin: Vec, direction: Vec, points: ArrayLike<number>, triangles: ArrayLike<number>): Hit | null {
  let found: Hit | null = null;
  for (let t = 0; t < triangles.length; t += 3) {
    const d = meeting(origin, direction, points, 3 * triangles[t]!, 3 * triangles[t + 1]!, 3 * triangles[t + 2]!);
    if (d > (found?.distance ?? -Infinity)) found = {triangle: t / 3, distance: d};
  }
  return found;
}
