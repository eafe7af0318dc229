import {cividis, gradient} from '../colours';
import type {Disagreement} from '../data';
import {colourBar, make, panel} from '../dom';
import {minus, orDash, unitText} from '../format';
import {heatCell} from './heat_cell';

const cuts: Record<string, string> = {regime: 'by regime', speed: 'by speed', time: 'over time'};
const largest_power = 100;

const key = (d: Disagreement): string => `${d.run} ${d.channel} ${d.cut} ${d.part}`;

/** Where and when the calibrated twin disagrees: the mean residual, on the colour of its power beside the noise. */
export function disagreementPanel(before: Disagreement[], after: Disagreement[]): HTMLElement {
  const left = new Map(after.map((d) => [key(d), d]));
  const shown = Object.keys(cuts).filter((cut) => before.some((d) => d.cut === cut));
  const told = make('p', {class: 'words told', 'aria-live': 'polite'});
  const host = make('div', {class: 'scroll', onclick: (event) => {
    told.textContent = (event.target as Element).closest<HTMLElement>('.cell')?.title ?? '';
  }});
  const chips = shown.map((cut) => make('button', {class: 'chip', 'data-cut': cut, onclick: () => show(cut)}, cuts[cut]!));
  const show = (cut: string): void => {
    told.textContent = '';
    shown.forEach((c, i) => chips[i]!.setAttribute('aria-pressed', String(c === cut)));
    const parts = before.filter((d) => d.cut === cut), runs = [...new Set(parts.map((d) => d.run))];
    host.replaceChildren(...(cut === 'time' ? runs.map((run) => table(parts.filter((d) => d.run === run), left)) : [table(parts, left)]));
  };
  show(shown[0]!);
  return panel('Where and when the calibrated twin disagrees', 'disagreement', () => [
    {name: 'run', values: before.map((d) => d.run)}, {name: 'channel', values: before.map((d) => d.channel)},
    {name: 'unit', values: before.map((d) => d.unit)}, {name: 'cut', values: before.map((d) => d.cut)},
    {name: 'part', values: before.map((d) => d.part)}, {name: 'mean', values: before.map((d) => d.mean)},
    {name: 'rms', values: before.map((d) => d.rms)}, {name: 'power', values: before.map((d) => d.power)},
    {name: 'p_value', values: before.map((d) => d.p_value)}, {name: 'significant', values: before.map((d) => Number(d.significant))},
    {name: 'power_after', values: before.map((d) => left.get(key(d))?.power ?? NaN)},
  ], make('div', {class: 'chips'}, ...chips), host, told,
  colourBar(gradient(cividis), [0, 0.5, 1, 1.5, 2], 'log₁₀ of the power of the residual; noise alone: 0'),
  make('p', {class: 'words'}, 'Mean of measured minus twin, before any effect was added. Bold: significant at a rate of false discoveries of 1 %. Point at a number or touch it for its power, before and after.'));
}

function table(all: Disagreement[], left: Map<string, Disagreement>): HTMLElement {
  const runs = [...new Set(all.map((d) => d.run))], channels = [...new Set(all.map((d) => d.channel))];
  const parts = runs.map((run) => [...new Set(all.filter((d) => d.run === run).map((d) => d.part))]);
  const rows = channels.map((channel) => {
    const unit = unitText(all.find((d) => d.channel === channel)!.unit);
    return make('tr', {}, make('th', {scope: 'row'}, `${channel} / ${unit}`), ...runs.flatMap((run, r) => parts[r]!.map((part) => {
      const found = all.find((d) => d.channel === channel && d.run === run && d.part === part);
      return found ? cell(found, left.get(key(found)), unit) : make('td', {}, '–');
    })));
  });
  const windows = all[0]!.cut === 'time', from = (part: string): string => `${+parseFloat(part).toFixed(2)} h`;
  return make('table', {class: windows ? 'heat-map windows' : 'heat-map'},
    make('tr', {}, make('td', {}), ...runs.map((run, r) => make('th', {colspan: parts[r]!.length, scope: 'colgroup'}, run))),
    make('tr', {}, make('th', {}, windows && 'from'), ...parts.flat().map((part) => make('th', {title: part}, windows ? from(part) : part))), ...rows);
}

function cell(found: Disagreement, after: Disagreement | undefined, unit: string): HTMLElement {
  const share = Math.min(1, Math.max(0, Math.log10(found.power ?? 1) / Math.log10(largest_power)));
  const mean = orDash(found.mean, (x) => minus(x.toFixed(Math.abs(x) < 10 ? 2 : 1)));
  const precise = (x: number | null): string => orDash(x, (known) => known.toPrecision(3));
  const words = [`mean ${mean} ${unit}, RMS ${precise(found.rms)} ${unit}`,
    `power ${precise(found.power)}${after ? `, with the effects ${precise(after.power)}` : ''}`];
  return heatCell(share, `${found.run}, ${found.channel}, ${found.part}: ${words.join('; ')}`, found.significant ? make('strong', {}, mean) : mean);
}
