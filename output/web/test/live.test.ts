// A page that the program serves and renews.
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {copyFileSync, renameSync} from 'node:fs';
import {before, test} from 'node:test';
import type {Page} from 'playwright-core';
import {failures, settled} from './browser';
import {at, browser, folder, program, slider, thermotwin} from './reports';

before(() => {
  thermotwin('run', 'spindle_standard', '-m', 'v450', '--nodes', '-q', '-o', 'run.h5');
  thermotwin('run', 'spindle_standard', '-m', 'v450', '--set', 'bearing.front.grease_factor=0.8', '-q', '-o', 'other.h5');
});

/** What the page's window would call before a print. */
async function callsBeforePrint(page: Page): Promise<number> {
  const session = await page.context().newCDPSession(page);
  const {result} = await session.send('Runtime.evaluate', {expression: 'window'});
  const {listeners} = await session.send('DOMDebugger.getEventListeners', {objectId: result.objectId!});
  return listeners.filter((listener) => listener.type === 'beforeprint').length;
}

test('a served page renews itself and keeps what the reader has chosen', async () => {
  const served = spawn(program, ['view', 'live.h5'], {cwd: folder});
  const address = await new Promise<string>((found) => served.stdout.on('data', (text) => found(/http:\S+/.exec(String(text))![0])));
  const complaints: string[] = [];
  try {
    const page = await browser.newPage({viewport: {width: 1440, height: 700}});
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
    await page.locator('.sensor[aria-label^="Sensor T8,"] .dot').click();
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
    await settled(page);
    assert.equal(await callsBeforePrint(page), 1, 'charts that the page no longer has are called');
    assert.deepEqual(await failures(page), []);
    served.kill('SIGINT');
    await page.getByText('no longer answers').waitFor({timeout: 20_000});
    assert.deepEqual(complaints, []);
    await page.close();
  } finally {
    served.kill('SIGKILL');
  }
});
