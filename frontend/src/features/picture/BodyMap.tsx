// The servos at their places on the body: a press selects one. While arranging, they are dragged to other places.

import { useRef, useState, type CSSProperties, type KeyboardEvent } from 'react';
import type { BodyKind, RobotServo } from '#shared/profile/robot.ts';
import { runByKey } from '../../ui/action.ts';
import { UNDO_ACTIONS } from '../undo/UndoTools.tsx';
import { useRobot, useServoView, useStores } from '../stores.ts';
import { Toggle } from '../../ui/Toggle.tsx';
import { UndoTools } from '../undo/UndoTools.tsx';
import { words } from '../../i18n/whole.ts';
import { ArrangedPlace, Place, nearest } from './ArrangedPlace.tsx';
import { LiveArm, LiveBones } from './Body.tsx';
import { reachOf, type Reach } from './reach.ts';
import { UnknownNote } from './UnknownNote.tsx';
import styles from './BodyMap.module.css';

export function BodyMap({ isArrangingFirst = false }: { readonly isArrangingFirst?: boolean }) {
  const { robots } = useStores();
  const robot = useRobot();
  const { body, servos } = robot;
  const hidden = useServoView((view) => view.hidden);
  const [isArranging, setArranging] = useState(isArrangingFirst);
  const stage = useRef<HTMLDivElement>(null);
  const shown = servos.filter(({ servo }) => !hidden.includes(servo));
  const order = shown.map(({ servo }) => servo);

  /** While arranging, the undo keys apply to the places. */
  function undoKey(event: KeyboardEvent): void {
    if (!isArranging || !runByKey(UNDO_ACTIONS, event, robots)) return;
    event.preventDefault();
    event.stopPropagation();
  }

  return (
    <div className={styles.map} onKeyDown={undoKey}>
      <div className={styles.room} data-body={body} style={sizesFor(reachOf(robot), shown)}>
        <div className={styles.stage}>
          <Picture body={body} />
          <div ref={stage} className={styles.places} style={placesIn(reachOf(robot))}>
            <ul aria-label={words.servoPanel.places}>
              {shown.map((servo) =>
                isArranging ? (
                  <ArrangedPlace key={servo.servo} servo={servo} stage={stage} />
                ) : (
                  <Place key={servo.servo} servo={servo} order={order} />
                ),
              )}
            </ul>
          </div>
        </div>
      </div>
      <div className={styles.foot}>
        <UnknownNote />
        <span className={styles.tools}>
          {isArranging && <UndoTools of={robots} />}
          <Toggle label={words.servoPanel.arrange} isOn={isArranging} onChange={setArranging} />
        </span>
      </div>
    </div>
  );
}

function Picture({ body }: { readonly body: BodyKind }) {
  if (body === 'plain') return null;
  return <div className={styles.picture}>{body === 'arm' ? <LiveArm /> : <LiveBones />}</div>;
}

/** The picture of a body by bones has room for each of its poses; dials are so small that neighbours at most touch. */
function sizesFor(reach: Reach | null, servos: readonly RobotServo[]): CSSProperties {
  if (reach === null) return {};
  const width = reach.right - reach.left;
  const apart = nearest(servos.map(({ place }) => place)) / width;
  return { '--ratio': width / (reach.bottom - reach.top), '--apart': apart } as CSSProperties;
}

/** The square that places are percentages of, within that room. */
function placesIn(reach: Reach | null): CSSProperties {
  if (reach === null) return { inset: 0 };
  const { left, top, right, bottom } = reach;
  const across = (by: number): string => `${(by / (right - left)) * 100}%`;
  const down = (by: number): string => `${(by / (bottom - top)) * 100}%`;
  return { left: across(-left), top: down(-top), width: across(100), height: down(100) };
}
