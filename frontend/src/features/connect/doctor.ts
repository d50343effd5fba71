// Looks for what keeps a robot from being connected: the browser, the address, devices that are allowed, and what the board has
// sent so far. Facts in, findings out; queries nothing and moves nothing.

import timings from '../../../../shared/protocol/timings.json' with { type: 'json' };
import { COMMAND_NUMBER } from '#shared/codec/commands.ts';
import type { LinkState } from '#shared/robot/state.ts';
import { isLineOpen } from '../../robot/readiness.ts';
import type { LogEntry, TrafficLog } from '../../robot/traffic.ts';

export type Sight = 'seen' | 'missing' | 'blocked';

export interface Facts {
  readonly browser: string;
  readonly isSecure: boolean;
  /** What the browser has for each cable: its interface, none, or one that a rule of the site or the administrator forbids. */
  readonly interfaces: Readonly<Record<'serial' | 'hid' | 'bluetooth', Sight>>;
  /** Serial ports that a person has allowed. */
  readonly allowedPorts: number;
  readonly gateway: 'absent' | 'looking' | 'answers';
  readonly link: LinkState;
  readonly way: string | null;
  readonly heard: Heard;
  /** The board has answered a question, also one of the gateway's before this page was there. */
  readonly hasAnswered: boolean;
  /** The link is the board's own USB cable. */
  readonly isOwnCable: boolean;
  readonly batteryMv: number | null;
}

/** Of the packets and other bytes since the link was opened, as far as the log goes back. */
export interface Heard {
  readonly packets: number;
  readonly noise: readonly number[];
  /** From the newest battery question to its answer; null where none was answered. */
  readonly answeredMs: number | null;
}

/** What bytes that are no packet look like. `rate`: those of another speed. `text`: a program that prints. */
export type NoiseKind = 'rate' | 'text' | 'other';

export type Finding =
  | { readonly id: 'secure' | 'insecure' }
  | {
      readonly id: 'interface';
      readonly cable: keyof Facts['interfaces'];
      readonly sight: Sight;
      /** No other way is in use. */
      readonly isWanted: boolean;
    }
  | { readonly id: 'allowedPorts'; readonly count: number }
  | { readonly id: 'gateway'; readonly answers: boolean }
  | { readonly id: 'link'; readonly link: LinkState; readonly way: string }
  | { readonly id: 'noWay' }
  | { readonly id: 'heardPackets'; readonly count: number }
  | { readonly id: 'heardNoise'; readonly count: number; readonly kind: NoiseKind }
  | { readonly id: 'heardNothing'; readonly isOwnCable: boolean }
  | { readonly id: 'battery'; readonly batteryMv: number; readonly answeredMs: number | null };

export function findingsOf(facts: Facts): readonly Finding[] {
  const { link, way } = facts;
  return [
    { id: facts.isSecure ? 'secure' : 'insecure' },
    ...(['serial', 'hid', 'bluetooth'] as const).map(
      (cable) =>
        ({ id: 'interface', cable, sight: facts.interfaces[cable], isWanted: way === null }) as const,
    ),
    ...(facts.interfaces.serial === 'seen'
      ? [{ id: 'allowedPorts', count: facts.allowedPorts } as const]
      : []),
    ...(facts.gateway === 'looking'
      ? []
      : [{ id: 'gateway', answers: facts.gateway === 'answers' } as const]),
    way === null ? { id: 'noWay' } : { id: 'link', link, way },
    ...(way !== null && isLineOpen(link) ? heardFindings(facts) : []),
    ...(facts.batteryMv === null
      ? []
      : [{ id: 'battery', batteryMv: facts.batteryMv, answeredMs: facts.heard.answeredMs } as const]),
  ];
}

function heardFindings({ heard: { packets, noise }, hasAnswered, isOwnCable }: Facts): readonly Finding[] {
  if (packets === 0 && noise.length === 0) return hasAnswered ? [] : [{ id: 'heardNothing', isOwnCable }];
  return [
    ...(packets > 0 ? [{ id: 'heardPackets', count: packets } as const] : []),
    ...(noise.length > 0
      ? [{ id: 'heardNoise', count: noise.length, kind: kindOfNoise(noise) } as const]
      : []),
  ];
}

/** At another speed bits run together: what arrives is nearly all ones or zeros. Its twin is `looks_like`; vectors/noise.json holds both. */
export function kindOfNoise(bytes: readonly number[]): NoiseKind {
  const share = (test: (byte: number) => boolean): number => bytes.filter(test).length / bytes.length;
  if (
    share((byte) => (byte >= 0x20 && byte < 0x7f) || byte === 0x0a || byte === 0x0d) >=
    timings.decoder.noiseShare
  )
    return 'text';
  return share((byte) => RUNS.has(byte)) >= timings.decoder.noiseShare ? 'rate' : 'other';
}

/** Packets, or text of a program that prints. */
export function isReadable({ packets, noise }: Pick<Heard, 'packets' | 'noise'>): boolean {
  return packets > 0 || (noise.length > 0 && kindOfNoise(noise) === 'text');
}

/** Bytes of one run of ones beside one run of zeros. */
const RUNS = new Set(Array.from({ length: 9 }, (_, zeros) => [(0xff << zeros) & 0xff, 0xff >> zeros]).flat());

/** Enough to recognise noise. */
const NOISE_KEPT = 256;

/** Since the link before this one ended. */
export function heardIn(traffic: TrafficLog): Heard {
  const { oldestId, nextId } = traffic.store.getState();
  let packets = 0;
  const noise: number[] = [];
  let answerMs: number | null = null;
  let answeredMs: number | null = null;
  for (let id = nextId - 1; id >= oldestId; id--) {
    const { entry } = traffic.at(id);
    if (entry.mark === 'link' && (entry.happening === 'lost' || entry.happening === 'closed')) break;
    if (entry.mark === 'received') packets += 1;
    if (isOfBattery(entry) && entry.mark === 'received') answerMs = entry.atMs;
    if (isOfBattery(entry) && entry.mark === 'sent' && answerMs !== null)
      answeredMs ??= answerMs - entry.atMs;
    if ((entry.mark === 'garbage' || entry.mark === 'truncated') && noise.length < NOISE_KEPT)
      noise.push(...entry.bytes);
  }
  return { packets, noise, answeredMs };
}

const isOfBattery = (entry: LogEntry['entry']): boolean =>
  'bytes' in entry && entry.bytes[3] === COMMAND_NUMBER.readBattery;

/** What the browser has; listing granted devices shows no chooser. */
export async function interfacesHere(): Promise<Facts['interfaces']> {
  const [serial, hid, bluetooth] = await Promise.all([
    sightOf(navigator.serial, (serial) => serial.getPorts()),
    sightOf(hidOf(navigator), (hid) => hid.getDevices()),
    sightOf(bluetoothOf(navigator), (bluetooth) => bluetooth.getAvailability()),
  ]);
  return { serial, hid, bluetooth };
}

async function sightOf<T>(found: T | undefined, look: (found: T) => Promise<unknown>): Promise<Sight> {
  if (found === undefined) return 'missing';
  return look(found).then(
    (answer) => (answer === false ? 'missing' : 'seen'),
    () => 'blocked',
  );
}

/** Not every browser has them, and the compiler's library knows neither. */
const hidOf = (from: object): { getDevices(): Promise<unknown> } | undefined =>
  Reflect.get(from, 'hid') as never;
const bluetoothOf = (from: object): { getAvailability(): Promise<boolean> } | undefined =>
  Reflect.get(from, 'bluetooth') as never;
