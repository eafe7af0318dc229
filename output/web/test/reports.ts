// Reports that the program makes for one file of tests, in a folder of its own, and the browser in which they are read.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, test} from 'node:test';
import type {Browser, Locator, Page} from 'playwright-core';
import {launch, open, photograph, type Opened} from './browser';

export const program = process.env.THERMOTWIN_PROGRAM!, folder = mkdtempSync(join(tmpdir(), 'thermotwin-page-'));
export let browser: Browser;

before(async () => {
  browser = await launch();
});

after(async () => {
  await browser?.close();
  rmSync(folder, {recursive: true, force: true});
});

export const at = (name: string): string => join(folder, name);

export function thermotwin(...args: string[]): string {
  return execFileSync(program, args, {cwd: folder, encoding: 'utf8'});
}

export const openReport = (name: string, width = 1440, theme: 'light' | 'dark' = 'light'): Promise<Opened> =>
  open(browser, at(`${name}.html`), width, theme);

/** A test per width and theme. Pictures of the reports go to the folder in PICTURES. */
export function testWhole(...names: string[]): void {
  for (const name of names)
    for (const [width, theme] of [[1440, 'light'], [1440, 'dark'], [390, 'light'], [390, 'dark']] as const)
      test(`${name} at ${width}, ${theme}: whole, quiet, nothing cut off`, async () => {
        const {page, complaints} = await openReport(name, width, theme);
        await photograph(page, process.env.PICTURES!, `${name}_${width}_${theme}`);
        const overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
        assert.ok(overflow <= 0, `the page is ${overflow} px wider than the screen`);
        assert.ok(await page.locator('.panel').count() > 2);
        assert.deepEqual(complaints, []);
        await page.close();
      });
}

export const slider = (page: Page): Locator => page.getByRole('slider', {name: 'Time'});

/** What a panel's CSV holds: its heads, and its rows as numbers and as they stand. */
export async function table(page: Page, name: string): Promise<{heads: string[]; rows: number[][]; texts: string[][]}> {
  const waiting = page.waitForEvent('download');
  await page.getByRole('button', {name: `Download ${name} as CSV`}).click();
  const [heads, ...texts] = cells(await (await waiting).path());
  return {heads: heads!, rows: texts.map((row) => row.map((x) => (x === '' ? NaN : Number(x)))), texts};
}

/** A data set as rows of text, its heads first. */
export function exported(name: string): string[][] {
  thermotwin('export', name, '-o', 'exported.csv');
  return cells(at('exported.csv'));
}

export function writeCells(name: string, rows: (string | number)[][]): void {
  writeFileSync(at(name), rows.map((row) => row.join()).join('\n') + '\n');
}

/** A data set of which one column always shows the same. */
export function writeStuck(name: string, data: string, head: string, text: string): void {
  const [heads, ...rows] = exported(data), stuck = heads!.indexOf(head);
  writeCells(name, [heads!, ...rows.map((row) => row.map((x, i) => (i === stuck ? text : x)))]);
}

const cells = (file: string): string[][] => readFileSync(file, 'utf8').trim().split('\n').map((line) => line.split(','));
