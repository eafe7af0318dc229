// Reports of several data sets, and of what was measured.
import assert from 'node:assert/strict';
import {writeFileSync} from 'node:fs';
import {before, test} from 'node:test';
import {settled} from './browser';
import {at, exported, openReport, slider, table, testWhole, thermotwin, writeCells, writeStuck} from './reports';

before(() => {
  thermotwin('run', 'spindle_standard', '-m', 'v450', '--nodes', '-q', '-o', 'run.h5');
  thermotwin('run', 'spindle_standard', '-m', 'v450', '--set', 'bearing.front.grease_factor=0.8', '-q', '-o', 'other.h5');
  thermotwin('report', 'other.h5', 'run.h5', '-o', 'two.html');
});

/** run.h5 as a measurement in K, mm and mrad, without its rows between two hours and three where `gap` is set. */
function putMeasurement(name: string, gap: boolean): void {
  const [heads, ...rows] = exported('run.h5');
  const others: Record<string, {unit: string; factor: number; zero: number}> = {
    degC: {unit: 'K', factor: 1, zero: 273.15}, um: {unit: 'mm', factor: 1e-3, zero: 0},
    urad: {unit: 'mrad', factor: 1e-3, zero: 0}, rpm: {unit: 'rpm', factor: 1, zero: 0},
  };
  const columns = heads!.flatMap((head, i) => {
    const [, channel, unit] = /^(spindle\.speed|ambient\.temperature|\w+)_(degC|um|urad|rpm)$/.exec(head) ?? [];
    return channel ? [{i, channel, ...others[unit!]!}] : [];
  });
  const table = rows.filter((row) => !gap || Number(row[0]) <= 7200 || Number(row[0]) >= 10800)
    .map((row) => [row[0]!, ...columns.map(({i, factor, zero}) => (row[i] === '' ? '' : zero + factor * Number(row[i])))]);
  writeCells(`${name}.csv`, [['t', ...columns.map((c) => c.channel)], ...table]);
  const list = (key: string, given: boolean): string => columns.filter(({channel}) => channel.includes('.') === given)
    .map(({channel, unit}) => `{column = "${channel}", ${key} = "${channel}", unit = "${unit}"}`).join();
  writeFileSync(at(`${name}.toml`), `title = "Montag, Aufwärmen"\nmachine = "v450"\n[[table]]\nfile = "${name}.csv"
time_column = "t"\ninput = [${list('channel', true)}]\nreading = [${list('sensor', false)}]\n`);
}

testWhole('two');

test('two runs: the worst channel is chosen, with residual, map and table', async () => {
  const {page} = await openReport('two');
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
  assert.match((await page.locator('[data-panel="residual_sensor_temperatures_degC"] > .words').nth(-2).textContent())!,
    /^RMS \d\.\d\d K; \d\.\d\d K with one constant per channel taken off$/);
  await page.close();
});

test('on paper every chart is drawn as wide as a sheet, and light', async () => {
  const {page, complaints} = await openReport('two', 1440, 'dark');
  const paper = await page.evaluate(async () => {
    const charts = (): Element[] => [...document.querySelectorAll('.chart')];
    const waiting = charts().filter((chart) => !chart.querySelector('canvas')).length;
    dispatchEvent(new Event('beforeprint'));
    await Promise.resolve();
    const still = document.querySelector<HTMLCanvasElement>('.still')!, pixels = still.getContext('2d')!.getImageData(0, 0, still.width, still.height).data;
    return {waiting, blank: charts().filter((chart) => !chart.querySelector('canvas')).length, theme: document.documentElement.dataset.theme,
      widest: Math.max(...charts().map((chart) => chart.querySelector('.uplot')!.clientWidth)), ground: pixels[0], grey: pixels.some((x) => x < 200)};
  });
  assert.ok(paper.waiting > 0, 'nothing was left to be drawn');
  assert.ok(paper.widest > 600 && paper.widest < 718, `${paper.widest} px`);
  assert.deepEqual([paper.blank, paper.theme, paper.ground, paper.grey], [0, 'light', 255, true]);
  await page.evaluate(() => dispatchEvent(new Event('afterprint')));
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark');
  assert.deepEqual(complaints, []);
  await page.close();
});

test('a run and the same in K and mm are one', async () => {
  putMeasurement('same', false);
  thermotwin('report', 'same.toml', 'run.h5', '-o', 'same.html');
  const {page, complaints} = await openReport('same');
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
  const {page, complaints} = await openReport('gap');
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

test('a sensor without readings has a residual that nobody knows, and the others keep theirs', async () => {
  writeStuck('dead.csv', 'run.h5', 'T1_degC', '');
  thermotwin('report', 'dead.csv', 'other.h5', '-o', 'dead.html');
  const {page, complaints} = await openReport('dead');
  const shown = await page.locator('[data-panel="residual_summary"] tr:has(td)').evaluateAll((all) => all.map((row) => ({
    name: row.querySelector('th')!.textContent!, width: parseFloat(row.querySelector<HTMLElement>('.bar')!.style.width),
    numbers: [...row.querySelectorAll('.number')].map((cell) => cell.textContent!)})));
  assert.deepEqual(shown[0], {name: 'T1', width: 0, numbers: ['– K', '– K', '– K', '– K']});
  const others = shown.slice(1).filter(({numbers}) => numbers[0]!.endsWith(' K')), most = Math.max(...others.map((m) => parseFloat(m.numbers[0]!)));
  for (const {name, width, numbers} of others)
    assert.ok(Math.abs(width - (100 * parseFloat(numbers[0]!)) / most) < 1, `${name}: a bar of ${width} %`);
  const worst = others.find(({width}) => width === 100)!.name;
  assert.equal(await page.locator('.chip[data-channel][aria-pressed="true"]').first().getAttribute('data-channel'), worst);
  assert.deepEqual(complaints, []);
  await page.close();
});
