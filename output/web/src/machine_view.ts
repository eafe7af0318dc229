import {Camera, farthestHit, type Vec} from './camera';
import {css, gradient, viridis, type Rgb} from './colours';
import {extent, valueAt, type Course} from './course';
import type {Machine, Numbers} from './data';
import {colourBar, make} from './dom';
import {SurfaceField} from './field';
import {grouped, roundDown, roundTicks} from './format';
import {Scene} from './scene';
import {SensorMarks} from './sensor_marks';
import type {PageState} from './signal';
import {keepFitted} from './sizes';
import {turntable} from './turntable';
import {visibleTriangles} from './visible';

const factors = (largest: number): number[] => [0, ...[0.2, 0.5, 1, 2, 5].map((m) => roundDown(m * largest * 1.0001))];

/** What the colours stand for, and the words above the picture. */
export interface Look {
  quantity: string;
  caption: (t: number) => string;
  /** The colours go over the values of the time that is shown, and not over those of all times. */
  fitted?: boolean;
}

/** The machine in space: coloured by temperature, deformed, turned with pointer or keys, its parts to be picked. */
export class MachineView {
  readonly element: HTMLElement;
  private readonly stage = make('div', {class: 'stage', tabindex: 0, role: 'application',
    'aria-label': 'The machine in space. Arrow keys turn it, plus and minus zoom, 0 fits it.'});
  /** What is printed: of a picture in space that no screen has shown browsers print nothing. */
  private readonly still = make('canvas', {class: 'still'});
  private readonly caption = make('p', {class: 'caption', 'aria-live': 'off'});
  private readonly rest: Float32Array;
  private readonly triangles: Int32Array;
  private readonly edges: Int32Array;
  private readonly moved: Float32Array;
  private readonly field: SurfaceField | null;
  private range: [number, number];
  private bar: HTMLElement;
  private readonly scene: Scene;
  private readonly camera: Camera;
  private readonly marks: SensorMarks;
  private factor = 0;
  private pending = 0;
  private dirty = {field: true, spots: true};
  private hidden: boolean[] = [];
  private fineness = 1;
  private size = '';
  private slow = 0;
  private settle = 0;

  constructor(private readonly machine: Machine, numbers: Numbers, time: Float32Array,
              private readonly readings: Map<string, Course>, private readonly state: PageState,
              private readonly look: Look) {
    this.rest = numbers.single(machine.points);
    this.triangles = numbers.whole(machine.triangles);
    this.edges = numbers.whole(machine.edges);
    this.moved = new Float32Array(this.rest.length);
    this.field = machine.field ? new SurfaceField(machine.field, numbers, time) : null;
    const ticks = roundTicks(...this.temperatureRange());
    this.range = [ticks[0]!, ticks[ticks.length - 1]!];
    this.scene = new Scene(this.stage, this.rest, this.triangles, this.edges, this.field && this.range);
    this.camera = new Camera(machine.up);
    if (state.view) Object.assign(this.camera, state.view);
    this.marks = new SensorMarks(machine.sensors, state);
    this.stage.append(this.still, this.marks.element, this.caption);
    this.bar = colourBar(gradient(viridis), ticks, look.quantity);
    this.element = make('section', {class: 'machine', 'aria-label': machine.title},
      this.stage,
      make('div', {class: 'controls'}, this.deformationControl(), this.viewButtons()),
      this.bar,
      this.bodyList());
    this.listen();
  }

  private temperatureRange(): [number, number] {
    const field = this.machine.field;
    if (field) return [field.lowest, field.highest];
    return extent(this.machine.sensors.map((s) => this.readings.get(s.name)?.values ?? []));
  }

  private deformationControl(): HTMLElement | null {
    const largest = this.field?.largestDisplacement() ?? 0;
    if (!(largest > 0)) return null;
    const [low, high] = extent([this.rest]);
    const choices = factors((0.05 * Math.hypot(high - low)) / largest);
    this.factor = choices[3]!;
    const text = make('output', {}, `×${grouped(this.factor)}`);
    return make('label', {class: 'deformation'}, 'Deformation', make('input', {
      type: 'range', min: 0, max: choices.length - 1, step: 1, value: 3, 'aria-label': 'Deformation factor',
      oninput: (event) => {
        this.factor = choices[+(event.target as HTMLInputElement).value]!;
        text.textContent = `×${grouped(this.factor)}`;
        this.dirty.spots = true;
        this.refresh();
      },
    }), text);
  }

  private viewButtons(): HTMLElement {
    const views: [string, number, number][] = [['Slant', 36.9, 26.4], ['Front', 0, 0], ['Side', 90, 0], ['Top', 0, 89]];
    return make('div', {class: 'buttons', role: 'group', 'aria-label': 'View'},
      ...views.map(([name, azimuth, elevation]) => make('button', {class: 'quiet', onclick: () => {
        Object.assign(this.camera, {azimuth, elevation});
        this.fit();
      }}, name)),
      make('button', {class: 'quiet', 'aria-label': 'Closer', onclick: () => this.zoom(1 / 1.25)}, '+'),
      make('button', {class: 'quiet', 'aria-label': 'Farther', onclick: () => this.zoom(1.25)}, '−'));
  }

  private bodyList(): HTMLElement {
    const chips = this.machine.bodies.map((body) => make('button', {class: 'chip', 'data-body': body.name,
      onclick: () => this.state.choose({kind: 'body', name: body.name})}, body.name.replaceAll('_', ' ')));
    this.state.selection.watch((selection) => chips.forEach((chip) => chip.setAttribute('aria-pressed',
      String(selection?.kind === 'body' && selection.name === chip.dataset.body))));
    return make('div', {class: 'chips bodies', role: 'group', 'aria-label': 'Bodies'},
      make('span', {class: 'label'}, 'Bodies'), ...chips);
  }

  private listen(): void {
    this.state.time.watch(() => this.refresh());
    this.state.dark.watch((dark) => {
      const ground: Rgb = dark ? [23, 28, 33] : [255, 255, 255], faces: Rgb = dark ? [92, 101, 110] : [206, 211, 215];
      this.scene.paint(ground, faces, dark ? [20, 24, 28] : [235, 238, 240], dark ? [255, 255, 255] : [20, 24, 28]);
      this.refresh();
    });
    this.state.selection.watch((selection) => {
      const body = selection?.kind === 'body' && this.machine.bodies.find((b) => b.name === selection.name);
      this.scene.choose(body ? this.edges.filter((_, i, all) => {
        const point = all[i - (i % 2)]!;
        return point >= body.first_point && point < body.first_point + body.points;
      }) : []);
      this.refresh();
    });
    turntable(this.stage, this.camera, {changed: () => this.viewChanged(), fit: () => this.fit(), pick: (event) => this.pick(event)});
    keepFitted(this.stage, () => this.resized());
  }

  private pick(event: PointerEvent): void {
    const frame = this.stage.getBoundingClientRect();
    const under = this.camera.unproject(event.clientX - frame.left, event.clientY - frame.top, frame.width, frame.height);
    const hit = farthestHit(under, this.camera.towards, this.scene.points, this.triangles);
    const body = hit && this.machine.bodies.find((b) =>
      hit.triangle >= b.first_triangle && hit.triangle < b.first_triangle + b.triangles);
    if (body) this.state.choose({kind: 'body', name: body.name});
    else this.state.selection.value = null;
  }

  private zoom(by: number): void {
    this.camera.scale *= by;
    this.viewChanged();
  }

  private fit(): void {
    this.camera.fit(this.rest, this.stage.clientWidth / Math.max(1, this.stage.clientHeight));
    this.viewChanged();
  }

  private viewChanged(): void {
    const {azimuth, elevation, scale, focus} = this.camera;
    this.state.view = {azimuth, elevation, scale, focus};
    this.dirty.spots = true;
    this.ask();
  }

  private refresh(): void {
    this.dirty.field = true;
    this.ask();
  }

  private resized(): void {
    if (this.stage.clientWidth === 0) return;
    this.fineness = 1;
    if (this.size === '' && this.state.view) this.viewChanged();
    else this.fit();
    cancelAnimationFrame(this.pending);
    this.pending = 0;
    this.draw();
    this.scene.copyTo(this.still);
  }

  /** The picture's pixels; only before a drawing, because it empties the picture. */
  private fitPixels(): void {
    const ratio = this.fineness * Math.min(2, devicePixelRatio), {clientWidth: width, clientHeight: height} = this.stage;
    const size = [width * ratio, height * ratio].map(Math.round).join();
    if (size === this.size) return;
    this.size = size;
    this.scene.resize(width * ratio, height * ratio);
  }

  private ask(): void {
    if (this.pending || this.stage.clientWidth === 0) return;
    const asked = performance.now();
    this.pending = requestAnimationFrame(() => {
      this.pending = 0;
      this.draw();
      this.adapt(performance.now() - asked);
    });
  }

  /** A machine that cannot follow gets fewer pixels while things move, and all of them when they rest. */
  private adapt(took: number): void {
    this.slow = 0.7 * this.slow + 0.3 * Math.min(60, took); // the first drawing is slow anywhere
    if (this.slow > 30 && this.fineness > 0.5) {
      this.fineness /= 1.5;
      this.slow = 20;
    }
    clearTimeout(this.settle);
    this.settle = setTimeout(() => {
      this.fineness = 1;
      this.dirty.spots = true;
      this.draw();
    }, 500) as unknown as number;
  }

  private draw(): void {
    if (!this.element.isConnected) return;
    const t = this.state.time.value;
    if (this.dirty.field) this.showField(t);
    if (this.dirty.spots) this.showVisible();
    this.fitPixels();
    this.scene.draw(this.camera);
    this.placeMarks();
    this.dirty = {field: false, spots: false};
    const coarse = this.fineness < 1 ? ' · fewer pixels while it moves' : '';
    this.caption.textContent = this.look.caption(t) + coarse;
  }

  private showField(t: number): void {
    if (this.field) {
      this.field.temperature(t, this.scene.values);
      this.field.displacement(t, this.moved);
      const points = this.scene.points;
      for (let i = 0; i < points.length; ++i) points[i] = this.rest[i]! + this.factor * this.moved[i]!;
      if (this.look.fitted) this.fitColours();
      this.scene.changed(true);
    }
    const [low, high] = this.range;
    this.marks.colour(this.machine.sensors.map((sensor) => {
      const course = this.readings.get(sensor.name);
      const value = course ? valueAt(course, t) : NaN;
      return Number.isFinite(value) ? css(viridis((value - low) / (high - low))) : 'transparent';
    }));
  }

  private fitColours(): void {
    const ticks = roundTicks(...extent([this.scene.values])), bar = colourBar(gradient(viridis), ticks, this.look.quantity);
    this.range = [ticks[0]!, ticks[ticks.length - 1]!];
    this.scene.spread(this.range);
    this.bar.replaceWith(bar);
    this.bar = bar;
  }

  private showVisible(): void {
    const aspect = this.stage.clientWidth / Math.max(1, this.stage.clientHeight);
    this.scene.show(visibleTriangles(this.camera, this.scene.points, this.triangles, aspect));
  }

  private placeMarks(): void {
    const {clientWidth: width, clientHeight: height} = this.stage;
    const places = this.machine.sensors.map(({position, point}) =>
      position.map((x, i) => x + this.factor * this.moved[3 * point + i]!) as Vec);
    if (this.dirty.spots) {
      const towards = this.camera.towards, near = 0.02 * this.camera.scale;
      this.hidden = places.map((p) => (farthestHit(p, towards, this.scene.points, this.triangles)?.distance ?? 0) > near);
    }
    this.marks.place(places.map((p, i) => {
      const [x, y] = this.camera.project(p, width, height);
      return {x, y, hidden: this.hidden[i] ?? false};
    }), width, height);
  }
}
