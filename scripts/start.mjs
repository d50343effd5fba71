// `npm start`: sets up, puts a simulated board on a serial port, starts the gateway on it and opens the page.
// `-- --serial DEVICE` takes a real board instead. Whatever is not known here goes to the gateway.

import { setTimeout as pause } from 'node:timers/promises';
import { createInterface } from 'node:readline';
import { chooseAddress, textOf, urlOf } from './address.mjs';
import { simulatedBoard } from './cable.mjs';
import { endChildren, onEnd, startChild } from './children.mjs';
import { python } from './python.mjs';
import { setUp } from './setup.mjs';
import { main, say } from './steps.mjs';

const pollMs = 25;

/** @param {readonly string[]} args */
function parseArguments(args) {
  /** @type {Record<string, string>} */
  const named = {};
  const passedOn = [];
  for (let index = 0; index < args.length; index += 1) {
    const [, name, value] = /^--(serial|listen)(?:=(.*))?$/.exec(args[index] ?? '') ?? [];
    if (name === undefined) passedOn.push(args[index] ?? '');
    else named[name] = value ?? args[(index += 1)] ?? '';
  }
  return { serial: named.serial ?? null, listen: named.listen ?? null, passedOn };
}

/** Nobody sees a window there, and a text browser would take over the terminal. */
function cannotShowPages() {
  const lacksDisplay = process.platform === 'linux' && !process.env.DISPLAY && !process.env.WAYLAND_DISPLAY;
  return lacksDisplay || Boolean(process.env.CI);
}

/** @param {string} url @param {() => boolean} isOver */
async function untilItAnswers(url, isOver) {
  while (!isOver()) {
    const answer = await fetch(`${url}/api/health`).catch(() => null);
    if (answer?.ok) return true;
    await pause(pollMs);
  }
  return false;
}

/** @param {import('./cable.mjs').Cable} cable */
async function toggle(cable) {
  if (cable.isPlugged()) {
    await cable.pull();
    say('The cable is pulled. Enter plugs it back in.');
  } else {
    await cable.plug();
    if (cable.isPlugged()) say('The cable is plugged in. Enter pulls it.');
  }
}

/** @param {string} device */
function boardOn(device) {
  return simulatedBoard({
    link: device,
    onLine: say,
    onLost: () => say('The simulated board has ended. Enter brings it back.'),
  });
}

/** One key press at a time: a second Enter waits until the cable has settled. @param {import('./cable.mjs').Cable} cable */
function listenForEnter(cable) {
  let turn = Promise.resolve();
  createInterface({ input: process.stdin }).on('line', () => {
    turn = turn.then(() => toggle(cable));
  });
}

/** @returns {Promise<number>} */
async function start() {
  onEnd(() => void endChildren().then(() => process.exit(0)));
  const { serial, listen, passedOn } = parseArguments(process.argv.slice(2));
  await setUp();
  const address = await chooseAddress(listen);
  const cable = serial === null ? await boardOn(`build/simulated-board-${address.port}`) : null;
  const plugged = cable?.plug();

  let exitCode = /** @type {number | null} */ (null);
  const gateway = startChild(
    python,
    [
      ...['-m', 'servodeck', 'serve', '--listen', textOf(address), '--serial', cable?.device ?? serial ?? ''],
      ...['--exit-with-stdin', ...(cannotShowPages() ? ['--no-open'] : []), ...passedOn],
    ],
    say,
  );
  const ended = new Promise((resolve) => gateway.once('close', (code) => resolve((exitCode = code ?? 1))));
  await plugged;
  if (await untilItAnswers(urlOf(address), () => exitCode !== null)) {
    say(`\nServodeck is ready: ${urlOf(address)}`);
    if (cable) {
      say(
        'The board is simulated: Enter pulls its cable, Enter again plugs it back in. Ctrl-C ends everything.\n',
      );
      listenForEnter(cable);
    } else {
      say('Ctrl-C ends it.\n');
    }
  }
  await ended;
  say(`The gateway has ended (code ${exitCode}).`);
  await endChildren();
  process.exit(exitCode === 0 ? 0 : 1); // an open stdin would keep us here
}

await main(start);
