// Action groups generated for tests, and ways to look at their motion. Knows documents; no board.

import fc from 'fast-check';
import { COLOURS } from '../document/schema.ts';
import { EASINGS, emptyGroup, type ActionGroup, type Easing } from '../group/group.ts';
import { insertFrame } from '../group/groupEdits.ts';
import { addMarker } from '../group/frameEdits.ts';
import type { TimeRange } from '../group/timeEdits.ts';
import { frameEnds, positionAt, tracksOf, type KeyRef, type Tracks } from '../group/tracks.ts';

// Action groups generated for tests, and ways to look at their motion.

interface GroupTraits {
  readonly servos?: readonly number[];
  /** Every frame names every servo. */
  readonly isFull?: boolean;
  readonly durationMs?: fc.Arbitrary<number>;
  readonly easings?: readonly Easing[];
  readonly positions?: fc.Arbitrary<number>;
  readonly least?: number;
}

const SERVOS = [1, 2, 3, 4, 5, 6];

export function someGroup({
  servos = SERVOS,
  isFull = false,
  durationMs = fc.oneof(fc.integer({ min: 0, max: 1500 }), fc.constantFrom(0, 20, 100, 500)),
  easings = EASINGS,
  positions = fc.integer({ min: 500, max: 2500 }),
  least = 0,
}: GroupTraits = {}): fc.Arbitrary<ActionGroup> {
  const targets = fc
    .subarray([...servos], { minLength: isFull ? servos.length : 0 })
    .chain((named) => fc.tuple(...named.map((servo) => positions.map((position) => ({ servo, position })))));
  const frame = fc.record({
    durationMs,
    targets,
    easing: fc.constantFrom(...easings),
    note: fc.constantFrom('', '', '', 'Wait for it'),
    colour: fc.constantFrom(null, null, null, ...COLOURS),
  });
  const marker = fc.record({ atMs: fc.integer({ min: 0, max: 8000 }), text: fc.string({ maxLength: 8 }) });
  return fc
    .tuple(fc.array(frame, { minLength: least, maxLength: 8 }), fc.array(marker, { maxLength: 3 }))
    .map(([frames, markers]) => {
      const group = frames.reduce(
        (sum, each) => insertFrame(sum, sum.frames.length, each),
        emptyGroup('Wave', 'us'),
      );
      return frozen(markers.reduce((sum, { atMs, text }) => addMarker(sum, atMs, text), group));
    });
}

/** Whoever changes it in place throws. */
export function frozen<T>(value: T): T {
  if (typeof value === 'object' && value !== null) Object.values(Object.freeze(value)).forEach(frozen);
  return value;
}

export function refsOf({ frames }: ActionGroup): readonly KeyRef[] {
  return frames.flatMap(({ id, targets }) => targets.map(({ servo }) => ({ frameId: id, servo })));
}

/** Any of its keys. */
export const someRefs = (group: ActionGroup): fc.Arbitrary<KeyRef[]> => fc.subarray([...refsOf(group)]);

/** Often just where a frame ends. */
function someInstant({ frames }: ActionGroup): fc.Arbitrary<number> {
  const ends = frameEnds(frames);
  return fc.oneof(fc.constantFrom(0, ...ends), fc.integer({ min: 0, max: (ends.at(-1) ?? 0) + 500 }));
}

export function someRange(group: ActionGroup): fc.Arbitrary<TimeRange> {
  return fc
    .tuple(someInstant(group), someInstant(group))
    .map(([one, other]) => ({ fromMs: Math.min(one, other), toMs: Math.max(one, other) }));
}

/** A group and what is generated of it. */
export function withGroup<T>(
  groups: fc.Arbitrary<ActionGroup>,
  more: (group: ActionGroup) => fc.Arbitrary<T>,
): fc.Arbitrary<readonly [ActionGroup, T]> {
  return groups.chain((group) => fc.tuple(fc.constant(group), more(group)));
}

/** What moves, without the names of the frames. */
export function shapeOf(group: ActionGroup) {
  return [...tracksOf(group).values()].map(({ servo, keys }) => ({
    servo,
    keys: keys.map(({ atMs, position, easing }) => ({ atMs, position, easing })),
  }));
}

/** Where these servos are at many instants. */
export function sampled(tracks: Tracks, servos: readonly number[], untilMs = 14_000, stepMs = 37) {
  const times = Array.from({ length: Math.ceil(untilMs / stepMs) }, (_, index) => index * stepMs);
  return servos.map((servo) => {
    const track = tracks.get(servo);
    return times.map((atMs) => (track === undefined ? null : positionAt(track, atMs)));
  });
}
