import {Chart} from '../chart';
import type {FreeHeat} from '../data';
import {make, panel} from '../dom';
import {timeUnitFor, valueText} from '../format';
import type {PageState} from '../signal';

const two_sided_95 = 1.96;

/** Heat of unknown course into a body, run by run, with the band in which 95 % of it lies. */
export function freeHeatPanel(title: string, file: string, bodies: FreeHeat[], state: PageState): HTMLElement {
  const host = make('div', {}), buttons = bodies.map((heat, i) => make('button', {class: 'chip', onclick: () => show(i)},
    `${heat.body.replaceAll('_', ' ')}${heat.watts_per_kelvin_of_air ? ', of the air' : ''}, ${meanText(heat)} W on average`));

  function show(chosen: number): void {
    buttons.forEach((button, i) => button.setAttribute('aria-pressed', String(i === chosen)));
    host.replaceChildren(...bodies[chosen]!.runs.map((run, r) => courseOf(run, bodies[chosen]!.runs.length > 1 ? `Run ${r + 1}` : '', state)));
  }
  show(0);
  const rows = bodies.flatMap((heat) => heat.runs.flatMap((run, r) => run.time_s.map((t, i) =>
    ({body: heat.body, run: r + 1, t, watts: run.watts[i]!, error: run.standard_error[i]!}))));
  return panel(title, file, () => [
    {name: 'body', values: rows.map((x) => x.body)}, {name: 'run', values: rows.map((x) => x.run)},
    {name: 'time_s', values: rows.map((x) => x.t)}, {name: 'heat_W', values: rows.map((x) => x.watts)},
    {name: 'standard_error_W', values: rows.map((x) => x.error)},
  ], make('div', {class: 'chips'}, ...buttons), host,
  make('p', {class: 'words'}, 'Shaded: where the heat lies with 95 % probability.'));
}

/** "−1.8 ± 8.5", with half of the 95 % interval. */
function meanText({watts, standard_error}: FreeHeat): string {
  return valueText(watts, 'W') + (standard_error === undefined ? '' : ` ± ${valueText(two_sided_95 * standard_error, 'W')}`);
}

function courseOf(run: FreeHeat['runs'][number], name: string, state: PageState): HTMLElement {
  const time = run.time_s, range: [number, number] = [time[0] ?? 0, time[time.length - 1] ?? 1], unit = timeUnitFor(range[1] - range[0]);
  const shifted = (sign: number): number[] => run.watts.map((w, i) => w + sign * two_sided_95 * run.standard_error[i]!);
  const ink = (): string => (state.dark.value ? '#7ad151' : '#2a788e');
  return make('div', {}, name && make('p', {class: 'label'}, name), new Chart({
    x: {label: `Time / ${unit.unit}`, scale: unit.seconds, range}, y: {label: 'Heat / W'},
    lines: [
      {name: 'high', time, values: shifted(1), colour: () => 'transparent'},
      {name: 'low', time, values: shifted(-1), colour: () => 'transparent'},
      {name: 'heat', time, values: run.watts, colour: ink, width: () => 2},
    ],
    bands: [{between: [0, 1], fill: () => `${ink()}3a`}],
    dark: state.dark, height: 160, describe: 'Unknown heat over time, with its 95 % band',
  }).element);
}
