/**
 * What is drawn to the size of its element: once somebody has come near it, so that the page is there sooner, then
 * whenever that size changes, and all of it at once before the page is printed.
 */
const drawings = new Map<Element, () => void>();

const size = new ResizeObserver((entries) => entries.forEach(({target}) => drawings.get(target)?.()));
const near = new IntersectionObserver((entries) => entries.forEach(({target, isIntersecting}) => {
  if (!isIntersecting) return;
  near.unobserve(target);
  size.observe(target);
}), {rootMargin: '800px'});

export function keepFitted(element: Element, draw: () => void): void {
  drawings.set(element, draw);
  near.observe(element);
}

export function fitAll(): void {
  for (const draw of drawings.values()) draw();
}

/** Of a page that is drawn anew: they would be kept, with all their numbers. */
export function forgetSizes(): void {
  for (const observer of [size, near]) observer.disconnect();
  drawings.clear();
}
