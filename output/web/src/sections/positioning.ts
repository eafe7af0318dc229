import {cells, Chart, type Line} from '../chart';
import {css, gradient, viridis} from '../colours';
import {extent, rowAt} from '../course';
import {colourBar, make, panel} from '../dom';
import type {Numbers, Positioning} from '../data';
import {edgesAround} from '../edges';
import {roundTicks, timeText, timeUnitFor} from '../format';
import type {PageState} from '../signal';
import type {Run} from './run_data';

/** What the laser saw: the error along the stroke, pass by pass, and as a map over stroke and time. */
export function positioningPanels(runs: Run[], numbers: Numbers, state: PageState, range: [number, number]): HTMLElement[] {
  return runs.flatMap((run) => run.set.positioning.flatMap((axis) =>
    axisPanels(axis, runs.length > 1 ? `, ${run.name}` : '', `${run.name}_${axis.axis}`, numbers, state, range)));
}

function axisPanels(axis: Positioning, suffix: string, file: string, numbers: Numbers, state: PageState, range: [number, number]): HTMLElement[] {
  const position = numbers.single(axis.position_mm), time = numbers.single(axis.time);
  const forward = numbers.single(axis.forward_um), backward = numbers.single(axis.backward_um);
  const n = position.length, passes = time.length;
  const ticks = roundTicks(...extent([forward, backward])), [low, high] = [ticks[0]!, ticks[ticks.length - 1]!];
  const stroke: [number, number] = extent([position]);
  const now = (): number => rowAt(time, state.time.value + 1e-3);
  const name = `Axis ${axis.axis.toUpperCase()}`;

  const line = (values: Float32Array, pass: number, dash?: number[]): Line => ({
    name: timeText(time[pass]!), time: position, values: values.subarray(pass * n, (pass + 1) * n), dash,
    colour: () => {
      const dark = state.dark.value, share = passes > 1 ? pass / (passes - 1) : 0.5;
      return css(viridis(dark ? 0.28 + 0.72 * share : 0.86 * share), pass === now() ? 1 : dash ? 0 : 0.3);
    },
    width: () => (pass === now() ? 2.5 : 1.2),
  });
  const indices = Array.from({length: passes}, (_, i) => i);
  const curves = new Chart({
    x: {label: 'Position / mm', range: stroke}, y: {label: 'Error / µm', range: [low, high]},
    lines: [...indices.map((p) => line(forward, p)), ...indices.map((p) => line(backward, p, [5, 4]))],
    dark: state.dark, height: 280, describe: `${name}: error along the stroke`,
  });
  const words = make('p', {class: 'words'});
  state.time.watch(() => {
    words.textContent = `Strong: the pass at ${timeText(time[now()]!)}; solid forward, dashed backward. Faint: the other passes forward, dark to light with time.`;
    curves.redraw();
  });

  const unit = timeUnitFor(range[1] - range[0]);
  const map = (values: Float32Array, way: string): HTMLElement => new Chart({
    x: {label: `Time / ${unit.unit}`, scale: unit.seconds, range: extent([edgesAround(time)])},
    y: {label: `Position / mm, ${way}`, range: extent([edgesAround(position)])},
    lines: [], time: state.time, dark: state.dark, height: 220, describe: `${name}: map of the error ${way}`,
    ground: cells(edgesAround(time).map((t) => t / unit.seconds), edgesAround(position), (i, j) => {
      const value = values[i * n + j]!;
      return Number.isFinite(value) ? css(viridis((value - low) / (high - low))) : null;
    }),
  }).element;
  const columns = () => [
    {name: 'time_s', values: indices.flatMap((p) => new Array<number>(n).fill(time[p]!))},
    {name: 'position_mm', values: indices.flatMap(() => Array.from(position))},
    {name: 'forward_um', values: forward}, {name: 'backward_um', values: backward},
  ];
  return [
    panel(`${name}: error along the stroke${suffix}`, `positioning_${file}`, columns, curves.element, words),
    panel(`${name}: error over stroke and time${suffix}`, `positioning_map_${file}`, columns, map(forward, 'forward'), map(backward, 'backward'),
      colourBar(gradient(viridis), ticks, 'Error / µm')),
  ];
}
