// The state of the link and of the board: the chip in the bar that opens the ways to connect, and a line that never moves: the latch with its
// Resume first, then a lost link with its countdown, then the board's activity. Changes are read out.

import type { Unheld } from '#shared/motion/haltPlan.ts';
import { useDevice, useDocument, useIsTeaching, useSnapshot, useStores, usePlayedFrame } from '../stores.ts';
import { mayResume } from '#shared/robot/lease.ts';
import type { LinkErrorCode } from '#shared/robot/linkError.ts';
import type { Latch, LinkState } from '#shared/robot/state.ts';
import { shownActivity, type ShownActivity } from '../../robot/readiness.ts';
import { Button } from '../../ui/Button.tsx';
import { Mark, type Truth } from '../../ui/Chip.tsx';
import { cx } from '../../ui/cx.ts';
import { useNow } from '../../ui/useEachFrame.ts';
import { servosText, stoppedBy, mayResumeText, errorSentence, linkSentence } from '../../i18n/sentences.ts';
import { secondsLeft } from '../../i18n/numbers.ts';
import { words } from '../../i18n/words.ts';
import { laterComponent } from '../../ui/later.tsx';
import styles from './StatusLine.module.css';
import { pressOnce } from '../../ui/inputEvents.ts';
import linkChip from './LinkChip.module.css';

const LeaseStatus = laterComponent(
  async () => (await import('../people/LeaseChip.tsx')).LeaseStatus,
  '0',
  'guards',
);

export interface StatusLineProps {
  /** Its place in the bar. */
  readonly className?: string | undefined;
  /** Has another tab let go of the robot. */
  onMoveHere(): void;
}

export function StatusLine({ className, onMoveHere }: StatusLineProps) {
  const link = useSnapshot((snapshot) => snapshot.link);
  const latch = useSnapshot((snapshot) => snapshot.latch);
  const activity = useDevice(shownActivity);
  const isShared = useSnapshot((snapshot) => snapshot.lease !== null);
  const played = usePlayed();
  const isTeaching = useIsTeaching();
  const isDown = link.status === 'lost' || link.status === 'refused';
  const isCalm = link.status === 'ready' && latch === null;
  const mayBeRunning = useSnapshot((snapshot) => snapshot.mayBeRunning) && activity.kind === 'idle';
  return (
    <div
      className={cx(
        styles.line,
        className,
        isDown && styles.lost,
        latch !== null && styles.held,
        isCalm && styles.calm,
      )}
    >
      {isDown ? (
        <Down link={link} onMoveHere={onMoveHere} />
      ) : link.status === 'stale' ? (
        <Said truth="warning" text={errorSentence('boardSilent')} />
      ) : link.status === 'identifying' ? (
        <Said truth="unknown" text={words.identity.asking} />
      ) : latch !== null ? (
        <Latched latch={latch} />
      ) : isTeaching ? (
        <Said truth="warning" text={words.teach.status} />
      ) : mayBeRunning && link.status === 'ready' ? (
        <Said truth="warning" text={words.activity.before} />
      ) : (
        <Said
          truth={activityTruth(activity)}
          text={link.status === 'ready' ? activityWords(activity, played) : ''}
        />
      )}
      {isShared && <LeaseStatus />}
    </div>
  );
}

function Said({ truth, text, more = '' }: { truth: Truth; text: string; more?: string }) {
  return (
    <div className={styles.said} role="status">
      {text !== '' && <Mark truth={truth} />}
      <div className={styles.words}>
        <p className={styles.text}>{text}</p>
        <p className={styles.more}>{more}</p>
      </div>
    </div>
  );
}

function Latched({ latch }: { readonly latch: Latch }) {
  const { device } = useStores();
  const lease = useSnapshot((snapshot) => snapshot.lease);
  const isOurs = lease === null || mayResume(lease);
  return (
    <>
      <Said
        truth={STOP_TRUTH[latch.stop]}
        text={words.stop.outcome[latch.stop]}
        more={isOurs ? latchWords(latch) : `${latchWords(latch)}. ${mayResumeText(lease)}`}
      />
      {isOurs && (
        <Button onPress={() => device.resume()} icon="play" hint={words.stop.resumeHint}>
          {words.stop.resume}
        </Button>
      )}
    </>
  );
}

const STOP_TRUTH: Readonly<Record<Latch['stop'], Truth>> = {
  sending: 'warning',
  sent: 'warning',
  confirmed: 'confirmed',
  unanswered: 'danger',
  failed: 'danger',
};

const ANSWERED_ELSEWHERE: readonly LinkErrorCode[] = ['closed', 'boardUnknown', 'wrongBoard', 'echo'];

const IN_ANOTHER_TAB: readonly LinkErrorCode[] = ['heldElsewhere', 'movedAway'];

function latchWords({ reason, by, unheld }: Latch): string {
  const why = reason === 'elsewhere' ? stoppedBy(by) : words.stop.reason[reason];
  if (unheld === null) return why;
  const moving = unheldText(unheld);
  return reason === 'pressed' ? moving : `${moving}. ${why}`;
}

function unheldText({ servos, forMs }: Unheld): string {
  const who = servos === null ? words.stop.robot : servosText(servos);
  return Number.isFinite(forMs)
    ? words.stop.mayKeepMovingFor({ servos: who, ms: forMs })
    : words.stop.mayKeepMoving({ servos: who });
}

type DownState = Extract<LinkState, { status: 'lost' | 'refused' }>;

function Down({ link, onMoveHere }: { readonly link: DownState; readonly onMoveHere: () => void }) {
  const { device } = useStores();
  const needsChoice = link.error.code === 'boardUnknown';
  const said = <Said truth={needsChoice ? 'warning' : 'danger'} text={linkSentence(link.error)} />;
  // There is nothing to try again: the sentence says to connect, or to say which board it is.
  if (ANSWERED_ELSEWHERE.includes(link.error.code)) return said;
  const retryAtMs = link.status === 'lost' ? link.retryAtMs : null;
  return (
    <>
      {said}
      <span className={styles.countdown}>
        {retryAtMs === null ? words.link.needsYou : <Countdown untilMs={retryAtMs} />}
      </span>
      {IN_ANOTHER_TAB.includes(link.error.code) ? (
        <Button onPress={onMoveHere}>{words.link.moveHere}</Button>
      ) : (
        <Button onPress={() => device.retryNow()} icon="refresh">
          {words.link.retryNow}
        </Button>
      )}
    </>
  );
}

function Countdown({ untilMs }: { readonly untilMs: number }) {
  const { device } = useStores();
  const nowMs = useNow(device.clock.now, 250);
  return words.link.retryIn({ seconds: secondsLeft(untilMs - nowMs) });
}

function activityTruth(activity: ShownActivity): Truth {
  if (activity.kind === 'idle') return 'neutral';
  if (activity.kind === 'moving') return 'estimated';
  if (activity.kind !== 'running') return 'commanded';
  return ({ requested: 'commanded', acknowledged: 'confirmed', unknown: 'unknown' } as const)[activity.truth];
}

interface Played {
  readonly frame: number;
  readonly count: number;
}

/** Of the person's group, counted from one: what is sent are more frames, as compile makes them. null: something else is played. */
function usePlayed(): Played | null {
  const count = useDocument(({ present }) => present.frames.length);
  const index = usePlayedFrame();
  return index === null ? null : { frame: index + 1, count };
}

function activityWords(activity: ShownActivity, played: Played | null): string {
  switch (activity.kind) {
    case 'idle':
      return words.activity.idle;
    case 'moving':
      return words.activity.moving;
    case 'running':
      return words.activity.summary({
        activity: words.activity.running(activity),
        truth: words.activity.runTruth[activity.truth],
      });
    case 'playing':
      return played === null
        ? words.activity.moving
        : words.activity.playing({ frame: played.frame, count: played.count });
    case 'downloading':
      return words.activity.downloading({ slot: activity.slot });
    case 'erasing':
      return words.activity.erasing;
  }
}

const TRUTH: Readonly<Record<LinkState['status'], Truth>> = {
  closed: 'neutral',
  opening: 'unknown',
  identifying: 'unknown',
  ready: 'confirmed',
  stale: 'warning',
  lost: 'danger',
  refused: 'danger',
};

export function LinkChip() {
  const { view } = useStores();
  const status = useSnapshot((snapshot) => snapshot.link.status);
  const mustChoose = useSnapshot(({ link }) => link.status === 'refused' && link.error.code === 'closed');
  const way = useDevice((state) => state.way);
  const isSimulated = way?.isSimulated === true;
  const connects = way === null || isSimulated || mustChoose;
  const open = (): void => view.setState({ connectOpen: true });
  const label = way === null || isSimulated ? '' : way.label;
  const said = isSimulated ? words.link.simulated : words.link.status[status];
  return (
    <div className={linkChip.link} data-connects={connects}>
      <button
        type="button"
        className={linkChip.chip}
        aria-label={
          label === '' ? words.link.chip({ status: said }) : words.link.chipWithPort({ status: said, label })
        }
        onClick={open}
        onKeyDown={pressOnce}
      >
        <Mark truth={TRUTH[status]} />
        <span className={linkChip.word}>{words.link.status[status]}</span>
        {isSimulated ? (
          <span className={linkChip.badge}>{words.link.simulated}</span>
        ) : (
          <span className={linkChip.label}>{label}</span>
        )}
      </button>
      {connects && (
        <Button tone={status === 'ready' ? 'plain' : 'primary'} icon="plug" onPress={open}>
          {words.link.connect}
        </Button>
      )}
    </div>
  );
}
