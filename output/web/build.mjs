// build.mjs OUTPUT          bundles the page and writes it as two C++ texts: what stands before its data, and after.
// build.mjs --tests FOLDER  bundles the tests, for node --test.
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

function asCpp(text) {
  if (text.includes(')page"')) throw new Error('the page holds the end of a C++ text');
  return `R"page(${text})page"`;
}

function buildPage(output) {
  const parts = {
    style: bundled('page.css'),
    script: insideScript(bundled('main.ts', {format: 'iife'})),
  };
  const html = readFileSync(join(here, 'src/page.html'), 'utf8')
    .replace(/<!--(style|script)-->/g, (_, name) => parts[name]);
  const halves = html.split('<!--data-->');
  if (halves.length !== 2) throw new Error('page.html needs <!--data--> once');
  mkdirSync(dirname(output), {recursive: true});
  writeFileSync(output, halves.map(asCpp).join(',\n') + '\n');
}

function buildTests(folder) {
  const tests = readdirSync(join(here, 'test')).filter((name) => name.endsWith('.test.ts'));
  esbuild.buildSync({
    entryPoints: tests.map((name) => join(here, 'test', name)),
    bundle: true, platform: 'node', format: 'esm', outdir: folder, outExtension: {'.js': '.mjs'},
    external: ['playwright-core'], nodePaths: [join(here, 'node_modules')], logLevel: 'warning',
  });
}

const [first, second] = process.argv.slice(2);
if (first === '--tests') buildTests(second);
else buildPage(first);
