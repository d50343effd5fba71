// What a person waits for in the timeline, on the largest group a board of 32 servos can hold: an edit with what is drawn of
// it, and the frames for the board. Beside the time that is left in a frame of the screen once everything is drawn.

import { duplicateKeys } from '#shared/group/clip.ts';
import { compile } from '#shared/group/compile.ts';
import { emptyGroup, type ActionGroup } from '#shared/group/group.ts';
import { insertFrame } from '#shared/group/groupEdits.ts';
import { deleteKeys, moveKeys, scaleAmplitude, setEasing, setKey } from '#shared/group/keyEdits.ts';
import { deleteTime, insertTime, reverse, stretch } from '#shared/group/timeEdits.ts';
import { tracksOf, type KeyRef } from '#shared/group/tracks.ts';
import { family } from '#shared/codec/families.ts';
import { createRandom } from '#shared/simulator/faults.ts';
import { amount } from './amounts.ts';
import type { Figure } from './figure.ts';
import { median } from './statistics.ts';

const FRAMES = 255;
const SERVOS = 32;
const SEED = 255;
const RUNS = amount(15, 1);
const EDIT_LIMIT_MS = 2;

type Edit = (group: ActionGroup) => ActionGroup;

export function measureTimeline(): Figure[] {
  const group = largestGroup();
  const tracks = tracksOf(group);
  const refs = refsOf(group);
  const edits = Object.entries(editsOf(refs)).map(([name, edit]) => ({
    ...{ name, ms: medianMs(() => tracksOf(edit(group), tracks)) },
  }));
  const slowest = edits.reduce((most, each) => (each.ms > most.ms ? each : most));
  const typical = median(edits.map(({ ms }) => ms));
  const against = { what: 'limit', value: EDIT_LIMIT_MS };
  const of = `of ${edits.length} edits of ${FRAMES} × ${SERVOS} keys with their tracks, each a median of ${RUNS}`;
  return [
    { key: 'timeline.editMs', value: typical, unit: 'ms', against, note: `the middle ${of}` },
    {
      key: 'timeline.slowestEditMs',
      value: slowest.ms,
      unit: 'ms',
      against,
      note: `${slowest.name}: the slowest ${of}`,
    },
    ...[2, 10].map((maxErrorUnits) => compileFigure(group, maxErrorUnits)),
  ];
}

function compileFigure(group: ActionGroup, maxErrorUnits: number): Figure {
  const made = () => compile(group, { family: family('doc'), maxErrorUnits });
  const { frameCount } = made().report;
  return {
    ...{ key: `timeline.compile${maxErrorUnits}UnitsMs`, value: medianMs(made), unit: 'ms' },
    note: `the same group, eased and every third key missing, to ${frameCount} frames`,
  };
}

function editsOf(refs: readonly KeyRef[]): Readonly<Record<string, Edit>> {
  const one = refs.slice(4000, 4001);
  const some = refs.slice(2000, 2300);
  const half = refs.slice(0, refs.length / 2);
  const range = { fromMs: 20_000, toMs: 40_000 };
  const move =
    (moved: readonly KeyRef[], ripple = false): Edit =>
    (group) =>
      moveKeys(group, moved, { deltaMs: 130, deltaPosition: 5 }, { ripple });
  return {
    'one key set': (group) => setKey(group, 7, 33_333, 1600),
    'one key moved': move(one),
    '300 keys moved': move(some),
    'all keys moved': move(refs),
    'all keys moved with ripple': move(refs, true),
    '300 keys deleted': (group) => deleteKeys(group, some, { ripple: false }),
    'all keys deleted with ripple': (group) => deleteKeys(group, refs, { ripple: true }),
    'half of all keys duplicated': (group) => duplicateKeys(group, half, 51_000, { ripple: true }).group,
    'all swings halved': (group) => scaleAmplitude(group, refs, 0.5, 'mean'),
    'time inserted': (group) => insertTime(group, 30_000, 500),
    'time deleted': (group) => deleteTime(group, range),
    'time stretched': (group) => stretch(group, range, 1.5, { ripple: true }),
    'time reversed': (group) => reverse(group, range),
    'one easing set': (group) =>
      setEasing(
        group,
        refsOf(group).filter(({ frameId }) => frameId === 100),
        'out',
      ),
  };
}

function medianMs(work: () => unknown): number {
  const times = Array.from({ length: RUNS }, () => {
    const startMs = performance.now();
    work();
    return performance.now() - startMs;
  });
  return median(times);
}

function largestGroup(): ActionGroup {
  const random = createRandom(SEED);
  return Array.from({ length: FRAMES }).reduce<ActionGroup>(
    (group, _, index) => {
      const servos = Array.from({ length: SERVOS }, (_each, servo) => servo + 1).filter(
        () => index === 0 || random() < 2 / 3,
      );
      const targets = servos.map((servo) => ({ servo, position: 1200 + Math.floor(random() * 600) }));
      return insertFrame(group, index, {
        durationMs: 20 * (10 + Math.floor(random() * 10)),
        targets,
        easing: 'inOut',
      });
    },
    emptyGroup('Dance', 'us'),
  );
}

function refsOf({ frames }: ActionGroup): readonly KeyRef[] {
  return frames.flatMap(({ id, targets }) => targets.map(({ servo }) => ({ frameId: id, servo })));
}
