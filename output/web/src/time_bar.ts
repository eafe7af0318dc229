import {make} from './dom';
import {timeText} from './format';
import type {PageState} from './signal';

const seconds_for_all = 20;

/** Play button and slider for the time that the whole page shows. */
export function timeBar(state: PageState, start: number, end: number): HTMLElement {
  const slider = make('input', {
    type: 'range', min: start, max: end, step: 'any', 'aria-label': 'Time',
    oninput: () => {
      state.time.value = +slider.value;
    },
    onkeydown: (event) => {
      const steps: Record<string, number> = {ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10};
      const step = steps[(event as KeyboardEvent).key];
      if (step === undefined) return;
      event.preventDefault();
      state.time.value = Math.min(end, Math.max(start, state.time.value + (step * (end - start)) / 100));
    },
  });
  const text = make('output', {class: 'time'});
  let last = 0, playing = false, told = 0;
  const button = make('button', {class: 'play', 'aria-label': 'Play', onclick: () => play(!playing)});

  function play(on: boolean): void {
    playing = on;
    button.setAttribute('aria-label', on ? 'Pause' : 'Play');
    button.dataset.playing = String(on);
    if (!on) return;
    if (state.time.value >= end) state.time.value = start;
    last = performance.now();
    requestAnimationFrame(step);
  }

  function step(now: number): void {
    if (!playing) return;
    const t = state.time.value + (Math.max(0, now - last) / 1000) * ((end - start) / seconds_for_all);
    last = now;
    state.time.value = Math.min(end, t);
    if (t >= end) play(false);
    else requestAnimationFrame(step);
  }

  state.time.watch((t) => {
    slider.value = String(t);
    clearTimeout(told);
    told = setTimeout(() => slider.setAttribute('aria-valuetext', timeText(t)), 200) as unknown as number;
    slider.style.setProperty('--share', String((t - start) / (end - start || 1)));
    text.textContent = timeText(t);
  });
  return make('div', {class: 'time-bar', role: 'group', 'aria-label': 'Time'}, button, slider, text);
}
