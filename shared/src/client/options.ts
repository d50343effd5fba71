// The words that methods of `Servodeck` take; times in seconds.

/** Degrees from home, or the board's unit. */
export type Units = 'deg' | 'board';
export const UNITS: readonly Units[] = ['deg', 'board'];
/** Of servos by name or number. */
export type Positions = Readonly<Record<string | number, number>>;
/** Each: the seconds that it takes, and where servos are at its end. */
export type Frames = Iterable<readonly [seconds: number, positions: Positions]>;
/** Of a run: the board has taken it; it should have said so and has not; such a board never says. */
export type Outcome = 'acknowledged' | 'silent' | 'sent';

export interface Options {
  /** Made by an owner on the page; the gateway's own computer needs none. */
  readonly token?: string;
  /** An owner's: from any other driver. */
  readonly take?: boolean;
  /** Seconds for each request. */
  readonly timeout?: number;
}

export interface Waiting {
  /** Until the motion has ended; else until it has begun. */
  readonly wait?: boolean;
  /** Seconds after which the motion is stopped and TimedOutError thrown. */
  readonly timeout?: number;
  /** Stops the motion that is waited for. */
  readonly signal?: AbortSignal;
}

export interface PoseOptions extends Waiting {
  readonly seconds?: number;
}

export interface MoveOptions extends PoseOptions {
  readonly units: Units;
}

export interface RunOptions extends Waiting {
  /** 0: until stopped. */
  readonly times?: number;
  /** Not waited for, it continues for so many seconds without this program; else until this robot is closed. */
  readonly alone?: number;
  /** A person wants it although the battery is at its alarm and new runs are refused. */
  readonly anyway?: boolean;
}

export interface PlayOptions extends RunOptions {
  readonly units: Units;
  /** Each pass but the first begins with this frame. */
  readonly loopFrom?: number;
}

export interface DownloadOptions extends Waiting {
  readonly units: Units;
  readonly name?: string;
  /** Only if the slot holds that version. */
  readonly replaces?: string;
}
