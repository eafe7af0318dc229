import {cividis, css} from '../colours';
import {make} from '../dom';

/** A cell of a table on the colour of its share of the largest, its text legible on it. */
export function heatCell(share: number, title: string, text: string | HTMLElement): HTMLElement {
  const box = make('td', {class: 'cell', title}, text);
  box.style.background = css(cividis(share));
  box.style.color = share > 0.5 ? '#101418' : '#ffffff';
  return box;
}
