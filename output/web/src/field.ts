import type {Field, Numbers} from './data';
import {rowAt, type Course} from './course';

/** Temperature and displacement of the surface's points at any time: shapes with courses (output/field_modes.h). */
export class SurfaceField {
  private readonly start: Float32Array;
  private readonly courses: Float32Array;
  private readonly temperatures: Float32Array[];
  private readonly displacements: Float32Array[];

  constructor(field: Field, numbers: Numbers, private readonly time: Float32Array) {
    this.start = numbers.single(field.start);
    this.courses = numbers.single(field.courses);
    this.temperatures = numbers.columns(field.temperature);
    this.displacements = numbers.columns(field.displacement);
  }

  private factors(t: number): number[] {
    const modes = this.temperatures.length, row = rowAt(this.time, t);
    const next = Math.min(row + 1, this.time.length - 1);
    const gap = this.time[next]! - this.time[row]!;
    const share = gap > 0 ? Math.min(1, Math.max(0, (t - this.time[row]!) / gap)) : 0;
    return Array.from({length: modes}, (_, k) => {
      const a = this.courses[row * modes + k]!, b = this.courses[next * modes + k]!;
      return a + share * (b - a);
    });
  }

  temperature(t: number, into: Float32Array): void {
    into.set(this.start);
    add(this.factors(t), this.temperatures, into);
  }

  /** Three numbers for each point, in metre. */
  displacement(t: number, into: Float32Array): void {
    into.fill(0);
    add(this.factors(t), this.displacements, into);
  }

  /** The largest of any point at any of `samples` times. */
  largestDisplacement(samples = 12): number {
    const last = this.time.length - 1, into = new Float32Array(3 * this.start.length);
    let largest = 0;
    for (let s = 1; s <= samples; ++s) {
      this.displacement(this.time[Math.round((s / samples) * last)]!, into);
      for (let i = 0; i < into.length; i += 3)
        largest = Math.max(largest, into[i]! ** 2 + into[i + 1]! ** 2 + into[i + 2]! ** 2);
    }
    return Math.sqrt(largest);
  }
}

function add(factors: number[], shapes: Float32Array[], into: Float32Array): void {
  shapes.forEach((shape, k) => {
    const factor = factors[k]!;
    for (let i = 0; i < into.length; ++i) into[i]! += factor * shape[i]!;
  });
}

export interface BodyCourse {
  mean: Course;
  lowest: Course;
  highest: Course;
}

export function bodyCourses(field: Field, numbers: Numbers, time: Float32Array, bodies: number): BodyCourse[] {
  const column = (all: Float32Array, b: number): Course =>
    ({time, values: Float32Array.from({length: time.length}, (_, row) => all[row * bodies + b]!)});
  const [mean, lowest, highest] = [field.bodies.mean, field.bodies.lowest, field.bodies.highest].map((r) => numbers.single(r));
  return Array.from({length: bodies}, (_, b) =>
    ({mean: column(mean!, b), lowest: column(lowest!, b), highest: column(highest!, b)}));
}
