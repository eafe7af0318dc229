import {csv, download, type Column} from './csv';

type Attributes = Record<string, string | number | boolean | undefined | ((event: Event) => void)>;
type Child = Node | string | null | undefined | false;

/** An element: `onclick` and such are listeners, other attributes are set unless undefined or false. */
export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  dress(element, attributes, children);
  return element;
}

export function svg(tag: string, attributes: Attributes = {}, ...children: Child[]): SVGElement {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  dress(element, attributes, children);
  return element;
}

function dress(element: Element, attributes: Attributes, children: Child[]): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') element.addEventListener(name.slice(2), value);
    else if (value !== undefined && value !== false) element.setAttribute(name, value === true ? '' : String(value));
  }
  for (const child of children) if (child) element.append(child);
}

/** A panel with its title, what is said beside it, and its numbers as CSV. */
export function panel(title: string, file: string, columns: () => Column[], ...children: Child[]): HTMLElement {
  const button = make('button', {
    class: 'quiet', title: `numbers of “${title}” as CSV`, 'aria-label': `Download ${title} as CSV`,
    onclick: () => download(`${file}.csv`, csv(columns())),
  }, 'CSV');
  return make('section', {class: 'panel', 'data-panel': file},
    make('header', {}, make('h3', {}, title), button), ...children);
}

/** The numbers below a track, each where it lies on it in percent. */
export function trackAxis(ticks: number[], place: (tick: number) => number): HTMLElement {
  return make('span', {class: 'track axis'}, ...ticks.map((tick) => {
    const mark = make('span', {}, String(tick).replace('-', '−'));
    mark.style.left = `${place(tick)}%`;
    return mark;
  }));
}

/** A strip of colours with its numbers. */
export function colourBar(gradient: string, ticks: number[], label: string): HTMLElement {
  const low = ticks[0]!, span = ticks[ticks.length - 1]! - low || 1;
  const marks = make('div', {class: 'marks'});
  for (const tick of ticks) {
    const mark = make('span', {}, String(tick).replace('-', '−'));
    mark.style.left = `${(100 * (tick - low)) / span}%`;
    marks.append(mark);
  }
  const strip = make('div', {class: 'strip'});
  strip.style.background = `linear-gradient(to right, ${gradient})`;
  return make('div', {class: 'colour-bar'}, make('span', {class: 'label'}, label), make('div', {class: 'scale'}, strip, marks));
}
