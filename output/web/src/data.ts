/** The document that a page carries, as `output/report_page.h` and `twin/report` write it. */

export interface NumberRef {
  type: 'f32' | 'i16' | 'i32';
  at: number;
  shape: number[];
  scales?: number[];
}

export interface Channel {
  name: string;
  unit: string;
  title: string;
  values?: NumberRef;
  constant?: number;
}

export interface Positioning {
  axis: string;
  position_mm: NumberRef;
  time: NumberRef;
  forward_um: NumberRef;
  backward_um: NumberRef;
}

export interface RunSet {
  name: string;
  title: string;
  simulated: boolean;
  complete: boolean;
  time: NumberRef;
  inputs: Channel[];
  readings: Channel[];
  displacements: Channel[];
  heat: Channel[];
  positioning: Positioning[];
  facts: Record<string, string>;
}

export interface Body {
  name: string;
  first_triangle: number;
  triangles: number;
  first_point: number;
  points: number;
}

export interface Sensor {
  name: string;
  title: string;
  position: [number, number, number];
  point: number;
}

export interface Field {
  start: NumberRef;
  courses: NumberRef;
  temperature: NumberRef;
  displacement: NumberRef;
  lowest: number;
  highest: number;
  largest_error: number;
  nodes: number;
  bodies: {mean: NumberRef; lowest: NumberRef; highest: NumberRef};
}

export interface Machine {
  title: string;
  up: [number, number, number];
  set: number;
  points: NumberRef;
  triangles: NumberRef;
  edges: NumberRef;
  bodies: Body[];
  sensors: Sensor[];
  field?: Field;
}

export interface RunsSection {
  kind: 'runs';
  sets: RunSet[];
  machine?: Machine | null;
  remarks: string[];
}

export interface Finding {
  group: number;
  effect: string;
  site: string;
  body: string;
  parameter: string;
  amplitude: number;
  low: number;
  high: number;
  unit: string;
  weight: number;
  strength: number;
  meaning: string;
  separated_by: string;
  text: string;
}

export interface FreeHeat {
  body: string;
  watts: number;
  gain: number;
  runs: {time_s: number[]; watts: number[]; standard_error: number[]}[];
}

export interface Gap {
  run: string;
  channel: string;
  unit: string;
  before: number;
  after: number;
}

export interface DiagnosisSection {
  kind: 'diagnosis';
  name: string;
  sentence: string;
  verdict: string;
  effects: Finding[];
  heat?: FreeHeat;
  where: {body: string; regime: string}[];
  gap: {before: number; after: number};
  gaps: {fitted: Gap[]; held_out: Gap[]};
  unaccounted_heat: FreeHeat[];
  estimates: {name: string; estimate: number; standard_error: number; prior: number}[];
  remarks: string[];
}

export interface PageDocument {
  title: string;
  version: string;
  bytes: number;
  sections: {kind: string}[];
}

/** The numbers of a page, in one piece. */
export class Numbers {
  constructor(private readonly buffer: ArrayBuffer) {}

  single(ref: NumberRef): Float32Array {
    return new Float32Array(this.buffer, ref.at, count(ref));
  }

  whole(ref: NumberRef): Int32Array {
    return new Int32Array(this.buffer, ref.at, count(ref));
  }

  /** Quantised columns as numbers, column after column. */
  columns(ref: NumberRef): Float32Array[] {
    const [columns = 0, rows = 0] = ref.shape;
    const quantised = new Int16Array(this.buffer, ref.at, columns * rows);
    return Array.from({length: columns}, (_, k) => {
      const scale = ref.scales?.[k] ?? 1;
      return Float32Array.from(quantised.subarray(k * rows, (k + 1) * rows), (q) => q * scale);
    });
  }
}

function count(ref: NumberRef): number {
  return ref.shape.reduce((a, b) => a * b, 1);
}

export async function unpack(base64: string): Promise<Numbers> {
  const packed = Uint8Array.from(atob(base64.trim()), (digit) => digit.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Numbers(await new Response(stream).arrayBuffer());
}
