// The servos where they sit on the body: pressing one selects it. While arranging, they are dragged to other places instead.

import { useRef, useState, type KeyboardEvent } from 'react';
import type { BodyKind } from '#shared/actions/robot/robot.ts';
import { undoActionOf } from '../actions/useUndoKeys.ts';
import { useRobot, useServoView, useStores } from '../stores/stores.ts';
import { Toggle } from '../ui/Toggle.tsx';
import { UndoTools } from '../undo/UndoTools.tsx';
import { words } from '../words/words.ts';
import { ArrangedPlace } from './ArrangedPlace.tsx';
import { LiveArm } from './LiveArm.tsx';
import { LiveBones } from './LiveBones.tsx';
import { Place } from './Place.tsx';
import { UnknownNote } from './UnknownNote.tsx';
import styles from './BodyMap.module.css';

export function BodyMap({ isArrangingFirst = false }: { readonly isArrangingFirst?: boolean }) {
  const { robots } = useStores();
  const { body, servos } = useRobot();
  const hidden = useServoView((view) => view.hidden);
  const [isArranging, setArranging] = useState(isArrangingFirst);
  const stage = useRef<HTMLDivElement>(null);
  const shown = servos.filter(({ servo }) => !hidden.includes(servo));
  const order = shown.map(({ servo }) => servo);

  /** While places are written on, the undo keys are about them. */
  function undoKey(event: KeyboardEvent): void {
    const action = isArranging ? undoActionOf(event) : null;
    if (action === null) return;
    event.preventDefault();
    event.stopPropagation();
    robots[action]();
  }

  return (
    <div className={styles.map} onKeyDown={undoKey}>
      <div className={styles.room}>
        <div ref={stage} className={styles.stage} data-body={body}>
          <Picture body={body} />
          <ul className={styles.places} aria-label={words.servoPanel.places}>
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
