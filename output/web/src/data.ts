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
  /** Of what was measured: samples farther apart [s] have nothing between them. */
  longest_gap?: number;
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
  /** It went through the same as the reference: their residual tells something. */
  compared: boolean;
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
  standard_error?: number;
  gain: number;
  watts_per_kelvin_of_air?: Record<string, number>;
  runs: {time_s: number[]; watts: number[]; standard_error: number[]}[];
}

/** null: of a channel without readings. */
export interface Gap {
  run: string;
  channel: string;
  unit: string;
  before: number | null;
  after: number | null;
}

/** Of one channel in one part of a run. */
export interface Disagreement {
  run: string;
  channel: string;
  unit: string;
  cut: string;
  part: string;
  mean: number | null;
  rms: number | null;
  power: number | null;
  p_value: number | null;
  significant: boolean;
}

/** How large an effect at a site may be without being named, and how much it moves the channel that it moves most. */
export interface DetectionLimit {
  effect: string;
  site: string;
  parameter: string;
  amplitude: number;
  unit: string;
  any_size: boolean;
  text: string;
  channel: string;
  swing: number;
  swing_unit: string;
}

export interface DiagnosisSection {
  kind: 'diagnosis';
  name: string;
  sentence: string;
  verdict: string;
  effects: Finding[];
  /** Of nothing evident: what has half or more of the evidence that is asked for. */
  suspicion?: {asked: number; effects: Finding[]};
  /** What moves most first; absent in files of earlier versions. */
  could_hide?: DetectionLimit[];
  heat?: FreeHeat;
  where: {body: string; regime: string}[];
  gap: {before: number; after: number};
  gaps: {fitted: Gap[]; held_out: Gap[]};
  disagreement?: {before: Disagreement[]; after: Disagreement[]};
  unaccounted_heat: FreeHeat[];
  /** Of an either/or or a suspicion: a schedule's file, by how many σ it tells, and by how many it should. */
  experiment?: string;
  experiment_distance?: number;
  experiment_wanted_distance?: number;
  estimates: {name: string; estimate: number | null; standard_error: number | null; prior: number | null}[];
  doubts?: {run: string; channel: string; text: string}[];
  remarks: string[];
}

export interface StudyFigure {
  mean: number | null;
  half_width_95: number;
}

export interface StudyCombination {
  world: string;
  selection: string;
  model: string;
  sensors: string[];
  refused: string | null;
  remark: string;
  figures: Record<string, StudyFigure>;
}

export interface StudySection {
  kind: 'study';
  title: string;
  verdict: string[];
  claims: {says: string; world?: string; answer: string; words: string}[];
  remarks: string[];
  worlds: {name: string; machine: string; error: string; unit: string; repetitions: number}[];
  selections: {world: string; selection: string; remark: string; figures: Record<string, StudyFigure>}[];
  combinations: StudyCombination[];
}

export interface SensorSet {
  sensors: {name: string; at: string[]; position_m: [number, number, number]; cost: number; error_without_um: number; idle: boolean}[];
  cost: number;
  model_um: number;
  predicted_um: number;
  unseen_rms_um: number;
  displacements: {name: string; without_sensors_um: number; predicted_um: number; unseen_rms_um: number}[];
  worst_with_dead_sensors_um?: number;
}

export interface PlacementSection {
  kind: 'placement';
  machine: string;
  candidates: number;
  noise_K: number;
  dead: number;
  no_sensor_um: number;
  all_candidates_um: number;
  bound_um: number;
  all_sets_looked_at: boolean;
  recommended: SensorSet;
  one_fewer?: SensorSet;
  one_more?: SensorSet;
  proposed?: SensorSet;
  distinction?: {effects: number; recommended_deg: number; for_displacement_deg: number; all_candidates_deg: number;
    proposed_deg?: number; closest: [string, string]};
  /** The machine, its field going from what one sensor tells alone (0) to beside the recommended ones (1). */
  shape?: Machine | null;
  remarks: string[];
}

/** Components along X, Y and Z. */
export interface Components {
  x: number[];
  y: number[];
  z: number[];
}

export interface VolumeState {
  diagonals_um: Record<string, number>;
  grid_largest_um: number;
  grid_rms_um: number;
}

export interface VolumetricSection {
  kind: 'volumetric';
  travel_mm: [number, number, number];
  compensated_by: string;
  predictions: {method: string; remark: string; rms_um: number; largest_um: number; mape_percent: number | null; training_s: number}[];
  before: VolumeState;
  after: VolumeState;
  reduction: number | null;
  misleading: boolean;
  field?: {points: [number, number, number]; position_mm: Components; before_um: Components; after_um: Components};
  functions?: {axis: string; position_mm: number[]; predicted_um: Components; true_um: Components}[];
  drift: {time_s: number; moved_um: number; uncompensated_um: number; compensated_um: number}[];
  remarks: string[];
}

/** A channel of a campaign: quantiles over its runs at every time (5, 25, 50, 75, 95 %), and each run's last value. */
export interface CampaignChannel {
  name: string;
  unit: string;
  group: 'readings' | 'displacements';
  quantiles?: NumberRef;
  last: NumberRef;
}

export interface CampaignSection {
  kind: 'campaign';
  title: string;
  runs: number;
  failed: number;
  failures: {run: number; reason: string}[];
  time?: NumberRef;
  run: NumberRef;
  channels: CampaignChannel[];
  parameters: {name: string; unit: string; title: string; values: NumberRef}[];
  remarks: string[];
}

/** What a command has done so far. */
export interface ProgressSection {
  kind: 'progress';
  title: string;
  steps: {what: string; share?: number; at_s: number}[];
  done: boolean;
}

export interface PageDocument {
  title: string;
  version: string;
  bytes: number;
  /** Of a page that a program serves and renews: what it has; 0 or absent: from disk. */
  revision?: number;
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
