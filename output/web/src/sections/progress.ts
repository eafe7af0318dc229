import {make} from '../dom';
import type {ProgressSection} from '../data';
import {timeText} from '../format';

/** What a command that goes on has done so far, the last first. */
export function progressSection(section: ProgressSection): HTMLElement {
  const steps = [...section.steps].reverse();
  return make('section', {class: 'progress', 'data-kind': 'progress'},
    make('section', {class: 'panel', 'data-panel': 'progress', 'aria-live': 'polite'},
      make('header', {}, make('h3', {}, section.title)),
      make('ol', {class: 'steps'}, ...steps.map((step, i) => {
        const strip = make('i', {class: 'bar'});
        strip.style.width = `${100 * (step.share ?? 0)}%`;
        return make('li', {class: i === 0 && !section.done ? 'latest' : ''}, make('span', {class: 'number'}, timeText(step.at_s)), make('span', {}, step.what),
          step.share !== undefined && make('span', {class: 'track'}, strip));
      }))));
}
