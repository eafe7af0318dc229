import {cividis, gradient} from '../colours';
import type {Column} from '../csv';
import type {DetectionLimit, DiagnosisSection, Finding, Gap} from '../data';
import {colourBar, make, panel, trackAxis} from '../dom';
import {minus, orDash, roundTicks, unitText} from '../format';
import type {PageState} from '../signal';
import {disagreementPanel} from './disagreement';
import {freeHeatPanel} from './free_heat';
import {heatCell} from './heat_cell';

const verdicts: Record<string, string> = {
  nothing: 'Nothing evident', effect: 'Effect found', either: 'Either, or', sensor: 'Sensor at fault', none_known: 'None known',
};

const tagOf = ({verdict, heat}: DiagnosisSection): string => (heat ? 'Unknown heat' : verdicts[verdict] ?? verdict);

/** What a diagnosis found, in the order in which one asks: what, how sure, how much better, where else. */
export function diagnosisSection(section: DiagnosisSection, state: PageState): HTMLElement {
  const {before, after} = section.gap;
  const panels = [
    section.effects.length > 0 && candidatesPanel('Candidates and their evidence', 'candidates', section.effects, section),
    section.suspicion && candidatesPanel(`Suspected: evidence below the ${section.suspicion.asked.toFixed(0)} that is asked for`,
      'suspected', section.suspicion.effects, section),
    section.gaps.held_out.length > 0 && gapPanel('Gap on data held out', 'gap_held_out', section.gaps.held_out),
    section.gaps.fitted.length > 0 && gapPanel('Gap on the fitted data', 'gap_fitted', section.gaps.fitted),
    section.disagreement && disagreementPanel(section.disagreement.before, section.disagreement.after),
    residualHeatMap([...section.gaps.fitted, ...section.gaps.held_out]),
    section.heat && freeHeatPanel('Heat that no effect explains', 'unknown_heat', [section.heat], state),
    section.unaccounted_heat.length > 0 && freeHeatPanel('Unaccounted heat, before any effect was added', 'unaccounted_heat',
      section.unaccounted_heat, state),
    section.could_hide && section.could_hide.length > 0 && limitsPanel(section.could_hide),
    estimatesPanel(section),
  ].filter((p) => p !== false && p !== undefined);
  return make('section', {class: 'diagnosis', 'data-kind': 'diagnosis'},
    ...doubtsOf(section).map((words) => make('p', {class: 'remark'}, words)),
    make('div', {class: `verdict ${section.verdict}`},
      make('div', {}, make('p', {class: 'tag'}, tagOf(section)), make('h2', {}, section.sentence)),
      make('dl', {class: 'figures'},
        figure('gap before', size(before)), figure('gap after', size(after)),
        section.verdict !== 'nothing' && before > 0 && figure('left of it', `${((100 * after) / before).toFixed(0)} %`)),
      make('p', {class: 'remark'}, `Gap: root mean square over all channels ${section.gaps.held_out.length ? 'held out' : 'fitted'}, ${unitsOf([...section.gaps.fitted, ...section.gaps.held_out])}; one constant per channel and run taken off.`),
      ...actsOn(section.where).map((words) => make('p', {class: 'remark'}, words))),
    make('div', {class: 'flow'}, ...panels),
    ...section.remarks.map((remark) => make('p', {class: 'remark'}, remark)));
}

/** What speaks against the data, before all that takes them as they are. */
function doubtsOf({doubts = []}: DiagnosisSection): string[] {
  const told = doubts.map(({run, text}) => `${run}: ${text}`);
  return told.length > 0 ? ['Look at the data first; all that follows takes them as they are:', ...told] : [];
}

/** A sentence per body. */
function actsOn(where: DiagnosisSection['where']): string[] {
  const when: Record<string, string> = {moving: 'while the machine moves', standing: 'while it stands'};
  return [...new Set(where.map((w) => w.body))].map((body) =>
    `Missing heat acts on ${body} ${where.filter((w) => w.body === body).map((w) => when[w.regime] ?? w.regime).join(' and ')}.`);
}

/** Of a file, as commands name it. */
const stem = (path: string): string => path.replace(/^.*\//, '').replace(/\.toml$/, '');

const size = (x: number | null): string => orDash(x, (known) => known.toFixed(known < 10 ? 2 : 1));

function figure(label: string, value: string): HTMLElement {
  return make('div', {}, make('dt', {}, label), make('dd', {}, value));
}

function candidatesPanel(title: string, file: string, effects: Finding[],
    {experiment, experiment_distance, experiment_wanted_distance: wanted}: DiagnosisSection): HTMLElement {
  const groups = [...new Set(effects.map((e) => e.group))];
  const lists = groups.map((group) => {
    const all = effects.filter((e) => e.group === group);
    const list = make('ol', {class: 'candidates'}, ...all.map(candidate));
    const apart = all[0]!.separated_by;
    return make('div', {}, all.length > 1 && make('p', {class: 'words'}, `One of ${all.length}; these data do not tell them apart:`),
      list, all.length > 1 && apart && make('p', {class: 'words'}, `What would tell them apart: ${apart}.`));
  });
  return panel(title, file, () => [
    {name: 'effect', values: effects.map((e) => e.effect)}, {name: 'site', values: effects.map((e) => e.site)},
    {name: 'parameter', values: effects.map((e) => e.parameter)}, {name: 'unit', values: effects.map((e) => e.unit)},
    {name: 'amplitude', values: effects.map((e) => e.amplitude)}, {name: 'low', values: effects.map((e) => e.low)},
    {name: 'high', values: effects.map((e) => e.high)}, {name: 'weight', values: effects.map((e) => e.weight)},
    {name: 'two_ln_evidence', values: effects.map((e) => e.strength)},
  ], ...lists, experiment && experiment_distance !== undefined && make('p', {class: 'words'}, `Of the schedules that come with the program, ${
    stem(experiment)} ${effects.length > 1 ? 'does it best: they lie' : 'would show it best:'} ${size(experiment_distance)} σ ${effects.length > 1 ? 'apart there' : 'from nothing'}${wanted !== undefined && experiment_distance < wanted ? `, of ${wanted} that are wanted` : ''}.`));
}

function candidate(effect: Finding): HTMLElement {
  const weight = make('i', {class: 'bar'});
  weight.style.width = `${100 * effect.weight}%`;
  return make('li', {},
    make('p', {class: 'name'}, make('strong', {}, effect.effect.replaceAll('_', ' ')), ` at ${effect.site}`),
    make('p', {class: 'words'}, effect.meaning),
    interval(effect),
    make('div', {class: 'measure'}, make('span', {}, 'weight in its group'), make('span', {class: 'track'}, weight),
      make('span', {class: 'number'}, `${(100 * effect.weight).toFixed(0)} %`)),
    make('p', {class: 'words'}, `2 ln evidence ${effect.strength.toFixed(0)} over a machine without it`));
}

/** The amplitude with its 95 % interval, on an axis that begins or ends at zero where zero is near. */
function interval(effect: Finding): HTMLElement {
  const ticks = roundTicks(Math.min(0, effect.low), Math.max(0, effect.high)), low = ticks[0]!, high = ticks[ticks.length - 1]!;
  const at = (x: number): string => `${(100 * (x - low)) / (high - low)}%`;
  const whisker = make('i', {class: 'whisker'}), point = make('i', {class: 'point'}), zero = make('i', {class: 'zero'});
  whisker.style.left = at(effect.low);
  whisker.style.right = `calc(100% - ${at(effect.high)})`;
  point.style.left = at(effect.amplitude);
  zero.style.left = at(0);
  return make('div', {class: 'measure'}, make('span', {}, `${effect.parameter.replaceAll('_', ' ')}, 95 %`),
    make('span', {class: 'track interval', role: 'img', 'aria-label': effect.text}, zero, whisker, point),
    make('span', {class: 'number'}, amplitudeText(effect.text)));
}

/** With the signs that people write. */
const amplitudeText = (text: string): string =>
  text.replaceAll('-', '−').replace(/\bu(?=m\b|rad\b)/g, 'µ').replace(/(?<=\bm)([23])\b/g, (n) => '²³'[+n - 2]!);

function gapColumns(gaps: Gap[]): Column[] {
  return [
    {name: 'run', values: gaps.map((g) => g.run)}, {name: 'channel', values: gaps.map((g) => g.channel)},
    {name: 'unit', values: gaps.map((g) => g.unit)}, {name: 'before', values: gaps.map((g) => g.before)},
    {name: 'after', values: gaps.map((g) => g.after)},
  ];
}

/** A row per channel: from the ring, before, to the disc, after; neither where nothing was read. */
function gapPanel(title: string, file: string, gaps: Gap[]): HTMLElement {
  const units = [...new Set(gaps.map((g) => g.unit))], runs = [...new Set(gaps.map((g) => g.run))];
  const blocks = runs.flatMap((run) => units.map((unit) => {
    const all = gaps.filter((g) => g.unit === unit), shown = all.filter((g) => g.run === run);
    const ticks = roundTicks(0, Math.max(...all.map((g) => Math.max(g.before ?? 0, g.after ?? 0)))), highest = ticks[ticks.length - 1]!;
    return shown.length > 0 && make('div', {class: 'gap-block'},
      make('p', {class: 'label'}, runs.length > 1 || units.length > 1 ? `${run}, ${unitText(unit)}` : unitText(unit)),
      ...shown.map((gap) => gapRow(gap, highest)), gapAxis(ticks, `RMS / ${unitText(unit)}`));
  }));
  return panel(title, file, () => gapColumns(gaps), make('p', {class: 'key'}, make('span', {}, make('i', {class: 'ring'}), 'before'), make('span', {}, make('i', {class: 'disc'}), 'after')),
  ...blocks);
}

function gapRow({channel, before, after}: Gap, highest: number): HTMLElement {
  const marks = before === null || after === null ? [] : fromTo(before, after, highest);
  return make('div', {class: 'gap-row'}, make('span', {}, channel), make('span', {class: 'track'}, ...marks),
    make('span', {class: 'number'}, marks.length > 0 ? `${size(before)} → ${size(after)}` : '–'));
}

function fromTo(before: number, after: number, highest: number): HTMLElement[] {
  const at = (x: number): string => `${(100 * x) / highest}%`;
  const line = make('i', {class: `link ${after > before ? 'worse' : ''}`}), ring = make('i', {class: 'ring'}), disc = make('i', {class: 'disc'});
  line.style.left = at(Math.min(before, after));
  line.style.width = at(Math.abs(before - after));
  ring.style.left = at(before);
  disc.style.left = at(after);
  return [line, ring, disc];
}

function gapAxis(ticks: number[], label: string): HTMLElement {
  const highest = ticks[ticks.length - 1]!;
  return make('div', {class: 'gap-row'}, make('span', {}), trackAxis(ticks, (tick) => (100 * tick) / highest),
    make('span', {class: 'number label'}, label));
}

/** What one scale for temperatures and displacements counts in. */
function unitsOf(gaps: Gap[]): string {
  return `in units of 0.1 K${gaps.some((g) => g.unit === 'urad') ? ', 1 µm and 1 µrad' : ' and 1 µm'}`;
}

/** Per channel and run, before and after, on one scale. */
function residualHeatMap(gaps: Gap[]): HTMLElement | false {
  if (gaps.length === 0) return false;
  const channels = [...new Set(gaps.map((g) => g.channel))], runs = [...new Set(gaps.map((g) => g.run))];
  const scaled = (gap: Gap, x: number | null): number => (gap.unit === 'K' ? 10 : 1) * (x ?? 0);
  const ticks = roundTicks(0, Math.max(...gaps.map((g) => Math.max(scaled(g, g.before), scaled(g, g.after)))));
  const highest = ticks[ticks.length - 1]!;
  const cell = (gap: Gap | undefined, x: number | null | undefined): HTMLElement => {
    if (!gap || x === null || x === undefined) return make('td', {}, '–');
    return heatCell(scaled(gap, x) / highest, `${x.toPrecision(3)} ${unitText(gap.unit)}`, size(x));
  };
  const rows = channels.map((channel) => {
    const unit = gaps.find((g) => g.channel === channel)!.unit;
    return make('tr', {}, make('th', {scope: 'row'}, `${channel} / ${unitText(unit)}`), ...runs.flatMap((run) => {
      const gap = gaps.find((g) => g.channel === channel && g.run === run);
      return [cell(gap, gap?.before), cell(gap, gap?.after)];
    }));
  });
  return panel('Residual per channel and run, RMS', 'residual_heat_map', () => gapColumns(gaps), make('div', {class: 'scroll'}, make('table', {class: 'heat-map'},
    make('tr', {}, make('td', {}), ...runs.map((run) => make('th', {colspan: 2, scope: 'colgroup'}, run))),
    make('tr', {}, make('td', {}), ...runs.flatMap(() => [make('th', {}, 'before'), make('th', {}, 'after')])), ...rows)),
  colourBar(gradient(cividis), ticks, `RMS ${unitsOf(gaps)}`));
}

/** Of each effect the site at which it moves most. */
function limitsPanel(limits: DetectionLimit[]): HTMLElement {
  const largest = limits.filter((l, i) => limits.findIndex((other) => other.effect === l.effect) === i);
  const rows = largest.map((l) => make('tr', {}, make('th', {scope: 'row'}, `${l.effect.replaceAll('_', ' ')} at ${l.site}`),
    make('td', {}, l.any_size ? 'of any plausible size' : `${l.parameter.replaceAll('_', ' ')} up to ${amplitudeText(l.text)}`),
    make('td', {class: 'number'}, size(l.swing)), make('td', {}, `${unitText(l.swing_unit)} of ${l.channel}`)));
  return panel('What could hide in these data', 'could_hide', () => [
    {name: 'effect', values: limits.map((l) => l.effect)}, {name: 'site', values: limits.map((l) => l.site)},
    {name: 'parameter', values: limits.map((l) => l.parameter)}, {name: 'amplitude', values: limits.map((l) => l.amplitude)},
    {name: 'unit', values: limits.map((l) => l.unit)}, {name: 'any_size', values: limits.map((l) => Number(l.any_size))},
    {name: 'channel', values: limits.map((l) => l.channel)}, {name: 'swing', values: limits.map((l) => l.swing)},
    {name: 'swing_unit', values: limits.map((l) => l.swing_unit)},
  ], make('p', {class: 'words'}, 'Of each effect the site at which it moves most without being named, as calibration takes it for numbers of the file; 19 of 20 such records show more. The CSV has every site.'),
  make('div', {class: 'scroll tall'}, make('table', {}, make('tr', {}, make('th', {}, 'effect'), make('th', {}, 'size'),
    make('th', {class: 'number', colspan: 2}, 'moves in these runs')), ...rows)));
}

function estimatesPanel(section: DiagnosisSection): HTMLElement {
  const estimates = section.estimates;
  const known = estimates.filter((e) => e.standard_error !== null && e.prior !== null && e.standard_error < 0.5 * e.prior);
  const rows = (known.length ? known : estimates).map((e) => make('tr', {}, make('th', {scope: 'row'}, e.name),
    ...[e.estimate, e.standard_error, e.prior].map((x) => make('td', {class: 'number'}, orDash(x, (number) => minus(number.toPrecision(2)))))));
  return panel('Unknowns of the final fit', 'estimates', () => [
    {name: 'name', values: estimates.map((e) => e.name)}, {name: 'estimate', values: estimates.map((e) => e.estimate)},
    {name: 'standard_error', values: estimates.map((e) => e.standard_error)}, {name: 'prior', values: estimates.map((e) => e.prior)},
  ], make('p', {class: 'words'}, `${known.length} of ${estimates.length} are known at least twice as well as before; these are listed, as ln(value/nominal) or in their unit. The CSV holds all.`),
  make('div', {class: 'scroll tall'}, make('table', {}, make('tr', {}, make('th', {}, 'unknown'), make('th', {class: 'number'}, 'estimate'),
    make('th', {class: 'number'}, 'standard error'), make('th', {class: 'number'}, 'prior')), ...rows)));
}
