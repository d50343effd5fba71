// The robot in three dimensions, to look around it, to press a part and so select its servo, and to lead its limbs. Loaded when requested
// for: nothing else of the page knows three.js.

import {
  type KeyboardEvent,
  type PointerEvent,
  useEffect,
  useDeferredValue,
  useEffectEvent,
  useMemo,
  useRef,
  useState,
} from 'react';
import { timesOf } from '#shared/group/groupTimes.ts';
import { servoOf } from '#shared/profile/robot.ts';
import { words } from '../../../i18n/whole.ts';
import { motionHindrance } from '../../../robot/readiness.ts';
import { Button, IconButton } from '../../../ui/Button.tsx';
import { EmptyState } from '../../../ui/Panel.tsx';
import { Toggle } from '../../../ui/Toggle.tsx';
import { useFollow } from '../../../ui/useEachFrame.ts';
import { select } from '../../servoView.ts';
import {
  editServoView,
  type Stores,
  useCollisions,
  useGroup,
  useKnownFamily,
  useRobot,
  useServoView,
  useSnapshot,
  useStores,
  useView,
} from '../../stores.ts';
import { workedOn } from '../../view.ts';
import { lookOf } from '../Canvas.tsx';
import { motionsInFrame, usePreview } from '../motion.ts';
import { useMotions, useNeighbours } from '../useMotions.ts';
import type { Pose } from '../pose.ts';
import { UnknownNote } from '../UnknownNote.tsx';
import { parseUrdf } from './figure.ts';
import { JointKnob, placeKnob, ElbowButton, LimbHandle, placeHandles, PlaceFields } from './handles.tsx';
import { type LedLimb, limbsOfModel, belowFloorAtMs, pathOf, type PathPoint } from './limbs.ts';
import { createModel, type Model, type Preview } from './model.ts';
import { createStage, type Stage } from './stage.ts';
import { useModel } from './useModel.ts';
import styles from './RobotView.module.css';

const TURN_RADIANS = 0.15;
const ZOOM = 0.85;
/** A pointer that moved farther turned the view. */
const PRESS_PX = 5;

export function RobotView() {
  const stores = useStores();
  const robot = useRobot();
  const { description, state } = useModel(robot);
  const servos = useMemo(() => robot.servos.map(({ servo }) => servo), [robot]);
  const limbs = useMemo(
    () => (description === null ? [] : limbsOfModel(parseUrdf(description), servos)),
    [description, servos],
  );
  const canvas = useRef<HTMLCanvasElement>(null);
  const shown = useRef<Model | null>(null);
  const preview = useRef<Pose | null>(null);
  const handles = useRef(new Map<string, HTMLButtonElement>());
  const knob = useRef<HTMLElement>(null);
  const pressed = useRef<{ readonly x: number; readonly y: number } | null>(null);
  const [hasPlace, setPlace] = useState(false);
  const [isLevel, setLevel] = useState(false);
  const [hasNeighbours, setNeighbours] = useState(false);
  const [isMissing, setMissing] = useState(false);
  const isGroup = useView((view) => workedOn(view) === 'group');
  const isBlocked = useSnapshot((snapshot) => motionHindrance(snapshot) !== null);
  const selected = useServoView((view) => view.selected.at(-1) ?? null);
  const servo = selected === null ? undefined : servoOf(robot, selected);

  const beforeDraw = useEffectEvent(() => {
    const [model, element] = [shown.current, canvas.current];
    if (model === null || element === null) return;
    const shownPose = { pose: preview.current, touching: touchingIn(stores, preview.current) };
    model.draw(motionsInFrame(stores.device), shownPose, lookOf(element));
    placeHandles(stores, model, limbs, handles.current, element);
    if (servo !== undefined && knob.current !== null)
      placeKnob(model, servo, stores.device.motion(servo.servo).target, knob.current, element);
  });

  useEffect(() => {
    if (canvas.current === null || description === null) return undefined;
    const stage = stageIn(canvas.current, () => beforeDraw());
    if (stage === null) {
      setMissing(true);
      return undefined;
    }
    const model = createModel(stage, description, robot);
    shown.current = model;
    return () => {
      shown.current = null;
      model.dispose();
      stage.dispose();
    };
  }, [description, robot]);

  const paths = usePaths(limbs);
  useEffect(() => shown.current?.select(selected), [selected, description, robot]);
  useEffect(() => shown.current?.showPaths(paths), [paths, description, robot]);
  useMotions(servos, () => shown.current?.stage.draw());
  useFollow({
    read: () => (canvas.current === null ? null : lookOf(canvas.current)),
    draw: () => shown.current?.stage.draw(),
  });
  usePreview((pose) => {
    preview.current = pose;
    shown.current?.stage.draw();
  });

  const places = useCollisions((state) => state.places);
  useEffect(() => shown.current?.stage.draw(), [places]);

  useNeighbours(hasNeighbours && isGroup, description, (poses) => shown.current?.showNeighbours(poses));

  function turnKey(event: KeyboardEvent): void {
    const turn = TURNS[event.key];
    if (shown.current === null || turn === undefined) return;
    event.preventDefault();
    turn(shown.current.stage);
  }

  function release({ clientX, clientY, shiftKey }: PointerEvent): void {
    const from = pressed.current;
    pressed.current = null;
    if (from === null || Math.hypot(clientX - from.x, clientY - from.y) > PRESS_PX) return;
    const under = shown.current?.servoAt(clientX, clientY) ?? null;
    if (under === null && shiftKey) return;
    editServoView(stores, (view) => {
      const others = shiftKey ? view.selected.filter((one) => one !== under) : [];
      return select(view, under === null ? [] : [...others, under]);
    });
  }

  if (isMissing)
    return (
      <EmptyState title={words.robot3d.missing} hint={words.robot3d.missingHint} className={styles.view} />
    );
  return (
    <div className={styles.view}>
      <div className={styles.room}>
        <canvas
          ref={canvas}
          className={styles.canvas}
          role="img"
          tabIndex={0}
          aria-label={words.robot3d.figure({ robot: robot.name })}
          onKeyDown={turnKey}
          onPointerDown={({ clientX: x, clientY: y }) => (pressed.current = { x, y })}
          onPointerUp={release}
        />
        {servo !== undefined && !isBlocked && (
          <JointKnob
            servo={servo}
            model={() => shown.current}
            onElement={(element) => (knob.current = element)}
          />
        )}
        {limbs.map((limb) => (
          <LimbHandle
            key={limb.tip}
            {...{ limb, isLevel, isBlocked }}
            model={() => shown.current}
            onElement={(element) => {
              if (element === null) handles.current.delete(limb.tip);
              else handles.current.set(limb.tip, element);
            }}
          />
        ))}
        <div className={styles.looks} role="group" aria-label={words.robot3d.look}>
          <IconButton
            icon="plus"
            label={words.robot3d.zoomIn}
            onPress={() => shown.current?.stage.zoom(ZOOM)}
          />
          <IconButton
            icon="minus"
            label={words.robot3d.zoomOut}
            onPress={() => shown.current?.stage.zoom(1 / ZOOM)}
          />
          {isGroup && (
            <IconButton
              icon="frames"
              label={words.robot3d.neighbours}
              aria-pressed={hasNeighbours}
              onPress={() => setNeighbours(!hasNeighbours)}
            />
          )}
          <IconButton icon="home" label={words.robot3d.home} onPress={() => shown.current?.stage.home()} />
        </div>
      </div>
      <UnknownNote />
      {state === 'missing' && (
        <p className={styles.warning} role="status">
          {words.robot3d.modelMissing({ file: robot.model?.fileName ?? '' })}
        </p>
      )}
      <FloorNote {...{ paths }} />
      {limbs.length === 1 && limbs[0] !== undefined && (
        <div className={styles.foot}>
          <Button
            tone="quiet"
            icon={hasPlace ? 'down' : 'later'}
            aria-expanded={hasPlace}
            onPress={() => setPlace(!hasPlace)}
          >
            {words.robot3d.place}
          </Button>
          {hasPlace && (
            <>
              <PlaceFields limb={limbs[0]} {...{ isLevel, isBlocked }} />
              <Toggle label={words.robot3d.level} isOn={isLevel} onChange={setLevel} />
              <ElbowButton limb={limbs[0]} {...{ isLevel, isBlocked }} />
            </>
          )}
        </div>
      )}
    </div>
  );
}

/** What may touch something in the pose at the playhead; nothing while a blend of poses is shown, or no pose. */
function touchingIn(
  { blend, collisions, document, timeline }: Stores,
  pose: Pose | null,
): Preview['touching'] {
  if (pose === null || blend.store.getState().targets !== null) return new Set();
  const { ends } = timesOf(document.store.getState().present);
  const atMs = Math.max(timeline.getState().playheadMs, ends[0] ?? 0);
  const places = collisions.getState().places.filter(({ fromMs, toMs }) => fromMs <= atMs && atMs <= toMs);
  return new Set(places.flatMap(({ servos }) => servos));
}

/** Of the open group, while it is what is worked on; after an edit when there is time. */
function usePaths(limbs: readonly LedLimb[]): readonly (readonly PathPoint[])[] {
  const robot = useRobot();
  const group = useDeferredValue(useGroup());
  const { unit } = useKnownFamily();
  const isShown = useView((view) => workedOn(view) === 'group');
  return useMemo(
    () =>
      isShown ? limbs.map((limb) => pathOf(limb, robot, group, unit)).filter((path) => path.length > 0) : [],
    [isShown, limbs, robot, group, unit],
  );
}

/** Only where the base stands on the floor: a body on legs lowers itself. */
function FloorNote({ paths }: { readonly paths: readonly (readonly PathPoint[])[] }) {
  const { body, model } = useRobot();
  const atMs =
    body === 'arm' && model === undefined
      ? paths.map(belowFloorAtMs).find((found) => found !== null)
      : undefined;
  if (atMs === undefined) return null;
  return (
    <p className={styles.warning} role="status">
      {words.robot3d.belowFloor({ seconds: words.numbers.formatSeconds(atMs) })}
    </p>
  );
}

/** null: the browser has no WebGL, or no more of it. */
function stageIn(canvas: HTMLCanvasElement, beforeDraw: () => void): Stage | null {
  try {
    return createStage(canvas, beforeDraw);
  } catch {
    return null;
  }
}

const TURNS: Readonly<Record<string, (stage: Stage) => void>> = {
  ArrowLeft: (stage) => stage.turn(-TURN_RADIANS, 0),
  ArrowRight: (stage) => stage.turn(TURN_RADIANS, 0),
  ArrowUp: (stage) => stage.turn(0, TURN_RADIANS),
  ArrowDown: (stage) => stage.turn(0, -TURN_RADIANS),
  '+': (stage) => stage.zoom(ZOOM),
  '-': (stage) => stage.zoom(1 / ZOOM),
  Home: (stage) => stage.home(),
};
