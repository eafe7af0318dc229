// The only file that knows uPlot.
import uPlot from 'uplot';
import {interrupted, type Course} from './course';
import {make} from './dom';
import {minus} from './format';
import {forgetSizes, keepFitted} from './sizes';
import type {Signal} from './signal';

export interface Line extends Course {
  name: string;
  /** Read anew at each drawing: it depends on theme and selection. */
  colour: () => string;
  width?: () => number;
  dash?: number[];
  points?: boolean;
  /** Points only, each by itself. */
  scattered?: boolean;
}

export interface Axis {
  label: string;
  /** Of one unit of the axis: seconds for a time, 1 otherwise. */
  scale?: number;
  range: [number, number];
}

export interface ChartOptions {
  x: Axis;
  y: {label: string; range?: [number, number]; names?: string[]};
  lines: Line[];
  height?: number;
  /** Pairs of lines between which the ground is shaded. */
  bands?: {between: [number, number]; fill: () => string}[];
  /** Draws below the lines. */
  ground?: (u: uPlot) => void;
  /** A vertical line that the pointer moves, in the axis' own numbers. */
  time?: Signal<number>;
  dark: Signal<boolean>;
  describe: string;
}

function styleOf(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** A little more than the values need; a course that stays where it is lies in the middle. */
function roomFor(low: number, high: number): [number, number] {
  if (high - low < 1e-6 * Math.abs(high)) {
    const room = Math.max(1, 0.05 * Math.abs(high));
    return [low - room, high + room];
  }
  return uPlot.rangeNum(low, high, 0.08, true) as [number, number];
}

const pointer = new Set<(x: number | null) => void>();
const charts = new Set<Chart>();

/** Ends every chart of a page that is drawn anew. */
export function forgetCharts(): void {
  forgetSizes();
  for (const chart of charts) chart.end();
  charts.clear();
  pointer.clear();
}

/** Tells where on the common time axis the pointer is, or that it is nowhere. */
export function watchPointer(watcher: (x: number | null) => void): void {
  pointer.add(watcher);
}

/** Lines over a common axis. */
export class Chart {
  readonly element: HTMLElement;
  private plot: uPlot | null = null;
  private readonly host = make('div', {class: 'plot'});
  private readonly now = make('div', {class: 'now'});

  constructor(private readonly options: ChartOptions) {
    this.element = make('div', {class: 'chart', role: 'img', 'aria-label': options.describe}, this.host);
    this.host.style.setProperty('--height', `${options.height ?? 190}px`);
    charts.add(this);
    keepFitted(this.host, () => this.resized());
    options.dark.watch(() => this.redraw());
    options.time?.watch(() => this.placeNow());
  }

  end(): void {
    this.plot?.destroy();
  }

  redraw(): void {
    if (!this.plot) return;
    this.options.lines.forEach((line, i) => {
      this.plot!.series[i + 1]!.width = line.width?.() ?? 1.5;
    });
    this.plot.redraw(false);
  }

  private get xScale(): number {
    return this.options.x.scale ?? 1;
  }

  private resized(): void {
    const width = this.host.clientWidth;
    if (width === 0 || !this.element.isConnected) return;
    const height = this.options.height ?? 190;
    if (this.plot) this.plot.setSize({width, height});
    else this.plot = new uPlot(this.settings(width, height), this.data(), this.host);
    this.plot.over.append(this.now);
    this.placeNow();
  }

  private data(): uPlot.AlignedData {
    const tables = this.options.lines.map(interrupted).map(({time, values}) => [
      time.map((t) => t / this.xScale), values,
    ] as uPlot.AlignedData);
    if (tables.length === 0) return [this.options.x.range.map((t) => t / this.xScale), [null, null]];
    const x = tables[0]![0], shared = tables.every(([own]) => own.length === x.length && own.every((t, i) => t === x[i]));
    return shared ? [x, ...tables.map((t) => t[1]!)] as uPlot.AlignedData : uPlot.join(tables);
  }

  private settings(width: number, height: number): uPlot.Options {
    const {x, y, lines, bands, ground, time} = this.options;
    const ink = (): string => styleOf('--muted'), rule = (): string => styleOf('--rule');
    const font = '12px system-ui, sans-serif', narrow = width < 480;
    const axis = {stroke: ink, font, labelFont: font, labelGap: 0, grid: {stroke: rule, width: 1}, ticks: {stroke: rule, width: 1, size: 4}, gap: 4};
    const numbers = (_: uPlot, splits: number[]): string[] => splits.map((v) => minus(String(+v.toPrecision(10))));
    return {
      width, height, padding: [10, 14, 0, 0],
      legend: {show: false},
      cursor: {drag: {x: false, y: false}, points: {show: false}, y: false, sync: time ? {key: 'time'} : undefined},
      scales: {
        x: {time: false, range: () => x.range.map((t) => t / this.xScale) as [number, number]},
        y: {range: y.range ? () => y.range! : (_, low, high) => roomFor(low ?? 0, high ?? 1)},
      },
      axes: [
        {...axis, label: x.label, size: 30, labelSize: 17, values: numbers, space: 60},
        {...axis, label: y.label, size: narrow ? 44 : 52, labelSize: 18, values: numbers, space: 28,
          ...(y.names ? {
            grid: {show: false}, space: 1,
            splits: () => y.names!.map((_, i) => i + 0.5), values: () => y.names!,
          } : {})},
      ],
      series: [{}, ...(lines.length ? lines : [null]).map((line) => ({
        label: line?.name ?? '',
        stroke: line ? () => line.colour() : undefined,
        width: line?.width?.() ?? 1.5,
        dash: line?.dash,
        points: {show: line?.points ?? line?.scattered ?? false, size: 4, ...(line?.scattered ? {width: 0, size: 5, fill: () => line.colour()} : {})},
        ...(line?.scattered ? {paths: () => null} : line?.held ? {paths: uPlot.paths.stepped!({align: 1})} : {}),
        spanGaps: false,
      }))],
      bands: bands?.map(({between, fill}) => ({series: [between[0] + 1, between[1] + 1], fill})),
      hooks: {
        drawAxes: ground ? [ground] : [],
        setCursor: time ? [(u) => this.pointed(u)] : [],
        ready: [(u) => this.follow(u)],
      },
    };
  }

  private pointed(u: uPlot): void {
    const left = u.cursor.left ?? -1;
    const at = left >= 0 ? u.posToVal(left, 'x') * this.xScale : null;
    for (const watcher of pointer) watcher(at);
  }

  private follow(u: uPlot): void {
    const {time} = this.options;
    if (!time) return;
    const set = (event: PointerEvent): void => {
      const [low, high] = this.options.x.range;
      const x = u.posToVal(event.clientX - u.over.getBoundingClientRect().left, 'x') * this.xScale;
      time.value = Math.min(high, Math.max(low, x));
    };
    u.over.addEventListener('pointerdown', (event) => {
      u.over.setPointerCapture(event.pointerId);
      set(event);
    });
    u.over.addEventListener('pointermove', (event) => {
      if (event.buttons & 1) set(event);
    });
  }

  private placeNow(): void {
    const {time} = this.options;
    if (!this.plot || !time) return;
    this.now.style.transform = `translateX(${this.plot.valToPos(time.value / this.xScale, 'x')}px)`;
  }
}

/** Fills cells between edges of x and y, in the axes' own numbers. */
export function cells(xEdges: number[], yEdges: number[], colour: (column: number, row: number) => string | null):
    (u: uPlot) => void {
  return (u) => {
    const at = (value: number, scale: string): number => Math.round(u.valToPos(value, scale, true));
    u.ctx.save();
    u.ctx.beginPath();
    u.ctx.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
    u.ctx.clip();
    for (let i = 0; i + 1 < xEdges.length; ++i)
      for (let j = 0; j + 1 < yEdges.length; ++j) {
        const fill = colour(i, j);
        if (!fill) continue;
        u.ctx.fillStyle = fill;
        const left = at(xEdges[i]!, 'x'), top = at(yEdges[j + 1]!, 'y');
        u.ctx.fillRect(left, top, at(xEdges[i + 1]!, 'x') - left, at(yEdges[j]!, 'y') - top);
      }
    u.ctx.restore();
  };
}

/** Columns that stand on zero, in the axes' own numbers. */
export function columns(edges: number[], heights: number[], colour: () => string): (u: uPlot) => void {
  return (u) => {
    const at = (value: number, scale: string): number => Math.round(u.valToPos(value, scale, true));
    const gap = Math.max(1, Math.round(devicePixelRatio));
    u.ctx.save();
    u.ctx.fillStyle = colour();
    heights.forEach((height, i) => {
      const left = at(edges[i]!, 'x'), top = at(height, 'y');
      u.ctx.fillRect(left, top, at(edges[i + 1]!, 'x') - left - gap, at(0, 'y') - top);
    });
    u.ctx.restore();
  };
}
