import {dot, type Camera, type Vec} from './camera';
import {css, viridisLines} from './colours';
import {make} from './dom';
import {keepFitted} from './sizes';
import {turntable} from './turntable';

/** Vectors at points, in the unit in which people read each. */
export interface Arrow {
  at: Vec;
  along: Vec;
  length: number;
}

export interface ArrowOptions {
  title: string;
  arrows: Arrow[];
  box: {low: Vec; high: Vec};
  camera: Camera;
  /** Length on the picture over length of the vector. */
  magnification: number;
  /** The vector that has the last colour. */
  longest: number;
  /** Told when the camera has moved, for those who share it. */
  changed: () => void;
}

const theme = (name: string): string => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** Arrows in a box, turned with pointer or keys. */
export class ArrowView {
  readonly element: HTMLElement;
  private readonly canvas = make('canvas', {});
  private pending = 0;

  constructor(private readonly options: ArrowOptions) {
    this.element = make('div', {class: 'stage arrows', tabindex: 0, role: 'application',
      'aria-label': `${options.title}. Arrow keys turn it, plus and minus zoom, 0 fits it.`},
    this.canvas, make('p', {class: 'caption'}, options.title));
    turntable(this.element, options.camera, {changed: options.changed, fit: () => this.fit()});
    keepFitted(this.element, () => {
      this.fit();
      this.paint();
    });
  }

  draw(): void {
    this.pending ||= requestAnimationFrame(() => {
      this.pending = 0;
      this.paint();
    });
  }

  private fit(): void {
    const {low, high} = this.options.box;
    this.options.camera.fit(corners(low, high).flat(), this.element.clientWidth / Math.max(1, this.element.clientHeight));
    this.options.camera.scale *= 1.12;
  }

  private paint(): void {
    const {clientWidth: width, clientHeight: height} = this.element, ratio = Math.min(2, devicePixelRatio);
    const context = this.canvas.getContext('2d');
    if (!context || width === 0) return;
    [this.canvas.width, this.canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
    context.scale(ratio, ratio);
    this.paintBox(context, width, height);
    const {arrows, camera, magnification, longest} = this.options, towards = camera.towards;
    context.lineWidth = 1.8;
    for (const {at, along, length} of [...arrows].sort((a, b) => dot(a.at, towards) - dot(b.at, towards))) {
      const tip = at.map((x, i) => x + magnification * along[i]!) as Vec;
      context.strokeStyle = context.fillStyle = css(viridisLines(length / longest));
      paintArrow(context, camera.project(at, width, height), camera.project(tip, width, height));
    }
  }

  /** Each axis is named at the outermost of its edges, near its far end, the lower of two. */
  private paintBox(context: CanvasRenderingContext2D, width: number, height: number): void {
    const {box, camera} = this.options, at = (p: Vec): [number, number] => camera.project(p, width, height);
    const all = corners(box.low, box.high);
    context.strokeStyle = theme('--rule');
    context.fillStyle = theme('--muted');
    context.font = '12px system-ui, sans-serif';
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    const edges = all.flatMap((a, i) => [1, 2, 4].flatMap((bit, axis) => (i & bit ? [] : [{axis, from: a, to: all[i | bit]!}])));
    for (const {from, to} of edges) {
      context.beginPath();
      context.moveTo(...at(from));
      context.lineTo(...at(to));
      context.stroke();
    }
    const centre = at(box.low.map((x, i) => (x + box.high[i]!) / 2) as Vec);
    for (let axis = 0; axis < 3; ++axis) {
      const names = edges.filter((e) => e.axis === axis).map(({from, to}) => {
        const [x, y] = at(from.map((x, i) => 0.2 * x + 0.8 * to[i]!) as Vec), [dx, dy] = [x - centre[0], y - centre[1]];
        return {x, y, dx, dy, away: Math.hypot(dx, dy)};
      });
      const {x, y, dx, dy, away} = names.reduce((a, b) => (b.away + b.dy > a.away + a.dy ? b : a));
      const text = `${'XYZ'[axis]} ${+box.high[axis]!.toFixed(1)} mm`;
      const half = context.measureText(text).width / 2, beside = x + (dx / away) * (8 + half);
      context.fillText(text, Math.min(width - half - 2, Math.max(half + 2, beside)), y + (dy / away) * 16);
    }
  }
}

/** Of a box: the bits of a corner's number say which side of each axis. */
function corners(low: Vec, high: Vec): Vec[] {
  return Array.from({length: 8}, (_, i) => low.map((x, axis) => (i & (1 << axis) ? high[axis]! : x)) as Vec);
}

function paintArrow(context: CanvasRenderingContext2D, [x, y]: [number, number], [tipX, tipY]: [number, number]): void {
  const length = Math.hypot(tipX - x, tipY - y);
  if (length < 2) {
    context.fillRect(x - 1.2, y - 1.2, 2.4, 2.4);
    return;
  }
  const [ux, uy] = [(tipX - x) / length, (tipY - y) / length], head = Math.min(9, 0.5 * length);
  context.beginPath();
  context.moveTo(x, y);
  context.lineTo(tipX - 0.8 * head * ux, tipY - 0.8 * head * uy);
  context.stroke();
  context.beginPath();
  context.moveTo(tipX, tipY);
  context.lineTo(tipX - head * (ux + 0.42 * uy), tipY - head * (uy - 0.42 * ux));
  context.lineTo(tipX - head * (ux - 0.42 * uy), tipY - head * (uy + 0.42 * ux));
  context.fill();
}
