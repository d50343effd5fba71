// Calibration of one servo after the other: its limits and home by jogging, its direction, its mirror and its trim. It can be left and
// continued at any step: results are in the robot.

import { useEffect, useId, useRef } from 'react';
import { flawOf, servoOf, TRIM, type Robot, type RobotServo } from '#shared/profile/robot.ts';
import {
  changeServo,
  fromPartner,
  homeAtCentre,
  isDone,
  isServoDone,
  stepsOf,
} from '#shared/profile/robotEdits.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import type { CalibrationStep } from '#shared/profile/calibration.ts';
import { servoLabel } from '../../../i18n/sentences.ts';
import { words } from '../../../i18n/whole.ts';
import { RobotHead } from '../RobotPicture.tsx';
import { useStores } from '../../stores.ts';
import { Button } from '../../../ui/Button.tsx';
import { Mark } from '../../../ui/Chip.tsx';
import { cx } from '../../../ui/cx.ts';
import { DirectionStep } from './DirectionStep.tsx';
import { EndStep } from './EndStep.tsx';
import { MotionGate, Answer, Ask, type CurrentCalibration, useCalibration } from './StepParts.tsx';
import styles from './CalibrationWizard.module.css';

/** Offers to copy the results, mirrored, to the servo on the other side. */
function PartnerStep({ at: { robot, servo, accept, keep } }: { readonly at: CurrentCalibration }) {
  const partner = servo.mirror === null ? undefined : servoOf(robot, servo.mirror);
  if (partner === undefined) return null;
  const change = fromPartner(robot, servo);
  const { min, home, max } = { ...partner, ...change };
  const fits = flawOf(changeServo(robot, partner.servo, change)) === null;
  return (
    <>
      <Ask>{words.calibration.partner({ name: servoLabel(partner) })}</Ask>
      <p className={styles.figures}>
        {fits ? words.calibration.partnerFigures({ min, home, max }) : words.calibration.partnerNot}
      </p>
      <div className={styles.actions}>
        <Answer
          tone="primary"
          isDisabled={!fits}
          onPress={() => accept((all) => changeServo(all, partner.servo, change), { partner: partner.servo })}
        >
          {words.calibration.takeOver({ name: servoLabel(partner) })}
        </Answer>
        <Answer tone="quiet" onPress={keep}>
          {words.calibration.leaveAsIs}
        </Answer>
      </div>
    </>
  );
}

/** Sets home to the value of every robot of this build, and the trim to the difference. */
function TrimStep({ at: { robot, servo, isFinished, accept, keep } }: { readonly at: CurrentCalibration }) {
  const { centre } = FAMILIES[robot.board];
  const change = servo.home === centre ? null : homeAtCentre(robot, servo);
  return (
    <>
      <Ask>{sentence(robot, servo, change)}</Ask>
      <div className={styles.actions}>
        {change !== null && (
          <Answer
            tone={isFinished ? 'plain' : 'primary'}
            onPress={() => accept((all) => changeServo(all, servo.servo, change))}
          >
            {words.calibration.trimSet({ centre })}
          </Answer>
        )}
        {!isFinished && (
          <Answer tone={change === null ? 'primary' : 'quiet'} onPress={keep}>
            {change === null ? words.calibration.continue : words.calibration.leaveAsIs}
          </Answer>
        )}
      </div>
    </>
  );
}

function sentence({ board }: Robot, { home }: RobotServo, change: Partial<RobotServo> | null): string {
  const { centre } = FAMILIES[board];
  if (home === centre) return words.calibration.trimNone;
  return change === null
    ? words.calibration.trimFar({ home, centre, reach: TRIM.max })
    : words.calibration.trim({ home, centre, trim: change.trim ?? 0 });
}

export function CalibrationWizard() {
  const at = useCalibration();
  const titleId = useId();
  return (
    <>
      <RobotHead />
      <div className={styles.wizard}>
        <Servos at={at} />
        <section className={styles.work} aria-labelledby={titleId}>
          <h3 id={titleId} className={styles.title}>
            {servoLabel(at.servo)}
          </h3>
          <Steps at={at} />
          <div
            key={`${at.servo.servo} ${at.progress.step}`}
            className={styles.step}
            role="group"
            aria-labelledby={titleId}
          >
            {contentOf(at)}
          </div>
          <p className={styles.problem} role="alert">
            {at.problem}
          </p>
          <div className={styles.foot}>{at.isFinished ? <Finished /> : <SkipServo at={at} />}</div>
        </section>
      </div>
    </>
  );
}

function contentOf(at: CurrentCalibration) {
  const { step } = at.progress;
  switch (step) {
    case 'min':
    case 'max':
    case 'home':
      return (
        <MotionGate servo={at.servo} robot={at.robot}>
          <EndStep at={at} end={step} />
        </MotionGate>
      );
    case 'direction':
      return (
        <MotionGate servo={at.servo} robot={at.robot}>
          <DirectionStep at={at} />
        </MotionGate>
      );
    case 'partner':
      return <PartnerStep at={at} />;
    case 'trim':
      return <TrimStep at={at} />;
  }
}

interface At {
  readonly at: CurrentCalibration;
}

function Servos({ at: { robot, servo, progress, go } }: At) {
  const list = useRef<HTMLOListElement>(null);
  // On a phone the row of servos is wider than the window.
  useEffect(() => {
    list.current?.querySelector('[aria-current]')?.scrollIntoView({ block: 'nearest', inline: 'nearest' });
  }, [servo.servo]);
  return (
    <ol ref={list} className={styles.servos} aria-label={words.calibration.servos}>
      {robot.servos.map((one) => {
        const steps = stepsOf(one);
        const doneCount = steps.filter((step) => isDone(progress, one.servo, step)).length;
        return (
          <li key={one.servo}>
            <button
              type="button"
              className={cx(styles.servo, one === servo && styles.selected)}
              aria-label={words.calibration.servo({
                name: servoLabel(one),
                done: doneCount,
                all: steps.length,
              })}
              aria-current={one === servo ? 'step' : undefined}
              onClick={() => go(one.servo, steps.find((step) => !isDone(progress, one.servo, step)) ?? 'min')}
            >
              <Mark truth={doneCount === steps.length ? 'confirmed' : 'neutral'} />
              <span className={styles.called}>
                {one.name}
                <span className={styles.dim}>{one.group}</span>
              </span>
            </button>
          </li>
        );
      })}
    </ol>
  );
}

function Steps({ at: { servo, progress, go } }: At) {
  const named = (step: CalibrationStep): string => words.calibration.stepNames[step];
  return (
    <ol className={styles.steps} aria-label={words.calibration.steps}>
      {stepsOf(servo).map((step) => {
        const done = isDone(progress, servo.servo, step);
        return (
          <li key={step}>
            <button
              type="button"
              className={cx(styles.stepName, step === progress.step && styles.selected)}
              aria-label={done ? words.calibration.isDone({ step: named(step) }) : named(step)}
              aria-current={step === progress.step ? 'step' : undefined}
              onClick={() => go(servo.servo, step)}
            >
              <Mark truth={done ? 'confirmed' : 'neutral'} />
              {named(step)}
            </button>
          </li>
        );
      })}
    </ol>
  );
}

function SkipServo({ at: { servo, progress, skipServo } }: At) {
  if (isServoDone(progress, servo)) return null;
  return (
    <Answer key={servo.servo} tone="quiet" onPress={skipServo}>
      {words.calibration.keepServo({ name: servoLabel(servo) })}
    </Answer>
  );
}

function Finished() {
  const { view } = useStores();
  return (
    <div className={styles.actions} role="status">
      <p>{words.calibration.finished}</p>
      <Button
        tone="primary"
        onPress={() => view.setState({ robotView: null, tab: 'actions', authoring: 'poses' })}
      >
        {words.calibration.onToPoses}
      </Button>
      <Button onPress={() => view.setState({ robotView: null })}>{words.calibration.done}</Button>
    </div>
  );
}
