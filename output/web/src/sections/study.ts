import {make, panel, trackAxis} from '../dom';
import type {StudyCombination, StudyFigure, StudySection} from '../data';
import {roundTicks} from '../format';
import {card, remark, short} from './card';

const shown_first = 20;

const titles: Record<string, string> = {
  'cross.rmse': 'RMSE on unseen runs', 'validation.rmse': 'RMSE in cross-validation', 'self.rmse': 'RMSE on its own runs',
  'cross.mae': 'MAE on unseen runs', 'cross.max': 'Largest on unseen runs', 'cross.r_squared': 'R² on unseen runs',
  'cross.mape': 'MAPE on unseen runs', improvement: 'Better than the reference', S: 'S: residual on its own run',
  Mn: 'Mn: mean residual on other runs', Sd: 'Sd: its spread over them', 'verification.Mn': 'Mn of verification',
  'verification.Sd': 'Sd of verification',
};
const percent = new Set(['cross.mape', 'improvement']), pure = new Set(['cross.r_squared']), more_is_better = new Set(['cross.r_squared', 'improvement']);

/** Which selection with which model predicts best, how sure that is, and what became of the claims. */
export function studySection(section: StudySection): HTMLElement {
  const worlds = [...new Set(section.combinations.map((c) => c.world))];
  const several = worlds.includes('mean of worlds');
  const ordered = several ? ['mean of worlds', ...worlds.filter((w) => w !== 'mean of worlds')] : worlds;
  const [first, ...others] = section.verdict.map(inMicrometres);
  return make('section', {class: 'study', 'data-kind': 'study'},
    card('Study', '', first ?? section.title, [
      ['combinations', String(new Set(section.combinations.map((c) => name(c))).size)],
      [section.worlds.length === 1 ? 'world' : 'worlds', String(section.worlds.length)],
    ], ...others.map(remark)),
    make('div', {class: 'flow'},
      section.claims.length > 0 && claimsPanel(section),
      ...ordered.map((world) => rankingPanel(section, world)),
      ...section.worlds.map((world) => selectionsPanel(section, world.name))),
    ...section.remarks.map(remark));
}

/** The program writes µm without its letter. */
const inMicrometres = (text: string): string => text.replace(/(\d) um\b/g, '$1 µm').replaceAll(' -', ' −');

const name = (row: StudyCombination): string => `${row.selection} + ${row.model}`;

const file = (world: string): string => world.replace(/\W+/g, '_');

function unitOf(section: StudySection, world: string, figure: string): string {
  if (percent.has(figure)) return '%';
  if (pure.has(figure)) return '';
  const unit = section.worlds.find((w) => w.name === world)?.unit ?? section.worlds[0]?.unit ?? '';
  return unit.replace(/^um/, 'µm');
}

function claimsPanel(section: StudySection): HTMLElement {
  const look: Record<string, string> = {holds: 'good', 'does not hold': 'bad'};
  return panel('Claims', 'claims', () => [
    {name: 'claim', values: section.claims.map((c) => c.says)}, {name: 'answer', values: section.claims.map((c) => c.answer)},
    {name: 'words', values: section.claims.map((c) => c.words)},
  ], make('ul', {class: 'claims'}, ...section.claims.map((claim) => make('li', {},
    make('span', {class: `answer ${look[claim.answer] ?? ''}`}, claim.answer), make('span', {}, `${claim.world ? `${claim.world}: ` : ''}“${claim.says}”`),
    make('p', {class: 'words'}, inMicrometres(claim.words))))));
}

/** A row per combination, best first: the mean over the seeds, with its 95 % interval. */
function rankingPanel(section: StudySection, world: string): HTMLElement {
  const rows = section.combinations.filter((c) => c.world === world);
  const figures = Object.keys(titles).filter((f) => rows.some((r) => r.figures[f]?.mean !== undefined && r.figures[f]?.mean !== null));
  const host = make('div', {}), refused = rows.filter((r) => r.refused);
  const chips = figures.map((figure) => make('button', {class: 'chip', 'data-figure': figure, onclick: () => show(figure, shown_first)}, titles[figure]!));

  function show(figure: string, most: number): void {
    figures.forEach((f, i) => chips[i]!.setAttribute('aria-pressed', String(f === figure)));
    const sorted = rows.flatMap((row) => {
      const value = row.figures[figure];
      return value && value.mean !== null ? [{row, value: value as Known}] : [];
    }).sort((a, b) => (more_is_better.has(figure) ? -1 : 1) * (a.value.mean - b.value.mean));
    const visible = sorted.slice(0, most), unit = unitOf(section, world, figure);
    host.replaceChildren(ranking(visible.map((s) => ({name: name(s.row), ...s.value})), unit ? `${titles[figure]} / ${unit}` : titles[figure]!),
      ...(sorted.length > most ? [make('button', {class: 'quiet all', onclick: () => show(figure, Infinity)}, `Show all ${sorted.length}`)] : []));
  }
  if (figures.length) show(figures[0]!, shown_first);
  return panel(`Ranking: ${world}`, `ranking_${file(world)}`, () => [
    {name: 'selection', values: rows.map((r) => r.selection)}, {name: 'model', values: rows.map((r) => r.model)},
    {name: 'refused', values: rows.map((r) => r.refused ?? '')},
    ...figures.flatMap((f) => [{name: f, values: rows.map((r) => r.figures[f]?.mean ?? NaN)},
      {name: `${f}.half_width_95`, values: rows.map((r) => r.figures[f]?.half_width_95 ?? NaN)}]),
  ], make('div', {class: 'chips', role: 'group', 'aria-label': 'Figure'}, ...chips), host,
  refused.length > 0 && make('details', {}, make('summary', {}, `${refused.length} refused`),
    ...refused.map((r) => make('p', {class: 'words'}, `${name(r)}: ${r.refused}`))));
}

interface Known {
  mean: number;
  half_width_95: number;
}

interface Ranked extends Known {
  name: string;
}

/** On an axis of powers of ten where the best and the worst are far apart. */
function ranking(rows: Ranked[], label: string): HTMLElement {
  const values = rows.map((r) => r.mean), least = Math.min(...values), most = Math.max(...values);
  const power = least > 0 && most > 30 * least;
  const ends = rows.flatMap((r) => [r.mean - r.half_width_95, r.mean + r.half_width_95]).filter(Number.isFinite);
  const low = power ? least / 1.5 : Math.min(0, Math.max(least - 2 * Math.abs(most), Math.min(...ends)));
  const high = power ? most * 1.5 : Math.max(0, Math.min(Math.max(...ends), most > 0 ? 1.6 * most : 0)) || 1;
  const share = (x: number): number => {
    const s = power ? Math.log(Math.max(x, 1e-300) / low) / Math.log(high / low) : (x - low) / (high - low);
    return 100 * Math.min(1, Math.max(0, s));
  };
  const ticks = (power ? powersOfTen(low, high) : roundTicks(low, high)).filter((tick) => tick >= low && tick <= high);
  return make('div', {class: 'ranking'}, ...rows.map((row) => {
    const whisker = make('i', {class: 'whisker'}), point = make('i', {class: 'point'});
    whisker.style.left = `${share(row.mean - row.half_width_95)}%`;
    whisker.style.right = `${100 - share(row.mean + row.half_width_95)}%`;
    point.style.left = `${share(row.mean)}%`;
    const text = row.half_width_95 > 0 ? `${short(row.mean)} ± ${short(row.half_width_95)}` : short(row.mean);
    return make('div', {class: 'rank-row'}, make('span', {title: row.name}, row.name.replaceAll('_', ' ')),
      make('span', {class: 'track', role: 'img', 'aria-label': text}, row.half_width_95 > 0 && whisker, point), make('span', {class: 'number'}, text));
  }), make('div', {class: 'rank-row'}, make('span', {}), trackAxis(ticks, share), make('span', {})),
  make('p', {class: 'label'}, `${label}${power ? ', logarithmic' : ''}; whiskers: 95 % over the seeds`));
}

const powersOfTen = (low: number, high: number): number[] =>
  Array.from({length: Math.ceil(Math.log10(high / low)) + 2}, (_, i) => +(10 ** (Math.floor(Math.log10(low)) + i)).toPrecision(1));

const selection_titles: Record<string, string> = {
  count: 'sensors', regret: 'regret', informative: 'informative', found: 'found', rank_correlation: 'rank correlation', switches: 'switches',
};

function selectionsPanel(section: StudySection, world: string): HTMLElement | false {
  const rows = section.selections.filter((s) => s.world === world);
  const figures = Object.keys(selection_titles).filter((f) => rows.some((r) => r.figures[f]?.mean !== undefined && r.figures[f]?.mean !== null));
  if (rows.length === 0 || figures.length === 0) return false;
  const text = (figure: StudyFigure | undefined): string =>
    `${short(figure?.mean)}${figure && figure.half_width_95 > 0 ? ` ± ${short(figure.half_width_95)}` : ''}`;
  return panel(`Selections: ${world}`, `selections_${file(world)}`, () => [
    {name: 'selection', values: rows.map((r) => r.selection)},
    ...figures.map((f) => ({name: f, values: rows.map((r) => r.figures[f]?.mean ?? NaN)})),
  ], make('div', {class: 'scroll'}, make('table', {},
    make('tr', {}, make('th', {}, 'selection'), ...figures.map((f) => make('th', {class: 'number'}, selection_titles[f]!))),
    ...rows.map((row) => make('tr', {}, make('th', {scope: 'row', title: row.remark}, row.selection.replaceAll('_', ' ')),
      ...figures.map((f) => make('td', {class: 'number'}, text(row.figures[f]))))))));
}
