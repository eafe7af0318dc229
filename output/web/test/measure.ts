// measure.cjs PAGE…: size, time to the first picture, frames per second while the time is dragged, CPU time per frame.
import {readdirSync, readFileSync, statSync} from 'node:fs';
import {loadavg} from 'node:os';
import {resolve} from 'node:path';
import {launch, settled} from './browser';

const frames = 120;

/** CPU seconds that this process' descendants have used. */
function cpuOfChildren(): number {
  const parents = new Map<number, {parent: number; ticks: number}>();
  for (const entry of readdirSync('/proc').filter((name) => /^\d+$/.test(name))) {
    try {
      const fields = readFileSync(`/proc/${entry}/stat`, 'utf8').split(') ')[1]!.split(' ');
      parents.set(+entry, {parent: +fields[1]!, ticks: +fields[11]! + +fields[12]!});
    } catch { /* gone meanwhile */ }
  }
  const ours = (pid: number): boolean => pid === process.pid || (parents.has(pid) && pid > 1 && ours(parents.get(pid)!.parent));
  return [...parents].filter(([pid]) => pid !== process.pid && ours(pid)).reduce((sum, [, p]) => sum + p.ticks, 0) / 100;
}

async function main(): Promise<void> {
  for (const file of process.argv.slice(2).map((name) => resolve(name))) {
    const browser = await launch();
    const page = await browser.newPage({viewport: {width: 1440, height: 900}});
    const before = cpuOfChildren();
    await page.goto(`file://${file}`);
    await page.locator('.stage canvas').waitFor();
    await settled(page);
    const first = await page.evaluate(() => performance.now()), firstCpu = cpuOfChildren() - before;
    await page.waitForTimeout(1500);
    const cpu = cpuOfChildren();
    const drag = await page.evaluate((count) => new Promise<number>((done) => {
      const slider = document.querySelector('.time-bar input') as HTMLInputElement, max = +slider.max, start = performance.now();
      let frame = 0;
      const step = (): void => {
        slider.value = String((max * (frame % 100)) / 100);
        slider.dispatchEvent(new Event('input', {bubbles: true}));
        if (++frame < count) requestAnimationFrame(step);
        else done(performance.now() - start);
      };
      requestAnimationFrame(step);
    }), frames);
    const caption = await page.locator('.caption').textContent();
    console.log(`${file}: ${(statSync(file).size / 1e6).toFixed(2)} MB; first picture after ${(first / 1000).toFixed(2)} s, ` +
      `${firstCpu.toFixed(2)} s of CPU with the browser's start; ${((1000 * frames) / drag).toFixed(0)} frames/s while dragging, ` +
      `${((1000 * (cpuOfChildren() - cpu)) / frames).toFixed(0)} ms of CPU per frame; “${caption}”; load ${loadavg()[0]!.toFixed(1)}`);
    await browser.close();
  }
}

void main();
