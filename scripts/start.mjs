// `npm start`: sets up, puts a simulated board on a serial port, starts the gateway on it and opens the page.
// `-- --serial DEVICE` takes a real board instead. Whatever is not known here goes to the gateway.

import { once } from 'node:events';
import { createInterface } from 'node:readline';
import { chooseAddress, textOf } from './address.mjs';
import { simulatedBoard } from './cable.mjs';
import { endChildren, isEnding, onEnd, startChild } from './children.mjs';
import { python } from './python.mjs';
import { setUp } from './setup.mjs';
import { at, main, say } from './steps.mjs';

const readyLine = /^Servodeck is at (\S+)/;

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

/** Elsewhere nobody sees a window, and a text browser would take over the terminal. */
function showsPages() {
  const { CI, DISPLAY, WAYLAND_DISPLAY } = process.env;
  return !CI && (process.platform !== 'linux' || Boolean(DISPLAY) || Boolean(WAYLAND_DISPLAY));
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

/** @param {number} code */
async function leave(code) {
  await endChildren();
  process.exit(code); // an open stdin would keep us here
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

/**
 * @param {import('./address.mjs').Address} address @param {readonly string[]} port @param {readonly string[]} passedOn
 * @returns {string[]}
 */
function gatewayCommand(address, port, passedOn) {
  const serve = ['-m', 'servodeck', 'serve', '--listen', textOf(address), '--data', at('data'), ...port];
  // What the person says comes last and so has the last word.
  return [...serve, '--exit-with-stdin', showsPages() ? '--open' : '--no-open', ...passedOn];
}

/** @param {string} url @param {import('./cable.mjs').Cable | null} cable */
function greet(url, cable) {
  say(`\nServodeck is ready: ${url}`);
  if (cable === null) {
    say('Ctrl-C ends it.\n');
    return;
  }
  say(
    'The board is simulated: Enter pulls its cable, Enter again plugs it back in. Ctrl-C ends everything.\n',
  );
  listenForEnter(cable);
}

/** @returns {Promise<number>} */
async function start() {
  onEnd(() => void leave(0));
  const { serial, listen, passedOn } = parseArguments(process.argv.slice(2));
  await setUp();
  const address = await chooseAddress(listen, { lan: passedOn.includes('--lan') });
  const cable = serial === null ? await boardOn(`build/simulated-board-${address.port}`) : null;
  const plugged = cable?.plug();
  const port = cable === null ? ['--serial', serial ?? ''] : ['--serial', cable.device, '--simulated'];

  const gateway = startChild(python, gatewayCommand(address, port, passedOn), (line) => {
    const [, url] = readyLine.exec(line) ?? [];
    if (url === undefined) say(line);
    else void Promise.resolve(plugged).then(() => greet(url, cable));
  });
  await once(gateway, 'close');
  if (isEnding()) return 0;
  say('The gateway has ended by itself; the lines above may say why.');
  await leave(1);
  return 1;
}

await main(start);
