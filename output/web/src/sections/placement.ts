import {make, panel} from '../dom';
import type {Numbers, PlacementSection, SensorSet} from '../data';
import {MachineView} from '../machine_view';
import {PageState} from '../signal';
import {card, remark, short} from './card';

/** Where sensors tell most: the map, the chosen sites, and what they leave of the error. */
export function placementSection(section: PlacementSection, numbers: Numbers, page: PageState): HTMLElement {
  const best = section.recommended, left = section.no_sensor_um > 0 ? (100 * best.model_um) / section.no_sensor_um : 0;
  const bound = section.all_sets_looked_at ? `No set of ${best.sensors.length} is better: all were looked at.`
    : `No set of ${best.sensors.length} leaves less than ${short(section.bound_um)} µm.`;
  return make('section', {class: 'placement', 'data-kind': 'placement'},
    card('Placement', 'nothing', `${best.sensors.length} sensors of ${section.candidates} sites on ${section.machine} leave ${short(left)} % of the tool’s error unknown.`, [
      ['no sensor', `${short(section.no_sensor_um)} µm`], ['recommended', `${short(best.model_um)} µm`],
      ['every site', `${short(section.all_candidates_um)} µm`]], remark(bound)),
    make('div', {class: section.shape ? 'split' : 'whole'},
      make('div', {class: 'side'}, section.shape && informationMap(section, numbers, page)),
      make('div', {class: 'courses'}, sensorsPanel(section), setsPanel(section), channelsPanel(best),
        section.distinction && distinctionPanel(section.distinction))),
    ...section.remarks.map(remark));
}

const shown = [['One sensor alone', 0], ['Beside the recommended', 1]] as const;

/** Every place in the colour of what a sensor there takes off the error. Its own axis goes from one map to the other. */
function informationMap(section: PlacementSection, numbers: Numbers, page: PageState): HTMLElement {
  const state = new PageState(page.dark);
  const view = new MachineView(section.shape!, numbers, Float32Array.of(0, 1), new Map(), state, {
    quantity: 'Error removed / µm', fitted: true,
    caption: (at) => (at < 0.5 ? 'What one sensor there takes off the error' : 'What one more sensor there takes off'),
  });
  const buttons = shown.map(([text, at]) => make('button', {class: 'chip', onclick: () => {
    state.time.value = at;
  }}, text));
  state.time.watch((at) => buttons.forEach((b, i) => b.setAttribute('aria-pressed', String(shown[i]![1] === at))));
  view.element.prepend(make('div', {class: 'chips map-choice', role: 'group', 'aria-label': 'Map'}, ...buttons));
  return view.element;
}

function bar(share: number): HTMLElement {
  const strip = make('i', {class: 'bar'});
  strip.style.width = `${100 * Math.max(0, Math.min(1, share))}%`;
  return strip;
}

function sensorsPanel(section: PlacementSection): HTMLElement {
  const {sensors} = section.recommended, worst = Math.max(...sensors.map((s) => s.error_without_um), 1e-12);
  const place = (p: [number, number, number]): string => p.map((x) => (1e3 * x).toFixed(0).replace('-', '−')).join(', ');
  const idle = section.dead > 0 ? ', spare' : section.distinction ? ', for the effects' : ', idle';
  const rows = sensors.map((s, i) => make('tr', {}, make('td', {class: 'number'}, String(i + 1)), make('th', {scope: 'row', class: 'site'}, s.name),
    make('td', {class: 'number'}, s.at[0] === 'ambient' ? 'room air' : place(s.position_m)),
    make('td', {class: 'wide'}, bar(s.error_without_um / worst)),
    make('td', {class: 'number'}, `${short(s.error_without_um)} µm${s.idle ? idle : ''}`)));
  return panel('Recommended sensors', 'sensors', () => [
    {name: 'site', values: sensors.map((s) => s.name)},
    ...['x', 'y', 'z'].map((axis, i) => ({name: `${axis}_m`, values: sensors.map((s) => s.position_m[i]!)})),
    {name: 'cost', values: sensors.map((s) => s.cost)}, {name: 'error_without_um', values: sensors.map((s) => s.error_without_um)},
  ], make('div', {class: 'scroll'}, make('table', {}, make('tr', {}, make('th', {}), make('th', {}, 'site'),
    make('th', {class: 'number'}, 'x, y, z / mm'), make('th', {class: 'wide'}), make('th', {class: 'number'}, 'error without it')), ...rows)));
}

function setsPanel(section: PlacementSection): HTMLElement {
  const named = (what: string, set: SensorSet | undefined): [string, SensorSet][] => (set ? [[`${what} ${set.sensors.length}`, set]] : []);
  const best = section.distinction ? 'for displacement' : 'best';
  const sets = [...named(best, section.one_fewer), ...named('recommended', section.recommended), ...named(best, section.one_more),
    ...named('proposed', section.proposed)];
  const cells = (name: string, model: number, rest: number[]): HTMLElement => make('tr', {}, make('th', {scope: 'row', class: 'site'}, name),
    make('td', {class: 'wide'}, bar(model / section.no_sensor_um)), ...[model, ...rest].map((x) => make('td', {class: 'number'}, short(x))));
  const none = [NaN, NaN];
  return panel('What sets leave of the error', 'sets', () => [
    {name: 'set', values: sets.map(([name]) => name)}, {name: 'model_um', values: sets.map(([, s]) => s.model_um)},
    {name: 'predicted_um', values: sets.map(([, s]) => s.predicted_um)}, {name: 'unseen_rms_um', values: sets.map(([, s]) => s.unseen_rms_um)},
  ], make('div', {class: 'scroll'}, make('table', {}, make('tr', {}, make('th', {}, 'set'), make('th', {class: 'wide'}),
    ...['model / µm', 'predicted 1σ / µm', 'unseen RMS / µm'].map((t) => make('th', {class: 'number'}, t))),
  cells('no sensor', section.no_sensor_um, none), ...sets.map(([name, s]) => cells(name, s.model_um, [s.predicted_um, s.unseen_rms_um])),
  cells(`all ${section.candidates}`, section.all_candidates_um, none))));
}

function channelsPanel(best: SensorSet): HTMLElement {
  const channels = best.displacements;
  return panel('Error per displacement, recommended sensors', 'displacements', () => [
    {name: 'channel', values: channels.map((c) => c.name)}, {name: 'without_sensors_um', values: channels.map((c) => c.without_sensors_um)},
    {name: 'predicted_um', values: channels.map((c) => c.predicted_um)}, {name: 'unseen_rms_um', values: channels.map((c) => c.unseen_rms_um)},
  ], make('div', {class: 'scroll'}, make('table', {}, make('tr', {}, make('th', {}, 'channel'),
    ...['no sensor / µm', 'predicted 1σ / µm', 'unseen RMS / µm'].map((t) => make('th', {class: 'number'}, t))),
  ...channels.map((c) => make('tr', {}, make('th', {scope: 'row'}, c.name),
    ...[c.without_sensors_um, c.predicted_um, c.unseen_rms_um].map((x) => make('td', {class: 'number'}, short(x))))))));
}

function distinctionPanel(d: NonNullable<PlacementSection['distinction']>): HTMLElement {
  const rows: [string, number][] = [['recommended', d.recommended_deg], ['chosen for the displacement', d.for_displacement_deg], ['all candidates', d.all_candidates_deg]];
  if (d.proposed_deg !== undefined) rows.splice(1, 0, ['proposed', d.proposed_deg]);
  return panel(`Telling ${d.effects} missing effects apart`, 'distinction', () => [
    {name: 'set', values: rows.map(([n]) => n)}, {name: 'smallest_angle_deg', values: rows.map(([, x]) => x)},
  ], make('table', {}, make('tr', {}, make('th', {}, 'set'), make('th', {class: 'number'}, 'smallest angle / °')),
    ...rows.map(([n, x]) => make('tr', {}, make('th', {scope: 'row'}, n), make('td', {class: 'number'}, short(x))))),
  make('p', {class: 'words'}, `Told apart worst: ${d.closest.join(' and ')}.`));
}
