import {make} from '../dom';

/** Long names may break after an underscore; E_Z is none. */
const breakable = (text: string): (string | HTMLElement)[] =>
  text.split(/(?<=\w{3}_)/).flatMap((part, i) => (i > 0 ? [make('wbr'), part] : [part]));

/** The first thing that is read of an answer: what kind it is, one sentence, and its figures in large. */
export function card(kind: string, look: string, sentence: string, figures: [string, string][], ...below: HTMLElement[]): HTMLElement {
  return make('div', {class: `verdict ${look}`},
    make('div', {}, make('p', {class: 'tag'}, kind), make('h2', {}, ...breakable(sentence))),
    make('dl', {class: 'figures'}, ...figures.map(([label, value]) => make('div', {}, make('dt', {}, label), make('dd', {}, value)))),
    ...below);
}

export const remark = (text: string): HTMLElement => make('p', {class: 'remark'}, text);

/** A number to three digits or so, with a proper minus. */
export function short(x: number | null | undefined): string {
  if (x === null || x === undefined || !Number.isFinite(x)) return '–';
  const size = Math.abs(x);
  return x.toFixed(size >= 100 ? 0 : size >= 10 ? 1 : 2).replace('-', '−');
}
