// Reports of what a diagnosis found.
import assert from 'node:assert/strict';
import {readFileSync, renameSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {before, test} from 'node:test';
import type {DiagnosisSection, Disagreement} from '../src/data';
import {at, openReport, table, testWhole, thermotwin, writeStuck} from './reports';

/** What a machine file does not say: warm days show heat in the column or a warm neighbour, and not which. */
const cabinet = `
[[heat]]
name = "cabinet"
at = "column_rear"
power = "120 W"
while_on = "machine.on"
`;

before(() => {
  writeFileSync(at('shop.toml'), readFileSync(join(process.env.MACHINES!, 'v450.toml'), 'utf8') + cabinet);
  ['golden_b_4000', 'golden_b_6000', 'spindle_standard'].forEach((experiment, i) =>
    thermotwin('run', experiment, '-m', 'shop.toml', '--set', `experiment.seed=${i + 1}`, '-q', '-o', `day${i + 1}.h5`));
  const long_name = 'the_second_day_after_the_machine_was_moved_to_the_hall_behind_the_foundry.h5';
  renameSync(at('day2.h5'), at(long_name));
  writeFileSync(at('diagnosis.json'), thermotwin('diagnose', 'v450', 'day1.h5', long_name, '--hold-out', 'day3.h5', '--json'));
  thermotwin('report', 'diagnosis.json', '-o', 'diagnosis.html');
  thermotwin('run', 'spindle_standard', '-m', 'v450', '-q', '-o', 'whole.h5');
  writeStuck('dead.csv', 'whole.h5', 'T1_degC', '22');
  writeFileSync(at('dead.json'), thermotwin('diagnose', 'v450', 'dead.csv', '--json'));
  thermotwin('report', 'dead.json', '-o', 'dead.html');
});

testWhole('diagnosis', 'dead');

/** What `diagnose --json` printed, as far as its page shows it as it is. */
type Diagnosis = Required<Pick<DiagnosisSection,
  'verdict' | 'effects' | 'could_hide' | 'gap' | 'gaps' | 'disagreement' | 'unaccounted_heat' | 'experiment' | 'estimates'>>;

const found = (name = 'diagnosis'): Diagnosis => JSON.parse(readFileSync(at(`${name}.json`), 'utf8')) as Diagnosis;

test('a diagnosis names the effect, its rivals and its evidence', async () => {
  const {page} = await openReport('diagnosis'), {verdict, effects, gap, gaps, ...rest} = found();
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

test('what could hide is listed once per effect, at its largest', async () => {
  const {page, complaints} = await openReport('diagnosis'), {could_hide: limits} = found();
  const rows = page.locator('[data-panel="could_hide"] tr:has(td)'), names = [...new Set(limits.map((l) => l.effect))];
  const size = (x: number): string => x.toFixed(x < 10 ? 2 : 1);
  assert.deepEqual(await rows.locator('th').allTextContents(), names.map((name) => {
    const largest = limits.filter((l) => l.effect === name).reduce((a, b) => (b.swing > a.swing ? b : a));
    return `${name.replaceAll('_', ' ')} at ${largest.site}`;
  }));
  assert.equal(await rows.first().locator('.number').textContent(), size(Math.max(...limits.map((l) => l.swing))));
  const {rows: all} = await table(page, 'What could hide in these data');
  assert.equal(all.length, limits.length);
  assert.deepEqual(complaints, []);
  await page.close();
});

test('what speaks against the data stands above a verdict that knows no name', async () => {
  const {effects, ...rest} = found(), one = {...effects[0]!, group: 0, weight: 1}, other = {...one, group: 1};
  writeFileSync(at('none_known.json'), JSON.stringify({...rest, verdict: 'none_known', effects: [one, other],
    doubts: [{run: 'day1', channel: 'E_Z', text: 'E_Z moves against the machine'}]}));
  thermotwin('report', 'none_known.json', '-o', 'none_known.html');
  const {page, complaints} = await openReport('none_known'), name = `${one.effect.replaceAll('_', ' ')} at ${one.site}`;
  assert.equal(await page.locator('.verdict .tag').textContent(), 'None known');
  assert.equal(await page.locator('.verdict h2').textContent(),
    `Something is missing that none of the effects tried explains. What stands in for it: ${name}; and ${name}.`);
  assert.deepEqual(await page.locator('.diagnosis > .remark:nth-child(-n + 2)').allTextContents(),
    ['Look at the data first; all that follows takes them as they are:', 'day1: E_Z moves against the machine']);
  assert.deepEqual(complaints, []);
  await page.close();
});

test('where and when the twin disagrees is told by regime, by speed and over time', async () => {
  const {page, complaints} = await openReport('diagnosis'), {before, after} = found().disagreement;
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
      assert.ok(Math.abs(mean - part.mean!) <= 0.051, `${part.channel}, ${part.part}: ${mean}, not ${part.mean}`);
      assert.ok(title.endsWith(`power ${part.power!.toPrecision(3)}, with the effects ${left!.power!.toPrecision(3)}`), title);
    });
    assert.ok(parts.some((d) => d.significant) && parts.some((d) => !d.significant), `${cut}: nothing to tell apart`);
  }
  const {heads, rows, texts} = await table(page, 'Where and when the calibrated twin disagrees');
  assert.equal(rows.length, before.length);
  before.forEach((part, i) => {
    for (const name of ['run', 'channel', 'unit', 'cut', 'part'] as const) assert.equal(texts[i]![heads.indexOf(name)], part[name]);
    for (const name of ['mean', 'rms', 'power', 'p_value'] as const)
      assert.equal(rows[i]![heads.indexOf(name)], +part[name]!.toPrecision(7), `${name}, row ${i}`);
    assert.equal(rows[i]![heads.indexOf('significant')], Number(part.significant));
  });
  await host.locator('.cell').first().click();
  assert.equal(await host.locator('.told').textContent(), await host.locator('.cell').first().getAttribute('title'));
  assert.deepEqual(complaints, []);
  await page.close();
});

test('a sensor that never moves has no gap, and the verdict names it', async () => {
  const {page, complaints} = await openReport('dead'), {verdict, gaps} = found('dead');
  assert.equal(verdict, 'sensor');
  assert.deepEqual(gaps.fitted.filter((g) => g.before === null).map((g) => g.channel), ['T1']);
  assert.equal(await page.locator('.verdict h2').textContent(), 'The sensor T1 is at fault, not the machine.');
  assert.ok((await page.locator('.verdict').boundingBox())!.width > 1000, 'the verdict lies over the panels');
  const row = page.locator('[data-panel="gap_fitted"] .gap-row', {has: page.getByText('T1', {exact: true})});
  assert.equal(await row.locator('.number').textContent(), '–');
  assert.equal(await page.locator('[data-panel="gap_fitted"] .gap-row .disc').count(), gaps.fitted.length - 1);
  const cells = page.locator('[data-panel="residual_heat_map"] tr', {has: page.getByText('T1 / K', {exact: true})}).locator('td');
  assert.deepEqual(await cells.allTextContents(), ['–', '–']);
  const {rows, texts} = await table(page, 'Gap on the fitted data');
  texts.forEach((text, i) => assert.equal(Number.isNaN(rows[i]![4]), text[1] === 'T1', text.join()));
  assert.deepEqual(complaints, []);
  await page.close();
});

test('numbers that a diagnosis does not know are dashes', async () => {
  const {effects, gaps, ...rest} = found(), {before, after} = rest.disagreement, unknown = {mean: null, rms: null, power: null, p_value: null};
  writeFileSync(at('unknown.json'), JSON.stringify({...rest, effects, gap: {before: 0, after: 0},
    gaps: {fitted: gaps.fitted.map((g) => ({...g, before: null, after: null})), held_out: []},
    disagreement: {before: before.map((d) => ({...d, ...unknown})), after: after.map((d) => ({...d, ...unknown}))},
    estimates: rest.estimates.map(({name}) => ({name, estimate: null, standard_error: null, prior: null}))}));
  thermotwin('report', 'unknown.json', '-o', 'unknown.html');
  const {page, complaints} = await openReport('unknown');
  assert.deepEqual(await page.locator('.verdict .figures dd').allTextContents(), ['0.00', '0.00']);
  for (const cells of ['[data-panel="gap_fitted"] .gap-row .number:not(.label)', '[data-panel="residual_heat_map"] td:not(:empty)',
    '[data-panel="disagreement"] .cell', '[data-panel="estimates"] td'])
    assert.deepEqual([...new Set(await page.locator(cells).allTextContents())], ['–'], cells);
  assert.match((await page.locator('[data-panel="disagreement"] .cell').first().getAttribute('title'))!, /RMS – .*; power –, with the effects –$/);
  assert.deepEqual(complaints, []);
  await page.close();
});
