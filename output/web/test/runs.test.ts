// Reports of one run: its machine, its courses, one time for both.
import assert from 'node:assert/strict';
import {before, test} from 'node:test';
import {colours, settled} from './browser';
import {exported, openReport, slider, table, testWhole, thermotwin} from './reports';

before(() => {
  thermotwin('run', 'spindle_standard', '-m', 'v450', '--nodes', '-q', '-o', 'run.h5');
  thermotwin('run', 'feed_12000', '--nodes', '-q', '-o', 'feed.h5');
  thermotwin('report', 'run.h5', '-o', 'run.html');
  thermotwin('report', 'feed.h5', '-o', 'feed.html');
});

testWhole('run', 'feed');

test('the machine is drawn, in many colours', async () => {
  const {page} = await openReport('run');
  await settled(page);
  const seen = [...(await colours(page, '.stage')).values()].sort((a, b) => b - a);
  const all = seen.reduce((a, b) => a + b, 0);
  assert.ok(seen.length > 200, `${seen.length} colours`);
  assert.ok(seen[0]! < 0.9 * all, 'nearly all of the canvas is one colour');
  await page.close();
});

test('every sensor on the machine has its name, on a narrow screen too, and no two names lie on one another', async () => {
  for (const width of [1440, 390]) {
    const {page} = await openReport('run', width);
    const names = await page.locator('.sensor .name').evaluateAll((all) => all.map((name) => {
      const {left, right, top, bottom} = name.getBoundingClientRect();
      return {left, right, top, bottom};
    }));
    assert.ok(names.length > 5 && names.every(({left, right}) => right > left), `a name is missing at ${width} px`);
    names.forEach((a, i) => names.slice(i + 1).forEach((b) =>
      assert.ok(a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top, `two names are one at ${width} px`)));
    await page.close();
  }
});

test('the slider changes time, colours and values', async () => {
  const {page, complaints} = await openReport('run');
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
  const {page} = await openReport('run');
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
  const {page} = await openReport('run');
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
  const {page} = await openReport('run');
  const stage = (await page.locator('.stage').boundingBox())!;
  await page.mouse.click(stage.x + stage.width / 2, stage.y + 0.75 * stage.height);
  assert.equal(await page.locator('.chip[data-body][aria-pressed="true"]').count(), 1);
  assert.equal(await page.locator('.body-panel .panel').count(), 1);
  await page.locator('.chip[data-body="shaft"]').click();
  assert.match((await page.locator('.body-panel h3').textContent())!, /^shaft: mean/);
  await page.close();
});

test('the machine turns with pointer and keys, and deforms', async () => {
  const {page} = await openReport('run');
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
  const {page, complaints} = await openReport('run');
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
  const {page} = await openReport('run');
  const {heads, rows} = await table(page, 'Sensor temperatures'), [names, ...written] = exported('run.h5');
  assert.equal(rows.length, written.length);
  for (const name of ['time_s', 'T1_degC', 'T10_degC']) {
    const mine = heads.indexOf(name), theirs = names!.indexOf(name);
    for (let i = 0; i < rows.length; i += 50)
      assert.ok(Math.abs(rows[i]![mine]! - Number(written[i]![theirs])) < 1e-4, `${name}, row ${i}`);
  }
  await page.close();
});

test('the error along the stroke is drawn as curves and as a map', async () => {
  const {page} = await openReport('feed');
  for (const name of ['positioning_feed_z', 'positioning_map_feed_z']) {
    await page.locator(`[data-panel="${name}"]`).scrollIntoViewIfNeeded();
    await settled(page);
  }
  const map = await colours(page, '[data-panel="positioning_map_feed_z"] .chart');
  assert.ok(map.size > 100, `${map.size} colours`);
  await page.close();
});
