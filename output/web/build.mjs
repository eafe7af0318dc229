// build.mjs OUTPUT          bundles the page into one file, to which the program adds data.
// build.mjs --tests FOLDER  bundles the tests, for node --test, and measure.cjs.
import {mkdirSync, readFileSync, readdirSync, writeFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const esbuild = await import('esbuild').catch(() => {
  console.error('output/web/node_modules is missing: run script/bootstrap');
  process.exit(1);
});

const browser = {bundle: true, minify: true, write: false, charset: 'ascii', target: 'es2022', logLevel: 'warning'};

function bundled(entry, options = {}) {
  const result = esbuild.buildSync({...browser, entryPoints: [join(here, 'src', entry)], ...options});
  return result.outputFiles[0].text.trim();
}

/** `</script` in a string of the program would end it in the middle. */
const insideScript = (text) => text.replaceAll('</script', '<\\/script');

function buildPage(output) {
  const parts = {
    style: bundled('page.css'),
    script: insideScript(bundled('main.ts', {format: 'iife'})),
  };
  const html = readFileSync(join(here, 'src/page.html'), 'utf8')
    .replace(/<!--(style|script)-->/g, (_, name) => parts[name]);
  if (html.split('<!--data-->').length !== 2) throw new Error('page.html needs <!--data--> once');
  mkdirSync(dirname(output), {recursive: true});
  writeFileSync(output, html);
}

function buildTests(folder) {
  const tests = readdirSync(join(here, 'test')).filter((name) => name.endsWith('.test.ts') || name === 'measure.ts');
  esbuild.buildSync({
    entryPoints: tests.map((name) => join(here, 'test', name)),
    bundle: true, platform: 'node', format: 'cjs', outdir: folder, outExtension: {'.js': '.cjs'},
    external: ['playwright-core'], logLevel: 'warning',
  });
}

const [first, second] = process.argv.slice(2);
if (first === '--tests') buildTests(second);
else buildPage(first);
