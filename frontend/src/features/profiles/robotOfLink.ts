// On a shared link the robot at hand is the one that the link says to stand on the board, and what a person takes up here is put
// there for everybody. Knows who may change what it is judged by. Moves nothing.

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
  /** False in a viewer's browser, which only looks at what the library has. */
  readonly mayWrite: boolean;
  /** In the library both; rejects where another one stands there than `insteadOf`, or somebody else drives. */
  putOnBoard(document: string, insteadOf: string | null): Promise<void>;
}

/** Returns what is to be called with each state of the session. */
export function followRobot(options: RobotOfLinkOptions): (snapshot: SessionState) => void {
  const { robots, robotSync, notices, mayWrite } = options;
  let { family, link, lease, robotOnBoard: reported } = INITIAL_STATE;
  let lastWord = reported;
  /** The word that was followed; another robot at hand since then is the person's wish. */
  let followed: string | null = null;
  let isOffering = false;
  /** Nothing is asked twice by itself: the answer may be on its way, or have been no. */
  let asked = '';
  let waitsForLibrary = false;
  /** Counts the words about what was put there from here last. */
  let echoes = 0;

  function settle(): void {
    if (family.id !== 'unknown' && reported !== null && link.status === 'ready' && !isOffering)
      agree(reported.document, family.id);
  }

  function agree(document: string | null, board: FamilyId): void {
    const there = document === null ? null : robotSync.robotOf(document);
    if (document !== null && there === null) return; // it is on its way
    const isNews = document !== followed;
    followed = document;
    // Either may have `settle` called anew.
    if (there === null) robots.takeUpFor(board);
    else if (isNews) robots.takeUp(there);
    const { id, robot } = robots.current();
    if (id === there || isOffering) return;
    const wish = `${id} ${document}`;
    if (robot.board === board && mayWrite && mayResume(lease) && wish !== asked) void offer(id, document);
    else if (there !== null) bounce(there, robot.board === board && wish !== asked);
  }

  function bounce(there: number, isNews: boolean): void {
    if (isNews) notices.tell('warning', whyNot());
    robots.takeUp(there);
  }

  const whyNot = (): string =>
    mayWrite ? words.robots.onlyTheDriver({ driver: lease?.driver ?? '' }) : words.robots.onlyLooking;

  /** A link that has just opened tells it too, and may be asked anew. */
  function hear(word: RobotOnBoard | null): void {
    if (link.status !== 'ready' || word?.document !== reported?.document) asked = '';
    lastWord = reported = word;
    if (word?.document === followed) echoes += 1;
    if (word !== null) robotSync.refresh();
  }

  async function offer(id: number, insteadOf: string | null): Promise<void> {
    isOffering = true;
    asked = `${id} ${insteadOf}`;
    try {
      const document = await robotSync.keep(id);
      waitsForLibrary = document === null;
      const isWanted = link.status === 'ready' && reported?.document === insteadOf;
      if (!isWanted) asked = '';
      else if (document !== null && document !== insteadOf) {
        // Our own word is no news: what was taken up meanwhile is wished for.
        followed = document;
        const before = echoes;
        await options.putOnBoard(document, insteadOf);
        // The word about it may be on its way still; where it has come, whatever came behind it is newer.
        if (echoes === before) reported = { document };
      }
    } catch (error) {
      followed = insteadOf;
      if (insteadOf !== null) notices.tellError(error);
      // Somebody was faster: nothing is asked in place of none before the word about it comes.
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
    if (waitsForLibrary) asked = '';
    settle();
  });
  return (snapshot) => {
    ({ family, link, lease } = snapshot);
    if (snapshot.robotOnBoard !== lastWord) hear(snapshot.robotOnBoard);
    settle();
  };
}

/** Whether what moves are judged by may be changed from here. */
function mayResume(lease: Lease | null): boolean {
  return lease !== null && lease.mayDrive && (lease.driver === null || lease.drives || lease.mayTake);
}

function sameLimits(one: Robot, other: Robot): boolean {
  return JSON.stringify(limitsOnBoard(one)) === JSON.stringify(limitsOnBoard(other));
}
