// On a shared link the current robot is the one that the gateway reports for the board, and choosing another one here sets it for
// everybody. Also decides who may change limits. Moves nothing.

import type { Clock } from '#shared/clock.ts';
import { limitsOnBoard, type Robot } from '#shared/profile/robot.ts';
import type { FamilyId } from '#shared/codec/families.ts';
import type { Lease } from '#shared/robot/lease.ts';
import { INITIAL_STATE } from '#shared/robot/store.ts';
import type { SessionState } from '#shared/robot/state.ts';
import type { RobotOnBoard } from '#shared/robot/state.ts';
import { words } from '../../i18n/words.ts';
import type { Notices } from '../../state/notices.ts';
import type { RobotSync } from './robotSync.ts';
import type { RobotStore } from './robots.ts';

export interface RobotOfLinkOptions {
  readonly robots: RobotStore;
  readonly robotSync: RobotSync;
  readonly notices: Notices;
  readonly clock: Clock;
  /** False in a viewer's browser, which only reads the library. */
  readonly mayWrite: boolean;
  /** Sets the robot on the board; both are in the library. Rejects if it is not `insteadOf` any more, or if another person drives. */
  putOnBoard(document: string, insteadOf: string | null): Promise<void>;
}

/** Loading a robot or putting one on the board takes less: until then the difference is no news. */
export const DIFFERS_AFTER_MS = 3000;

/** Returns a function to call with each snapshot. */
export function followRobot(options: RobotOfLinkOptions): (snapshot: SessionState) => void {
  const { robots, robotSync, notices, clock, mayWrite } = options;
  let { family, link, lease, robotOnBoard: reported } = INITIAL_STATE;
  let lastWord = reported;
  /** The last reported robot that was followed; another current robot since then is the person's choice. */
  let followed: string | null = null;
  let isOffering = false;
  /** The last request, which is not repeated: its answer may be on its way, or negative. */
  let requested = '';
  let waitsForLibrary = false;
  /** Number of the last request from here. */
  let echoes = 0;
  let cancelDifference: (() => void) | null = null;
  /** The notice that is shown, and the robot that was current then: choosing another one puts that on the board. */
  let difference: { readonly text: string; readonly document: string | null; readonly id: number } | null =
    null;

  function settle(): void {
    if (family.id !== 'unknown' && reported !== null && link.status === 'ready' && !isOffering)
      agree(reported.document, family.id);
    noteDifference();
  }

  /** Whether this page shows another robot than the gateway uses. */
  function differs(): boolean {
    if (family.id === 'unknown' || reported === null || link.status !== 'ready') return false;
    return reported.document === null || robotSync.robotOf(reported.document) !== robots.current().id;
  }

  function noteDifference(): void {
    if (!differs()) {
      cancelDifference?.();
      cancelDifference = null;
      if (difference !== null) notices.takeBack(difference.text);
      difference = null;
    } else cancelDifference ??= clock.after(DIFFERS_AFTER_MS, tellDifference);
  }

  function tellDifference(): void {
    const { id, robot } = robots.current();
    const document = reported?.document ?? null;
    const tell = document === null ? words.robots.noneAtGateway : words.robots.otherAtGateway;
    difference = { text: tell({ name: robot.name }), document, id };
    notices.ofBoard.show('warning', difference.text);
  }

  function agree(document: string | null, board: FamilyId): void {
    const there = document === null ? null : robotSync.robotOf(document);
    if (document !== null && there === null) {
      // Not yet loaded from the library, or not to be read: then a person may choose another one for everybody.
      const { id, robot } = robots.current();
      const isChosen = difference?.document === document && difference.id !== id;
      if (isChosen && robot.board === board && mayWrite && mayResume(lease)) void offer(id, document);
      return;
    }
    const isNews = document !== followed;
    followed = document;
    // Both calls may call `settle` again.
    if (there === null) robots.takeUpFor(board);
    else if (isNews) robots.takeUp(there);
    const { id, robot } = robots.current();
    if (id === there || isOffering) return;
    const wish = `${id} ${document}`;
    if (robot.board === board && mayWrite && mayResume(lease) && wish !== requested) void offer(id, document);
    else if (there !== null) bounce(there, robot.board === board && wish !== requested);
  }

  function bounce(there: number, isNews: boolean): void {
    if (isNews) notices.show('warning', whyNot());
    robots.takeUp(there);
  }

  const whyNot = (): string =>
    mayWrite ? words.robots.onlyTheDriver({ driver: lease?.driver ?? '' }) : words.robots.onlyLooking;

  /** A new link reports the robot as well, and may get a new request. */
  function hear(word: RobotOnBoard | null): void {
    if (link.status !== 'ready' || word?.document !== reported?.document) requested = '';
    lastWord = reported = word;
    if (word?.document === followed) echoes += 1;
    if (word !== null) robotSync.refresh();
  }

  async function offer(id: number, insteadOf: string | null): Promise<void> {
    isOffering = true;
    requested = `${id} ${insteadOf}`;
    try {
      const document = await robotSync.keep(id);
      waitsForLibrary = document === null;
      const isWanted = link.status === 'ready' && reported?.document === insteadOf;
      if (!isWanted) requested = '';
      else if (document !== null && document !== insteadOf) {
        // Our own report is no news: a robot chosen meanwhile is the person's choice.
        followed = document;
        const before = echoes;
        await options.putOnBoard(document, insteadOf);
        // The report of this request may still be on its way; reports after it are newer.
        if (echoes === before) reported = { document };
      }
    } catch (error) {
      followed = insteadOf;
      if (insteadOf !== null) notices.showError(error);
      // Another page was faster: waits for its report before a new request.
      else if (reported?.document === null) reported = null;
    } finally {
      isOffering = false;
    }
    settle();
  }

  robots.refuseBy((before, next) => {
    if (!mayWrite) return whyNot();
    const isShared = link.status === 'ready' && reported !== null;
    if (!isShared || mayResume(lease) || next === null || sameLimits(before, next)) return null;
    return whyNot();
  });
  robots.store.subscribe(settle);
  robotSync.store.subscribe(() => {
    if (waitsForLibrary) requested = '';
    settle();
  });
  return (snapshot) => {
    ({ family, link, lease } = snapshot);
    if (snapshot.robotOnBoard !== lastWord) hear(snapshot.robotOnBoard);
    settle();
  };
}

/** True if this page may change the limits. */
function mayResume(lease: Lease | null): boolean {
  return lease !== null && lease.mayDrive && (lease.driver === null || lease.drives || lease.mayTake);
}

function sameLimits(one: Robot, other: Robot): boolean {
  return JSON.stringify(limitsOnBoard(one)) === JSON.stringify(limitsOnBoard(other));
}
