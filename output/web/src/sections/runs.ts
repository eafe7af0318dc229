import {make} from '../dom';
import type {Numbers, RunsSection} from '../data';
import {bodyCourses} from '../field';
import {timeText, unitText, valueText} from '../format';
import {MachineView} from '../machine_view';
import type {PageState} from '../signal';
import {timeBar} from '../time_bar';
import {bodyPanel} from './body';
import {coursesPanel, residualRuns, type ShownRun} from './courses';
import {positioningPanels} from './positioning';
import {misfitTable, misfitWords, residualMap} from './residuals';
import {misfit, runsOf, sameCourses, shownInputs, tellingTime, timeRange, worst, type NamedCourse, type Run} from './run_data';

/** A unit in the name of a panel and of its file, as `figure` has it. */
const filePart = (unit: string): string => unit.replace(/\W/g, '_');

const quantities: Record<string, string> = {
  rpm: 'Speed', 'mm/min': 'Feed', degC: 'Temperature', K: 'Temperature', W: 'Heat', um: 'Displacement', urad: 'Tilt',
  mm: 'Position', 'K/m': 'Gradient', '1': 'Setting',
};

/** Angles after lengths, whatever the file's order. */
const order = (unit: string): number => Number(unit === 'urad');

function inputTitle(unit: string, channels: NamedCourse[]): string {
  if (unit === 'degC') return channels.every((c) => c.name.startsWith('ambient')) ? 'Ambient' : 'Given temperatures';
  const titles: Record<string, string> = {rpm: 'Spindle speed', 'mm/min': 'Feed', '1': 'Switches and shares', mm: 'Position'};
  return titles[unit] ?? channels[0]!.name;
}

/** One or several runs: the machine on one side, all courses on the other, one time for both. */
export function runsSection(section: RunsSection, numbers: Numbers, state: PageState): HTMLElement {
  const runs = runsOf(section, numbers), range = timeRange(runs, numbers);
  state.time.value = tellingTime(runs);

  const machine = machineParts(section, numbers, runs, state);
  const courses = make('div', {class: 'courses'}, ...inputPanels(runs, numbers, state, range),
    ...channelPanels(runs, state, range), ...heatPanels(runs, state, range));
  const below = [...positioningPanels(runs, numbers, state, range), factsPanel(runs)];
  if (runs.length > 1) chooseWorst(runs, state);
  return make('section', {class: 'runs', 'data-kind': 'runs'},
    section.machine ? make('div', {class: 'split'}, make('div', {class: 'side'}, ...machine), courses) : make('div', {}, ...machine, courses),
    make('div', {class: 'flow'}, ...below),
    timeBar(state, ...range));
}

function machineParts(section: RunsSection, numbers: Numbers, runs: Run[], state: PageState): (HTMLElement | null)[] {
  const machine = section.machine;
  const remarks = section.remarks.map((remark) => make('p', {class: 'remark'}, remark));
  if (!machine) return runs.length ? remarks : [];
  const drawn = runs.find((run) => run.set === section.sets[machine.set])!;
  const readings = new Map(drawn.readings.map((course) => [course.name, course]));
  const view = new MachineView(machine, numbers, drawn.time, readings, state, {
    quantity: 'Temperature / °C', caption: (t) => `${runs.length > 1 ? `${drawn.name}, ` : ''}t = ${timeText(t)}`,
  });
  const bodies = machine.field
    ? bodyPanel(machine, bodyCourses(machine.field, numbers, drawn.time, machine.bodies.length), state, timeRange(runs, numbers))
    : null;
  return [view.element, bodies, ...remarks];
}

function channelPanels(runs: Run[], state: PageState, range: [number, number]): HTMLElement[] {
  const panels: HTMLElement[] = [];
  const add = (kind: 'sensor' | 'displacement', title: string, pick: (run: Run) => NamedCourse[]): void => {
    const units = [...new Set(runs.flatMap((run) => pick(run).map((c) => c.unit)))].sort((a, b) => order(a) - order(b));
    for (const unit of units) {
      const ofUnit = (run: Run): NamedCourse[] => pick(run).filter((c) => c.unit === unit);
      const shown = runs.map((run) => ({...run, channels: ofUnit(run)})).filter((run) => run.channels.length > 0);
      const heading = unit === 'urad' ? 'Tilt' : title, file = `${heading.toLowerCase().replaceAll(' ', '_')}_${filePart(unit)}`;
      const quantity = quantities[unit] ?? 'Value';
      panels.push(coursesPanel({title: heading, file, quantity, runs: shown, sets: runs.length, kind, state, range, height: kind === 'sensor' ? 250 : 200}));
      const differences = residualRuns(runs, ofUnit);
      if (differences.length === 0) continue;
      const courses = coursesPanel({
        title: `Residual of ${heading.toLowerCase()}`, file: `residual_${file}`, quantity: 'Residual',
        runs: differences, sets: runs.length, kind, state, range, height: 160,
      });
      courses.append(...misfitWords(differences));
      panels.push(courses, residualMap(`${heading}: residual by window`, `residual_map_${file}`, differences, state, range));
    }
  };
  add('sensor', 'Sensor temperatures', (run) => run.readings);
  add('displacement', 'Displacements', (run) => run.displacements);
  const rows = residualRuns(runs, (run) => [...run.readings, ...run.displacements]);
  if (rows.length) panels.push(misfitTable(rows.map((run) =>
    ({name: run.name, misfits: run.channels.map((c) => misfit(c.name, c.unit, c.values))})), state));
  return panels;
}

/** What the machine was given: once where all data sets were given the same, else of each, over one another. */
function inputPanels(runs: Run[], numbers: Numbers, state: PageState, range: [number, number]): HTMLElement[] {
  const given = runs.map((run) => ({...run, channels: shownInputs(run, numbers)}));
  const units = [...new Set(given.flatMap((run) => run.channels.map((c) => c.unit)))];
  return units.map((unit) => {
    const [which, drawn] = distinct(given.map((run) => ({...run, channels: run.channels.filter((c) => c.unit === unit)})));
    return coursesPanel({title: `${inputTitle(unit, drawn[0]!.channels)}${which}`, file: `input_${filePart(unit)}`,
      quantity: quantities[unit] ?? 'Value', runs: drawn, sets: drawn.length > 1 ? runs.length : 1, kind: null, state, range, height: 152});
  });
}

/** A panel for each data set that differs: over one another the sources of several were too many to tell apart. */
function heatPanels(runs: Run[], state: PageState, range: [number, number]): HTMLElement[] {
  const made = runs.map((run) => ({...run, channels: run.heat.filter((course) => Array.prototype.some.call(course.values, (v: number) => v !== 0))}));
  const [which, drawn] = distinct(made);
  return drawn.map((run) => coursesPanel({title: `Heat given to the bodies${drawn.length > 1 ? `, ${run.name}` : which}`,
    file: drawn.length > 1 ? `heat_${run.name}` : 'heat', quantity: 'Heat', runs: [run], sets: 1, kind: null, state, range, height: 220}));
}

/** Of data sets those with channels, the first alone where all have the same; and whose they are, where one of several has any. */
function distinct<R extends ShownRun>(runs: R[]): [string, R[]] {
  const [first, ...others] = runs.filter((run) => run.channels.length > 0);
  if (!first) return ['', []];
  if (others.some((run) => !sameCourses(first.channels, run.channels))) return ['', [first, ...others]];
  return [others.length === 0 && runs.length > 1 ? `, ${first.name}` : '', [first]];
}

/** With several data sets, the channel that disagrees most is chosen to begin with. */
function chooseWorst(runs: Run[], state: PageState): void {
  const differences = residualRuns(runs, (run) => run.readings).flatMap((run) => run.channels);
  const chosen = worst(differences.map((c) => misfit(c.name, c.unit, c.values)));
  if (chosen) state.selection.value = {kind: 'sensor', name: chosen.name};
}

function factsPanel(runs: Run[]): HTMLElement {
  const tables = runs.map((run) => {
    const constants = run.set.inputs.filter((c) => c.constant !== undefined && c.constant !== 0);
    const rows: [string, string][] = [
      ['data set', run.set.title],
      ['rows', `${run.time.length}${run.set.complete ? '' : ', so far: the run has not ended'}`],
      ...Object.entries(run.set.facts),
      ...constants.map((c): [string, string] => [c.name, `${valueText(c.constant!, c.unit)} ${unitText(c.unit)}`.trim() + ', constant']),
    ];
    return make('details', {open: runs.length === 1}, make('summary', {}, run.name),
      make('table', {class: 'facts'}, ...rows.map(([key, value]) => make('tr', {}, make('th', {scope: 'row'}, key), make('td', {}, value)))));
  });
  return make('section', {class: 'panel facts-panel', 'data-panel': 'facts'}, make('header', {}, make('h3', {}, 'About the data')), ...tables);
}
