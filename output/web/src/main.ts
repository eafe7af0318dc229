import {forgetCharts} from './chart';
import {unpack, type PageDocument} from './data';
import {make} from './dom';
import {follow} from './live';
import {drawSection} from './sections';
import {PageState, Signal} from './signal';
import {fitAll} from './sizes';

const theme_key = 'thermotwin-theme';

/** The reader's choice, kept where the browser allows it; otherwise what the system says. */
function themeButton(dark: Signal<boolean>): HTMLElement {
  const system = matchMedia('(prefers-color-scheme: dark)');
  const kept = (): string | null => {
    try {
      return localStorage.getItem(theme_key);
    } catch {
      return null;
    }
  };
  const button = make('button', {class: 'quiet theme', onclick: () => {
    dark.value = !dark.value;
    try {
      localStorage.setItem(theme_key, dark.value ? 'dark' : 'light');
    } catch { /* a page from disk may keep nothing */ }
  }});
  document.documentElement.dataset.theme = kept() ?? (system.matches ? 'dark' : 'light');
  dark.value = document.documentElement.dataset.theme === 'dark';
  system.addEventListener('change', () => {
    if (!kept()) dark.value = system.matches;
  });
  dark.watch((on) => {
    document.documentElement.dataset.theme = on ? 'dark' : 'light';
    button.textContent = on ? 'Light' : 'Dark';
    button.setAttribute('aria-label', on ? 'Switch to light' : 'Switch to dark');
  });
  return button;
}

/** On paper the page is light, as wide as a sheet, and drawn everywhere. */
function followPrinter(dark: Signal<boolean>): void {
  const {classList} = document.documentElement;
  let kept = false;
  addEventListener('beforeprint', () => {
    if (classList.contains('paper')) return;
    kept = dark.value;
    dark.value = false;
    classList.add('paper');
    fitAll();
  });
  addEventListener('afterprint', () => {
    classList.remove('paper');
    dark.value = kept;
  });
}

/** Graphics memory is scarce: a browser keeps few pictures in space at once. */
function giveUpPictures(host: HTMLElement): void {
  for (const canvas of host.querySelectorAll('canvas')) canvas.getContext('webgl2')?.getExtension('WEBGL_lose_context')?.loseContext();
}

/** The sections of a page, which can be drawn anew without losing what the reader has chosen. */
class Content {
  readonly element = make('div', {});
  private state: PageState | null = null;
  private firstTime = 0;

  constructor(private readonly dark: Signal<boolean>) {}

  async draw(content: PageDocument, packed: string): Promise<void> {
    const numbers = await unpack(packed), before = this.state, top = scrollY;
    const state = this.state = new PageState(new Signal(this.dark.value));
    state.view = before?.view ?? null;
    forgetCharts();
    giveUpPictures(this.element);
    this.element.replaceChildren(...content.sections.map((section) => drawSection(section, numbers, state)));
    const moved = before !== null && before.time.value !== this.firstTime;
    this.firstTime = state.time.value;
    if (moved) state.time.value = before.time.value;
    if (before?.selection.value) state.selection.value = before.selection.value;
    scrollTo(0, top);
  }

  setDark(dark: boolean): void {
    if (this.state) this.state.dark.value = dark;
  }
}

async function main(): Promise<void> {
  const page = document.getElementById('page')!;
  const content = JSON.parse(document.getElementById('document')!.textContent!) as PageDocument;
  const packed = document.getElementById('numbers')!;
  const dark = new Signal(false), body = new Content(dark), button = themeButton(dark);
  dark.watch((on) => body.setDark(on));
  followPrinter(dark);
  const title = make('h1', {}), footer = make('footer', {}, `${content.version}. The page is whole in this one file.`);
  const head = make('header', {class: 'masthead'}, make('div', {}, make('p', {class: 'brand'}, 'ThermoTwin'), title));
  const show = (now: PageDocument, numbers: string): Promise<void> => {
    title.textContent = now.title;
    document.title = `${now.title} · ThermoTwin`;
    return body.draw(now, numbers);
  };
  if (content.revision) {
    head.append(follow(content.revision, (news) => show(news.document, news.numbers)));
    footer.textContent = `${content.version}. Served by the program on this computer.`;
  }
  head.append(button);
  page.append(head, body.element, footer);
  await show(content, packed.textContent!);
  packed.remove();
  page.dataset.ready = 'true';
}

main().catch((error: unknown) => {
  document.getElementById('page')!.append(make('p', {class: 'remark'}, `This page could not be drawn: ${String(error)}`));
  throw error;
});
