import {Chart, watchPointer, type Line} from '../chart';
import {courseColours, setColours} from '../colours';
import {residual, valueAt} from '../course';
import {make, panel} from '../dom';
import {axisText, timeUnitFor, unitText, valueText} from '../format';
import type {PageState, Selection} from '../signal';
import type {Column} from '../csv';
import type {NamedCourse, Run} from './run_data';

export interface CoursesOptions {
  title: string;
  file: string;
  quantity: string;
  /** Per data set, the reference first; channels of one unit. */
  runs: {name: string; channels: NamedCourse[]}[];
  kind: 'sensor' | 'displacement' | null;
  state: PageState;
  range: [number, number];
  height?: number;
}

const faint = (colour: string): string => colour.replace(/,1\)$/, ',0.22)');

/** Channels that at least one data set has, in order. */
function namesOf(runs: {channels: NamedCourse[]}[]): NamedCourse[] {
  const known = new Map<string, NamedCourse>();
  for (const run of runs) for (const channel of run.channels) if (!known.has(channel.name)) known.set(channel.name, channel);
  return [...known.values()];
}

/** Courses of channels of one unit: a chart, and a chip per channel that shows its value and chooses it. */
export function coursesPanel(options: CoursesOptions): HTMLElement {
  const {state, runs, kind, range} = options, channels = namesOf(runs), unit = channels[0]!.unit;
  const chosen = (): string | null => (state.selection.value?.kind === kind ? state.selection.value.name : null);
  const isChannel = (name: string | null): boolean => channels.some((c) => c.name === name);
  const colourOf = (i: number): string => courseColours(channels.length, state.dark.value)[i]!;

  const lines: Line[] = runs.flatMap((run, r) => run.channels.map((course) => {
    const i = channels.findIndex((c) => c.name === course.name);
    return {
      ...course, dash: r > 0 ? [[6, 4], [2, 3], [10, 3, 2, 3]][(r - 1) % 3] : undefined,
      colour: () => {
        const name = chosen();
        if (!isChannel(name)) return colourOf(i);
        if (name !== course.name) return faint(colourOf(i));
        return runs.length > 1 ? setColours(runs.length, state.dark.value)[r]! : colourOf(i);
      },
      width: () => (chosen() === course.name ? 2.5 : 1.5),
    };
  }));
  const time = timeUnitFor(range[1] - range[0]);
  const chart = new Chart({
    x: {label: `Time / ${time.unit}`, scale: time.seconds, range}, y: {label: axisText(options.quantity, unit)},
    lines, time: state.time, dark: state.dark, height: options.height, describe: `${options.title} over time`,
  });
  const chips = chipRow(options, channels, colourOf, chosen);
  state.selection.watch(() => chart.redraw());
  const columns = (): Column[] => [{name: 'time_s', values: runs[0]!.channels[0]!.time},
    ...runs.flatMap((run) => run.channels.map((c) => ({
      name: `${runs.length > 1 ? `${run.name}.` : ''}${c.name}_${unit}`,
      values: c.time === runs[0]!.channels[0]!.time ? c.values : Array.from(runs[0]!.channels[0]!.time, (t) => valueAt(c, t)),
    })))];
  const whole = panel(options.title, options.file, columns, chart.element, ...chips, runs.length > 1 && setKey(runs, state));
  if (channels.length === 1) whole.querySelector('h3')!.after(chips[0]!);
  return whole;
}

function chipRow(options: CoursesOptions, channels: NamedCourse[], colourOf: (i: number) => string,
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
    for (const {channel, value} of chips) value.textContent = valueText(valueAt(channel, t), channel.unit);
  };
  state.time.watch(show);
  watchPointer((t) => show(t ?? state.time.value));
  const colour = (): void => chips.forEach(({element}, i) => element.style.setProperty('--colour', colourOf(i)));
  state.dark.watch(colour);
  state.selection.watch(() => {
    const name = chosen(), channel = channels.find((c) => c.name === name);
    for (const chip of chips) if (kind) chip.element.setAttribute('aria-pressed', String(chip.channel.name === name));
    words.textContent = channel ? `${channel.name}: ${channel.title}` : '';
    words.hidden = !channel?.title;
  });
  return [make('div', {class: 'chips', role: 'group', 'aria-label': `${options.title}, ${unitText(channels[0]!.unit)}`},
    ...chips.map((c) => c.element)), words];
}

/** Which line is which data set, when there are several. */
function setKey(runs: {name: string}[], state: PageState): HTMLElement {
  const entries = runs.map((run, r) => {
    const line = make('i', {class: `line-${r === 0 ? 'solid' : 'dashed'}`});
    return {line, element: make('span', {}, line, run.name)};
  });
  state.dark.watch((dark) => entries.forEach(({line}, r) => {
    line.style.borderColor = setColours(runs.length, dark)[r]!;
  }));
  return make('p', {class: 'key'}, ...entries.map((e) => e.element));
}

/** The same channels of the data sets that went through the same, taken from the reference. */
export function residualRuns(runs: Run[], pick: (run: Run) => NamedCourse[]): {name: string; channels: NamedCourse[]}[] {
  const [reference, ...others] = runs;
  return others.filter((other) => other.set.compared).map((other) => ({
    name: `${reference!.name} − ${other.name}`,
    channels: pick(reference!).flatMap((mine) => {
      const theirs = pick(other).find((c) => c.name === mine.name);
      if (!theirs) return [];
      const unit = mine.unit === 'degC' ? 'K' : mine.unit;
      return [{...mine, unit, values: residual(mine, theirs)}];
    }),
  })).filter((run) => run.channels.length > 0);
}
