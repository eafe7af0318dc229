import type {CampaignSection, DiagnosisSection, Numbers, PlacementSection, ProgressSection, RunsSection, StudySection, VolumetricSection} from '../data';
import {make} from '../dom';
import type {PageState} from '../signal';
import {campaignSection} from './campaign';
import {diagnosisSection} from './diagnosis';
import {placementSection} from './placement';
import {progressSection} from './progress';
import {runsSection} from './runs';
import {studySection} from './study';
import {volumetricSection} from './volumetric';

type Drawer = (section: never, numbers: Numbers, state: PageState) => HTMLElement;

/** What draws each kind of section. A new kind is one entry here and one file beside. */
const drawers: Record<string, Drawer> = {
  campaign: (section: CampaignSection, numbers: Numbers, state: PageState) => campaignSection(section, numbers, state),
  diagnosis: (section: DiagnosisSection, _: Numbers, state: PageState) => diagnosisSection(section, state),
  placement: (section: PlacementSection, numbers: Numbers, state: PageState) => placementSection(section, numbers, state),
  progress: (section: ProgressSection) => progressSection(section),
  runs: (section: RunsSection, numbers: Numbers, state: PageState) => runsSection(section, numbers, state),
  study: (section: StudySection) => studySection(section),
  volumetric: (section: VolumetricSection, _: Numbers, state: PageState) => volumetricSection(section, state),
};

/** A section that cannot be drawn says so in its place, and leaves the others as they are. */
export function drawSection(section: {kind: string}, numbers: Numbers, state: PageState): HTMLElement {
  const drawer = drawers[section.kind];
  if (!drawer) return failure(`This page cannot draw a section of kind “${section.kind}”.`);
  try {
    return drawer(section as never, numbers, state);
  } catch (error) {
    console.error(error);
    return failure(`This section, of kind “${section.kind}”, could not be drawn: ${String(error)}`);
  }
}

const failure = (text: string): HTMLElement => make('p', {class: 'remark failure'}, text);
