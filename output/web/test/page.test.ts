// Reports as their readers open them: from disk, in Chromium. Pictures of them go to the folder in PICTURES.
import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import {copyFileSync, mkdtempSync, readFileSync, renameSync, rmSync, statSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, test} from 'node:test';
import type {Browser, Page} from 'playwright-core';
import type {DiagnosisSection, Disagreement} from '../src/data';
import {colours, launch, open, photograph, settled} from './browser';

const program = process.env.THERMOTWIN_PROGRAM!, pictures = process.env.PICTURES!;
let folder: string, browser: Browser;

/** What a machine file does not say: warm days show heat in the column or a warm neighbour, and not which. */
const cabinet = `
[[heat]]
name = "cabinet"
at = "column_rear"
power = "120 W"
while_on = "machine.on"
`;

/** Two selections, two models, and a claim, on two short runs. */
const small_study = `
title = "Two rules on one spindle"
seeds = 5
folds = 0
selections = ["all", "forward 3"]
models = ["linear", "ridge_distributed_lag"]
[[world]]
name = "v450"
machine = "v450"
error = "E_Z"
train = ["golden_b_4000"]
test = ["golden_b_6000"]
[[claim]]
says = "three sensors are enough"
combination = "forward 3 + linear"
than = "all + linear"
figure = "cross.rmse"
`;

/** Twenty machines that bear the speed and one that does not, with four greases each. */
const small_campaign = `
title = "Grease and speed"
experiments = ["golden_b_4000"]
machine = "v450"
[[grid]]
path = "spindle.maximum_speed"
values = [${Array.from({length: 20}, (_, i) => `"${4100 + 100 * i} rpm"`).join(', ')}, "3000 rpm"]
[latin_hypercube]
count = 4
[[latin_hypercube.vary]]
path = "bearing.front.grease_factor"
from = 0.4
to = 0.8
`;

function thermotwin(...args: string[]): string {
  return execFileSync(program, args, {cwd: folder, encoding: 'utf8'});
}

const at = (name: string): string => join(folder, name);
const slider = (page: Page) => page.getByRole('slider', {name: 'Time'});

/** What a panel's CSV holds: its heads, and its rows as numbers and as they stand. */
async function table(page: Page, name: string): Promise<{heads: string[]; rows: number[][]; texts: string[][]}> {
  const waiting = page.waitForEvent('download');
  await page.getByRole('button', {name: `Download ${name} as CSV`}).click();
  const [heads, ...texts] = readFileSync(await (await waiting).path(), 'utf8').trim().split('\n').map((line) => line.split(','));
  return {heads: heads!, rows: texts.map((row) => row.map((x) => (x === '' ? NaN : Number(x)))), texts};
}

/** run.h5 as a measurement in K, mm and mrad, without its rows between two hours and three where `gap` is set. */
function putMeasurement(name: string, gap: boolean): void {
  thermotwin('export', 'run.h5', '-o', 'exported.csv');
  const [heads, ...rows] = readFileSync(at('exported.csv'), 'utf8').trim().split('\n').map((line) => line.split(','));
  const others: Record<string, {unit: string; factor: number; zero: number}> = {
    degC: {unit: 'K', factor: 1, zero: 273.15}, um: {unit: 'mm', factor: 1e-3, zero: 0},
    urad: {unit: 'mrad', factor: 1e-3, zero: 0}, rpm: {unit: 'rpm', factor: 1, zero: 0},
  };
  const columns = heads!.flatMap((head, i) => {
    const [, channel, unit] = /^(spindle\.speed|ambient\.temperature|\w+)_(degC|um|urad|rpm)$/.exec(head) ?? [];
    return channel ? [{i, channel, ...others[unit!]!}] : [];
  });
  const table = rows.filter((row) => !gap || Number(row[0]) <= 7200 || Number(row[0]) >= 10800)
    .map((row) => [row[0], ...columns.map(({i, factor, zero}) => (row[i] === '' ? '' : zero + factor * Number(row[i])))].join());
  writeFileSync(at(`${name}.csv`), [['t', ...columns.map((c) => c.channel)].join(), ...table].join('\n') + '\n');
  const list = (key: string, given: boolean): string => columns.filter(({channel}) => channel.includes('.') === given)
    .map(({channel, unit}) => `{column = "${channel}", ${key} = "${channel}", unit = "${unit}"}`).join();
  writeFileSync(at(`${name}.toml`), `title = "Montag, Aufwärmen"\nmachine = "v450"\n[[table]]\nfile = "${name}.csv"
time_column = "t"\ninput = [${list('channel', true)}]\nreading = [${list('sensor', false)}]\n`);
}

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'thermotwin-page-'));
  thermotwin('run', 'spindle_standard', '-m', 'v450', '--nodes', '-q', '-o', 'run.h5');
  thermotwin('run', 'spindle_standard', '-m', 'v450', '--set', 'bearing.front.grease_factor=0.8', '-q', '-o', 'other.h5');
  thermotwin('run', 'feed_12000', '--nodes', '-q', '-o', 'feed.h5');
  thermotwin('report', 'run.h5', '-o', 'run.html');
  thermotwin('report', 'feed.h5', '-o', 'feed.html');
  thermotwin('report', 'other.h5', 'run.h5', '-o', 'two.html');
  writeFileSync(at('shop.toml'), readFileSync(join(process.env.MACHINES!, 'v450.toml'), 'utf8') + cabinet);
  ['golden_b_4000', 'golden_b_6000', 'spindle_standard'].forEach((experiment, i) =>
    thermotwin('run', experiment, '-m', 'shop.toml', '--set', `experiment.seed=${i + 1}`, '-q', '-o', `day${i + 1}.h5`));
  const long_name = 'the_second_day_after_the_machine_was_moved_to_the_hall_behind_the_foundry.h5';
  renameSync(at('day2.h5'), at(long_name));
  writeFileSync(at('diagnosis.json'), thermotwin('diagnose', 'v450', 'day1.h5', long_name, '--hold-out', 'day3.h5', '--json'));
  thermotwin('report', 'diagnosis.json', '-o', 'diagnosis.html');
  writeFileSync(at('two_rules.toml'), small_study);
  thermotwin('study', 'two_rules.toml', '-o', 'study', '--json');
  thermotwin('report', 'study/study.json', '-o', 'study.html');
  thermotwin('place', 'v450', '-k', '4', '--members', '4', '--unseen', '2', '--report', 'place', '--json');
  copyFileSync(at('place/report.html'), at('placement.html'));
  writeFileSync(at('volumetric.json'), thermotwin('volumetric', 'mill200', '--json'));
  thermotwin('report', 'volumetric.json', '-o', 'volumetric.html');
  writeFileSync(at('grease.toml'), small_campaign);
  thermotwin('campaign', 'grease.toml', '-q', '-o', 'many');
  thermotwin('report', 'many', '-o', 'campaign.html');
  browser = await launch();
});

after(async () => {
  await browser?.close();
  rmSync(folder, {recursive: true, force: true});
});

for (const kind of ['run', 'feed', 'two', 'diagnosis', 'study', 'placement', 'volumetric', 'campaign'])
  for (const [width, theme] of [[1440, 'light'], [1440, 'dark'], [390, 'light'], [390, 'dark']] as const)
    test(`${kind} at ${width}: whole, quiet, nothing cut off`, async () => {
      const {page, complaints} = await open(browser, at(`${kind}.html`), width, theme);
      await photograph(page, pictures, `${kind}_${width}_${theme}`);
      const overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(overflow <= 0, `the page is ${overflow} px wider than the screen`);
      assert.ok(await page.locator('.panel').count() > 2);
      assert.deepEqual(complaints, []);
      await page.close();
    });

test('the machine is drawn, in many colours', async () => {
  const {page} = await open(browser, at('run.html'), 1440);
  await settled(page);
  const seen = [...(await colours(page, '.stage')).values()].sort((a, b) => b - a);
  const all = seen.reduce((a, b) => a + b, 0);
  assert.ok(seen.length > 200, `${seen.length} colours`);
  assert.ok(seen[0]! < 0.9 * all, 'nearly all of the canvas is one colour');
  await page.close();
});

test('the slider changes time, colours and values', async () => {
  const {page, complaints} = await open(browser, at('run.html'), 1440);
  const value = page.locator('[data-panel="sensor_temperatures_degC"] [data-channel="T1"] .value');
  await slider(page).fill('0');
  await settled(page);
  const cold = {text: await value.textContent(), colours: await colours(page, '.stage')};
  assert.equal(await page.locator('.time-bar .time').textContent(), '0 s');
  await slider(page).fill('7200');
  await settled(page);
  assert.equal(await page.locator('.time-bar .time').textContent(), '2 h 00 min');
  assert.ok(Number(await value.textContent()) > Number(cold.text) + 10);
  const warm = await colours(page, '.stage');
  assert.ok([...warm.keys()].filter((c) => !cold.colours.has(c)).length > 50, 'the machine looks the same');
  await slider(page).press('ArrowRight');
  assert.equal(await page.locator('.time-bar .time').textContent(), '2 h 03 min');
  assert.deepEqual(complaints, []);
  await page.close();
});

test('play moves time, and pauses', async () => {
  const {page} = await open(browser, at('run.html'), 1440);
  await slider(page).fill('0');
  await page.getByRole('button', {name: 'Play'}).click();
  await page.waitForFunction(() => +(document.querySelector('.time-bar input') as HTMLInputElement).value > 300);
  await page.getByRole('button', {name: 'Pause'}).click();
  const then = await slider(page).inputValue();
  await page.waitForTimeout(200);
  assert.equal(await slider(page).inputValue(), then);
  await page.close();
});

test('a sensor is picked on the machine or by its chip, and both show it', async () => {
  const {page} = await open(browser, at('run.html'), 1440);
  const mark = page.locator('.sensor[aria-label^="Sensor T8,"]'), chip = page.locator('button.chip[data-channel="T8"]');
  await mark.locator('.dot').click();
  assert.equal(await chip.getAttribute('aria-pressed'), 'true');
  assert.match((await page.locator('[data-panel="sensor_temperatures_degC"] .words').textContent())!, /T8: motor/);
  await chip.focus();
  await page.keyboard.press('Enter');
  assert.equal(await mark.getAttribute('aria-pressed'), 'false');
  await page.close();
});

test('a body is picked on the machine, and its course appears', async () => {
  const {page} = await open(browser, at('run.html'), 1440);
  const stage = (await page.locator('.stage').boundingBox())!;
  await page.mouse.click(stage.x + stage.width / 2, stage.y + 0.75 * stage.height);
  assert.equal(await page.locator('.chip[data-body][aria-pressed="true"]').count(), 1);
  assert.equal(await page.locator('.body-panel .panel').count(), 1);
  await page.locator('.chip[data-body="shaft"]').click();
  assert.match((await page.locator('.body-panel h3').textContent())!, /^shaft: mean/);
  await page.close();
});

test('the machine turns with pointer and keys, and deforms', async () => {
  const {page} = await open(browser, at('run.html'), 1440);
  const place = async (): Promise<string> => {
    await settled(page);
    return (await page.locator('.sensor[aria-label^="Sensor T8,"]').getAttribute('style'))!.replace(/--reading.*?;/, '');
  };
  const first = await place();
  await page.locator('.stage').press('ArrowLeft');
  const turned = await place();
  assert.notEqual(turned, first);
  const stage = (await page.locator('.stage').boundingBox())!;
  await page.mouse.move(stage.x + 40, stage.y + 200);
  await page.mouse.down();
  await page.mouse.move(stage.x + 140, stage.y + 220, {steps: 4});
  await page.mouse.up();
  const dragged = await place();
  assert.notEqual(dragged, turned);
  await page.getByRole('slider', {name: 'Deformation factor'}).fill('5');
  assert.notEqual(await place(), dragged);
  await page.close();
});

test('the theme switches, and the machine with it', async () => {
  const {page, complaints} = await open(browser, at('run.html'), 1440);
  const ground = (): Promise<string> => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const light = await ground();
  await page.getByRole('button', {name: 'Switch to dark'}).click();
  await settled(page);
  assert.notEqual(await ground(), light);
  assert.ok((await colours(page, '.stage')).has('23,28,33'), 'the ground of the picture is still light');
  assert.deepEqual(complaints, []);
  await page.close();
});

test('numbers come as CSV, and are those of the data set', async () => {
  const {page} = await open(browser, at('run.html'), 1440);
  const waiting = page.waitForEvent('download');
  await page.getByRole('button', {name: 'Download Sensor temperatures as CSV'}).click();
  const file = await (await waiting).path(), rows = readFileSync(file, 'utf8').trim().split('\n').map((line) => line.split(','));
  thermotwin('export', 'run.h5', '-o', 'run.csv');
  const exported = readFileSync(at('run.csv'), 'utf8').trim().split('\n').map((line) => line.split(','));
  assert.equal(rows.length, exported.length);
  for (const name of ['time_s', 'T1_degC', 'T10_degC']) {
    const mine = rows[0]!.indexOf(name), theirs = exported[0]!.indexOf(name);
    for (let i = 1; i < rows.length; i += 50)
      assert.ok(Math.abs(Number(rows[i]![mine]) - Number(exported[i]![theirs])) < 1e-4, `${name}, row ${i}`);
  }
  await page.close();
});

test('two runs: the worst channel is chosen, with residual, map and table', async () => {
  const {page} = await open(browser, at('two.html'), 1440);
  for (const name of ['residual_sensor_temperatures_degC', 'residual_map_sensor_temperatures_degC', 'residual_summary'])
    assert.equal(await page.locator(`[data-panel="${name}"]`).count(), 1, name);
  const chosen = await page.locator('.chip[data-channel][aria-pressed="true"]').first().getAttribute('data-channel');
  const bars = await page.locator('[data-panel="residual_summary"] tr').evaluateAll((rows) => rows.slice(1).map((row) => ({
    name: row.querySelector('th')!.textContent!, rms: row.querySelectorAll('td.number')[0]!.textContent!})));
  const kelvin = bars.filter((b) => b.rms.endsWith(' K')).sort((a, b) => parseFloat(b.rms) - parseFloat(a.rms));
  assert.equal(chosen, kelvin[0]!.name);
  assert.ok(parseFloat(kelvin[0]!.rms) > 0.5);
  const {heads, rows} = await table(page, 'Residual of every channel'), column = (name: string): number => heads.indexOf(name);
  for (const row of rows) {
    const [rms, offset, left] = ['rms', 'offset', 'rms_offset_taken_off'].map((name) => row[column(name)]!) as [number, number, number];
    assert.ok(Math.abs(Math.hypot(offset, left) - rms) < 1e-4 * (1 + rms), `${rms}, of which ${offset} and ${left}`);
  }
  assert.match((await page.locator('[data-panel="residual_sensor_temperatures_degC"] > .words').last().textContent())!,
    /^RMS \d\.\d\d K; \d\.\d\d K with one constant per channel taken off, as compare does$/);
  await page.close();
});

test('a run and the same in K and mm are one', async () => {
  putMeasurement('same', false);
  thermotwin('report', 'same.toml', 'run.h5', '-o', 'same.html');
  const {page, complaints} = await open(browser, at('same.html'), 1440);
  for (const name of ['sensor_temperatures', 'displacements', 'residual_displacements', 'tilt', 'input_K', 'input_degC'])
    assert.equal(await page.locator(`[data-panel^="${name}"]`).count(), name === 'input_K' ? 0 : 1, name);
  const {heads, rows, texts} = await table(page, 'Residual of every channel');
  assert.ok(rows.length >= 13, `${rows.length} channels`);
  rows.forEach((row, i) => assert.ok(row[heads.indexOf('largest')]! < 1e-4, texts[i]!.join()));
  assert.deepEqual(complaints, []);
  await page.close();
});

test('a measurement has its title and its machine, and nothing where nobody recorded', async () => {
  putMeasurement('gap', true);
  thermotwin('report', 'gap.toml', '-o', 'gap.html');
  const {page, complaints} = await open(browser, at('gap.html'), 1440);
  assert.equal(await page.locator('h1').textContent(), 'Montag, Aufwärmen');
  assert.equal(await page.locator('.sensor[aria-label^="Sensor T8,"]').count(), 1);
  await page.locator('[data-panel="sensor_temperatures_degC"]').scrollIntoViewIfNeeded();
  await settled(page);
  const [before, within, after] = await page.locator('[data-panel="sensor_temperatures_degC"] .plot').evaluate((plot) => {
    const canvas = plot.querySelector('canvas')!, whole = canvas.getBoundingClientRect(), scale = canvas.width / whole.width;
    const area = plot.querySelector('.u-over')!.getBoundingClientRect(), input = document.querySelector<HTMLInputElement>('.time-bar input')!;
    const {data} = canvas.getContext('2d')!.getImageData(0, 0, canvas.width, canvas.height);
    return [6480, 9000, 11_700].map((t) => {
      const x = Math.round((area.left - whole.left + (area.width * (t - +input.min)) / (+input.max - +input.min)) * scale);
      const rows = Array.from({length: Math.floor(area.height * scale)}, (_, y) => 4 * ((y + Math.round((area.top - whole.top) * scale)) * canvas.width + x));
      return rows.filter((i) => Math.max(...data.slice(i, i + 3)) - Math.min(...data.slice(i, i + 3)) > 60).length;
    });
  });
  assert.ok(before! > 0 && after! > 0, 'nothing is drawn beside the gap');
  assert.equal(within, 0);
  await slider(page).fill('9000');
  assert.equal(await page.locator('[data-panel="sensor_temperatures_degC"] [data-channel="T1"] .value').textContent(), '–');
  assert.deepEqual(complaints, []);
  await page.close();
});

test('the error along the stroke is drawn as curves and as a map', async () => {
  const {page} = await open(browser, at('feed.html'), 1440);
  for (const name of ['positioning_feed_z', 'positioning_map_feed_z']) {
    await page.locator(`[data-panel="${name}"]`).scrollIntoViewIfNeeded();
    await settled(page);
  }
  const map = await colours(page, '[data-panel="positioning_map_feed_z"] .chart');
  assert.ok(map.size > 100, `${map.size} colours`);
  await page.close();
});

/** What `diagnose --json` printed, as far as its page shows it as it is. */
type Diagnosis = Required<Pick<DiagnosisSection,
  'verdict' | 'effects' | 'gap' | 'gaps' | 'disagreement' | 'unaccounted_heat' | 'experiment' | 'estimates'>>;

const found = (): Diagnosis => JSON.parse(readFileSync(at('diagnosis.json'), 'utf8')) as Diagnosis;

test('a diagnosis names the effect, its rivals and its evidence', async () => {
  const {page} = await open(browser, at('diagnosis.html'), 1440), {verdict, effects, gap, gaps, ...rest} = found();
  assert.equal(verdict, 'either');
  assert.ok(effects.some((e) => e.effect === 'heat' && e.site === 'column_rear'), 'the cabinet is not among the candidates');
  const names = effects.map((e) => `${e.effect.replaceAll('_', ' ')} at ${e.site}`);
  assert.equal(await page.locator('.verdict h2').textContent(), `The machine file lacks ${names.join(', or ')}.`);
  assert.deepEqual(await page.locator('.verdict .figures dd').allTextContents(),
    [gap.before, gap.after].map((x) => x.toFixed(x < 10 ? 2 : 1)).concat(`${((100 * gap.after) / gap.before).toFixed(0)} %`));
  assert.deepEqual(await page.locator('.candidates li .name').allTextContents(), names);
  const words = (await page.locator('.candidates li').allTextContents());
  effects.forEach((e, i) => {
    assert.ok(words[i]!.includes(`weight in its group${(100 * e.weight).toFixed(0)} %`), words[i]);
    assert.ok(words[i]!.includes(`2 ln evidence ${e.strength.toFixed(0)} `), words[i]);
  });
  const apart = await page.locator('[data-panel="candidates"] > .words').textContent();
  assert.ok(apart!.includes(rest.experiment.split('/').at(-1)!.replace('.toml', '')), apart!);
  assert.equal(await page.locator('[data-panel="gap_held_out"] .gap-row .disc').count(), gaps.held_out.length);
  assert.equal(await page.locator('[data-panel="gap_fitted"] .gap-row .disc').count(), gaps.fitted.length);
  assert.equal(await page.locator('[data-panel="residual_heat_map"] .cell').count(), 2 * (gaps.fitted.length + gaps.held_out.length));
  assert.equal(await page.locator('[data-panel="unaccounted_heat"] .chip').count(), rest.unaccounted_heat.length);
  assert.equal((await table(page, 'Unknowns of the final fit')).rows.length, rest.estimates.length);
  await page.close();
});

test('what speaks against the data stands above a verdict that knows no name', async () => {
  const {effects, ...rest} = found(), one = {...effects[0]!, group: 0, weight: 1}, other = {...one, group: 1};
  writeFileSync(at('none_known.json'), JSON.stringify({...rest, verdict: 'none_known', effects: [one, other],
    doubts: [{run: 'day1', channel: 'E_Z', text: 'E_Z moves against the machine'}]}));
  thermotwin('report', 'none_known.json', '-o', 'none_known.html');
  const {page, complaints} = await open(browser, at('none_known.html'), 1440), name = `${one.effect.replaceAll('_', ' ')} at ${one.site}`;
  assert.equal(await page.locator('.verdict .tag').textContent(), 'None known');
  assert.equal(await page.locator('.verdict h2').textContent(),
    `Something is missing that none of the effects tried explains. What stands in for it: ${name}; and ${name}.`);
  assert.deepEqual(await page.locator('.diagnosis > .remark:nth-child(-n + 2)').allTextContents(),
    ['Look at the data first; all that follows takes them as they are:', 'day1: E_Z moves against the machine']);
  assert.deepEqual(complaints, []);
  await page.close();
});

test('where and when the twin disagrees is told by regime, by speed and over time', async () => {
  const {page, complaints} = await open(browser, at('diagnosis.html'), 1440), {before, after} = found().disagreement;
  const host = page.locator('[data-panel="disagreement"]');
  assert.deepEqual(await host.locator('.chip').allTextContents(), ['by regime', 'by speed', 'over time']);
  for (const cut of ['regime', 'speed', 'time']) {
    const chip = host.locator(`.chip[data-cut="${cut}"]`), parts = before.filter((d) => d.cut === cut);
    await chip.click();
    assert.equal(await chip.getAttribute('aria-pressed'), 'true');
    assert.equal(await host.locator('.chip[aria-pressed="true"]').count(), 1);
    const shown = await host.locator('.cell').evaluateAll((cells) => cells.map((cell) => ({
      mean: Number(cell.textContent!.replace('−', '-')), bold: cell.querySelector('strong') !== null, title: cell.getAttribute('title')!})));
    assert.equal(shown.length, parts.length);
    shown.forEach(({mean, bold, title}) => {
      const part = parts.find((d) => title.startsWith(`${d.run}, ${d.channel}, ${d.part}: `))!, left = after.find((d) => ['run', 'channel', 'cut', 'part'].every((k) => d[k as keyof Disagreement] === part[k as keyof Disagreement]));
      assert.equal(bold, part.significant, `${part.channel}, ${part.part}`);
      assert.ok(Math.abs(mean - part.mean) <= 0.051, `${part.channel}, ${part.part}: ${mean}, not ${part.mean}`);
      assert.ok(title.endsWith(`power ${part.power.toPrecision(3)}, with the effects ${left!.power.toPrecision(3)}`), title);
    });
    assert.ok(parts.some((d) => d.significant) && parts.some((d) => !d.significant), `${cut}: nothing to tell apart`);
  }
  const {heads, rows, texts} = await table(page, 'Where and when the calibrated twin disagrees');
  assert.equal(rows.length, before.length);
  before.forEach((part, i) => {
    for (const name of ['run', 'channel', 'unit', 'cut', 'part'] as const) assert.equal(texts[i]![heads.indexOf(name)], part[name]);
    for (const name of ['mean', 'rms', 'power', 'p_value'] as const)
      assert.equal(rows[i]![heads.indexOf(name)], +part[name].toPrecision(7), `${name}, row ${i}`);
    assert.equal(rows[i]![heads.indexOf('significant')], Number(part.significant));
  });
  assert.deepEqual(complaints, []);
  await page.close();
});

test('a study ranks its combinations, best first, and judges its claims', async () => {
  const {page} = await open(browser, at('study.html'), 1440);
  const answer = JSON.parse(readFileSync(at('study/study.json'), 'utf8')) as {verdict: string[]; combinations: {selection: string; model: string;
    figures: Record<string, {mean: number}>}[]};
  assert.equal(await page.locator('.verdict h2').textContent(), answer.verdict[0]!.replace(/ um$/, ' µm'));
  assert.equal(await page.locator('h1').textContent(), 'Two rules on one spindle');
  const ranked = page.locator('[data-panel="ranking_v450"] .rank-row:has(.number)'), first = ranked.first();
  const best = [...answer.combinations].sort((a, b) => a.figures['cross.rmse']!.mean - b.figures['cross.rmse']!.mean)[0]!;
  assert.equal(await ranked.count(), 4);
  assert.equal(await first.locator('span').first().textContent(), `${best.selection} + ${best.model}`.replaceAll('_', ' '));
  assert.ok((await first.locator('.number').textContent())!.startsWith(best.figures['cross.rmse']!.mean.toFixed(2)));
  await page.locator('[data-panel="ranking_v450"] [data-figure="cross.r_squared"]').click();
  const values = await page.locator('[data-panel="ranking_v450"] .rank-row .number').allTextContents();
  assert.deepEqual(values.map(parseFloat), values.map(parseFloat).sort((a, b) => b - a));
  assert.equal(await page.locator('.claims .answer').count(), 1);
  await page.close();
});

test('a placement shows its map in colours, and another beside the recommended sensors', async () => {
  const {page, complaints} = await open(browser, at('placement.html'), 1440);
  assert.equal(await page.locator('[data-panel="sensors"] tr').count(), 5);
  const alone = await colours(page, '.stage');
  assert.ok(alone.size > 200, `${alone.size} colours`);
  await page.getByRole('button', {name: 'Beside the recommended'}).click();
  await settled(page);
  assert.match((await page.locator('.stage .caption').textContent())!, /one more sensor/);
  assert.notDeepEqual(await colours(page, '.stage'), alone, 'the map looks the same');
  const scale = (): Promise<string[]> => page.locator('.colour-bar .marks span').allTextContents();
  const beside = await scale();
  await page.getByRole('button', {name: 'One sensor alone'}).click();
  await settled(page);
  assert.notDeepEqual(await scale(), beside, 'one scale for both maps');
  const bars = await page.locator('[data-panel="sensors"] .bar').evaluateAll((all) => all.map((b) => parseFloat((b as HTMLElement).style.width)));
  const errors = (await page.locator('[data-panel="sensors"] td:last-child').allTextContents()).map(parseFloat);
  const most = Math.max(...errors);
  bars.forEach((width, i) => assert.ok(Math.abs(width - (100 * errors[i]!) / most) < 1, 'a bar begins at zero'));
  assert.deepEqual(complaints, []);
  await page.close();
});

test('a campaign shows how its runs spread, against what was varied, and which failed', async () => {
  const {page, complaints} = await open(browser, at('campaign.html'), 1440);
  assert.match((await page.locator('.verdict h2').textContent())!, /^Grease and speed: nine runs in ten end with E_Z between/);
  for (const panel of ['quantiles', 'last_values', 'against_spindle_maximum_speed', 'against_bearing_front_grease_factor'])
    assert.equal(await page.locator(`[data-panel="${panel}"] canvas`).count(), 1, panel);
  const failed = page.locator('[data-panel="failed_runs"] tbody tr');
  assert.equal(await failed.count(), 4);
  assert.match((await failed.first().textContent())!, /4000 rpm is above the machine's maximum, 3000 rpm/);
  const before = await colours(page, '[data-panel="last_values"] .chart');
  await page.locator('.chip[data-channel="T1"]').click();
  assert.equal(await page.locator('[data-panel="quantiles"] h3').textContent(), 'T1 over time');
  await settled(page);
  assert.notDeepEqual(await colours(page, '[data-panel="last_values"] .chart'), before);
  const {heads, rows} = await table(page, 'T1 at the end');
  assert.deepEqual(heads, ['run', 'spindle.maximum_speed_rpm', 'bearing.front.grease_factor', 'T1_last_degC']);
  assert.equal(rows.length, 84);
  assert.deepEqual(rows.filter((row) => Number.isNaN(row[3])).map((row) => row[1]), [3000, 3000, 3000, 3000]);
  const last = rows.map((row) => row[3]!).filter((x) => !Number.isNaN(x)).sort((a, b) => a - b);
  const quantiles = await table(page, 'T1 over time'), end = quantiles.rows.at(-1)!;
  assert.equal(quantiles.heads[3], 'T1_q50_degC');
  assert.ok(Math.abs(end[3]! - (last[39]! + last[40]!) / 2) < 1e-4, 'the median of what the runs end with');
  assert.ok(end[1]! < end[2]! && end[4]! < end[5]!);
  assert.deepEqual(complaints, []);
  await page.close();
});

test('the error in the volume is drawn as arrows, which turn together', async () => {
  const {page, complaints} = await open(browser, at('volumetric.html'), 1440);
  const pictures = page.locator('.stage.arrows');
  assert.equal(await pictures.count(), 2);
  const first = await colours(page, '.stage.arrows >> nth=1');
  assert.ok(first.size > 100, `${first.size} colours`);
  await pictures.first().press('ArrowLeft');
  await settled(page);
  assert.notDeepEqual(await colours(page, '.stage.arrows >> nth=1'), first);
  const answer = JSON.parse(readFileSync(at('volumetric.json'), 'utf8')) as {before: {grid_largest_um: number}; field: {points: number[]}};
  assert.ok((await page.locator('.verdict h2').textContent())!.includes(`from ${answer.before.grid_largest_um.toFixed(1)} to`));
  const waiting = page.waitForEvent('download');
  await page.getByRole('button', {name: 'Download Error field as CSV'}).click();
  const rows = readFileSync(await (await waiting).path(), 'utf8').trim().split('\n');
  assert.equal(rows.length, 1 + answer.field.points.reduce((a, b) => a * b, 1));
  assert.deepEqual(complaints, []);
  await page.close();
});

test('a served page renews itself and keeps what the reader has chosen', async () => {
  const served = spawn(program, ['view', 'live.h5'], {cwd: folder});
  const address = await new Promise<string>((found) => served.stdout.on('data', (text) => found(/http:\S+/.exec(String(text))![0])));
  const complaints: string[] = [];
  try {
    const page = await browser.newPage({viewport: {width: 1440, height: 900}});
    page.on('request', (request) => {
      if (!request.url().startsWith(address) && !request.url().startsWith('blob:')) complaints.push(request.url());
    });
    page.on('pageerror', (error) => complaints.push(error.message));
    await page.goto(address);
    await page.getByText('Nothing is in').waitFor();
    assert.equal(await page.locator('h1').textContent(), 'Waiting');
    const put = (name: string): void => {
      copyFileSync(at(name), at('live.tmp'));
      renameSync(at('live.tmp'), at('live.h5'));
    };
    put('other.h5');
    await page.locator('.stage .caption:not(:empty)').waitFor({timeout: 20_000});
    assert.match((await page.locator('h1').textContent())!, /^v450/);
    await slider(page).fill('7200');
    await page.locator('button.chip[data-channel="T8"]').click();
    const value = page.locator('[data-panel="sensor_temperatures_degC"] [data-channel="T1"] .value');
    const before = await value.textContent();
    put('run.h5');
    await page.waitForFunction((old) => {
      const now = document.querySelector('[data-panel="sensor_temperatures_degC"] [data-channel="T1"] .value')?.textContent;
      return now && now !== old;
    }, before, {timeout: 20_000});
    assert.equal(await page.locator('.time-bar .time').textContent(), '2 h 00 min');
    assert.equal(await page.locator('button.chip[data-channel="T8"]').getAttribute('aria-pressed'), 'true');
    assert.equal(await page.locator('.connection').textContent(), 'live');
    served.kill('SIGINT');
    await page.getByText('no longer answers').waitFor({timeout: 20_000});
    assert.deepEqual(complaints, []);
    await page.close();
  } finally {
    served.kill('SIGKILL');
  }
});

test('a page is small', () => {
  assert.ok(statSync(at('run.html')).size < 1.5e6);
});
