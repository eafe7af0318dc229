import {Chart, watchPointer, type Line} from '../chart';
import {courseStyles, setColours, swatch, type LineStyle} from '../colours';
import {residual, valueAt} from '../course';
import {make, panel, svg} from '../dom';
import {axisText, statesOf, timeUnitFor, unitText, valueText} from '../format';
import type {PageState, Selection} from '../signal';
import type {Column} from '../csv';
import type {NamedCourse, Run} from './run_data';

export interface CoursesOptions {
  title: string;
  file: string;
  quantity: string;
  /** Per data set, the reference first; channels of one unit. */
  runs: ShownRun[];
  /** How many data sets the page has. */
  sets: number;
  kind: 'sensor' | 'displacement' | null;
  state: PageState;
  range: [number, number];
  height?: number;
}

/** Channels of a data set, or what it lacks of the reference: `index` says which it is on the whole page. */
export interface ShownRun {
  name: string;
  index: number;
  channels: NamedCourse[];
}

/** The reference is solid. */
const dashesOf = (index: number): number[] | undefined => (index > 0 ? [[6, 4], [2, 3], [10, 3, 2, 3]][(index - 1) % 3] : undefined);

const faint = (colour: string): string => colour.replace(/,1\)$/, ',0.22)');

/** Channels that at least one data set has, in order. */
function namesOf(runs: {channels: NamedCourse[]}[]): NamedCourse[] {
  const known = new Map<string, NamedCourse>();
  for (const run of runs) for (const channel of run.channels) if (!known.has(channel.name)) known.set(channel.name, channel);
  return [...known.values()];
}

/**
 * Courses of channels of one unit: a chart, and a chip per channel that shows its value and chooses it. A channel has
 * one colour and a data set one way of dashing; of the channel that is chosen, each data set has its colour.
 */
export function coursesPanel(options: CoursesOptions): HTMLElement {
  const {state, runs, sets, kind, range} = options, channels = namesOf(runs), unit = channels[0]!.unit;
  const chosen = (): string | null => (state.selection.value?.kind === kind ? state.selection.value.name : null);
  const isChannel = (name: string | null): boolean => channels.some((c) => c.name === name);
  const styleOf = (i: number): LineStyle => courseStyles(channels.length, sets > 1, state.dark.value)[i]!;
  const colourOf = (i: number): string => styleOf(i).colour;
  const byRun = (): boolean => sets > 1 && (kind !== null || runs.length > 1) && (channels.length === 1 || isChannel(chosen()));
  const colourOfRun = (run: ShownRun): string => setColours(sets, state.dark.value)[run.index]!;
  /** Of a chip: the lines that its channel has. */
  const swatchOf = (i: number): string => {
    if (!byRun() || (channels.length > 1 && channels[i]!.name !== chosen())) return swatch(styleOf(i));
    const parts = runs.map((run, r) => `${colourOfRun(run)} ${(100 * r) / runs.length}% ${(100 * (r + 1)) / runs.length}%`);
    return `linear-gradient(to right, ${parts.join()})`;
  };

  const lines: Line[] = runs.flatMap((run) => run.channels.map((course) => {
    const i = channels.findIndex((c) => c.name === course.name);
    return {
      ...course, dash: runs.length > 1 ? dashesOf(run.index) : styleOf(i).dash,
      colour: () => {
        const name = chosen();
        if (isChannel(name) && name !== course.name) return faint(colourOf(i));
        return byRun() ? colourOfRun(run) : colourOf(i);
      },
      width: () => (chosen() === course.name ? 2.5 : 1.5),
    };
  }));
  const time = timeUnitFor(range[1] - range[0]);
  const chart = new Chart({
    x: {label: `Time / ${time.unit}`, scale: time.seconds, range}, y: {label: axisText(options.quantity, unit)},
    lines, time: state.time, dark: state.dark, height: options.height, describe: `${options.title} over time`,
  });
  const chips = chipRow(options, channels, swatchOf, chosen);
  state.selection.watch(() => chart.redraw());
  const whole = panel(options.title, options.file, () => courseColumns(runs), chart.element, ...chips, runs.length > 1 && setKey(runs, state, () => (byRun() ? colourOfRun : null)));
  if (channels.length === 1) whole.querySelector('h3')!.after(chips[0]!);
  return whole;
}

/** On the reference's times: all of them, of which a constant course has but the ends. */
export function courseColumns(runs: ShownRun[]): Column[] {
  const {time} = runs[0]!.channels.reduce((most, c) => (c.time.length > most.time.length ? c : most));
  return [{name: 'time_s', values: time}, ...runs.flatMap((run) => run.channels.map((c) => ({
    name: `${runs.length > 1 ? `${run.name}.` : ''}${c.name}_${c.unit}`,
    values: c.time === time ? c.values : Array.from(time, (t) => valueAt(c, t)),
  })))];
}

function chipRow(options: CoursesOptions, channels: NamedCourse[], swatchOf: (i: number) => string,
                 chosen: () => string | null): HTMLElement[] {
  const {state, kind} = options;
  const words = make('p', {class: 'words'});
  const chips = channels.map((channel) => {
    const selection: Selection = kind && {kind, name: channel.name};
    const value = make('span', {class: 'value'});
    const parts = [make('span', {class: 'swatch'}), make('span', {}, channel.name), value];
    return {channel, value, element: selection
      ? make('button', {class: 'chip', title: channel.title, 'data-channel': channel.name, onclick: () => state.choose(selection)}, ...parts)
      : make('span', {class: 'chip', title: channel.title}, ...parts)};
  });
  const show = (t: number): void => {
    for (const {channel, value} of chips) {
      const now = valueAt(channel, t), state = statesOf(channel.title).get(now);
      value.textContent = state ? `${now} ${state}` : valueText(now, channel.unit);
    }
  };
  state.time.watch(show);
  watchPointer((t) => show(t ?? state.time.value));
  const colour = (): void => chips.forEach(({element}, i) => element.style.setProperty('--colour', swatchOf(i)));
  state.dark.watch(colour);
  state.selection.watch(() => {
    colour();
    const name = chosen(), channel = channels.find((c) => c.name === name);
    for (const chip of chips) if (kind) chip.element.setAttribute('aria-pressed', String(chip.channel.name === name));
    const told = channel ? [channel] : channels.filter((c) => statesOf(c.title).size > 0);
    words.textContent = told.map((c) => `${c.name}: ${c.title}`).join('; ');
    words.hidden = !told.some((c) => c.title);
  });
  return [make('div', {class: 'chips', role: 'group', 'aria-label': `${options.title}, ${unitText(channels[0]!.unit)}`},
    ...chips.map((c) => c.element)), words];
}

/** Which line is which data set, when there are several: by its dashes, and by its colour where lines have that. */
function setKey(runs: ShownRun[], state: PageState, colour: () => ((run: ShownRun) => string) | null): HTMLElement {
  const entries = runs.map((run) => {
    const line = svg('line', {x1: 0, x2: 30, y1: 2, y2: 2, 'stroke-width': 2.5, 'stroke-dasharray': dashesOf(run.index)?.join(' ')});
    return {run, line, element: make('span', {}, svg('svg', {width: 30, height: 4, 'aria-hidden': 'true'}, line), run.name)};
  });
  const paint = (): void => {
    const of = colour();
    for (const {run, line} of entries) line.style.stroke = of ? of(run) : 'currentColor';
  };
  state.dark.watch(paint);
  state.selection.watch(paint);
  return make('p', {class: 'key'}, ...entries.map((e) => e.element));
}

/** The same channels of the data sets that went through the same, taken from the reference. */
export function residualRuns(runs: Run[], pick: (run: Run) => NamedCourse[]): ShownRun[] {
  const [reference, ...others] = runs;
  return others.filter((other) => other.set.compared).map((other) => ({
    name: `${reference!.name} − ${other.name}`, index: other.index,
    channels: pick(reference!).flatMap((mine) => {
      const theirs = pick(other).find((c) => c.name === mine.name && c.unit === mine.unit);
      if (!theirs) return [];
      const unit = mine.unit === 'degC' ? 'K' : mine.unit;
      return [{...mine, unit, values: residual(mine, theirs)}];
    }),
  })).filter((run) => run.channels.length > 0);
}
