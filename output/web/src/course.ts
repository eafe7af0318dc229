/** Courses over time, and what two of them differ by. */

export interface Course {
  time: ArrayLike<number>;
  values: ArrayLike<number>;
  /** Each value holds until the next: what the machine was told, not what follows from it. */
  held?: boolean;
  /** Samples farther apart have nothing between them, others are one course; without it, each missing one interrupts. */
  longestGap?: number;
}

/** The last index whose time is at or before t; 0 before the first. */
export function rowAt(time: ArrayLike<number>, t: number): number {
  let low = 0, high = time.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (time[middle]! <= t) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** Along straight lines, or held; NaN outside, in a gap, and next to a sample that is missing unless gaps are told by their length. */
export function valueAt(course: Course, t: number): number {
  const {time, values, longestGap} = course, n = time.length;
  if (n === 0 || t < time[0]! - 1e-6 || t > time[n - 1]! + 1e-6) return NaN;
  let i = rowAt(time, t), next = t > time[i]! ? Math.min(i + 1, n - 1) : i;
  if (longestGap !== undefined) {
    while (i > 0 && !Number.isFinite(values[i])) --i;
    while (next < n - 1 && !Number.isFinite(values[next])) ++next;
    if (time[next]! - time[i]! > longestGap) return NaN;
  }
  if (i === next || course.held) return values[i]!;
  return values[i]! + ((t - time[i]!) / (time[next]! - time[i]!)) * (values[next]! - values[i]!);
}

/**
 * As a line is drawn: null where it is interrupted, undefined where it goes on to the next sample. A gap without rows
 * gets one, just behind the row before it.
 */
export function interrupted({time, values, longestGap}: Course): {time: number[]; values: (number | null | undefined)[]} {
  const times: number[] = [], drawn: (number | null | undefined)[] = [];
  let known = -Infinity, behind = 0;  // when the last sample was, and what follows it
  for (let i = 0; i < time.length; ++i) {
    const now = time[i]!, step = i > 0 ? now - time[i - 1]! : 0;
    if (longestGap !== undefined && step > longestGap) {
      times.push(time[i - 1]! + 1e-3 * step);
      drawn.push(null);
    }
    if (Number.isFinite(values[i])) {
      if (longestGap !== undefined && now - known <= longestGap) drawn.fill(undefined, behind);
      known = now;
      behind = drawn.length + 1;
    }
    times.push(now);
    drawn.push(Number.isFinite(values[i]) ? values[i]! : null);
  }
  return {time: times, values: drawn};
}

export function resampled(course: Course, times: ArrayLike<number>): Float32Array {
  return Float32Array.from(times, (t) => valueAt(course, t));
}

/** reference − other, on the reference's times. */
export function residual(reference: Course, other: Course): Float32Array {
  const theirs = resampled(other, reference.time);
  return Float32Array.from(reference.values, (value, i) => value - theirs[i]!);
}

export function rootMeanSquare(values: ArrayLike<number>): number {
  let sum = 0, count = 0;
  for (let i = 0; i < values.length; ++i) {
    if (!Number.isFinite(values[i])) continue;
    sum += values[i]! ** 2;
    ++count;
  }
  return count ? Math.sqrt(sum / count) : NaN;
}

/** Root mean square in each of `n` windows of equal length between the first time and the last. */
export function windows(course: Course, n: number): number[] {
  const {time, values} = course;
  const start = time[0]!, span = time[time.length - 1]! - start || 1;
  const sums = new Array<number>(n).fill(0), counts = new Array<number>(n).fill(0);
  for (let i = 0; i < time.length; ++i) {
    if (!Number.isFinite(values[i])) continue;
    const w = Math.min(n - 1, Math.floor(((time[i]! - start) / span) * n));
    sums[w]! += values[i]! ** 2;
    counts[w]! += 1;
  }
  return sums.map((sum, w) => (counts[w] ? Math.sqrt(sum / counts[w]!) : NaN));
}

export function extent(lists: Iterable<ArrayLike<number>>): [number, number] {
  let low = Infinity, high = -Infinity;
  for (const list of lists)
    for (let i = 0; i < list.length; ++i) {
      const value = list[i]!;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  return low <= high ? [low, high] : [0, 1];
}
