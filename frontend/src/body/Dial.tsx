// A servo's horn on a scale: the needle is the estimate, the hollow triangle on the rim the target. Unknown is a hatched face with a
// question mark. The live one is drawn once a frame from the session's motion, past React.

import { useRef, useState } from 'react';
import type { ServoMotion } from '#shared/session/state.ts';
import type { Family } from '#shared/protocol/families.ts';
import { useStores } from '../stores/stores.ts';
import { setAttribute } from '../ui/setAttribute.ts';
import { words } from '../words/words.ts';
import { HUB, NEEDLE, TARGET, turnedBy, type Corners } from './hands.ts';
import { dialDegrees, halfDegree } from './pose.ts';
import { useMotion } from './useMotion.ts';
import styles from './Dial.module.css';

export function Dial({ servo, family }: { readonly servo: number; readonly family: Family }) {
  const { device } = useStores();
  const dial = useRef<SVGSVGElement>(null);
  useMotion(servo, (motion) => {
    if (dial.current !== null) drawDial(dial.current, motion, family);
  });
  const { target, estimated } = device.motion(servo);
  const [commanded, needle] = [pathOf(TARGET, target, family), pathOf(NEEDLE, estimated, family)];
  return (
    <span className={styles.place}>
      <svg
        ref={dial}
        className={styles.dial}
        viewBox="-24 -24 48 48"
        role="img"
        aria-label={words.body.gaugeFigure(servo)}
      >
        <path className={styles.rim} d={RIM} />
        <g visibility={visible(estimated === null)}>
          <Unknown />
        </g>
        <path className={styles.target} d={commanded} />
        <path className={styles.needle} d={needle} />
        <circle className={styles.hub} visibility={visible(estimated !== null)} r={HUB} />
      </svg>
    </span>
  );
}

/** The dial without hands, for those that are drawn together. */
export function DialFace({ servo }: { readonly servo: number }) {
  const isKnown = useIsKnown(servo);
  return (
    <svg
      className={styles.dial}
      viewBox="-24 -24 48 48"
      role="img"
      aria-label={words.body.gaugeFigure(servo)}
    >
      <path className={styles.rim} d={RIM} />
      {!isKnown && <Unknown />}
    </svg>
  );
}

function useIsKnown(servo: number): boolean {
  const { device } = useStores();
  const isKnownNow = (): boolean => device.motion(servo).estimated !== null;
  const [isKnown, setKnown] = useState(isKnownNow);
  useMotion(servo, () => setKnown(isKnownNow()));
  return isKnown;
}

function Unknown() {
  return (
    <>
      <path className={styles.hatch} d="M-9 5L5 -9M-6 9L9 -6M-11 0L0 -11M0 11L11 0" />
      <text className={styles.question} y={5}>
        {words.servos.unknown}
      </text>
    </>
  );
}

function drawDial(dial: SVGSVGElement, { target, estimated }: ServoMotion, family: Family): void {
  const [, unknown, commanded, needle, hub] = dial.children;
  setAttribute(unknown, 'visibility', visible(estimated === null));
  setAttribute(commanded, 'd', pathOf(TARGET, target, family));
  setAttribute(needle, 'd', pathOf(NEEDLE, estimated, family));
  setAttribute(hub, 'visibility', visible(estimated !== null));
}

/** 240 degrees of a circle of radius 19, open below. */
const RIM = 'M-16.45 9.5A19 19 0 1 1 16.45 9.5';

const visible = (shown: boolean): 'visible' | 'hidden' => (shown ? 'visible' : 'hidden');

/** The hand turned: as a path of its own, because a transform would have the browser sort its layers anew in each frame. */
function pathOf(hand: Corners, position: number | null, family: Family): string {
  if (position === null) return '';
  const corners = turnedBy(hand, halfDegree(dialDegrees(position, family)));
  return `M${corners.map(([x, y]) => `${x.toFixed(2)} ${y.toFixed(2)}`).join('L')}Z`;
}
