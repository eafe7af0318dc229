import {unpack, type PageDocument} from './data';
import {make} from './dom';
import {drawSection} from './sections';
import {PageState} from './signal';

/** The reader's choice, kept where the browser allows it; otherwise what the system says. */
function themeButton(state: PageState): HTMLElement {
  const key = 'thermotwin-theme', system = matchMedia('(prefers-color-scheme: dark)');
  const kept = (): string | null => {
    try {
      return localStorage.getItem(key);
    } catch {
      return null;
    }
  };
  const button = make('button', {class: 'quiet theme', onclick: () => {
    state.dark.value = !state.dark.value;
    try {
      localStorage.setItem(key, state.dark.value ? 'dark' : 'light');
    } catch { /* a page from disk may keep nothing */ }
  }});
  document.documentElement.dataset.theme = (kept() ?? (system.matches ? 'dark' : 'light'));
  state.dark.value = document.documentElement.dataset.theme === 'dark';
  system.addEventListener('change', () => {
    if (!kept()) state.dark.value = system.matches;
  });
  return button;
}

async function main(): Promise<void> {
  const page = document.getElementById('page')!;
  const content = JSON.parse(document.getElementById('document')!.textContent!) as PageDocument;
  const packed = document.getElementById('numbers')!;
  const state = new PageState(), button = themeButton(state);
  state.dark.watch((dark) => {
    document.documentElement.dataset.theme = dark ? 'dark' : 'light';
    button.textContent = dark ? 'Light' : 'Dark';
    button.setAttribute('aria-label', dark ? 'Switch to light' : 'Switch to dark');
  });
  document.title = `${content.title} · ThermoTwin`;
  page.append(make('header', {class: 'masthead'}, make('div', {}, make('p', {class: 'brand'}, 'ThermoTwin'), make('h1', {}, content.title)), button));
  const numbers = await unpack(packed.textContent!);
  packed.remove();
  for (const section of content.sections) page.append(drawSection(section, numbers, state));
  page.append(make('footer', {}, `${content.version}. The page is whole in this one file.`));
  page.dataset.ready = 'true';
}

main().catch((error: unknown) => {
  document.getElementById('page')!.append(make('p', {class: 'remark'}, `This page could not be drawn: ${String(error)}`));
  throw error;
});
