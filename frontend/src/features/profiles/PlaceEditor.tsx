// Where each servo sits on the robot, on the drawing of its build: dragged, or pushed by arrow keys. Moves nothing.

import { useId, useRef } from 'react';
import { ArrangedPlace } from '../picture/ArrangedPlace.tsx';
import { useRobot } from '../stores.ts';
import { words } from '../../i18n/whole.ts';
import { RobotPicture } from './RobotPicture.tsx';
import styles from './PlaceEditor.module.css';

export function PlaceEditor() {
  const robot = useRobot();
  const stage = useRef<HTMLDivElement>(null);
  const headingId = useId();
  return (
    <section className={styles.editor} aria-labelledby={headingId}>
      <div className={styles.words}>
        <h3 id={headingId}>{words.robotEditor.places}</h3>
        <p>{words.robotEditor.placesHint}</p>
      </div>
      <div ref={stage} className={styles.stage}>
        <RobotPicture robot={robot} />
        <ul aria-label={words.robotEditor.places}>
          {robot.servos.map((servo) => (
            <ArrangedPlace key={servo.servo} servo={servo} stage={stage} />
          ))}
        </ul>
      </div>
    </section>
  );
}
