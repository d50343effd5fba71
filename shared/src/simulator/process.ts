// The simulated board as a program: raw bytes on stdio or TCP, real time, a bus log in a file. The only file of shared/
// that knows Node; what the board does is board.ts.

import { createWriteStream, openSync } from 'node:fs';
import { createServer, type Socket } from 'node:net';
import { performance } from 'node:perf_hooks';
import type { Readable } from 'node:stream';
import { parseArgs } from 'node:util';
import type { Clock } from '../clock.ts';
import { createBoard, type Board, type BoardOptions } from './board.ts';
import type { BusLogEntry } from './line.ts';
import { parseFault } from './faults.ts';
import { isProfileName, type ProfileName } from './profileNames.ts';
import { PROFILES } from './profiles.ts';

const USAGE = `Usage: simulator (--stdio | --tcp HOST:PORT) [--board NAME] [--seed N] [--fault NAME[=VALUE]]... [--battery-mv N]
                 [--servos N] [--baud N] [--bus-log FILE] [--exit-with-stdin]
Boards: ${Object.keys(PROFILES).join(', ')}
A simulated servo board. Port 0 takes a free port; baud 0 takes no time on the wire. With --exit-with-stdin a board
on TCP ends with the program that started it, once its host has closed the connection.
Faults: droppedByte, doubledByte, flippedByte, insertedByte, stray55 [=PROBABILITY],
        lostAck, doubledAck, foreignAck [=NTH|=PROBABILITY], lateAck=MS[@NTH|@PROBABILITY], slowErase[=MS|=never],
        lowBattery[=MV], padRun=SLOT@MS, keyRun=MS, modeKey=MS, reboot=MS, brownOut=MS, unplug=MS|byteN`;

/** What the usual serial drivers buffer. */
const DRIVER_BYTES = 4096;
const DRAIN_POLL_MS = 50;
/** The latency timer of usual USB adapters. */
const ADAPTER_MS = 16;

/** A gateway stops the robot and is gone within three seconds of the end of what started both. */
const FAREWELL_MS = 4000;
/** Of Windows, SIGBREAK is Ctrl-Break and SIGHUP a console that was closed. */
const ENDING: readonly NodeJS.Signals[] =
  process.platform === 'win32'
    ? ['SIGINT', 'SIGTERM', 'SIGHUP', 'SIGBREAK']
    : ['SIGINT', 'SIGTERM', 'SIGQUIT', 'SIGHUP'];

const startedAtMs = performance.now();

const clock: Clock = {
  now: () => performance.now() - startedAtMs,
  after(delayMs, run) {
    const timer = setTimeout(run, delayMs);
    return () => {
      clearTimeout(timer);
    };
  },
};

function say(line: string): void {
  process.stderr.write(`${line}\n`);
}

function readArguments() {
  const { values } = parseArgs({
    options: {
      stdio: { type: 'boolean', default: false },
      tcp: { type: 'string' },
      board: { type: 'string', default: 'doc' },
      seed: { type: 'string', default: '1' },
      fault: { type: 'string', multiple: true, default: [] },
      'battery-mv': { type: 'string', default: '7500' },
      servos: { type: 'string' },
      baud: { type: 'string', default: '9600' },
      'bus-log': { type: 'string' },
      'exit-with-stdin': { type: 'boolean', default: false },
      help: { type: 'boolean', default: false },
    },
  });
  if (values.stdio === (values.tcp !== undefined) && !values.help)
    throw new RangeError('say --stdio or --tcp');
  return values;
}

function wholeNumber(name: string, text: string, min: number, max: number): number {
  const value = text === '' ? NaN : Number(text);
  if (Number.isInteger(value) && value >= min && value <= max) return value;
  throw new RangeError(`--${name} is a whole number ${min}..${max}, not "${text}"`);
}

function profileName(text: string): ProfileName {
  if (isProfileName(text)) return text;
  throw new RangeError(`no board is called "${text}"; there are ${Object.keys(PROFILES).join(', ')}`);
}

function address(text: string): { host: string; port: number } {
  const match = /^(?:\[(.+)\]|([^:]+)):(\d+)$/.exec(text);
  if (!match) throw new RangeError(`--tcp takes HOST:PORT, not "${text}"`);
  return { host: match[1] ?? match[2] ?? '', port: wholeNumber('tcp port', match[3] ?? '', 0, 65_535) };
}

interface BusLog {
  readonly add: (entry: BusLogEntry) => void;
  /** Ends the program when all is written. */
  readonly end: () => void;
}

/** JSON lines, written beside the board: a disk that stands still holds up the log, never a byte on the line. */
function openBusLog(path: string): BusLog {
  const file = createWriteStream(path, { fd: openSync(path, 'w') });
  const head = {
    // Not `Date.now()`: that one is cut to whole milliseconds.
    startedAtEpochMs: performance.timeOrigin + startedAtMs,
    // By the clock that other programs of a Linux computer read, too, and that nobody sets.
    startedAtMonotonicMs: startedAtMs - performance.now() + Number(process.hrtime.bigint()) / 1e6,
  };
  file.write(`${JSON.stringify(head)}\n`);
  file.on('finish', () => process.exit(0));
  return {
    add(entry) {
      if (!file.writableEnded)
        file.write(`${JSON.stringify({ ...entry, atMs: Math.round(entry.atMs * 1000) / 1000 })}\n`);
    },
    end: () => file.end(),
  };
}

type Wire = Pick<BoardOptions, 'send' | 'onUnplug'>;
type Build = (wire: Wire) => Board;

/** With a USB adapter between: what the board sends within its latency goes on together, also where this program is late. */
function throughAdapter({ send, onUnplug }: Wire): Wire {
  let gathered: Uint8Array[] = [];

  function flush(): void {
    if (gathered.length > 0) send(Buffer.concat(gathered));
    gathered = [];
  }

  return {
    send(bytes) {
      if (gathered.length === 0) setTimeout(flush, ADAPTER_MS);
      gathered.push(bytes);
    },
    onUnplug() {
      flush();
      onUnplug?.();
    },
  };
}

/** Reads no faster than the line takes it, as a driver does: a flooding host waits, not this program's memory. */
function feed(board: Board, source: Readable): void {
  function resumeWhenDrained(): void {
    if (board.waitingBytes() <= DRIVER_BYTES) source.resume();
    else setTimeout(resumeWhenDrained, DRAIN_POLL_MS);
  }

  source.on('data', (bytes: Uint8Array) => {
    board.receive(bytes);
    if (board.waitingBytes() <= DRIVER_BYTES) return;
    source.pause();
    resumeWhenDrained();
  });
}

function serveStdio(build: Build, end: () => void): void {
  const board = build({
    send: (bytes) => process.stdout.write(bytes),
    onUnplug: end,
  });
  feed(board, process.stdin);

  function endBehindTheLine(): void {
    if (board.waitingBytes() === 0) end();
    else setTimeout(endBehindTheLine, ADAPTER_MS);
  }

  // The last stop of a gateway is still on the line.
  process.stdin.on('end', endBehindTheLine);
  // The reader is gone: nothing of us is wanted any more.
  process.stdout.on('error', end);
}

interface Tcp {
  readonly host: string;
  readonly port: number;
  readonly endsWithStdin: boolean;
}

/** One host at a time, as on a cable; the board stays on between two of them. */
function serveTcp(build: Build, { host, port, endsWithStdin }: Tcp, end: () => void): void {
  let client: Socket | null = null;
  const board = build({ send: (bytes) => client?.write(bytes), onUnplug: end });
  const server = createServer({ noDelay: true }, (socket) => {
    socket.on('error', () => socket.destroy());
    if (client) {
      socket.destroy();
      return;
    }
    client = socket;
    feed(board, socket);
    socket.on('close', () => (client = null));
  });
  server.on('error', (error) => {
    say(error.message);
    process.exit(1);
  });
  if (endsWithStdin)
    process.stdin.resume().on('end', () => {
      if (!client) {
        end();
        return;
      }
      client.on('close', end);
      setTimeout(end, FAREWELL_MS);
    });
  server.listen(port, host, () => {
    const bound = server.address();
    if (bound !== null && typeof bound === 'object') {
      say(`listening ${host.includes(':') ? `[${host}]` : host}:${bound.port}`);
    }
  });
}

function main(): void {
  const values = readArguments();
  if (values.help) {
    say(USAGE);
    return;
  }
  const profile = profileName(values.board);
  const { usualServoCount, maxServoCount } = PROFILES[profile];
  const log = values['bus-log'] === undefined ? null : openBusLog(values['bus-log']);
  const end = log ? log.end : () => process.exit(0);
  const settings = {
    clock,
    seed: wholeNumber('seed', values.seed, 0, 2 ** 32 - 1),
    faults: values.fault.map(parseFault),
    batteryMv: wholeNumber('battery-mv', values['battery-mv'], 0, 65_535),
    profile,
    servoCount: wholeNumber('servos', values.servos ?? String(usualServoCount), 1, maxServoCount),
    baud: wholeNumber('baud', values.baud, 0, 1_000_000),
    ...(log && { onByte: log.add }),
  };
  const build: Build = (wire) => createBoard({ ...settings, ...throughAdapter(wire) });
  for (const signal of ENDING) process.on(signal, end);
  if (values.tcp === undefined) serveStdio(build, end);
  else serveTcp(build, { ...address(values.tcp), endsWithStdin: values['exit-with-stdin'] }, end);
}

try {
  main();
} catch (error) {
  // parseArgs throws TypeErrors with a sentence for people; whatever is wrong here was said on the command line.
  say(error instanceof Error ? error.message : String(error));
  say(USAGE);
  process.exit(2);
}
