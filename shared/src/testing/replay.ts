// A recording replayed both ways, as facts and as text for people. A fact is a short line; a log's `expect:` lines are facts that
// must come true, so that a bug report becomes a test. Knows replays; no file.

import type { BoardId } from '../codec/families.ts';
import type { SessionState } from '../robot/state.ts';
import { isProfileName, type ProfileName } from '../simulator/profileNames.ts';
import { type Entry, type Recording, entryOf, type PacketEntry } from '../files/recording.ts';
import { replayToBoard, replayToSession, type SessionReplay } from './replaySession.ts';
import { PROFILES } from '../simulator/profiles.ts';
import { readRecording } from '../files/recordingText.ts';
import { toHex } from '../codec/packet.ts';

type Verdict = 'same' | 'different' | 'missing' | 'extra';

export interface Row {
  readonly atMs: number;
  readonly verdict: Verdict;
  /** Null where it is `extra`. */
  readonly recorded: string | null;
  /** Null where it is `missing`. */
  readonly replayed: string | null;
  /** How much later than recorded; 0 where there is only one. */
  readonly laterMs: number;
}

type Tally = Readonly<Record<Verdict, number>>;

/** Longer than any board works on one packet (a flash erase at its worst). */
const WINDOW_MS = 2_500;

/** Both in the order of time. Pairs packets of one kind in that order, those further apart than 2.5 s not at all. */
export function compare(recorded: readonly PacketEntry[], replayed: readonly PacketEntry[]): readonly Row[] {
  const waiting = grouped(replayed);
  const next = new Map<string, number>();
  const taken = new Set<PacketEntry>();

  function partnerOf(entry: PacketEntry): PacketEntry | null {
    const kind = kindOf(entry);
    const candidates = waiting.get(kind) ?? [];
    let at = next.get(kind) ?? 0;
    while ((candidates[at]?.atMs ?? Infinity) < entry.atMs - WINDOW_MS) at += 1;
    const candidate = candidates[at];
    const isNear = candidate !== undefined && candidate.atMs <= entry.atMs + WINDOW_MS;
    next.set(kind, isNear ? at + 1 : at);
    return isNear ? candidate : null;
  }

  const rows = recorded.map((entry) => {
    const partner = partnerOf(entry);
    if (partner !== null) taken.add(partner);
    return row(entry, partner);
  });
  const extra = replayed.filter((entry) => !taken.has(entry)).map((entry) => row(null, entry));
  return [...rows, ...extra].sort((a, b) => a.atMs - b.atMs);
}

export function tally(rows: readonly Row[]): Tally {
  const counts = { same: 0, different: 0, missing: 0, extra: 0 };
  for (const { verdict } of rows) counts[verdict] += 1;
  return counts;
}

function grouped(entries: readonly PacketEntry[]): ReadonlyMap<string, readonly PacketEntry[]> {
  const groups = new Map<string, PacketEntry[]>();
  for (const entry of entries) {
    const group = groups.get(kindOf(entry));
    if (group === undefined) groups.set(kindOf(entry), [entry]);
    else group.push(entry);
  }
  return groups;
}

/** Command number and LEN: distinguishes kinds of packets on this wire. */
function kindOf({ bytes }: PacketEntry): string {
  return `${bytes[3] ?? ''}/${bytes.length}`;
}

function row(recorded: PacketEntry | null, replayed: PacketEntry | null): Row {
  const [before, after] = [recorded && toHex(recorded.bytes), replayed && toHex(replayed.bytes)];
  const both = recorded !== null && replayed !== null;
  return {
    atMs: recorded?.atMs ?? replayed?.atMs ?? 0,
    verdict: both ? (before === after ? 'same' : 'different') : recorded ? 'missing' : 'extra',
    recorded: before,
    replayed: after,
    laterMs: both ? Math.round(replayed.atMs - recorded.atMs) : 0,
  };
}

// A recording replayed both ways, as facts and as text for people. A fact is a short line; a log's `expect:` lines
// are facts that must come true, so that a bug report becomes a test.

export interface ReplayReport {
  /** Of the last part: before it stands how the board was found, or another board. */
  readonly facts: readonly string[];
  /** Expectations of the recording that did not come true. */
  readonly failed: readonly string[];
  readonly text: string;
}

interface Part {
  readonly board: BoardId;
  readonly entries: readonly Entry[];
}

/** `profile` is the simulated board; without it, the one the recording names, if there is such a one. */
export async function replay(recording: Recording, profile?: ProfileName): Promise<ReplayReport> {
  let facts: readonly string[] = [];
  const sections: string[] = [];
  for (const part of partsOf(recording)) {
    const replayed = await replayPart(part, profile ?? profileOf(part.board));
    facts = replayed.facts;
    sections.push(...replayed.sections);
  }
  const { expectations } = recording.header;
  const failed = expectations.filter((expectation) => !facts.includes(expectation));
  const verdicts = expectations.map((line) => `${failed.includes(line) ? 'FAILED' : 'ok    '}  ${line}`);
  return { facts, failed, text: [...sections, ...titled('Expectations', verdicts)].join('\n') };
}

/** A recording in which the board changed is several, one after the other. */
export function partsOf({ header, entries }: Recording): readonly Part[] {
  const parts: { board: BoardId; entries: Entry[] }[] = [{ board: header.board, entries: [] }];
  for (const entry of entries) {
    if (entry.mark === 'board') parts.push({ board: entry.board, entries: [] });
    else parts.at(-1)?.entries.push(entry);
  }
  return parts.filter((part) => part.entries.length > 0);
}

function profileOf(board: BoardId): ProfileName | null {
  return isProfileName(board) ? board : null;
}

async function replayPart({ board, entries }: Part, profile: ProfileName | null) {
  const session = await replayToSession(entries, board);
  const sent = compare(marked(entries, 'sent'), marked(session.traffic.map(entryOf), 'sent'));
  const answers = profile && (await replayToBoard(entries, profile));
  const answered = answers && compare(marked(entries, 'received'), marked(answers, 'received'));
  const sessionLines = sessionFacts(session);
  const facts = [...sessionLines, ...countFacts('sent', sent), ...countFacts('answers', answered ?? [])];
  return {
    facts,
    sections: [
      ...titled(`Session with ${board}`, sessionLines),
      ...titled('Sent: recorded and replayed', rowLines(sent)),
      ...titled(
        `Answers: recorded and of the simulated ${profile ?? board}`,
        answered === null ? [`no simulated board is called ${board}; name one`] : rowLines(answered),
      ),
    ],
  };
}

function marked(entries: readonly Entry[], mark: 'sent' | 'received'): readonly PacketEntry[] {
  return entries.filter((entry): entry is PacketEntry => entry.mark === mark);
}

function countFacts(what: 'sent' | 'answers', rows: readonly Row[]): readonly string[] {
  return Object.entries(tally(rows)).map(([verdict, count]) => `${what} ${verdict} ${count}`);
}

function sessionFacts({ state, failures }: SessionReplay): readonly string[] {
  const { link, latch, activity, brokenSlots, storedSlots } = state;
  const refusals = new Set(failures.map(({ what, code }) => `session failed ${what} ${code}`));
  return [
    `session link ${link.status}`,
    `session latch ${latch === null ? 'none' : `${latch.reason} ${latch.stop}`}`,
    `session activity ${activity.kind}`,
    `session battery ${batteryText(state.battery)}`,
    `session broken slots ${listText(brokenSlots)}`,
    `session stored slots ${listText(storedSlots)}`,
    ...(refusals.size === 0 ? ['session failed nothing'] : refusals),
  ];
}

function batteryText(battery: SessionState['battery']): string {
  return battery.kind === 'read' ? `${battery.batteryMv} mV` : battery.kind;
}

const listText = (slots: readonly number[]): string => (slots.length === 0 ? 'none' : slots.join(', '));

function titled(title: string, lines: readonly string[]): readonly string[] {
  return lines.length === 0 ? [] : [title, ...lines.map((line) => `  ${line}`), ''];
}

/** What is alike is counted, not listed. */
function rowLines(rows: readonly Row[]): readonly string[] {
  const { same } = tally(rows);
  return [`${same} the same`, ...rows.filter(({ verdict }) => verdict !== 'same').map(rowLine)];
}

function rowLine({ atMs, verdict, recorded, replayed }: Row): string {
  const time = (atMs / 1000).toFixed(3).padStart(10);
  const bytes = [recorded, replayed].filter((hex) => hex !== null).join('  ->  ');
  return `${time}  ${verdict.padEnd(9)}  ${bytes}`;
}

// A saved log in, a report out, as text: what the command line shows.

export interface ProgramResult {
  readonly output: string;
  /** The log could be read, and what it expects came true. */
  readonly isGood: boolean;
}

/** `board` names the simulated board to compare with; without it, the one the log names. */
export async function replayText(text: string, board?: string): Promise<ProgramResult> {
  if (board !== undefined && !isProfileName(board)) {
    const names = Object.keys(PROFILES).join(', ');
    return { output: `No simulated board is called "${board}"; there are ${names}.`, isGood: false };
  }
  const result = readRecording(text);
  if (result.recording === null) {
    const lines = result.problems.map(({ line, reason }) =>
      line === 0 ? reason : `line ${line}: ${reason}`,
    );
    return { output: ['This log cannot be read.', ...lines].join('\n'), isGood: false };
  }
  const report = await replay(result.recording, board);
  return { output: report.text, isGood: report.failed.length === 0 };
}
