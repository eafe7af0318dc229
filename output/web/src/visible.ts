import {dot, type Camera, type Vec} from './camera';

const columns = 320;

/**
 * The triangles that can be seen from where the camera stands: those in front at some place of a coarse picture, and
 * those with a corner that nothing covers. What is left out lies behind others, or is seen from inside.
 */
export function visibleTriangles(camera: Camera, points: Float32Array, triangles: ArrayLike<number>, aspect: number): Int32Array {
  const rows = Math.max(8, Math.round(columns / aspect)), n = points.length / 3, perCell = (2 * camera.scale) / rows;
  const {right, above} = camera.axes, towards = camera.towards, focus = camera.focus;
  const across = [dot(focus, right), dot(focus, above)];
  const x = new Float32Array(n), y = new Float32Array(n), z = new Float32Array(n);
  for (let p = 0; p < n; ++p) {
    const place: Vec = [points[3 * p]!, points[3 * p + 1]!, points[3 * p + 2]!];
    x[p] = columns / 2 + (dot(place, right) - across[0]!) / perCell;
    y[p] = rows / 2 + (dot(place, above) - across[1]!) / perCell;
    z[p] = dot(place, towards);
  }

  const depth = new Float32Array(columns * rows).fill(-Infinity), owner = new Int32Array(columns * rows).fill(-1);
  const faces = triangles.length / 3, turned = new Uint8Array(faces);
  for (let t = 0; t < faces; ++t) {
    const a = triangles[3 * t]!, b = triangles[3 * t + 1]!, c = triangles[3 * t + 2]!;
    const abx = x[b]! - x[a]!, aby = y[b]! - y[a]!, acx = x[c]! - x[a]!, acy = y[c]! - y[a]!;
    const area = abx * acy - aby * acx;
    if (area <= 0) continue;
    turned[t] = 1;
    const left = Math.max(0, Math.ceil(Math.min(x[a]!, x[b]!, x[c]!) - 0.5));
    const end = Math.min(columns - 1, Math.floor(Math.max(x[a]!, x[b]!, x[c]!) - 0.5));
    const low = Math.max(0, Math.ceil(Math.min(y[a]!, y[b]!, y[c]!) - 0.5));
    const high = Math.min(rows - 1, Math.floor(Math.max(y[a]!, y[b]!, y[c]!) - 0.5));
    for (let j = low; j <= high; ++j)
      for (let i = left; i <= end; ++i) {
        const dx = i + 0.5 - x[a]!, dy = j + 0.5 - y[a]!;
        const v = (dx * acy - dy * acx) / area, w = (abx * dy - aby * dx) / area;
        if (v < 0 || w < 0 || v + w > 1) continue;
        const height = z[a]! + v * (z[b]! - z[a]!) + w * (z[c]! - z[a]!), cell = j * columns + i;
        if (height > depth[cell]!) {
          depth[cell] = height;
          owner[cell] = t;
        }
      }
  }

  const seen = new Uint8Array(n);
  for (let p = 0; p < n; ++p) seen[p] = isOpen(x[p]!, y[p]!, z[p]! + 3 * perCell, depth, rows) ? 1 : 0;
  const kept = new Uint8Array(faces);
  for (const t of owner) if (t >= 0) kept[t] = 1;
  const list: number[] = [];
  for (let t = 0; t < faces; ++t) {
    const a = triangles[3 * t]!, b = triangles[3 * t + 1]!, c = triangles[3 * t + 2]!;
    if (turned[t] && (kept[t] || seen[a] || seen[b] || seen[c])) list.push(a, b, c);
  }
  return Int32Array.from(list);
}

/** Whether, at this place or one of its neighbours, nothing lies in front of this height. */
function isOpen(x: number, y: number, height: number, depth: Float32Array, rows: number): boolean {
  const column = Math.floor(x), row = Math.floor(y);
  for (let j = row - 1; j <= row + 1; ++j)
    for (let i = column - 1; i <= column + 1; ++i)
      if (i < 0 || j < 0 || i >= columns || j >= rows || depth[j * columns + i]! <= height) return true;
  return false;
}
