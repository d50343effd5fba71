// A servo's horn on a scale: the needle is the estimate, the hollow triangle on the rim the target, a dotted hand the group's pose. Unknown is a hatched
// face with a question mark. The live one is drawn once a frame from the session's motion, past React.

import { useRef } from 'react';
import type { ServoMotion } from '#shared/session/state.ts';
import type { Family } from '#shared/protocol/families.ts';
import { useStores } from '../stores/stores.ts';
import { words } from '../words/words.ts';
import { dialDegrees, type Pose } from './pose.ts';
import { useMotion } from './useMotion.ts';
import styles from './Dial.module.css';

export function Dial({ servo, family }: { readonly servo: number; readonly family: Family }) {
  const { device } = useStores();
  const dial = useRef<SVGSVGElement>(null);
  const drawn = useRef('');
  useMotion(servo, (motion) => {
    const look = `${turn(motion.target, family)} ${turn(motion.estimated, family)}`;
    if (dial.current === null || look === drawn.current) return;
    drawn.current = look;
    drawDial(dial.current, motion, family);
  });
  return (
    <DialFace
      ref={dial}
      servo={servo}
      label={words.body.gaugeFigure(servo)}
      motion={device.motion(servo)}
      family={family}
    />
  );
}

interface DialFaceProps {
  readonly servo: number;
  readonly label: string;
  readonly motion: ServoMotion;
  readonly family: Family;
  readonly ref?: React.Ref<SVGSVGElement>;
}

function DialFace({ servo, label, motion, family, ref }: DialFaceProps) {
  const { target, estimated } = motion;
  return (
    <svg ref={ref} className={styles.dial} viewBox="-24 -24 48 48" role="img" aria-label={label}>
      <path className={styles.rim} d={RIM} />
      <g visibility={visible(estimated === null)}>
        <path className={styles.hatch} d="M-9 5L5 -9M-6 9L9 -6M-11 0L0 -11M0 11L11 0" />
        <text className={styles.question} y={5}>
          {words.servos.unknown}
        </text>
      </g>
      <g visibility={visible(target !== null)} transform={turn(target, family)}>
        <path className={styles.target} d="M-4 -22.5h8L0 -15.5z" />
      </g>
      <g visibility={visible(estimated !== null)} transform={turn(estimated, family)}>
        <path className={styles.needle} d="M-2.5 4L-1 -14h2L2.5 4z" />
        <circle className={styles.hub} r={4} />
      </g>
      <path className={styles.preview} data-preview={servo} visibility="hidden" d="M0 -6V-19" />
    </svg>
  );
}

/** Where the group at hand would have the servos, on all dials within; null: nothing is shown of it. */
export function drawPreviews(dials: Element, pose: Pose | null, family: Family): void {
  for (const hand of dials.querySelectorAll<SVGPathElement>('[data-preview]')) {
    const position = pose?.(Number(hand.dataset.preview)) ?? null;
    set(hand, 'visibility', visible(position !== null));
    set(hand, 'transform', turn(position, family));
  }
}

function drawDial(dial: SVGSVGElement, { target, estimated }: ServoMotion, family: Family): void {
  const [, unknown, commanded, needle] = dial.children;
  set(unknown, 'visibility', visible(estimated === null));
  set(commanded, 'visibility', visible(target !== null));
  set(commanded, 'transform', turn(target, family));
  set(needle, 'visibility', visible(estimated !== null));
  set(needle, 'transform', turn(estimated, family));
}

/** Writing what is there already would have it painted anew. */
function set(part: Element | undefined, name: string, value: string): void {
  if (part !== undefined && part.getAttribute(name) !== value) part.setAttribute(name, value);
}

/** 240 degrees of a circle of radius 19, open below. */
const RIM = 'M-16.45 9.5A19 19 0 1 1 16.45 9.5';

const visible = (shown: boolean): 'visible' | 'hidden' => (shown ? 'visible' : 'hidden');

const turn = (position: number | null, family: Family): string =>
  position === null ? '' : `rotate(${halfDegree(dialDegrees(position, family))})`;

/** A sixth of a pixel at the needle's tip: finer turns are painted for nobody. */
const halfDegree = (degrees: number): string => (Math.round(degrees * 2) / 2).toFixed(1);
