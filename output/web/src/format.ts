/** Numbers, units and times as people read them. */

const symbols: Record<string, string> = {degC: '°C', um: 'µm', urad: 'µrad', '1': '', 'W/K': 'W/K'};

export function unitText(unit: string): string {
  return symbols[unit] ?? unit;
}

/** "Temperature / °C": a quantity with the unit of its numbers. */
export function axisText(quantity: string, unit: string): string {
  const text = unitText(unit);
  return text ? `${quantity} / ${text}` : quantity;
}

/** Of a channel whose numbers are states: "…: 0 waiting, 1 good" says which is which. */
export function statesOf(title: string): Map<number, string> {
  const list = /: (\d+ \w+(?:, \d+ \w+)+)$/.exec(title)?.[1]?.split(', ') ?? [];
  return new Map(list.map((entry) => [parseInt(entry, 10), entry.replace(/^\d+ /, '')]));
}

/** Decimals that tell apart what differs by `step`. */
export function decimalsFor(step: number): number {
  return Math.min(6, Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
}

/**
 * With digits that suit the unit: 0.01 for temperatures, 0.1 for micrometres; two digits of what is smaller, down to a
 * thousandth of that, where single precision ends.
 */
export function valueText(value: number, unit: string): string {
  if (!Number.isFinite(value)) return '–';
  const usual = unit === 'degC' || unit === 'K' ? 2 : unit === 'um' || unit === 'urad' || unit === 'W' ? 1 : 0;
  const size = Math.abs(value), decimals = usual === 0 && size < 10 && value % 1 !== 0 ? 2 : usual, digit = 10 ** -decimals;
  return minus(size < digit && size > 1e-3 * digit ? value.toPrecision(2) : value.toFixed(decimals));
}

/** As `write` has it; a dash where nobody knows the number, which JSON then has as null. */
export function orDash(x: number | null | undefined, write: (x: number) => string): string {
  return Number.isFinite(x) ? write(x!) : '–';
}

export function minus(text: string): string {
  return /^-0(\.0*)?$/.test(text) ? text.slice(1) : text.replace('-', '−');
}

/** "2 h 35 min", "12 min 30 s", "45 s". */
export function timeText(seconds: number): string {
  const s = Math.round(seconds);
  if (s < 60) return `${s} s`;
  if (s < 3600) return s % 60 ? `${Math.floor(s / 60)} min ${s % 60} s` : `${s / 60} min`;
  return `${Math.floor(s / 3600)} h ${String(Math.floor((s % 3600) / 60)).padStart(2, '0')} min`;
}

/** The unit in which a run's time is drawn. */
export interface TimeUnit {
  unit: string;
  seconds: number;
}

export function timeUnitFor(duration: number): TimeUnit {
  if (duration >= 2 * 3600) return {unit: 'h', seconds: 3600};
  if (duration >= 180) return {unit: 'min', seconds: 60};
  return {unit: 's', seconds: 1};
}

/** Round numbers, four to nine of them, that enclose [low, high]. */
export function roundTicks(low: number, high: number): number[] {
  const span = high - low || Math.abs(high) || 1;
  const power = 10 ** Math.floor(Math.log10(span / 4));
  const step = [1, 2, 2.5, 5, 10].map((m) => m * power).find((s) => span / s <= 7) ?? 10 * power;
  const first = Math.floor(low / step + 1e-9), last = Math.ceil(high / step - 1e-9);
  return Array.from({length: Math.max(1, last - first) + 1}, (_, i) => +((first + i) * step).toPrecision(12));
}

/** 1, 2 or 5 times a power of ten, the largest that is not above x > 0. */
export function roundDown(x: number): number {
  const power = 10 ** Math.floor(Math.log10(x) + 1e-12);
  return (x / power >= 5 - 1e-9 ? 5 : x / power >= 2 - 1e-9 ? 2 : 1) * power;
}

export function grouped(x: number): string {
  return x.toLocaleString('en-US', {maximumFractionDigits: 2});
}
