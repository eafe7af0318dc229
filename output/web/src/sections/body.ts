import {Chart} from '../chart';
import {make, panel} from '../dom';
import type {Machine} from '../data';
import type {BodyCourse} from '../field';
import {timeUnitFor} from '../format';
import type {PageState} from '../signal';

/** The course of the body that is chosen: mean over its volume, between its coldest and hottest place. */
export function bodyPanel(machine: Machine, courses: BodyCourse[], state: PageState, range: [number, number]): HTMLElement {
  const host = make('div', {class: 'body-panel'});
  const time = timeUnitFor(range[1] - range[0]);
  state.selection.watch((selection) => {
    const b = selection?.kind === 'body' ? machine.bodies.findIndex((body) => body.name === selection.name) : -1;
    host.replaceChildren();
    if (b < 0) return;
    const {mean, lowest, highest} = courses[b]!, name = machine.bodies[b]!.name;
    const ink = (): string => (state.dark.value ? '#5ec962' : '#21918c');
    const chart = new Chart({
      x: {label: `Time / ${time.unit}`, scale: time.seconds, range}, y: {label: 'Temperature / °C'},
      lines: [
        {...highest, name: 'highest', colour: () => 'transparent'},
        {...lowest, name: 'lowest', colour: () => 'transparent'},
        {...mean, name: 'mean', colour: ink, width: () => 2},
      ],
      bands: [{between: [0, 1], fill: () => `${ink()}44`}],
      time: state.time, dark: state.dark, height: 170, describe: `Temperature of ${name} over time`,
    });
    host.append(panel(`${name.replaceAll('_', ' ')}: mean, and from coldest to hottest place`, `body_${name}`, () => [
      {name: 'time_s', values: mean.time}, {name: 'mean_degC', values: mean.values},
      {name: 'lowest_degC', values: lowest.values}, {name: 'highest_degC', values: highest.values},
    ], chart.element));
  });
  return host;
}
