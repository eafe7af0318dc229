// Reports of studies, placements, volumes and campaigns.
import assert from 'node:assert/strict';
import {copyFileSync, readFileSync, writeFileSync} from 'node:fs';
import {before, test} from 'node:test';
import {colours, settled} from './browser';
import {at, openReport, table, testWhole, thermotwin} from './reports';

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

before(() => {
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
});

testWhole('study', 'placement', 'volumetric', 'campaign');

test('a study ranks its combinations, best first, and judges its claims', async () => {
  const {page} = await openReport('study');
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
  const {page, complaints} = await openReport('placement');
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
  const {page, complaints} = await openReport('campaign');
  assert.match((await page.locator('.verdict h2').textContent())!, /^Grease and speed: 4 of 84 runs failed; E_Z ends between [\d.]+ and [\d.]+ µm in nine of ten others$/);
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
  const {page, complaints} = await openReport('volumetric');
  const pictures = page.locator('.stage.arrows');
  assert.equal(await pictures.count(), 2);
  const first = await colours(page, '.stage.arrows >> nth=1');
  assert.ok(first.size > 100, `${first.size} colours`);
  await pictures.first().press('ArrowLeft');
  await settled(page);
  assert.notDeepEqual(await colours(page, '.stage.arrows >> nth=1'), first);
  const answer = JSON.parse(readFileSync(at('volumetric.json'), 'utf8')) as {before: {grid_largest_um: number}; field: {points: number[]}};
  assert.ok((await page.locator('.verdict h2').textContent())!.includes(`from ${answer.before.grid_largest_um.toFixed(1)} to`));
  assert.equal((await table(page, 'Error field')).rows.length, answer.field.points.reduce((a, b) => a * b, 1));
  assert.deepEqual(complaints, []);
  await page.close();
});
