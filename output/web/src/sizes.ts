/**
 * What is drawn to the size of its element: once somebody has come near it, so that the page is there sooner, then
 * whenever that size changes, and all of it at once before the page is printed.
 */
class Drawings {
  private readonly all = new Map<Element, () => void>();
  private readonly size = new ResizeObserver((entries) => entries.forEach(({target}) => this.all.get(target)?.()));
  private readonly near = new IntersectionObserver((entries) => entries.forEach(({target, isIntersecting}) => {
    if (!isIntersecting) return;
    this.near.unobserve(target);
    this.size.observe(target);
  }), {rootMargin: '800px'});

  add(element: Element, draw: () => void): void {
    this.all.set(element, draw);
    this.near.observe(element);
  }

  draw(): void {
    for (const draw of this.all.values()) draw();
  }

  end(): void {
    this.size.disconnect();
    this.near.disconnect();
  }
}

let drawings: Drawings | null = null;

export const keepFitted = (element: Element, draw: () => void): void => (drawings ??= new Drawings()).add(element, draw);

export const fitAll = (): void => drawings?.draw();

/** Of a page that is drawn anew: the window would keep what waits, with all its numbers. */
export function forgetSizes(): void {
  drawings?.end();
  drawings = null;
}
