import type {Sensor} from './data';
import {make} from './dom';
import type {PageState} from './signal';

interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

const overlap = (a: Box, b: Box): boolean =>
  a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;

/** Places around a dot where its name can stand, best first: beside it, or farther out, where a line leads to it. */
const beside = 8;
const offsets = (width: number): [number, number][] =>
  [[9, -9], [-9 - width, -9], [-width / 2, -27], [-width / 2, 9], [9, -24], [9, 6], [-9 - width, -24], [-9 - width, 6],
    ...[45, 60, 75, 90, 105].flatMap((far) => Array.from({length: 16}, (_, i): [number, number] =>
      [far * Math.cos((i * Math.PI) / 8) - width / 2, far * Math.sin((i * Math.PI) / 8) - 9]))];

export interface Spot {
  x: number;
  y: number;
  hidden: boolean;
}

/** Buttons over the machine, one per sensor: a dot in the colour of its reading, and its name where there is room. */
export class SensorMarks {
  readonly element = make('div', {class: 'marks-layer'});
  private readonly buttons: HTMLButtonElement[];
  private readonly names: HTMLElement[];
  private readonly leaders: HTMLElement[];

  constructor(private readonly sensors: Sensor[], state: PageState) {
    this.names = sensors.map((sensor) => make('span', {class: 'name'}, sensor.name));
    this.leaders = sensors.map(() => make('i', {class: 'leader'}));
    this.buttons = sensors.map((sensor, i) => make('button', {
      class: 'sensor', title: `${sensor.name}: ${sensor.title}`, 'aria-label': `Sensor ${sensor.name}, ${sensor.title}`,
      onclick: () => state.choose({kind: 'sensor', name: sensor.name}),
    }, this.leaders[i], make('span', {class: 'dot'}), this.names[i]));
    this.element.append(...this.buttons);
    state.selection.watch((selection) => sensors.forEach((sensor, i) =>
      this.buttons[i]!.setAttribute('aria-pressed', String(selection?.kind === 'sensor' && selection.name === sensor.name))));
  }

  place(spots: Spot[], width: number, height: number): void {
    const taken: Box[] = spots.map(({x, y}) => ({x: x - 6, y: y - 6, width: 12, height: 12}));
    const chosen = (i: number): boolean => this.buttons[i]!.getAttribute('aria-pressed') === 'true';
    const order = spots.map((_, i) => i).sort((a, b) =>
      Number(chosen(b)) - Number(chosen(a)) || Number(spots[a]!.hidden) - Number(spots[b]!.hidden));
    for (const i of order) {
      const {x, y, hidden} = spots[i]!, size = 7.5 * this.sensors[i]!.name.length + 8;
      const boxes = offsets(size).map(([dx, dy]) => ({x: x + dx, y: y + dy, width: size, height: 18}));
      const box = boxes.find((b) => b.x > 0 && b.y > 0 && b.x + size < width && b.y + 18 < height && !taken.some((t) => overlap(t, b)));
      if (box) taken.push(box);
      this.buttons[i]!.style.transform = `translate(${x}px,${y}px)`;
      this.buttons[i]!.classList.toggle('behind', hidden);
      this.names[i]!.hidden = !box;
      this.leaders[i]!.hidden = !box || boxes.indexOf(box) < beside;
      if (!box) continue;
      this.names[i]!.style.transform = `translate(${box.x - x}px,${box.y - y}px)`;
      const across = box.x + size / 2 - x, down = box.y + 9 - y;
      this.leaders[i]!.style.width = `${Math.hypot(across, down)}px`;
      this.leaders[i]!.style.transform = `rotate(${Math.atan2(down, across)}rad)`;
    }
  }

  colour(colours: string[]): void {
    colours.forEach((colour, i) => this.buttons[i]!.style.setProperty('--reading', colour));
  }
}
