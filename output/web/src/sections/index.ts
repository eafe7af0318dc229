import type {DiagnosisSection, Numbers, RunsSection} from '../data';
import {make} from '../dom';
import type {PageState} from '../signal';
import {diagnosisSection} from './diagnosis';
import {runsSection} from './runs';

type Drawer = (section: never, numbers: Numbers, state: PageState) => HTMLElement;

/** What draws each kind of section. A new kind is one entry here and one file beside. */
const drawers: Record<string, Drawer> = {
  diagnosis: (section: DiagnosisSection, _: Numbers, state: PageState) => diagnosisSection(section, state),
  runs: (section: RunsSection, numbers: Numbers, state: PageState) => runsSection(section, numbers, state),
};

export function drawSection(section: {kind: string}, numbers: Numbers, state: PageState): HTMLElement {
  const drawer = drawers[section.kind];
  return drawer ? drawer(section as never, numbers, state)
    : make('p', {class: 'remark'}, `This page cannot draw a section of kind “${section.kind}”.`);
}
