// Action groups generated for tests, ways to look at their motion, and files of groups: those of shared/protocol/vectors/files with what
// they mean, and as many in every format as are wanted, as large as real ones are (boards.md section 9). Knows documents; no board.

import fc from 'fast-check';
import { COLOURS } from '../document/schema.ts';
import { EASINGS, type Easing } from '../group/curves.ts';
import { easingOf, emptyGroup, type ActionGroup, type GroupSound } from '../group/group.ts';
import { insertFrame } from '../group/groupEdits.ts';
import { withOwnEasing } from '../group/moments.ts';
import { addMarker } from '../group/frameEdits.ts';
import type { TimeRange } from '../group/timeEdits.ts';
import { frameEnds, positionAt, tracksOf, type KeyRef, type Tracks } from '../group/tracks.ts';
import meanings from '../../protocol/vectors/files/meanings.json' with { type: 'json' };
import type { Reading } from '../files/reading.ts';
import { FAMILIES, type Family } from '../codec/families.ts';
import { readyRobot } from '../profile/readyRobots.ts';
import { writeGroupFile, type MakeDatabase, type SavedFile } from '../files/writeGroupFile.ts';

// Generated groups, and their motion.

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
const SOUND: GroupSound = {
  ...{ id: '0123456789abcdef', fileName: 'march.ogg', startMs: -250 },
  beats: { firstMs: 120.5, everyMs: 483.871 },
};

/** Those with a name, and curves that swing past one end, past both, start or end at once. */
export const ANY_EASING: readonly Easing[] = [
  ...EASINGS,
  [0.34, 1.56, 0.64, 1],
  [0.36, 0, 0.66, -0.56],
  [0.3, -2, 0.7, 3],
  [0, 1, 1, 0],
  [1, 0, 0, 1],
  [0, 0, 1, 1],
];

function someKey(servo: number, positions: fc.Arbitrary<number>, easings: readonly Easing[]) {
  const own = fc.oneof(
    { weight: 3, arbitrary: fc.constant({}) },
    { weight: 1, arbitrary: fc.constantFrom(...easings).map((easing) => ({ easing })) },
  );
  return fc.tuple(positions, own).map(([position, easing]) => ({ servo, position, ...easing }));
}

export function someGroup({
  servos = SERVOS,
  isFull = false,
  durationMs = fc.oneof(fc.integer({ min: 0, max: 1500 }), fc.constantFrom(0, 20, 100, 500)),
  easings = ANY_EASING,
  positions = fc.integer({ min: 500, max: 2500 }),
  least = 0,
}: GroupTraits = {}): fc.Arbitrary<ActionGroup> {
  const targets = fc
    .subarray([...servos], { minLength: isFull ? servos.length : 0 })
    .chain((named) => fc.tuple(...named.map((servo) => someKey(servo, positions, easings))));
  const frame = fc.record({
    durationMs,
    targets,
    easing: fc.constantFrom(...easings),
    note: fc.constantFrom('', '', '', 'Wait for it'),
    colour: fc.constantFrom(null, null, null, ...COLOURS),
  });
  const tidy = frame.map((one) => ({
    ...one,
    targets: one.targets.map((target) => withOwnEasing(target, easingOf(target, one), one.easing)),
  }));
  const marker = fc.record({ atMs: fc.integer({ min: 0, max: 8000 }), text: fc.string({ maxLength: 8 }) });
  return fc
    .tuple(
      fc.array(tidy, { minLength: least, maxLength: 8 }),
      fc.array(marker, { maxLength: 3 }),
      fc.constantFrom({}, {}, { sound: SOUND }),
    )
    .map(([frames, markers, sound]) => {
      const group = frames.reduce((sum, each) => insertFrame(sum, sum.frames.length, each), {
        ...emptyGroup('Wave', 'us'),
        ...sound,
      });
      return frozen(markers.reduce((sum, { atMs, text }) => addMarker(sum, atMs, text), group));
    });
}

/** A change in place throws. */
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

// The files of shared/protocol/vectors/files.

export const MEANINGS = meanings;

/** As the twin of a fixture says it. */
export function meaningOf(reading: Reading) {
  if ('problem' in reading) return reading;
  const { groups, isUnitMissing, remarks } = reading;
  return groups.map(({ name, slot, unit, frames }) => ({
    ...{ name, slot, unit, isUnitMissing, remarks: remarks.map(({ code }) => code) },
    frames: frames.map(({ durationMs, targets }) => ({ durationMs, targets })),
  }));
}

// Files in every format that can be opened.

const SERVO_COUNT = 16;
/** From the median of a real collection to its largest. */
const FRAME_COUNTS = [6, 12, 56, 120, 237];
const FORMATS = ['xml', 'd6a', 'csv', 'rob', 'json'] as const;

export async function mixedFiles(count: number, makeDatabase: MakeDatabase): Promise<readonly SavedFile[]> {
  const files: SavedFile[] = [];
  for (let index = 0; index < count; index += 1) {
    const format = FORMATS[index % FORMATS.length] ?? 'xml';
    const boardId = format === 'rob' ? 'xarm' : 'doc';
    const board = FAMILIES[boardId];
    const frames = FRAME_COUNTS[Math.floor(index / FORMATS.length) % FRAME_COUNTS.length] ?? 0;
    const group = groupOf(`mixed ${index + 1}`, frames, board);
    const names = { robot: 'Plain', role: (role: string) => role, limb: (limb: string) => limb };
    const robot = readyRobot('plain16', boardId, names);
    const made = await writeGroupFile(format, group, { family: board, robot }, makeDatabase);
    if ('content' in made) files.push(made);
  }
  return files;
}

/** Pulse widths below 1000 µs too, so that no file without a unit leaves a choice. */
function groupOf(name: string, frames: number, { unit, position: { min, max } }: Family): ActionGroup {
  const middle = (min + max) / 2;
  return Array.from({ length: frames }).reduce<ActionGroup>(
    (group, _, frame) => {
      const targets = Array.from({ length: SERVO_COUNT }, (_each, index) => ({
        servo: index + 1,
        position: Math.round(middle + 0.4 * (max - min) * Math.sin(frame * 0.3 + index)),
      }));
      return insertFrame(group, frame, { durationMs: 300, targets });
    },
    emptyGroup(name, unit),
  );
}
