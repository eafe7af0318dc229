/** A value that tells those who look at it when it changes. */
export class Signal<T> {
  private readonly watchers: ((value: T) => void)[] = [];

  constructor(private current: T) {}

  get value(): T {
    return this.current;
  }

  set value(next: T) {
    if (Object.is(next, this.current)) return;
    this.current = next;
    for (const watcher of this.watchers) watcher(next);
  }

  /** Calls now, and at every change. */
  watch(watcher: (value: T) => void): void {
    this.watchers.push(watcher);
    watcher(this.current);
  }
}

export interface View {
  azimuth: number;
  elevation: number;
  scale: number;
  focus: [number, number, number];
}

export type Selection = {kind: 'sensor' | 'body' | 'displacement'; name: string} | null;

/** What all parts of a page share; a part with a time of its own shares the theme only. */
export class PageState {
  readonly time = new Signal(0);
  readonly selection = new Signal<Selection>(null);
  /** From where the machine is seen; null: from where it fits. */
  view: View | null = null;

  constructor(readonly dark = new Signal(false)) {}

  /** Chooses, or gives up what was chosen. */
  choose(selection: Selection): void {
    const now = this.selection.value;
    const same = now && selection && now.kind === selection.kind && now.name === selection.name;
    this.selection.value = same ? null : selection;
  }
}
