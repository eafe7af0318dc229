import type {PageDocument} from './data';
import {make} from './dom';

/** A page as the program that serves it gives it anew. */
export interface News {
  document: PageDocument;
  numbers: string;
}

const between_ms = 1000;

/** Asks the program for what is newer, and says whether it answers. */
export function follow(revision: number, show: (news: News) => Promise<void>): HTMLElement {
  const word = make('p', {class: 'connection', role: 'status'});
  const say = (alive: boolean, text: string): void => {
    word.dataset.alive = String(alive);
    if (word.textContent !== text) word.textContent = text;
  };
  const ask = async (): Promise<void> => {
    const answer = await fetch(`document?after=${revision}`, {cache: 'no-store'});
    if (answer.status === 200) {
      const news = await answer.json() as News;
      revision = news.document.revision ?? 0;
      await show(news);
    }
    say(answer.ok, answer.ok ? 'live' : `the program answers ${answer.status}`);
  };
  const again = (): void => {
    ask().catch((error: unknown) => {
      if (!(error instanceof TypeError)) throw error;
      say(false, 'the program no longer answers; this is what it showed last');
    }).finally(() => setTimeout(again, between_ms));
  };
  say(true, 'live');
  setTimeout(again, between_ms);
  return word;
}
