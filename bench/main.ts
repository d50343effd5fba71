// `npm run bench`: measures what was asked for, prints the table, writes the JSON. Knows which groups there are, not how
// they measure. Each figure is taken in the same run as what it stands beside.

import { writeFileSync } from 'node:fs';
import { availableParallelism, loadavg } from 'node:os';
import { parseArgs } from 'node:util';
import { endChildren, onEnd } from '../scripts/children.mjs';
import { SetupProblem, main, say } from '../scripts/steps.mjs';
import { amount, isQuick } from './amounts.ts';
import { measureBluetooth, measureHid } from './cables.ts';
import { measureCodec } from './codec.ts';
import { measureCollision } from './collision.ts';
import { measureCrowd } from './crowd.ts';
import { measureDownload } from './download.ts';
import { measureDrag } from './drag.ts';
import { toRecord, type Figure } from './figure.ts';
import { measureFiles } from './files.ts';
import { measureFleet } from './fleet.ts';
import { measureFloods } from './floods.ts';
import { measureFrames } from './frames.ts';
import { measureTracks } from './tracks.ts';
import { measureIk } from './ik.ts';
import { measureLibrary } from './library.ts';
import { missed } from './limits.ts';
import { measureNetwork } from './network.ts';
import { measurePageLoad } from './pageLoad.ts';
import { measurePageSize } from './pageSize.ts';
import { measurePlay } from './play.ts';
import { measureRelay } from './relay.ts';
import { measureSound } from './sound.ts';
import { measureStart } from './start.ts';
import { measureStopDragging, measureStopIdle } from './stop.ts';
import { measureStopReconnect } from './stopAfterLoss.ts';
import { measureStopDownload, measureStopFlood, measureStopRunning } from './stopStates.ts';
import { measureThree } from './three.ts';
import { toTable } from './table.ts';
import { measureTimeline } from './timeline.ts';

/** First what takes longest, for a quick look; last what keeps this very process busy: the timers of others would be late. */
const GROUPS: Readonly<Record<string, () => Figure[] | Promise<Figure[]>>> = {
  bluetooth: measureBluetooth,
  hid: measureHid,
  network: measureNetwork,
  frames: measureFrames,
  three: measureThree,
  play: measurePlay,
  sound: measureSound,
  drag: measureDrag,
  load: measurePageLoad,
  library: measureLibrary,
  'stop.reconnect': measureStopReconnect,
  crowd: measureCrowd,
  fleet: measureFleet,
  tracks: measureTracks,
  files: measureFiles,
  relay: measureRelay,
  start: measureStart,
  'stop.idle': measureStopIdle,
  'stop.dragging': () => measureStopDragging(),
  'stop.running': measureStopRunning,
  'stop.download': measureStopDownload,
  'stop.flood': measureStopFlood,
  floods: measureFloods,
  page: measurePageSize,
  codec: measureCodec,
  ik: measureIk,
  collision: measureCollision,
  timeline: measureTimeline,
  download: measureDownload,
};

const USAGE = `npm run bench [-- [--only GROUP,GROUP…] [--quick] [--json FILE]]
--quick: less of all, to see that it can be measured; its figures are none to compare
groups: ${Object.keys(GROUPS).join(', ')}`;

function readArguments(): { only: readonly string[]; json: string | undefined } {
  const options = {
    only: { type: 'string' },
    json: { type: 'string' },
    quick: { type: 'boolean' }, // amounts.ts reads it
  } as const;
  try {
    const { values } = parseArgs({ options });
    const only = values.only?.split(',') ?? Object.keys(GROUPS);
    const unknown = only.filter((name) => !(name in GROUPS));
    if (unknown.length > 0) throw new TypeError(`There is no group ${unknown.join(', ')}.`);
    return { only, json: values.json };
  } catch (error) {
    throw new SetupProblem(`${error instanceof Error ? error.message : String(error)}\n${USAGE}`);
  }
}

/** Two measurements at once would measure each other, which matters to a quick look alone: that one waits most of its time. */
const AT_ONCE = amount(1, 4);

/** A group that fails leaves the others theirs. */
async function measure(names: readonly string[]): Promise<{ figures: readonly Figure[]; failed: boolean }> {
  const figures = new Map<string, readonly Figure[]>();
  const waiting = [...names];
  let failed = false;

  async function measureNext(): Promise<void> {
    const name = waiting.shift();
    if (name === undefined) return;
    const startMs = performance.now();
    try {
      figures.set(name, (await GROUPS[name]?.()) ?? []);
      say(`measured ${name} in ${((performance.now() - startMs) / 1_000).toFixed(1)} s`);
    } catch (error) {
      failed = true;
      say(`could not measure ${name}: ${error instanceof Error ? error.message : String(error)}`);
    }
    await measureNext();
  }

  await Promise.all(Array.from({ length: AT_ONCE }, measureNext));
  return { figures: names.flatMap((name) => figures.get(name) ?? []), failed };
}

function machineLoad(): Figure {
  const [lastMinute = 0] = loadavg();
  return {
    ...{ key: 'machine.load', value: lastMinute, unit: '' },
    against: { what: 'cores', value: availableParallelism() },
    note: 'work in the minute before; where others take the cores, times are upper bounds',
  };
}

await main(async () => {
  onEnd(() => void endChildren().then(() => process.exit(130)));
  const { only, json } = readArguments();
  const load = machineLoad();
  const measured = await measure(only);
  const figures = [load, ...measured.figures];
  say(`\n${toTable(figures)}\n`);
  if (!isQuick) missed(figures).forEach(say);
  if (json !== undefined) writeFileSync(json, `${JSON.stringify(toRecord(figures), null, 2)}\n`);
  process.exit(measured.failed ? 1 : 0); // a connection of the network group may still be closing
});
