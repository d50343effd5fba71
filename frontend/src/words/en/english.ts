// The English words that the first load needs, as one typed catalogue; those of what comes later are in later/, all of them in whole.ts.
// Words are short and concrete; verbs stand on buttons; whatever destroys something names what is lost.

import type { Family } from '#shared/protocol/families.ts';
import type { LinkState } from '#shared/session/state.ts';
import { counted, formatAge, formatCount, formatRoughly, formatWhole, numbers } from './numbers.ts';
import { actionWords } from './actions.ts';
import { batteryWords } from './battery.ts';
import { errorSentence } from './errors.ts';
import { firstMoveWords } from './firstMoves.ts';
import { identityWords } from './identity.ts';
import { leaseWords } from './lease.ts';
import { libraryWords } from './library.ts';
import { peopleWords } from './people.ts';
import { rangeText } from './refusals.ts';
import { padWords } from './pad.ts';
import { compileWords } from './compile.ts';
import { recordWords } from './record.ts';
import { macroWords } from './macros.ts';
import { playWords } from './play.ts';
import { teachWords } from './teach.ts';
import { poseWords } from './poses.ts';
import { robotWords } from './robots.ts';
import { servoPanelWords } from './servoPanel.ts';
import { timesWords } from './times.ts';
import { slotWords } from './slots.ts';
import { stopWords } from './stop.ts';

export const english = {
  /** For `lang` and for whatever speaks or sorts. */
  locale: 'en',
  product: 'Servodeck',
  numbers,
  errorSentence,
  rangeText,
  boardName: (family: Pick<Family, 'id' | 'name'>): string => family.name,
  regions: { top: 'Robot and link', notices: 'Notices' },
  tabs: { live: 'Live', actions: 'Actions', board: 'Board', log: 'Log', buttons: 'Buttons' },
  tabList: 'Parts of the dashboard',
  close: 'Close',
  /** Between marks of one thing. */
  comma: ', ',

  truth: {
    commanded: 'Commanded',
    estimated: 'Estimated',
    confirmed: 'Reported',
    unknown: 'Unknown',
    legend: 'What the marks mean',
  },

  link: {
    status: {
      closed: 'No robot',
      opening: 'Connecting',
      identifying: 'Asking the board',
      ready: 'Ready',
      stale: 'No answer',
      lost: 'Lost',
      refused: 'Needs you',
    } satisfies Record<LinkState['status'], string>,
    simulated: 'Simulated',
    noBoard: 'No robot',
    chip: (status: string, label: string): string => `Link: ${label === '' ? status : `${status}, ${label}`}`,
    connect: 'Connect',
    disconnect: 'Disconnect',
    retryNow: 'Try now',
    moveHere: 'Move it here',
    gatewayAnswers: 'The gateway answers now. Until now this page drove its simulated robot.',
    useGateway: 'Go to the gateway',
    retryIn: (ms: number): string => `Next try in ${formatWhole(Math.max(0, Math.ceil(ms / 1000)))} s`,
    needsYou: 'Waiting for you',
  },

  identity: identityWords,
  robots: robotWords,
  firstMoves: firstMoveWords,
  servoPanel: servoPanelWords,
  authoring: {
    label: 'What to work on',
    group: 'Action group',
    poses: 'Poses',
    pad: 'Keys and pad',
    padDriving: 'Keys and pad, driving',
  },
  pad: padWords,
  compile: compileWords,
  play: playWords,
  teach: teachWords,
  slots: slotWords,
  lease: leaseWords,
  record: recordWords,
  poses: poseWords,
  macros: macroWords,

  stop: stopWords,

  activity: {
    idle: 'Idle',
    moving: 'Moving',
    running: (slot: number, times: number): string =>
      `Running slot ${formatWhole(slot)}, ${timesWords(times)}`,
    runTruth: {
      requested: 'asked, not yet received',
      acknowledged: 'received by the board',
      unknown: 'no word from the board',
    },
    told: (activity: string, truth: string): string => `${activity}: ${truth}`,
    playing: (frame: number, count: number): string =>
      `Playing frame ${formatWhole(frame)} of ${formatWhole(count)}`,
    downloading: (slot: number): string => `Downloading to slot ${formatWhole(slot)}`,
    erasing: 'Erasing every slot',
  },

  theme: {
    now: (theme: string): string => `Appearance: ${theme}`,
    system: 'As the system',
    light: 'Light',
    dark: 'Dark',
  },
  language: {
    label: 'Language',
    system: 'As the system',
    notLoaded: 'The words of this language could not be loaded. Reload the page to try again.',
  },

  connect: {
    title: 'Connect a robot',
    isOpen: (label: string): string => `${label} is open and ready.`,
  },

  body: {
    allUnknown: 'Positions are unknown until each servo is moved once. The first move is slow.',
    gaugeFigure: (servo: number): string => `Dial of servo ${formatWhole(servo)}`,
  },

  servos: {
    title: 'Servos',
    name: (servo: number): string => `Servo ${formatWhole(servo)}`,
    position: (servo: number): string => `Servo ${formatWhole(servo)} position`,
    target: (servo: number): string => `Servo ${formatWhole(servo)} target`,
    unknownValue: 'Unknown; the first move may be slow',
    unknown: '?',
    moveTime: 'Move time',
    hand: 'As fast as my hand',
    timed: 'In a set time',
    moveTimeAbout: {
      hand: 'Follows the pointer. Typed numbers, Home and End: a whole range in 2 s.',
      timed: 'Every move takes this long.',
    },
    moveTimeField: 'Move time in milliseconds',
    ms: 'ms',
    age: (ms: number): string => formatAge(ms),
    readPositions: 'Read positions',
    readHint: 'Asks the board where its servos stand. Moves nothing.',
    release: 'Release',
    releaseTitle: 'Release every servo?',
    releaseText:
      'The arm drops. Hold it. Then it can be turned by hand; its positions are unknown until they are read. Any move powers the servos again.',
    releaseConfirm: 'Release every servo',
    releaseKeep: 'Keep holding',
    centre: 'Centre all',
    centreHint: 'Moves every servo that is not locked slowly to its home',
    blocked: {
      closed: 'No link to a robot.',
      identifying: 'The board is being asked who it is.',
      stale: 'The board does not answer.',
      latched: 'Stopped. Resume to move.',
      watching: 'Somebody else drives. Choose “Ask to drive” for a turn.',
      asking:
        'You have asked to drive. It is your turn when the driver allows it or says nothing for five seconds.',
      viewing: 'You look on; only a driver moves the robot. Stop works for you too.',
      busy: 'Board busy, moving waits.',
    },
  },

  actions: actionWords,

  board: {
    details: 'Details',
    title: 'Board',
    slot: 'Slot',
    download: 'Download',
    downloadHint: (count: number, slot: number): string =>
      `${counted(count, 'frame')} to slot ${formatWhole(slot)}`,
    nothingToDownload: 'Capture a frame first.',
    cancelDownload: 'Cancel',
    progress: 'Download progress',
    progressText: (stored: number, count: number): string =>
      `${formatCount(stored)} of ${counted(count, 'frame')}`,
    bytes: (sent: number, total: number): string => `${formatCount(sent)} of ${counted(total, 'byte')}`,
    left: (ms: number): string => `${formatRoughly(ms)} left`,
    run: 'Run',
    runsNothing: (slot: number): string =>
      `Slot ${formatWhole(slot)} is empty, as far as is known here: nothing runs. Download a group to it first.`,
    runHint: (slot: number, times: number): string => `Slot ${formatWhole(slot)}, ${timesWords(times)}`,
    stopGroup: 'End group',
    stopGroupHint: 'Ends the group after its frame in progress. Not an emergency stop.',
    erased: 'Every slot is empty.',
    downloaded: ([first = 0, ...others]: readonly number[]): string =>
      others.length === 0
        ? `Slot ${formatWhole(first)} is downloaded.`
        : `${counted(others.length + 1, 'group')} are downloaded.`,
    /** null: it was called off between two groups. */
    downloadCancelled: (broken: number | null): string =>
      broken === null
        ? 'Download cancelled. No slot is broken.'
        : `Download cancelled. Slot ${formatWhole(broken)} is broken until a whole group is downloaded.`,
    speedSent: (slot: number | null, percent: number): string =>
      `${slot === null ? 'Every slot' : `Slot ${formatWhole(slot)}`} was asked to play at ${formatWhole(percent)} %. The board does not confirm it.`,
  },

  battery: batteryWords,
  library: libraryWords,
  people: peopleWords,

  log: {
    title: 'Log',
    open: 'Show the log',
    empty: 'No packets yet',
  },

  refused: (name: string, value: number, min: number, max: number): string =>
    `${name}: ${formatWhole(value)} is out of range; it takes ${formatWhole(min)} to ${formatWhole(max)}.`,
  dismiss: 'Dismiss',
  later: {
    missing: 'This part of the page did not come.',
    missingHint:
      'Driving and STOP go on without it, and what you wrote is saved. Is the gateway still running? After an update of it, load the page again.',
    again: 'Try again',
  },
  moreNotices: (count: number): string => `${formatWhole(count)} more`,
};

export type FirstWords = typeof english;
