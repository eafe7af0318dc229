import type {Camera} from './camera';

/** What a view does when it is turned, fitted, or clicked without being turned. */
export interface Turned {
  changed: () => void;
  fit: () => void;
  pick?: (event: PointerEvent) => void;
}

const turns: Record<string, [number, number]> =
  {ArrowLeft: [-8, 0], ArrowRight: [8, 0], ArrowUp: [0, 8], ArrowDown: [0, -8]};

/** A camera turned, shifted and zoomed over a stage: one finger or the left button turns, two fingers, the right button
 * or Shift shift, Ctrl and the wheel zoom; arrow keys turn, plus and minus zoom, 0 fits. */
export function turntable(stage: HTMLElement, camera: Camera, act: Turned): void {
  stage.addEventListener('keydown', (event) => {
    const turn = turns[event.key];
    if (turn) camera.turn(...turn);
    else if (event.key === '+' || event.key === '=') camera.scale /= 1.15;
    else if (event.key === '-') camera.scale *= 1.15;
    else if (event.key === '0') act.fit();
    else return;
    event.preventDefault();
    act.changed();
  });
  stage.addEventListener('wheel', (event) => {
    if (!event.ctrlKey) return;
    event.preventDefault();
    camera.scale *= Math.exp(event.deltaY / 300);
    act.changed();
  }, {passive: false});
  stage.addEventListener('contextmenu', (event) => event.preventDefault());
  followPointers(stage, camera, act);
}

function followPointers(stage: HTMLElement, camera: Camera, act: Turned): void {
  const down = new Map<number, PointerEvent>();
  let still = true;
  stage.addEventListener('pointerdown', (event) => {
    if ((event.target as Element).closest('button')) return;
    down.set(event.pointerId, event);
    still = true;
    stage.setPointerCapture(event.pointerId);
  });
  stage.addEventListener('pointermove', (event) => {
    const last = down.get(event.pointerId);
    if (!last) return;
    const dx = event.clientX - last.clientX, dy = event.clientY - last.clientY;
    if (still && Math.hypot(dx, dy) < 4) return;
    still = false;
    const other = [...down.values()].find((p) => p.pointerId !== event.pointerId);
    if (other) {
      const gap = (p: PointerEvent): number => Math.hypot(p.clientX - other.clientX, p.clientY - other.clientY);
      camera.scale *= gap(last) / Math.max(10, gap(event));
      camera.shift(dx / 2 / stage.clientHeight, -dy / 2 / stage.clientHeight);
    } else if (event.shiftKey || event.buttons === 2) {
      camera.shift(dx / stage.clientHeight, -dy / stage.clientHeight);
    } else {
      camera.turn(dx * 0.4, dy * 0.4);
    }
    down.set(event.pointerId, event);
    act.changed();
  });
  const up = (event: PointerEvent): void => {
    if (down.delete(event.pointerId) && still && event.type === 'pointerup') act.pick?.(event);
  };
  stage.addEventListener('pointerup', up);
  stage.addEventListener('pointercancel', up);
}
