import {Chart, columns} from '../chart';
import type {CampaignChannel, CampaignSection, Numbers} from '../data';
import {make, panel} from '../dom';
import {axisText, minus, roundTicks, timeUnitFor, unitText, valueText} from '../format';
import type {PageState} from '../signal';
import {deviation, mean, rankCorrelation, sorted} from '../statistics';
import {card, remark} from './card';

const shares = ['q05', 'q25', 'q50', 'q75', 'q95'];
const failures_shown = 20;

/** What the runs of a campaign have in common, and what makes them differ. */
export function campaignSection(section: CampaignSection, numbers: Numbers, state: PageState): HTMLElement {
  const host = make('div', {class: 'flow'});
  const channels = section.channels.filter((c) => numbers.single(c.last).some(Number.isFinite));
  const chips = channels.map((channel, i) => make('button', {
    class: 'chip', 'data-channel': channel.name, onclick: () => show(i),
  }, channel.name));

  function show(chosen: number): void {
    chips.forEach((chip, i) => chip.setAttribute('aria-pressed', String(i === chosen)));
    const shown = new Shown(section, channels[chosen]!, numbers, state);
    host.replaceChildren(...shown.panels());
  }
  const first = channels.find((c) => c.name === 'E_Z') ?? channels.find((c) => c.group === 'displacements') ?? channels[0];
  if (first) show(channels.indexOf(first));
  return make('section', {class: 'campaign', 'data-kind': 'campaign'},
    card('Campaign', '', `${section.title}: ${ends(section, numbers, first)}`, [
      ['runs', String(section.runs)], ['failed', String(section.failed)], ['varied', String(section.parameters.length)],
    ], ...section.remarks.map(remark)),
    first && make('div', {class: 'chips', role: 'group', 'aria-label': 'Channel'}, ...chips), host,
    section.failures.length > 0 && failuresPanel(section));
}

/** How many failed, and where the others end: nine in ten of them where there are enough to tell. */
function ends({runs, failed}: CampaignSection, numbers: Numbers, channel: CampaignChannel | undefined): string {
  if (failed === runs) return runs === 1 ? 'its one run failed' : `all ${runs} runs failed`;
  const failures = failed > 0 ? `${failed} of ${runs} runs failed` : '';
  if (!channel) return failures || `${runs} runs`;
  const last = sorted(numbers.single(channel.last)), many = last.length >= 20;
  const at = (share: number): string => valueText(last[Math.round(share * (last.length - 1))]!, channel.unit);
  const where = last.length === 1 ? `at ${at(0)}` : many ? `between ${at(0.05)} and ${at(0.95)}` : `between ${at(0)} and ${at(1)}`;
  const which = failures ? (many ? 'in nine of ten others' : last.length > 1 ? 'in the others' : 'in the other') : many ? 'in nine runs of ten' : runs > 1 ? `in all ${runs} runs` : 'in its one run';
  return `${failures && `${failures}; `}${channel.name} ends ${where} ${unitText(channel.unit)} ${which}`;
}

const quantityOf = (channel: CampaignChannel): string => (channel.group === 'readings' ? 'Temperature' : channel.unit === 'urad' ? 'Rotation' : 'Displacement');

/** One channel of the campaign. */
class Shown {
  private readonly last: Float32Array;
  private readonly run: Int32Array;

  constructor(private readonly section: CampaignSection, private readonly channel: CampaignChannel,
              private readonly numbers: Numbers, private readonly state: PageState) {
    this.last = numbers.single(channel.last);
    this.run = numbers.whole(section.run);
  }

  panels(): HTMLElement[] {
    const courses = this.section.time && this.channel.quantiles ? [this.quantiles()] : [];
    return [...courses, this.histogram(), ...this.section.parameters.map((_, i) => this.against(i))];
  }

  private ink(): string {
    return this.state.dark.value ? '#7ad151' : '#2a788e';
  }

  private axis(): string {
    return axisText(quantityOf(this.channel), this.channel.unit);
  }

  /** Median, half and nine tenths of the runs over time. */
  private quantiles(): HTMLElement {
    const time = this.numbers.single(this.section.time!), all = this.numbers.single(this.channel.quantiles!);
    const course = (i: number): Float32Array => all.subarray(i * time.length, (i + 1) * time.length);
    const range: [number, number] = [time[0] ?? 0, time[time.length - 1] ?? 1], unit = timeUnitFor(range[1] - range[0]);
    const edge = (name: string, i: number) => ({name, time, values: course(i), colour: () => 'transparent'});
    const {name} = this.channel;
    return panel(`${name} over time`, 'quantiles', () => [
      {name: 'time_s', values: time}, ...shares.map((share, i) => ({name: `${name}_${share}_${this.channel.unit}`, values: course(i)})),
    ], new Chart({
      x: {label: `Time / ${unit.unit}`, scale: unit.seconds, range}, y: {label: this.axis()},
      lines: [edge('95 %', 4), edge('5 %', 0), edge('75 %', 3), edge('25 %', 1),
        {name: 'median', time, values: course(2), colour: () => this.ink(), width: () => 2}],
      bands: [{between: [0, 1], fill: () => `${this.ink()}2a`}, {between: [2, 3], fill: () => `${this.ink()}50`}],
      dark: this.state.dark, height: 240, describe: `${name} over time: median, half and nine tenths of the runs`,
    }).element, make('p', {class: 'words'}, 'Line: median. Inner band: half of the runs. Outer band: nine in ten.'));
  }

  /** How many runs end where. */
  private histogram(): HTMLElement {
    const values = sorted(this.last), ticks = roundTicks(values[0] ?? 0, values[values.length - 1] ?? 1);
    const low = ticks[0]!, high = ticks[ticks.length - 1]!, count = Math.max(5, Math.min(40, Math.ceil(Math.sqrt(values.length))));
    const edges = Array.from({length: count + 1}, (_, i) => low + (i / count) * (high - low)), heights = new Array<number>(count).fill(0);
    for (const value of values) ++heights[Math.min(count - 1, Math.floor(((value - low) / (high - low || 1)) * count))]!;
    const {name, unit} = this.channel, difference = unit === 'degC' ? 'K' : unit, looked = this.last.length;
    const counted = values.length < looked ? `${values.length} of ${looked} runs` : looked > 1 ? `${looked} runs` : 'One run';
    const spread = values.length > 1 && `, standard deviation ${valueText(deviation(values), difference)} ${unitText(difference)}`;
    return panel(`${name} at the end`, 'last_values', () => this.table(), new Chart({
      x: {label: this.axis(), range: [low, high]}, y: {label: 'Runs', range: [0, 1.08 * Math.max(1, ...heights)]},
      lines: [], ground: columns(edges, heights, () => `${this.ink()}b0`),
      dark: this.state.dark, height: 200, describe: `How many runs end with ${name} where`,
    }).element, make('p', {class: 'words'}, `${counted}, mean ${valueText(mean(values), unit)} ${unitText(unit)}${spread || ''}.`));
  }

  /** A point per run: the channel's last value over what was varied. */
  private against(parameter: number): HTMLElement {
    const {name: path, unit, values: ref, title} = this.section.parameters[parameter]!, varied = this.numbers.single(ref);
    const order = Array.from(varied.keys()).filter((i) => Number.isFinite(this.last[i]!) && Number.isFinite(varied[i]!)).sort((a, b) => varied[a]! - varied[b]!);
    const x = order.map((i) => varied[i]!), y = order.map((i) => this.last[i]!), {name} = this.channel;
    const low = x[0] ?? 0, high = x[x.length - 1] ?? 1, room = 0.03 * (high - low) || 1;
    const words = title.includes(';') ? title.slice(title.indexOf(';') + 1).trim() : '';
    return panel(`${name} against ${path}`, `against_${path.replace(/\W+/g, '_')}`, () => this.table(), new Chart({
      x: {label: axisText(path, unit), range: [low - room, high + room]}, y: {label: this.axis()},
      lines: [{name, time: x, values: y, colour: () => this.ink(), scattered: true}],
      dark: this.state.dark, height: 220, describe: `${name} at the end over ${path}, a point per run`,
    }).element, make('p', {class: 'words'}, [x.length > 2 && `Rank correlation ${minus(rankCorrelation(x, y).toFixed(2))}.`, words && `${words}.`].filter(Boolean).join(' ')));
  }

  private table(): {name: string; values: ArrayLike<number>}[] {
    return [{name: 'run', values: this.run},
      ...this.section.parameters.map((p) => ({name: p.unit === '1' ? p.name : `${p.name}_${p.unit}`, values: this.numbers.single(p.values)})),
      {name: `${this.channel.name}_last_${this.channel.unit}`, values: this.last}];
  }
}

function failuresPanel(section: CampaignSection): HTMLElement {
  const rows = (most: number): HTMLElement[] => section.failures.slice(0, most).map((f) =>
    make('tr', {}, make('th', {scope: 'row', class: 'number'}, String(f.run)), make('td', {}, f.reason)));
  const body = make('tbody', {}, ...rows(failures_shown)), more = section.failures.length > failures_shown;
  const all = make('button', {class: 'quiet all', onclick: () => {
    body.replaceChildren(...rows(Infinity));
    all.remove();
  }}, `Show all ${section.failures.length}`);
  return panel('Runs that failed', 'failed_runs', () => [
    {name: 'run', values: section.failures.map((f) => f.run)}, {name: 'reason', values: section.failures.map((f) => f.reason)},
  ], make('div', {class: 'scroll'}, make('table', {}, make('thead', {}, make('tr', {}, make('th', {class: 'number'}, 'run'), make('th', {}, 'why'))), body)), more && all);
}
