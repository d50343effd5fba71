// All English words: those of the first load, and of what comes later. Another language is another object of this type.

import { counted, formatCount, formatWhole } from './numbers.ts';
import { packetWords } from './later/packets.ts';
import { timesWords } from './times.ts';
import { english } from './english.ts';
import { wholeIdentityWords } from './later/identity.ts';
import { guideWords } from './later/guides.ts';
import { wholeRobotWords } from './later/robots.ts';
import { robotEditorWords } from './later/robotEditor.ts';
import { calibrationWords } from './later/calibration.ts';
import { wholePadWords } from './later/pad.ts';
import { wholeCompileWords } from './later/compile.ts';
import { wholePlayWords } from './later/play.ts';
import { wholeSlotWords } from './later/slots.ts';
import { exampleWords } from './later/examples.ts';
import { wholeRecordWords } from './later/examples.ts';
import { wholePoseWords } from './later/poses.ts';
import { wholeFileWords } from './later/files.ts';
import { timelineWords } from './later/timeline.ts';
import { wholeMacroWords } from './later/macros.ts';
import { wholeActionWords } from './later/actions.ts';
import { wholeBatteryWords } from './later/battery.ts';
import { wholeLibraryWords } from './later/library.ts';
import { wholePeopleWords } from './later/people.ts';

export const wholeEnglish = {
  ...english,
  packets: packetWords,
  identity: wholeIdentityWords,
  guide: guideWords,
  robots: wholeRobotWords,
  robotEditor: robotEditorWords,
  calibration: calibrationWords,
  pad: wholePadWords,
  compile: wholeCompileWords,
  play: wholePlayWords,
  slots: wholeSlotWords,
  examples: exampleWords,
  record: wholeRecordWords,
  poses: wholePoseWords,
  files: wholeFileWords,
  timeline: timelineWords,
  macros: wholeMacroWords,
  actions: wholeActionWords,
  battery: wholeBatteryWords,
  library: wholeLibraryWords,
  people: wholePeopleWords,
  body: {
    ...english.body,
    base: 'Base, from above',
    hand: 'Hand, from the front',
    figure:
      'Arm from the side; solid is estimated, outline is commanded, dashed is unknown, dotted is a preview',
  },
  connect: {
    ...english.connect,
    intro: 'Connecting moves nothing.',
    here: 'Connected by this',
    open: (label: string): string => `Open ${label}`,
    inUse: (label: string): string => `${label} is open`,
    reconnects: 'Come back by itself after a lost link',
    webSerial: {
      title: 'This computer’s port',
      about: 'A robot on a USB cable of this computer, opened by the browser.',
      choose: 'Choose a port',
      inUse: 'In use here. Disconnect, below, lets go of it for others.',
      secureLink: 'Open on 127.0.0.1',
    },
    gateway: {
      title: 'Gateway',
      about: 'A robot on a port of the machine that serves this page.',
      looking: 'Looking for a gateway at this address.',
      none: 'The gateway sees no serial port. Plug the robot in, then look again.',
      refresh: 'Look again',
      inUse: (hasOthers: boolean): string =>
        `In use here. Disconnect, below, takes this page off it${hasOthers ? '; another port takes its place on every screen' : ''}.`,
    },
    simulated: {
      title: 'Simulated robot',
      about: 'A board in this page. Nothing real moves.',
      board: 'Which board to simulate',
      open: 'Use the simulated robot',
      isOpen: 'The simulated robot is open',
    },
  },
  board: {
    ...english.board,
    /** What the group at hand says of itself. */
    place: (slot: number | null, times: number): string =>
      `This group: ${slot === null ? 'no slot of its own' : `slot ${formatWhole(slot)}`}, ${timesWords(times)}`,
    keepPlace: 'Remember slot and times',
    keepPlaceHint:
      'The slot and the times chosen here become this group’s own, for the next time it is opened',
    steps: { place: 'slot and times' },
    glance: (slot: number, badge: string): string => `Slot ${formatWhole(slot)}: ${badge}`,
    times: 'Times',
    untilStopped: 'Until stopped',
    untilStoppedHint: 'Repeats without end until you stop it.',
    untilStoppedAbsent: 'This board cannot repeat without end.',
    goOn: 'Keep running when I leave',
    goOnHint: 'Closing this page does not stop it. Everybody sees it and may.',
    goOnAtMost: 'At most',
    goOnUnit: 'min',
    goOnMinutes: 'Minutes at most',
    erase: 'Erase everything',
    eraseTitle: 'Erase every slot of the board?',
    eraseText: (slots: number): string =>
      `All ${counted(slots, 'slot')} are emptied, with the groups the maker put there. The board cannot be read, so what was not downloaded from this page cannot be brought back. Your frames on this page stay.`,
    eraseConfirm: 'Erase every slot',
    eraseKeep: 'Keep them',
    speed: 'Speed',
    speedField: 'Group speed in percent',
    percent: '%',
    everySlot: 'Every slot',
    setSpeed: 'Set speed',
    speedHint: 'Percent of the speed a group was stored with. Lasts until the board is switched off.',
    unsure: {
      download: 'Once it is clear which board this is.',
      run: 'Once it is clear which board this is.',
      speed: 'Once it is clear which board this is.',
      erase: 'Once it is clear which board this is.',
    },
    absent: {
      download:
        'This board takes no groups from here. Play from this page, or fill its slots with the maker’s program.',
      run: 'This board runs no groups. Play from this page.',
      speed: 'This board plays groups as they were stored.',
      erase: 'This board is erased only with the maker’s program.',
    },
  },
  log: {
    ...english.log,
    fold: 'Hide the log',
    entries: 'Packets',
    pause: 'Hold log',
    goOn: 'Continue log',
    paused: (count: number): string => `Held; ${formatCount(count)} new`,
    clear: 'Clear log',
    save: 'Save log',
    saveHint: 'A text file of this visit’s packets, for a bug report',
    copy: 'Copy line',
    copied: 'The line is copied.',
    notCopied: 'The browser does not allow copying here. Select the line and copy it by hand.',
    filter: 'Show',
    kinds: { move: 'Moves', group: 'Groups', battery: 'Battery', link: 'Link', noise: 'Noise' },
    search: 'Find in the log',
    searchHint: 'Words or hex',
    counted: (passed: number, hidden: number): string =>
      hidden === 0
        ? counted(passed, 'line')
        : `${formatCount(passed)} of ${counted(passed + hidden, 'line')}`,
    nothingFound: 'No line is like that',
    sent: 'Sent',
    received: 'Received',
    link: 'Link',
  },
  raw: {
    title: 'Send by hand',
    field: 'Packet in hex',
    example: '55 55 02 0F',
    hint: 'Type a packet to see what the board would make of it.',
    notHex: 'Only whole bytes in hex: 0 to 9 and A to F.',
    consent: 'I know what this does',
    send: 'Send packet',
    waits: 'Stopped. Resume before this can go.',
  },
};

export type Words = typeof wholeEnglish;
