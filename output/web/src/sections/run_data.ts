import {extent, resampled, rootMeanSquare, type Course} from '../course';
import {mean} from '../statistics';
import type {Channel, Numbers, RunSet, RunsSection} from '../data';

export interface NamedCourse extends Course {
  name: string;
  unit: string;
  title: string;
}

/** A data set with its numbers at hand. */
export interface Run {
  name: string;
  /** Among the runs of the page, the reference 0: its colour and its dashes everywhere. */
  index: number;
  set: RunSet;
  time: Float32Array;
  readings: NamedCourse[];
  displacements: NamedCourse[];
  heat: NamedCourse[];
}

function courses(channels: Channel[], time: Float32Array, numbers: Numbers): NamedCourse[] {
  return channels.filter((c) => c.values).map((c) =>
    ({name: c.name, unit: c.unit, title: c.title, time, longestGap: c.longest_gap, values: numbers.single(c.values!)}));
}

/** The reference comes first: what was measured, or else the first. */
export function runsOf(section: RunsSection, numbers: Numbers): Run[] {
  const runs = section.sets.map((set) => {
    const time = numbers.single(set.time);
    return {
      name: set.name, index: 0, set, time,
      readings: courses(set.readings, time, numbers),
      displacements: courses(set.displacements, time, numbers),
      heat: courses(set.heat, time, numbers),
    };
  });
  const reference = runs.findIndex((run) => !run.set.simulated);
  if (reference > 0) runs.unshift(...runs.splice(reference, 1));
  runs.forEach((run, i) => {
    run.index = i;
  });
  return runs;
}

/** Whether one shows what the other does wherever it shows anything, to a thousandth of its largest value. */
function shows(course: Course, other: Course): boolean {
  const theirs = resampled(course, other.time), near = 1e-3 * Math.max(...extent([other.values]).map(Math.abs));
  return Array.prototype.every.call(other.values, (value: number, i) => !Number.isFinite(value) || Math.abs(value - theirs[i]!) <= near);
}

/** Whether two lists have the same channels with the same courses. */
export function sameCourses(some: NamedCourse[], others: NamedCourse[]): boolean {
  return some.length === others.length && some.every((mine) => others.some((theirs) =>
    theirs.name === mine.name && shows(mine, theirs) && shows(theirs, mine)));
}

/** From the first row in which anything is shown: a measurement may begin long after its run. */
export function timeRange(runs: Run[], numbers: Numbers): [number, number] {
  return extent(runs.map((run) => {
    const shown = [...run.readings, ...run.displacements, ...shownInputs(run, numbers).filter((c) => c.time === run.time)];
    const first = run.time.findIndex((_, row) => shown.some((c) => Number.isFinite(c.values[row])));
    return [run.time[Math.max(0, first)] ?? 0, run.time[run.time.length - 1] ?? 1];
  }));
}

const derived = /\.(running|time_running|revolutions)$|^time_of_day$|^clock\.|\.stroke_|reference_height|^(?!spindle)\w+\.(speed|duty)$/;
const always = /^spindle\.speed$|\.feed$|^ambient\.temperature$/;

/** Speeds, feeds, switches and shares are set and stay; air and positions go from one value to the next. */
const held = new Set(['rpm', 'mm/min', '1', 'W', 'kg/s']);

/** What the machine was given that is worth a course; a constant one is drawn only if it is a speed or the air. */
export function shownInputs(run: Run, numbers: Numbers): NamedCourse[] {
  const {time, set} = run, ends = [time[0] ?? 0, time[time.length - 1] ?? 1];
  const shown: NamedCourse[] = [];
  for (const {name, unit, title, values, constant, longest_gap: longestGap} of set.inputs) {
    if (values ? derived.test(name) : !(always.test(name) && constant)) continue;
    const course = values ? {time, longestGap, values: numbers.single(values)} : {time: ends, values: [constant!, constant!]};
    shown.push({name, unit, title, ...course, held: held.has(unit)});
  }
  return shown;
}

/** When the first run is hottest: a telling moment to begin with. */
export function tellingTime(runs: Run[]): number {
  const run = runs[0]!;
  let best = run.time[0] ?? 0, highest = -Infinity;
  for (const course of run.readings)
    for (let i = 0; i < course.values.length; ++i)
      if (course.values[i]! > highest) {
        highest = course.values[i]!;
        best = run.time[i]!;
      }
  return best;
}

/** Of a residual; NaN where nothing of it is known. */
export interface Misfit {
  name: string;
  unit: string;
  rms: number;
  largest: number;
  /** The mean: what an instrument's offset or a displacement's zero may be, which `compare` takes off. */
  offset: number;
  /** RMS without it. */
  spread: number;
}

export function misfit(name: string, unit: string, difference: ArrayLike<number>): Misfit {
  const known = Array.from(difference).filter(Number.isFinite), offset = mean(known);
  return {
    name, unit, rms: rootMeanSquare(known), largest: known.reduce((most, x) => Math.max(most, Math.abs(x)), known.length > 0 ? 0 : NaN),
    offset, spread: rootMeanSquare(known.map((x) => x - offset)),
  };
}

/** Of those whose misfit is known. */
export function worst(misfits: Misfit[]): Misfit | undefined {
  return misfits.filter((m) => Number.isFinite(m.rms)).sort((a, b) => b.rms - a.rms)[0];
}
