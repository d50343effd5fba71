// Everything that can go wrong between a person and a board, as one union of codes. The page has one sentence for each
// code that determines the remedy; no code path may invent another. Knows no cable and no words.

export const LINK_ERROR_CODES = [
  'closed', // the link is not open
  'lost', // the device or the gateway went away while open
  'portMissing', // no such device
  'portBusy', // another program or tab holds it
  'portDenied', // the operating system refuses access
  'hidDenied', // the operating system refuses access to the board's own USB cable
  'moduleMissing', // the Bluetooth module does not answer
  'moduleNotChosen', // the person closed the chooser of Bluetooth modules
  'bluetoothOff', // this computer has no Bluetooth adapter, or it is off
  'otherDevice', // another device may stand where ours was: a person must choose
  'heldElsewhere', // another tab of this browser drives it
  'movedAway', // given to another tab that requested it
  'notChosen', // the person closed the chooser
  'unsupported', // this browser has no such device API
  'insecureAddress', // the page's address is no secure context
  'gatewayUnreachable', // no gateway answers at this address
  'pageOutdated', // the page was loaded from another version of the gateway
  'gatewayRefused', // the gateway said no; `detail` says why
  'boardUnknown', // no person has said which board this is
  'wrongBoard', // its answers are not those of the board it is taken for
  'echo', // the line sends back what it is given
  'boardSilent', // it does not answer what such a board always answers
  'noAnswer', // the board did not answer in time
  'notSupported', // this board has no such command
  'notOnThisCable', // the board has it, and no hardware has confirmed how this cable carries it
  'latched', // stopped: motion waits for Resume
  'notDriving', // another client drives this robot
  'expired', // it was said too long ago to be done now
  'busy', // something else must end first, e.g. a download
  'slotBroken', // the slot holds half a group (S35)
  'slotChanged', // the slot holds something else than was seen there
  'batteryLow', // the battery is at its alarm, and new runs are refused then
  'cancelled', // the person called it off
  'overslept', // this computer or page slept while it waited, so it was not sent
  'outOfRange', // the board cannot take this value
  'internal', // a defect of ours
] as const;

export type LinkErrorCode = (typeof LINK_ERROR_CODES)[number];

export function isLinkErrorCode(text: string): text is LinkErrorCode {
  return (LINK_ERROR_CODES as readonly string[]).includes(text);
}

/** Failures that pass by themselves; the others need the person. */
const PASSING: readonly LinkErrorCode[] = [
  'lost',
  'portMissing',
  'portBusy',
  'moduleMissing',
  'bluetoothOff',
  'gatewayUnreachable',
];

export const passesByItself = ({ code }: LinkError): boolean => PASSING.includes(code);

export const asLinkError = (error: unknown): LinkError =>
  error instanceof LinkError ? error : new LinkError('internal', String(error), { cause: error });

export class LinkError extends Error {
  override readonly name = 'LinkError';
  /** Of `portBusy`: the programs that have the port, where the gateway's system reports them. */
  readonly heldBy: readonly string[];
  constructor(
    readonly code: LinkErrorCode,
    message: string,
    options?: { cause?: unknown; heldBy?: readonly string[] },
  ) {
    super(message, options);
    this.heldBy = options?.heldBy ?? [];
  }
}
