// One sentence per code of a link's failure: what it is and what to do. Everything that can go wrong with a link is read
// here; no panel writes its own.

import type { LinkErrorCode } from '#shared/session/linkError.ts';

type Sentence = (detail: string) => string;

const SENTENCES: Readonly<Record<LinkErrorCode, Sentence>> = {
  closed: () => 'No robot is connected. Choose Connect first.',
  lost: () => 'The link ended. Check the cable and the power of the robot; Servodeck keeps trying.',
  portMissing: () => 'The port is not there. Plug the robot in and switch it on; Servodeck keeps trying.',
  portBusy: () => 'Another program or tab holds this port. Close it there; Servodeck keeps trying.',
  portDenied: () =>
    'The system does not allow access to this port. On Linux add yourself to the group “dialout”, then log in again.',
  otherDevice: () =>
    'This port may lead to another device now, so Servodeck left it alone. Choose the robot’s port under Connect.',
  heldElsewhere: () => 'Another Servodeck tab drives this robot. Choose “Move it here”, or go on there.',
  movedAway: () => 'Another tab has taken this robot over.',
  notChosen: () =>
    'No port was chosen. If the robot is not in the list, try another cable: some carry power only.',
  unsupported: () =>
    'This browser cannot open serial ports. Use Chrome or Edge on a computer, or start the gateway there.',
  insecureAddress: () =>
    'This address is not secure, so the browser hides its serial ports. Open the page on 127.0.0.1 instead.',
  pageOutdated: () => 'The gateway was updated. Reload this page.',
  gatewayUnreachable: () => 'No gateway answers at this address. Start it with “npm start” and try again.',
  gatewayRefused: (detail) => withDetail('The gateway refused this', detail),
  boardUnknown: () => 'Say which board this is. Until then nothing that moves is sent to it.',
  wrongBoard: () => 'Another board answers here than the one it was taken for. Say which board this is.',
  echo: () =>
    'This port sends back everything it is given. Check that the adapter is wired to the board: RX to TX, TX to RX.',
  boardSilent: () => 'The board does not answer. Switch it on and check its cable; Servodeck keeps asking.',
  noAnswer: () => 'The board did not answer in time. Check its power and its cable, then try again.',
  notSupported: () => 'This board has no such command.',
  latched: () => 'Stopped. Choose Resume before anything may move.',
  notDriving: () => 'Somebody else drives this robot. Ask for it first.',
  expired: () => 'This came too late to be done now. Do it again; if it goes on, the network is too slow.',
  busy: () => 'The robot moves, or a download or an erase is under way. Wait for its end, or cancel it.',
  slotBroken: () => 'This slot is broken: its download did not finish. Download a group to it again.',
  slotChanged: () =>
    'Somebody else has stored a group in this slot meanwhile. Nothing was overwritten: look at the slot, then download again.',
  cancelled: () => 'Cancelled.',
  overslept: () => 'This computer or page was asleep. What waited was not sent; ask for it again.',
  outOfRange: (detail) => withDetail('This value is out of range', detail),
  internal: (detail) => withDetail('Servodeck made a mistake; please report it', detail),
};

export function errorSentence(code: LinkErrorCode, detail = ''): string {
  return SENTENCES[code](detail);
}

function withDetail(sentence: string, detail: string): string {
  return detail === '' ? `${sentence}.` : `${sentence}: ${detail}${/[.!?]$/u.test(detail) ? '' : '.'}`;
}
