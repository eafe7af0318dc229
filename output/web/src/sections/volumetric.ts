import {ArrowView, type Arrow} from '../arrow_view';
import {Camera, type Vec} from '../camera';
import {Chart} from '../chart';
import {gradient, setColours, viridisLines} from '../colours';
import {extent} from '../course';
import {colourBar, make, panel, trackAxis} from '../dom';
import type {Components, VolumetricSection} from '../data';
import {grouped, orDash, roundDown, roundTicks, timeUnitFor} from '../format';
import type {PageState} from '../signal';
import {card, remark, short} from './card';

const most_arrows = 6, axes = ['x', 'y', 'z'] as const;

/** The error in the volume before and after its compensation, and how it was found. */
export function volumetricSection(section: VolumetricSection, state: PageState): HTMLElement {
  const {before, after} = section;
  return make('section', {class: 'volumetric', 'data-kind': 'volumetric'},
    card('Error in the volume', section.misleading ? 'none_known' : 'nothing',
      `Compensation takes the largest error in the volume from ${short(before.grid_largest_um)} to ${short(after.grid_largest_um)} µm.`, [
        ['RMS before', `${short(before.grid_rms_um)} µm`], ['RMS after', `${short(after.grid_rms_um)} µm`],
        ['largest, less by', orDash(section.reduction, (x) => `${(100 * x).toFixed(0)} %`)]], ...section.remarks.map(remark)),
    section.field ? fieldPanel(section.field, state) : remark('No field is drawn: this file holds none.'),
    make('div', {class: 'flow'}, diagonalsPanel(section), ...(section.functions ?? []).map((f) => functionsPanel(f, state)),
      section.drift.length > 0 && driftPanel(section, state), predictionsPanel(section)));
}

function arrowsOf(places: Components, vectors: Components, points: [number, number, number]): Arrow[] {
  const kept = points.map((n) => {
    const stride = Math.max(1, Math.ceil((n - 1) / (most_arrows - 1))), count = Math.floor((n - 1) / stride) + 1;
    return Array.from({length: count}, (_, i) => (count > 1 ? Math.floor(((n - 1) * i) / (count - 1)) : 0));
  });
  const at = (all: Components, i: number): Vec => [all.x[i]!, all.y[i]!, all.z[i]!];
  return kept[2]!.flatMap((k) => kept[1]!.flatMap((j) => kept[0]!.map((i) => {
    const index = (k * points[1] + j) * points[0] + i, along = at(vectors, index);
    return {at: at(places, index), along, length: Math.hypot(...along)};
  })));
}

function fieldPanel(field: NonNullable<VolumetricSection['field']>, state: PageState): HTMLElement {
  const camera = new Camera([0, 0, 1]), span = axes.map((axis) => extent([field.position_mm[axis]]));
  const box = {low: span.map(([low]) => low) as Vec, high: span.map(([, high]) => high) as Vec};
  const sets = [field.before_um, field.after_um].map((v) => arrowsOf(field.position_mm, v, field.points));
  const largest = Math.max(...sets[0]!.map((a) => a.length), 1e-9), ticks = roundTicks(0, largest);
  const diagonal = Math.hypot(...box.high.map((h, i) => h - box.low[i]!)), magnification = roundDown((0.2 * diagonal) / largest);
  const views = sets.map((arrows, i): ArrowView => new ArrowView({
    title: i ? 'Compensated' : 'As it is', arrows, box, camera, magnification, longest: ticks[ticks.length - 1]!,
    changed: () => views.forEach((view) => view.draw()),
  }));
  state.dark.watch(() => views.forEach((view) => view.draw()));
  const {position_mm: at, before_um: was, after_um: is} = field;
  return panel('Error field', 'field', () => [
    ...axes.map((a) => ({name: `${a}_mm`, values: at[a]})), ...axes.map((a) => ({name: `e${a}_before_um`, values: was[a]})),
    ...axes.map((a) => ({name: `e${a}_after_um`, values: is[a]})),
  ], make('div', {class: 'two-stages'}, ...views.map((view) => view.element)),
  colourBar(gradient(viridisLines), ticks, 'Error / µm'),
  make('p', {class: 'words'}, `True error of the tool against the workpiece, without the rigid motion that fits it best; ${grouped(1e3 * magnification)} times as long as it is${
    sets[0]!.length < at.x.length ? `; ${sets[0]!.length} of ${grouped(at.x.length)} arrows, the CSV has all` : ''}.`));
}

function diagonalsPanel({before, after}: VolumetricSection): HTMLElement {
  const rows: [string, number, number][] = [...Object.entries(before.diagonals_um).map(([name, x]): [string, number, number] => [`diagonal ${name}`, x, after.diagonals_um[name]!]),
    ['volume', before.grid_largest_um, after.grid_largest_um], ['volume, RMS', before.grid_rms_um, after.grid_rms_um]];
  const ticks = roundTicks(0, Math.max(...rows.flatMap(([, a, b]) => [a, b]))), highest = ticks[ticks.length - 1]!;
  const at = (x: number): string => `${(100 * x) / highest}%`;
  return panel('Largest error before and after', 'diagonals', () => [
    {name: 'where', values: rows.map(([n]) => n)}, {name: 'before_um', values: rows.map(([, x]) => x)}, {name: 'after_um', values: rows.map(([, , x]) => x)},
  ], make('p', {class: 'key'}, make('span', {}, make('i', {class: 'ring'}), 'before'), make('span', {}, make('i', {class: 'disc'}), 'after')),
  ...rows.map(([name, was, is]) => {
    const link = make('i', {class: `link ${is > was ? 'worse' : ''}`}), ring = make('i', {class: 'ring'}), disc = make('i', {class: 'disc'});
    [link.style.left, link.style.width, ring.style.left, disc.style.left] = [at(Math.min(was, is)), at(Math.abs(was - is)), at(was), at(is)];
    return make('div', {class: 'gap-row broad'}, make('span', {}, name), make('span', {class: 'track'}, link, ring, disc),
      make('span', {class: 'number'}, `${short(was)} → ${short(is)}`));
  }), axisRow(ticks, highest));
}

function axisRow(ticks: number[], highest: number): HTMLElement {
  return make('div', {class: 'gap-row broad'}, make('span', {}), trackAxis(ticks, (tick) => (100 * tick) / highest),
    make('span', {class: 'number label'}, 'µm'));
}

function functionsPanel(f: NonNullable<VolumetricSection['functions']>[number], state: PageState): HTMLElement {
  const colour = (i: number): string => setColours(4, state.dark.value)[i + 1]!;
  const pick = (set: Components, dash?: number[]) => axes.map((a, i) => ({name: a, time: f.position_mm, values: set[a], dash, colour: () => colour(i)}));
  const swatches = axes.map((a, i) => {
    const line = make('i', {class: 'line-solid'});
    state.dark.watch(() => {
      line.style.borderColor = colour(i);
    });
    return make('span', {}, line, `along ${a.toUpperCase()}`);
  });
  return panel(`Error along ${f.axis}`, `functions_${f.axis}`, () => [
    {name: 'position_mm', values: f.position_mm}, ...axes.map((a) => ({name: `e${a}_predicted_um`, values: f.predicted_um[a]})),
    ...axes.map((a) => ({name: `e${a}_true_um`, values: f.true_um[a]})),
  ], new Chart({
    x: {label: `${f.axis} / mm`, range: extent([f.position_mm])}, y: {label: 'Error / µm'},
    lines: [...pick(f.predicted_um), ...pick(f.true_um, [5, 4])], dark: state.dark, height: 190, describe: `Identified and true error along ${f.axis}`,
  }).element, make('p', {class: 'key'}, ...swatches, make('span', {}, 'solid: identified; dashed: true')),
  make('p', {class: 'words'}, 'The true errors are turned, as a whole, to where the identified ones have the workpiece: the diagonals do not show how it lies.'));
}

function driftPanel({drift}: VolumetricSection, state: PageState): HTMLElement {
  const time = drift.map((d) => d.time_s), range = extent([time]), unit = timeUnitFor(range[1] - range[0]);
  const lines: [string, number[]][] = [['moved since measured', drift.map((d) => d.moved_um)], ['machine', drift.map((d) => d.uncompensated_um)],
    ['compensated', drift.map((d) => d.compensated_um)]];
  const colour = (i: number): string => setColours(4, state.dark.value)[i + 1]!;
  return panel('Drift of the volume over the run', 'drift', () => [
    {name: 'time_s', values: time}, ...lines.map(([name, values]) => ({name: `${name.replaceAll(' ', '_')}_um`, values})),
  ], new Chart({
    x: {label: `Time / ${unit.unit}`, scale: unit.seconds, range}, y: {label: 'Largest error / µm'},
    lines: lines.map(([name, values], i) => ({name, time, values, colour: () => colour(i)})), dark: state.dark, height: 190,
    describe: 'Largest error in the volume over the run',
  }).element, make('p', {class: 'key'}, ...lines.map(([name], i) => {
    const line = make('i', {class: 'line-solid'});
    state.dark.watch(() => {
      line.style.borderColor = colour(i);
    });
    return make('span', {}, line, name);
  })));
}

function predictionsPanel(section: VolumetricSection): HTMLElement {
  const all = section.predictions;
  return panel('Prediction between the measured points', 'predictions', () => [
    {name: 'method', values: all.map((p) => p.method)}, {name: 'rms_um', values: all.map((p) => p.rms_um)},
    {name: 'largest_um', values: all.map((p) => p.largest_um)}, {name: 'mape_percent', values: all.map((p) => p.mape_percent)},
  ], make('div', {class: 'scroll'}, make('table', {}, make('tr', {}, make('th', {}, 'method'),
    ...['RMS / µm', 'largest / µm', 'MAPE / %'].map((t) => make('th', {class: 'number'}, t))),
  ...all.map((p) => make('tr', {}, make('th', {scope: 'row'}, p.method.replaceAll('_', ' '), p.method === section.compensated_by && ' (compensates)'),
    ...[p.rms_um, p.largest_um, p.mape_percent].map((x) => make('td', {class: 'number'}, short(x))))))));
}
