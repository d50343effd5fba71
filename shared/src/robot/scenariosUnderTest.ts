// Plays a scenario of shared/protocol/scenarios on a session in virtual time: requests and reports come in at their
// times, what the session sends, reports and ends with is noted. README.md there says what an event is. Knows no file.

import { sleep } from '../clock.ts';
import type { Frame, ServoTarget } from '../codec/commands.ts';
import { family as familyOf, type BoardId, type Family, type FamilyId } from '../codec/families.ts';
import { fromHex, toHex, wireMs } from '../codec/packet.ts';
import { commandIn, stopsIn } from '../codec/parse.ts';
import { createVirtualClock } from '../testing/virtualClock.ts';
import { STOP_PACKET } from './halt.ts';
import { LinkError } from './linkError.ts';
import { createLocalRobot } from './localRobot.ts';
import type { Robot } from './robot.ts';
import type { Latch, SessionState } from './state.ts';
import type { ByteChannel } from './byteChannel.ts';
import { STOP_AGAIN_MS, STOP_EVERY_MS, STOP_REPEATS } from './timings.ts';

export type Intent =
  | { readonly type: 'move'; readonly targets: readonly ServoTarget[]; readonly durationMs: number }
  | { readonly type: 'run'; readonly slot: number; readonly times: number }
  | { readonly type: 'stop' | 'resume' | 'stopGroup' | 'cancelDownload' | 'readBattery' | 'stopPlaying' }
  | { readonly type: 'readPositions'; readonly servos: readonly number[] }
  | {
      readonly type: 'play';
      readonly frames: readonly Frame[];
      readonly times: number;
      readonly loopFrom: number;
    }
  | { readonly type: 'board'; readonly family: FamilyId }
  | {
      readonly type: 'download';
      readonly groups: readonly { readonly slot: number; readonly frames: readonly Frame[] }[];
    };

/** What comes from outside. */
type Input =
  | { readonly intent: Intent; readonly id?: number }
  | { readonly says: string }
  /** Pulled, it takes no attempt to open it until it is there again. */
  | { readonly port: 'gone' | 'back' };

/** What must come of it. */
type Output =
  /** `times`: so many of these, back to back. */
  | { readonly leaves: string; readonly times?: number }
  | { readonly tells: Shown }
  | { readonly ends: number; readonly with: string };

export type ScenarioEvent = { readonly atMs: number } & (Input | Output);

export interface Scenario {
  readonly name: string;
  /** What the board is taken for. */
  readonly family: BoardId;
  /** The link opens at 0, and the board is identified. Otherwise it has been open for a while, and the family's word is enough. */
  readonly identifies?: true;
  readonly events: readonly ScenarioEvent[];
}

/** The part of the state that a scenario notes: each only when it has changed. */
interface Shown {
  /** The status, and where it is refused the code. */
  readonly link?: string;
  readonly latched?: boolean;
  /** Once the last packet of a stop has left. */
  readonly unheld?: { readonly servos: readonly number[] | null; readonly forMs: number | null } | null;
  readonly brokenSlots?: readonly number[];
  readonly waitingToStart?: readonly number[];
  /** The frame under way; null where nothing is played. */
  readonly playedFrame?: number | null;
}

/** Long after the last input, so that what should not come any more would be seen. */
const QUIET_MS = 10_000;
/** So long the stops of the opening have left before the first input. */
const OPEN_FOR_MS = 100;

/** From the opening until its stops have left. */
function openingMs({ leftOverBytes, serviceGapMs }: Family): number {
  return (
    serviceGapMs +
    wireMs(leftOverBytes) +
    serviceGapMs +
    STOP_REPEATS * STOP_EVERY_MS +
    wireMs(STOP_PACKET.length)
  );
}
const isInput = (event: ScenarioEvent): boolean => 'intent' in event || 'says' in event || 'port' in event;
const exactly = (ms: number): number => Math.round(ms * 1000) / 1000;

/** Its inputs with what came of them, in the order of time. */
export async function played({ events, ...head }: Scenario): Promise<Scenario> {
  const clock = createVirtualClock();
  const openForMs = head.identifies ? 0 : openingMs(familyOf(head.family)) + OPEN_FOR_MS;
  const inputs = events.filter(isInput);
  const outputs: ScenarioEvent[] = [];
  const note = (output: Output): void =>
    void outputs.push({ atMs: exactly(clock.now() - openForMs), ...output });
  let isBegun = false;
  let isThere = true;
  /** What is said again each second while motion is latched is left out of the transcript. */
  let leftMs = Infinity;
  let wasReminder = false;
  const channel: ByteChannel = {
    ...{ label: 'Board', longestPacket: Infinity, events: null },
    open: () =>
      isThere
        ? Promise.resolve()
        : Promise.reject(new LinkError('portMissing', 'the device is not plugged in')),
    async write(packet) {
      const isReminder = stopsIn(packet) === 1 && Math.abs(clock.now() - leftMs - STOP_AGAIN_MS) < 1;
      // Where such a board answers, it is asked behind it.
      const isAsked = wasReminder && commandIn(packet)?.kind === 'readBattery';
      wasReminder = isReminder;
      const times = Math.max(1, stopsIn(packet));
      const leaves = toHex(packet.subarray(0, packet.length / times));
      if ((isBegun || openForMs === 0) && !isReminder && !isAsked)
        note({ leaves, ...(times > 1 && { times }) });
      leftMs = clock.now() + wireMs(packet.length);
      await sleep(clock, wireMs(packet.length));
    },
    close: () => Promise.resolve(),
  };
  const session = createLocalRobot({
    ...{ channel, clock, family: familyOf(head.family), identifies: head.identifies },
  });
  function plug(isBack: boolean): void {
    isThere = isBack;
    if (!isBack) channel.events?.lost(new LinkError('lost', 'the device was pulled'));
  }

  let before = shownOf(session.state);
  session.subscribe({
    state(state) {
      const after = shownOf(state);
      const changed = Object.entries(after).filter(
        ([field, value]) => JSON.stringify(value) !== JSON.stringify(before[field as keyof Shown]),
      );
      before = after;
      if (changed.length > 0 && isBegun) note({ tells: Object.fromEntries(changed) });
    },
  });
  await session.open();
  await clock.advance(openForMs);
  isBegun = true;
  for (const { atMs, ...input } of inputs)
    clock.after(atMs, () => {
      if ('says' in input) channel.events?.received(fromHex(input.says));
      else if ('port' in input) plug(input.port === 'back');
      else if ('intent' in input) begin(session, input.intent, input.id ?? null, note);
    });
  await clock.advance(Math.max(0, ...inputs.map(({ atMs }) => atMs)) + QUIET_MS);
  const all = [
    ...inputs.map((event) => ({ ...event, rank: 0 })),
    ...outputs.map((event) => ({ ...event, rank: 1 })),
  ];
  const inOrder = all.toSorted((one, other) => one.atMs - other.atMs || one.rank - other.rank);
  return { ...head, events: inOrder.map(({ rank: _, ...event }) => event as ScenarioEvent) };
}

function begin(session: Robot, intent: Intent, id: number | null, note: (output: Output) => void): void {
  const end = (how: string): void => {
    if (id !== null) note({ ends: id, with: how });
  };
  requested(session, intent).then(
    () => end('done'),
    (error: unknown) => end(error instanceof LinkError ? error.code : String(error)),
  );
}

async function requested(session: Robot, intent: Intent): Promise<unknown> {
  switch (intent.type) {
    case 'move':
      session.move(intent.targets, intent.durationMs);
      return;
    case 'run':
      return session.run(intent.slot, intent.times);
    case 'stop':
      return session.halt();
    case 'resume':
      return session.resume();
    case 'stopGroup':
      return session.stopGroup();
    case 'readBattery':
      return session.readBattery();
    case 'readPositions':
      return session.readPositions(intent.servos);
    case 'board':
      return session.choose(familyOf(intent.family));
    case 'download':
      return session.download(intent.groups);
    case 'play':
      return session.play(intent.frames, intent);
    case 'stopPlaying':
      session.stopPlaying();
      return;
    case 'cancelDownload':
      return session.cancelDownload();
  }
}

/** Its last packet has left. */
const LEFT: ReadonlySet<Latch['stop']> = new Set(['sent', 'confirmed', 'unanswered']);

function shownOf({ link, latch, brokenSlots, waitingToStart, activity }: SessionState): Shown {
  return {
    link: link.status === 'refused' ? `refused: ${link.error.code}` : link.status,
    latched: latch !== null,
    ...(latch !== null && LEFT.has(latch.stop) && { unheld: rounded(latch.unheld) }),
    brokenSlots,
    waitingToStart,
    playedFrame: activity.kind === 'playing' ? activity.frameIndex : null,
  };
}

function rounded(unheld: NonNullable<SessionState['latch']>['unheld']): NonNullable<Shown['unheld']> | null {
  if (unheld === null) return null;
  const { servos, forMs } = unheld;
  return { servos, forMs: forMs === Infinity ? null : Math.ceil(forMs) };
}
