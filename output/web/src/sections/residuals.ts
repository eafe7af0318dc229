import {cells, Chart} from '../chart';
import {cividis, css, gradient} from '../colours';
import {extent, rootMeanSquare, windows} from '../course';
import {colourBar, make, panel} from '../dom';
import {axisText, roundTicks, timeUnitFor, unitText, valueText} from '../format';
import type {PageState} from '../signal';
import {misfit, type Misfit, type NamedCourse} from './run_data';

const window_count = 48;

interface Difference {
  name: string;
  channels: NamedCourse[];
}

/** How large the residual is, per channel and window of time. */
export function residualMap(title: string, file: string, differences: Difference[],
                            state: PageState, range: [number, number]): HTMLElement {
  const time = timeUnitFor(range[1] - range[0]), unit = differences[0]!.channels[0]!.unit;
  const tables = differences.map((d) => d.channels.map((c) => windows(c, window_count)));
  const ticks = roundTicks(0, extent(tables.flat())[1]), highest = ticks[ticks.length - 1]!;
  const charts = differences.flatMap((difference, d) => {
    const {channels} = difference, rows = channels.length;
    const [start, end] = extent([channels[0]!.time]);
    const edges = Array.from({length: window_count + 1}, (_, i) => (start + (i / window_count) * (end - start)) / time.seconds);
    const chart = new Chart({
      x: {label: `Time / ${time.unit}`, scale: time.seconds, range},
      y: {label: '', range: [0, rows], names: channels.map((c) => c.name).reverse()},
      lines: [], time: state.time, dark: state.dark, height: 54 + 20 * rows,
      describe: `${title}, ${difference.name}`,
      ground: cells(edges, Array.from({length: rows + 1}, (_, j) => j), (i, j) => {
        const value = tables[d]![rows - 1 - j]![i]!;
        return Number.isFinite(value) ? css(cividis(value / highest)) : null;
      }),
    });
    return [differences.length > 1 ? make('p', {class: 'words'}, difference.name) : null, chart.element];
  });
  return panel(title, file, () => [
    {name: 'channel', values: differences.flatMap((d) => d.channels.flatMap((c) => new Array<string>(window_count).fill(`${d.name}: ${c.name}`)))},
    {name: 'window', values: differences.flatMap((d) => d.channels.flatMap(() => Array.from({length: window_count}, (_, i) => i)))},
    {name: `rms_${unit}`, values: tables.flat(2)},
  ], ...charts.filter((c) => c !== null), colourBar(gradient(cividis), ticks, axisText('RMS', unit)));
}

/** A sentence per pair: the RMS over the channels' RMS, as it is and without a constant; and what was subtracted. */
export function misfitWords(differences: Difference[]): HTMLElement[] {
  const pairs = differences.map(({name, channels}) => {
    const unit = channels[0]!.unit, misfits = channels.map((c) => misfit(c.name, c.unit, c.values));
    const whole = (of: 'rms' | 'spread'): string => `${valueText(rootMeanSquare(misfits.map((m) => m[of])), unit)} ${unitText(unit)}`;
    const subject = differences.length > 1 ? `${name}: RMS` : 'RMS';
    return make('p', {class: 'words'}, `${subject} ${whole('rms')}; ${whole('spread')} with one constant per channel taken off`);
  });
  return [...pairs, make('p', {class: 'words'}, 'Readings less readings, each with the noise of its own instruments; compare has a twin without.')];
}

/** RMS, with and without a constant, and largest residual per channel, a row each. */
export function misfitTable(runs: {name: string; misfits: Misfit[]}[], state: PageState): HTMLElement {
  const largest: Record<string, number> = {};
  for (const {misfits} of runs) for (const m of misfits) largest[m.unit] = Math.max(largest[m.unit] ?? 0, m.rms || 0);
  const bar = (m: Misfit): HTMLElement => {
    const strip = make('i', {class: 'bar'});
    strip.style.width = `${(100 * (m.rms || 0)) / (largest[m.unit] || 1)}%`;
    return strip;
  };
  const rows = runs.flatMap((run) => run.misfits.map((m) => make('tr', {},
    runs.length > 1 && make('td', {class: 'pair'}, run.name),
    make('th', {scope: 'row'}, make('button', {class: 'quiet', onclick: () => state.choose(
      {kind: m.unit === 'K' ? 'sensor' : 'displacement', name: m.name})}, m.name)),
    make('td', {class: 'wide'}, bar(m)),
    ...[m.rms, m.largest, m.offset, m.spread].map((value) => make('td', {class: 'number'}, `${valueText(value, m.unit)} ${unitText(m.unit)}`)))));
  return panel('Residual of every channel', 'residual_summary', () => {
    const all = runs.flatMap((run) => run.misfits.map((m) => ({run: run.name, ...m})));
    return [{name: 'run', values: all.map((m) => m.run)}, {name: 'channel', values: all.map((m) => m.name)},
      {name: 'unit', values: all.map((m) => m.unit)}, {name: 'rms', values: all.map((m) => m.rms)},
      {name: 'largest', values: all.map((m) => m.largest)}, {name: 'offset', values: all.map((m) => m.offset)},
      {name: 'rms_offset_taken_off', values: all.map((m) => m.spread)}];
  }, make('div', {class: 'scroll'}, make('table', {}, make('tr', {}, runs.length > 1 && make('th', {}, 'pair'),
    make('th', {}, 'channel'), make('th', {class: 'wide'}),
    ...['RMS', 'largest', 'offset', 'RMS, offset taken off'].map((head) => make('th', {class: 'number'}, head))), ...rows)));
}
