// The timeline of an action group in its states.

import { addMarker } from '#shared/group/frameEdits.ts';
import type { ActionGroup } from '#shared/group/group.ts';
import { insertFrame, type NewFrame } from '#shared/group/groupEdits.ts';
import { makeBlock } from '#shared/group/blockEdits.ts';
import { moveKeys, setEasing } from '#shared/group/keyEdits.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { actionsParts } from '../../features/animate/frames/ActionsPanel.tsx';
import { AuthoringPanel } from '../Authoring.tsx';
import { select } from '../../features/animate/timeline/context.ts';
import { pressFrame } from '../../features/animate/timeline/inStep.ts';
import { keySet } from '../../features/animate/timeline/timeline.ts';
import { freshRobot } from '../../features/profiles/robots.ts';
import { editServoView, type Stores } from '../../features/stores.ts';
import { type Exhibit, specimenStores } from './exhibit.ts';

function wave(frames: number, servos: number): ActionGroup['frames'][number]['targets'][] {
  return Array.from({ length: frames }, (_, frame) =>
    Array.from({ length: servos }, (_, index) => ({
      servo: index + 1,
      position: Math.round(1500 + 700 * Math.sin((frame + 1) * 0.7 + index)),
    })).filter(({ servo }) => frames > 50 || (frame + servo) % 4 !== 0),
  );
}

const LOOKS: readonly Partial<NewFrame>[] = [
  { easing: 'in', note: 'Look up' },
  { easing: 'out', colour: 'violet' },
  { easing: 'inOut', colour: 'olive' },
  { easing: 'hold' },
];

function fill({ document }: Stores, frames: number, servos: number): void {
  document.edit(
    () => '',
    (empty) => {
      const group = wave(frames, servos).reduce<ActionGroup>(
        (sum, targets, index) =>
          insertFrame(
            sum,
            index,
            { durationMs: 300 + 100 * (index % 4), targets, ...LOOKS[index % 4] },
            'us',
          ),
        empty,
      );
      return frames === 0 ? group : addMarker(group, 900, 'Bow');
    },
  );
}

const SELECTED = [
  { frameId: 2, servo: 3 },
  { frameId: 3, servo: 3 },
  { frameId: 2, servo: 4 },
];

function drag({ document }: Stores): void {
  document.begin(() => '');
  document.preview((group) =>
    moveKeys(group, SELECTED, { deltaMs: 120, deltaPosition: 200 }, { ripple: false }),
  );
}

interface Case {
  readonly name: string;
  readonly frames: number;
  readonly robot?: 'plain32' | 'humanoid18';
  prepare?(stores: Stores): void;
}

const CASES: readonly Case[] = [
  { name: 'Timeline, empty', frames: 0 },
  { name: 'Timeline, simple', frames: 6 },
  {
    name: 'Timeline, keys selected',
    frames: 6,
    prepare: ({ timeline }) => timeline.setState({ selected: keySet(SELECTED), playheadMs: 700 }),
  },
  {
    name: 'Timeline, frames selected',
    frames: 6,
    prepare(stores) {
      pressFrame(stores, 2, { ctrl: false, shift: false });
      pressFrame(stores, 4, { ctrl: false, shift: true });
    },
  },
  {
    name: 'Timeline, tall and looped',
    frames: 6,
    prepare: ({ timeline }) => timeline.setState({ isTall: true, range: { fromMs: 300, toMs: 1200 } }),
  },
  {
    name: 'Timeline in degrees, a key chosen',
    frames: 6,
    prepare(stores) {
      stores.view.setState({ positionsIn: 'degrees' });
      stores.timeline.setState({ isTall: true });
      select(stores, keySet([{ frameId: 3, servo: 1 }]), { row: 'servo 1', frameId: 3 });
    },
  },
  { name: 'Timeline, dragging', frames: 6, prepare: drag },
  {
    name: 'Timeline, a curve and a block',
    frames: 6,
    prepare({ document, timeline }) {
      document.edit(
        () => '',
        (group) => setEasing(group, SELECTED.slice(0, 1), [0.34, 1.56, 0.64, 1]),
      );
      document.edit(
        () => '',
        (group) =>
          makeBlock(
            group,
            [
              { frameId: 4, servo: 4 },
              { frameId: 6, servo: 4 },
            ],
            'Nod',
          ) ?? group,
      );
      timeline.setState({
        large: { servo: 3, min: 700, max: 2300 },
        selected: keySet(SELECTED.slice(0, 1)),
        cursor: { row: 'servo 3', frameId: 2 },
      });
    },
  },
  {
    name: 'Timeline, rows locked and muted',
    frames: 6,
    prepare: (stores) => editServoView(stores, (view) => ({ ...view, locked: [2], muted: [4], hidden: [6] })),
  },
  {
    name: 'Timeline, limbs',
    frames: 12,
    robot: 'humanoid18',
    prepare: (stores) => editServoView(stores, (view) => ({ ...view, folded: ['Left leg'] })),
  },
  { name: 'Timeline, 255 frames of 32 servos', frames: 255, robot: 'plain32' },
];

export const TIMELINES: readonly Exhibit[] = CASES.map((specimen) => ({
  name: specimen.name,
  content: <AuthoringPanel {...actionsParts} />,
  stores: () => storesOf(specimen),
}));

function storesOf({ frames, robot, prepare }: Case): Stores {
  const stores = specimenStores(FAMILIES.doc);
  if (robot !== undefined) stores.robots.add(() => '', freshRobot(robot, 'lsc-32'));
  fill(stores, frames, robot === 'plain32' ? 32 : robot === 'humanoid18' ? 18 : 6);
  prepare?.(stores);
  return stores;
}
