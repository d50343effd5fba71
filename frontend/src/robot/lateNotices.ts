// That something came too late, or was slept through, stays shown until the same goes well: then the notice is old.
// Knows the messages and no session.

import type { Clock } from '#shared/clock.ts';
import { LinkError, type LinkErrorCode } from '#shared/robot/linkError.ts';
import { errorSentence } from '../i18n/sentences.ts';
import type { Notices } from '../state/notices.ts';

export interface LateNotices {
  report(error: unknown): void;
  /** Something was asked for and not refused. */
  asked(): void;
}

const LATE: readonly LinkErrorCode[] = ['expired', 'overslept'];
/** Long enough to be read, and to hear of another refusal. */
const WELL_MS = 3000;

export function createLateNotices(clock: Clock, notices: Pick<Notices, 'takeBack'>): LateNotices {
  let texts: readonly string[] = [];
  let cancel: (() => void) | null = null;

  function wait(): void {
    cancel?.();
    cancel = null;
  }

  return {
    report(error) {
      if (!(error instanceof LinkError) || !LATE.includes(error.code)) return;
      wait();
      texts = [...texts, errorSentence(error.code, error.message)];
    },
    asked() {
      if (texts.length === 0 || cancel !== null) return;
      cancel = clock.after(WELL_MS, () => {
        for (const text of texts) notices.takeBack(text);
        texts = [];
        cancel = null;
      });
    },
  };
}
