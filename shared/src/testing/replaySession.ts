// What a session makes of a recording: the host's wishes and the board's bytes at their recorded times, in virtual time. A bug
// that a log shows happens here again. Knows the session by its public face.

import { createLocalRobot } from '../robot/localRobot.ts';
import type { Robot } from '../robot/robot.ts';
import { type Intent, intentsOf } from './intents.ts';
import { sleep, type Clock } from '../clock.ts';
import { wireMs } from '../codec/packet.ts';
import { stopsIn } from '../codec/parse.ts';
import { LinkError, type LinkErrorCode } from '../robot/linkError.ts';
import type { ByteChannel } from '../robot/byteChannel.ts';
import { family, type BoardId, FAMILIES } from '../codec/families.ts';
import type { SessionState, Traffic } from '../robot/state.ts';
import { createVirtualClock } from './virtualClock.ts';
import type { Entry, Happening, PacketEntry } from '../files/recording.ts';
import { createReceiver } from '../robot/channelLink.ts';
import { createBoard, type BoardOptions } from '../simulator/board.ts';
import type { ProfileName } from '../simulator/profileNames.ts';

// Sends the requests of a recording's host to a session.

type Perform<K extends Intent['kind']> = (intent: Extract<Intent, { kind: K }>) => Promise<unknown>;

/** `failed` hears of each wish that was refused or came to nothing. */
function createHost(
  session: Robot,
  failed: (what: Intent['kind'], error: unknown) => void,
): (intent: Intent) => void {
  const perform: { readonly [K in Intent['kind']]: Perform<K> } = {
    async move({ targets, durationMs }) {
      session.move(targets, durationMs);
      await Promise.resolve();
    },
    run: ({ slot, times }) => session.run(slot, times),
    stopGroup: () => session.stopGroup(),
    halt: () => session.halt(),
    resume: () => session.resume(),
    close: () => session.close(),
    erase: () => session.erase(),
    readBattery: () => session.readBattery(),
    raw: ({ bytes }) => session.sendRaw(bytes),
    download: ({ slot, frames }) => session.download([{ slot, frames }]),
    cancelDownload: () => session.cancelDownload(),
  };

  return (intent) => {
    const work = perform[intent.kind] as Perform<typeof intent.kind>;
    work(intent as never).catch((error: unknown) => failed(intent.kind, error));
  };
}

// A link whose other end is a recording: it gives the board's bytes when the replay requests them.

interface ReplayChannel extends ByteChannel {
  /** `whole` where they are packets, as the recording has them. */
  say(bytes: Uint8Array, whole: boolean): void;
  lose(): void;
  comeBack(): void;
}

function createReplayChannel(clock: Clock): ReplayChannel {
  let isOpen = false;
  let isThere = true;

  const channel: ReplayChannel = {
    label: 'Recording',
    longestPacket: Infinity,
    events: null,
    open() {
      if (!isThere) return Promise.reject(new LinkError('portMissing', 'the recording has no link here'));
      isOpen = true;
      return Promise.resolve();
    },
    write: (packet) => sleep(clock, wireMs(packet.length)),
    close() {
      isOpen = false;
      return Promise.resolve();
    },
    say(bytes, whole) {
      if (isOpen) channel.events?.received(bytes, whole);
    },
    lose() {
      const wasOpen = isOpen;
      isOpen = false;
      isThere = false;
      if (wasOpen) channel.events?.lost(new LinkError('lost', 'the link went'));
    },
    comeBack() {
      isThere = true;
      channel.events?.available();
    },
  };
  return channel;
}

interface Failure {
  readonly atMs: number;
  /** The request; `link` where there was none. */
  readonly what: string;
  readonly code: LinkErrorCode;
}

export interface SessionReplay {
  /** What the session sent and heard this time. */
  readonly traffic: readonly Traffic[];
  readonly failures: readonly Failure[];
  readonly state: SessionState;
}

/** Longer than the session waits for anything. */
const SETTLE_MS = 10_000;

/** `entries` of one board, in the order of their times. */
export async function replayToSession(entries: readonly Entry[], board: BoardId): Promise<SessionReplay> {
  const clock = createVirtualClock(entries[0]?.atMs ?? 0);
  const channel = createReplayChannel(clock);
  const session = createLocalRobot({
    channel,
    isNew: !opensWithStops(entries),
    family: family(board),
    clock,
  });
  const log = listen(session, clock);
  const host = createHost(session, log.failed);
  const happen = createHappenings(channel, session);
  // A log that lost its beginning starts in the middle of a connection.
  if (!isOpening(entries[0])) happen('opened');

  const intents = intentsOf(entries);
  for (const [index, entry] of entries.entries()) {
    await clock.advance(entry.atMs - clock.now());
    if (entry.mark === 'link') happen(entry.happening);
    else if (entry.mark !== 'board' && entry.mark !== 'sent')
      channel.say(entry.bytes, entry.mark === 'received');
    const intent = intents[index];
    if (intent) host(intent);
  }
  await clock.advance(SETTLE_MS);
  return { traffic: log.traffic, failures: log.failures, state: session.state };
}

/** As a line that others may have used before; a board in the page has none. */
function opensWithStops(entries: readonly Entry[]): boolean {
  const first = entries.find(({ mark }) => mark === 'sent');
  return first !== undefined && 'bytes' in first && stopsIn(first.bytes) > 1;
}

function isOpening(entry: Entry | undefined): boolean {
  return entry?.mark === 'link' && entry.happening === 'opened';
}

/** What the link does by itself; the host's part of it is an intent. */
function createHappenings(channel: ReplayChannel, session: Robot): (happening: Happening) => void {
  return (happening) => {
    if (happening === 'lost') channel.lose();
    // Another screen's stop, or a loss, which latches by itself.
    if (happening === 'latched' && session.state.latch === null) session.halt().catch(() => undefined);
    if (happening !== 'opened') return;
    channel.comeBack();
    // A session that was open before finds the way back by itself; its failure would be in its state.
    if (session.state.link.status === 'closed') session.open().catch(() => undefined);
  };
}

function listen(session: Robot, clock: Clock) {
  const traffic: Traffic[] = [];
  const failures: Failure[] = [];

  function failed(what: string, error: unknown): void {
    const code = error instanceof LinkError ? error.code : 'internal';
    failures.push({ atMs: clock.now(), what, code });
  }

  session.subscribe({
    traffic: (entry) => traffic.push(entry),
    problem: (error) => failed('link', error),
  });
  return { traffic, failures, failed };
}

/** On for so long already that it serves commands and knows its battery. */
const ON_FOR_MS = 60_000;
/** An erase at its worst, and the answer to it. */
const BOARD_SETTLES_MS = 5_000;

/** `entries` in the order of their times. Gives the board's packets and noise. */
export async function replayToBoard(
  entries: readonly Entry[],
  profile: ProfileName,
  options: Pick<BoardOptions, 'faults' | 'seed' | 'batteryMv'> = {},
): Promise<readonly PacketEntry[]> {
  const clock = createVirtualClock(entries[0]?.atMs ?? 0);
  const heard: PacketEntry[] = [];
  const hear =
    (mark: 'received' | 'garbage' | 'truncated') =>
    (bytes: Uint8Array): number =>
      heard.push({ atMs: clock.now(), mark, bytes });
  const receiver = createReceiver({
    clock,
    family: () => FAMILIES[profile],
    report: (_, bytes) => hear('received')(bytes),
    noise: (reason, bytes) => hear(reason)(bytes),
  });
  const board = createBoard({
    ...{ onForMs: ON_FOR_MS, ...options, clock, profile },
    send: (bytes) => receiver.push(bytes, false),
  });

  for (const entry of entries) {
    await clock.advance(entry.atMs - clock.now());
    if (entry.mark === 'sent') board.receive(entry.bytes);
    if (entry.mark !== 'link') continue;
    if (entry.happening === 'lost') board.unplug();
    if (entry.happening === 'opened') board.plugIn();
  }
  await clock.advance(BOARD_SETTLES_MS);
  board.powerOff();
  return heard;
}
