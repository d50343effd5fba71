// Words about coming in and letting in: pairing, people and devices, what plain http means.

import type { PersonRoleName } from '../../people.ts';
import { formatCount, formatWhen, formatWhole } from '../numbers.ts';
import { peopleWords } from '../people.ts';

export const wholePeopleWords = {
  ...peopleWords,

  pair: {
    title: 'Come in',
    about:
      'This robot lets in paired devices only. Scan the QR code that an owner shows, or type the eight digits below it.',
    first: 'Nobody here yet? The terminal that started the gateway shows the first code.',
    name: 'Your name',
    code: 'Eight digits',
    submit: 'Come in',
  },

  named: {
    title: 'You are in',
    about: 'What shall the others call you? They see it when you drive, ask to drive or press Stop.',
    submit: 'Go on',
  },

  stopOnly: {
    title: 'Stop the robot',
    about: 'This page can stop the robot and do nothing else.',
    sending: 'Sending Stop',
    sent: 'Stop was sent. The robot moves again only after Resume on a page that drives.',
    unheard: (detail: string): string => `The gateway is stopped but did not reach the robot. ${detail}`,
  },
  overheard:
    'Plain http can be overheard by others on this network, and a listener can take a paired device’s place. On a network that is not yours, use Tailscale or an SSH tunnel, or put Caddy with https in front.',
  insecure:
    'At this address (plain http) a browser gives no USB port, no game pad and no clipboard. Sliders, playing, groups and Stop work.',

  invite: {
    title: 'Let somebody in',
    role: 'Role',
    name: 'Name',
    nameHint: 'Left empty: the device says',
    create: 'Show a QR code',
    again: 'New code',
    end: 'End the invitation',
    qr: 'QR code of the invitation',
    link: 'Link',
    code: 'Code',
    noCode: 'Five wrong codes were typed: scan the QR code, or ask for a new one.',
    left: (ms: number): string =>
      `Holds for ${formatCount(ms / 1000)} s, for one device. The next code follows by itself.`,
    over: 'This invitation is over.',
  },
  roles: {
    viewer: 'Viewer: sees everything, may stop',
    driver: 'Driver: may move the robot',
    owner: 'Owner: lets in, erases, sets up',
  } satisfies Record<PersonRoleName, string>,
  roleNames: { stopper: 'Stop only', viewer: 'Viewer', driver: 'Driver', owner: 'Owner' },

  list: 'Who may come in',
  kinds: { device: 'Device', token: 'Script', stopLink: 'Stop-only link' },
  you: 'You',
  here: 'Here now',
  drives: 'Drives now',
  handOver: 'Hand over',
  handOverTo: (name: string): string => `Hand the robot over to ${name}`,
  handOverHint: 'What moves is stopped first. Nobody is asked.',
  never: 'Not used yet',
  seen: (atMs: number): string => `Last here ${formatWhen(atMs)}`,
  rename: (name: string): string => `Name of ${name}`,
  roleOf: (name: string): string => `Role of ${name}`,
  revoke: 'Revoke',
  revokeOf: (name: string): string => `Revoke ${name}?`,
  revokeText: 'It is out at once, and needs a new invitation to come back.',
  revokeTextOfRun: (slot: number): string =>
    `It is out at once, and needs a new invitation to come back. Slot ${formatWhole(slot)}, which it let go on, still runs.`,
  revokeAndStop: 'Revoke and stop',
  revokeGroupGoesOn: 'Revoke, let it run',
  keep: 'Keep',

  more: {
    title: 'Scripts and stickers',
    name: 'What for',
    token: 'Make a token',
    stopLink: 'Make a stop-only QR code',
    tokenTitle: 'Token for a script',
    tokenText: 'Shown once. Send it as: Authorization: Bearer TOKEN',
    stopTitle: 'Stop-only QR code',
    stopText: 'Print it and stick it on the robot: whoever scans it can stop the robot and do nothing else.',
    qr: 'QR code that stops the robot',
    hide: 'Hide it',
  },
};
