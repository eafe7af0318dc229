// Reports as their readers open them: from disk, in Chromium. Pictures of them go to the folder in PICTURES.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync, statSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, test} from 'node:test';
import type {Browser, Page} from 'playwright-core';
import {colours, launch, open, photograph, settled} from './browser';

const program = process.env.THERMOTWIN_PROGRAM!, pictures = process.env.PICTURES!;
const diagnosis = process.env.EXAMPLE_DIAGNOSIS!;
let folder: string, browser: Browser;

function thermotwin(...args: string[]): string {
  return execFileSync(program, args, {cwd: folder, encoding: 'utf8'});
}

const at = (name: string): string => join(folder, name);
const slider = (page: Page) => page.getByRole('slider', {name: 'Time'});

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'thermotwin-page-'));
  thermotwin('run', 'spindle_standard', '-m', 'v450', '--nodes', '-q', '-o', 'run.h5');
  thermotwin('run', 'spindle_standard', '-m', 'v450', '--set', 'bearing.front.grease_factor=0.8', '-q', '-o', 'other.h5');
  thermotwin('run', 'feed_12000', '--nodes', '-q', '-o', 'feed.h5');
  thermotwin('report', 'run.h5', '-o', 'run.html');
  thermotwin('report', 'feed.h5', '-o', 'feed.html');
  thermotwin('report', 'other.h5', 'run.h5', '-o', 'two.html');
  thermotwin('report', diagnosis, '-o', 'diagnosis.html');
  browser = await launch();
});

after(async () => {
  await browser?.close();
  rmSync(folder, {recursive: true, force: true});
});

for (const kind of ['run', 'feed', 'two', 'diagnosis'])
  for (const [width, theme] of [[1440, 'light'], [390, 'dark']] as const)
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

test('a diagnosis names the effect, its rivals and its evidence', async () => {
  const {page} = await open(browser, at('diagnosis.html'), 1440);
  assert.match((await page.locator('.verdict h2').textContent())!, /bearing shift at E_Z by rear_ring, or centrifugal growth/);
  assert.equal(await page.locator('.candidates li').count(), 2);
  assert.ok(await page.locator('.gap-row .disc').count() > 20);
  assert.ok(await page.locator('.heat-map .cell').count() > 40);
  assert.equal(await page.locator('[data-panel="unaccounted_heat"] .chip').count(), 3);
  await page.close();
});

test('a page is small', () => {
  assert.ok(statSync(at('run.html')).size < 1.5e6);
});
