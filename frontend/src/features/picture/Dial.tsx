// A servo's horn on a scale: the needle is the estimate, the hollow triangle on the rim the target. Unknown is a hatched face with a
// question mark. The hands are drawn on the face.

import { useState } from 'react';
import type { Family } from '#shared/codec/families.ts';
import { useStores } from '../stores.ts';
import { READABLE_MS, useFollow } from '../../ui/useEachFrame.ts';
import { words } from '../../i18n/words.ts';
import { Drawing } from './Drawing.tsx';
import { paintNeedles } from './needles.ts';
import { motionInFrame } from './motionInFrame.ts';
import { dialDegrees, halfDegree } from './pose.ts';
import overlay from './overlay.module.css';
import styles from './Dial.module.css';

export function Dial({ servo, family }: { readonly servo: number; readonly family: Family }) {
  const { device } = useStores();
  const turn = (position: number | null): number | null =>
    position === null ? null : halfDegree(dialDegrees(position, family));
  return (
    <span className={styles.place}>
      <DialFace servo={servo} />
      <Drawing
        className={overlay.over}
        shown={() => {
          const { target, estimated } = motionInFrame(device, servo);
          return [turn(target), turn(estimated)] as const;
        }}
        paint={({ ctx, look, size }, [target, needle]) => {
          const spot = { x: size.width / 2, y: size.height / 2 };
          paintNeedles(ctx, look, size.width, [{ spot, needles: { target, needle, preview: null } }]);
        }}
      />
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
      aria-label={words.body.gaugeFigure({ servo })}
    >
      <path className={styles.rim} d={RIM} />
      {isKnown ? <circle className={styles.hub} r={4} /> : <Unknown />}
    </svg>
  );
}

function useIsKnown(servo: number): boolean {
  const { device } = useStores();
  const isKnownNow = (): boolean => motionInFrame(device, servo).estimated !== null;
  const [isKnown, setKnown] = useState(isKnownNow);
  useFollow({ read: isKnownNow, draw: setKnown, eachMs: READABLE_MS });
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

/** 240 degrees of a circle of radius 19, open below. */
const RIM = 'M-16.45 9.5A19 19 0 1 1 16.45 9.5';
