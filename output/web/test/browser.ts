import {mkdirSync} from 'node:fs';
import {chromium, type Browser, type Page} from 'playwright-core';

/** As a browser runs where there is no graphics card: WebGL and everything else by the processor. */
const flags = ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-gpu-compositing'];

export function launch(): Promise<Browser> {
  return chromium.launch({executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: flags});
}

/** A page from disk, and what went wrong on it: requests beyond its own file, errors, warnings, sections not drawn. */
export interface Opened {
  page: Page;
  complaints: string[];
}

export async function open(browser: Browser, file: string, width: number, theme: 'light' | 'dark' = 'light'): Promise<Opened> {
  const page = await browser.newPage({viewport: {width, height: width < 600 ? 844 : 900}, colorScheme: theme, hasTouch: width < 600});
  const complaints: string[] = [];
  page.on('request', (request) => {
    const url = request.url();
    if (url !== `file://${file}` && !url.startsWith('blob:') && !url.startsWith('data:')) complaints.push(`request: ${url}`);
  });
  page.on('pageerror', (error) => complaints.push(`error: ${error.message}`));
  page.on('console', (message) => {
    const driver = /GL Driver Message|GPU stall/.test(message.text());
    if (['error', 'warning'].includes(message.type()) && !driver) complaints.push(`${message.type()}: ${message.text()}`);
  });
  await page.goto(`file://${file}`);
  await page.locator('#page[data-ready]').waitFor({timeout: 60_000});
  if (await page.locator('.stage').count()) await page.locator('.stage .caption:not(:empty)').first().waitFor();
  await settled(page);
  complaints.push(...await failures(page));
  return {page, complaints};
}

/** What sections that could not be drawn say. */
export const failures = async (page: Page): Promise<string[]> =>
  (await page.locator('.failure').allTextContents()).map((text) => `failure: ${text}`);

/** Two pictures: of what is seen first, and of the whole page with every chart drawn. */
export async function photograph(page: Page, folder: string, name: string): Promise<void> {
  mkdirSync(folder, {recursive: true});
  await settled(page);
  await page.screenshot({path: `${folder}/${name}_first.png`});
  const height = await page.evaluate(() => document.body.scrollHeight);
  for (let y = 0; y <= height; y += 600) {
    await page.evaluate((top) => scrollTo(0, top), y);
    await settled(page);
  }
  await page.evaluate(() => scrollTo(0, 0));
  await settled(page);
  await page.screenshot({path: `${folder}/${name}.png`, fullPage: true});
}

/** Two frames have been drawn since. */
export async function settled(page: Page): Promise<void> {
  await page.evaluate(() => new Promise<void>((done) => requestAnimationFrame(() => requestAnimationFrame(() => done()))));
}

/** Colours of an element's picture, and how many pixels have each. */
export async function colours(page: Page, selector: string): Promise<Map<string, number>> {
  const png = (await page.locator(selector).first().screenshot()).toString('base64');
  const counts = await page.context().browser()!.newPage().then(async (reader) => {
    const found = await reader.evaluate(async (data) => {
      const image = new Image();
      image.src = `data:image/png;base64,${data}`;
      await image.decode();
      const canvas = document.createElement('canvas');
      [canvas.width, canvas.height] = [image.width, image.height];
      const context = canvas.getContext('2d')!;
      context.drawImage(image, 0, 0);
      const pixels = context.getImageData(0, 0, image.width, image.height).data, all: Record<string, number> = {};
      for (let i = 0; i < pixels.length; i += 4) {
        const colour = `${pixels[i]},${pixels[i + 1]},${pixels[i + 2]}`;
        all[colour] = (all[colour] ?? 0) + 1;
      }
      return all;
    }, png);
    await reader.close();
    return found;
  });
  return new Map(Object.entries(counts));
}
