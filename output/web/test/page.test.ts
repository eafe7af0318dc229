// What all sections of a page have in common.
import assert from 'node:assert/strict';
import {readFileSync, statSync, writeFileSync} from 'node:fs';
import {before, test} from 'node:test';
import {at, openReport, thermotwin} from './reports';

before(() => {
  thermotwin('run', 'spindle_standard', '-m', 'v450', '--nodes', '-q', '-o', 'run.h5');
  thermotwin('report', 'run.h5', '-o', 'run.html');
});

test('a page is small', () => {
  assert.ok(statSync(at('run.html')).size < 1.5e6);
});

test('a section that cannot be drawn says why, and the others are drawn', async () => {
  writeFileSync(at('broken.html'), readFileSync(at('run.html'), 'utf8').replace('"sections":[', '$&{"kind":"study"},{"kind":"poem"},'));
  const {page, complaints} = await openReport('broken');
  const [study, poem] = await page.locator('.failure').allTextContents();
  assert.match(study!, /^This section, of kind “study”, could not be drawn: TypeError: .*undefined/);
  assert.equal(poem, 'This page cannot draw a section of kind “poem”.');
  assert.equal(await page.locator('[data-panel="sensor_temperatures_degC"]').count(), 1);
  for (const words of [study, poem]) assert.ok(complaints.includes(`failure: ${words}`), 'a test would not see it');
  await page.close();
});
