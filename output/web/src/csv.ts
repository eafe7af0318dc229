/** Numbers of a panel as a table, in the form of `thermotwin export`: `time_s,<name>_<unit>`. */

export interface Column {
  name: string;
  values: ArrayLike<number | null> | string[];
}

/** Seven digits are what single precision holds. */
function cell(value: number | string): string {
  if (typeof value === 'string') return /[",\n]/.test(value) ? `"${value.replaceAll('"', '""')}"` : value;
  return Number.isFinite(value) ? String(+value.toPrecision(7)) : '';
}

export function csv(columns: Column[]): string {
  const rows = Math.max(0, ...columns.map((c) => c.values.length));
  const lines = [columns.map((c) => cell(c.name)).join(',')];
  for (let i = 0; i < rows; ++i) lines.push(columns.map((c) => cell(c.values[i] ?? NaN)).join(','));
  return lines.join('\n') + '\n';
}

export function download(fileName: string, text: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([text], {type: 'text/csv'}));
  link.download = fileName;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
