// The robot on its stage: body where it is by the estimate, outline where it was sent or where a preview has it, and the arc of the
// servo that is selected. Drawn past React, from the motion of the frame. Moves nothing.

import { Box3, type Object3D, Vector3 } from 'three';
import { type Robot, servoOf } from '#shared/profile/robot.ts';
import type { Motions } from '#shared/robot/state.ts';
import type { Look } from '../Canvas.tsx';
import type { Neighbours } from '../useMotions.ts';
import type { Pose } from '../pose.ts';
import { NO_MARKS, createFigure, type Angles, type Description, type Figure } from './figure.ts';
import { radiansOf, createPathLine, type PathLine, type PathPoint } from './limbs.ts';
import { createRing, type Ring } from './ring.ts';
import { sizeOf, type Stage } from './stage.ts';
import { jointName, TIP } from './urdf.ts';

/** In board units: differences that are invisible in the picture. */
const SAME = 6;
const ROOM = 1.12;

export interface Preview {
  /** null: there is none. */
  readonly pose: Pose | null;
  /** Servos whose parts may touch something there; null: the base. */
  readonly touching: ReadonlySet<number | null>;
}

export interface Model {
  readonly stage: Stage;
  /** How far the middle of the base is above the floor. */
  liftM(): number;
  /** The servo that turns what is under a pointer; null: none. */
  servoAt(clientX: number, clientY: number): number | null;
  /** Of the servo that is selected; null: none, or its target is unknown. */
  ring(): Ring | null;
  draw(motion: Motions, preview: Preview, look: Look): void;
  select(servo: number | null): void;
  /** Weak outlines of the frames before and after the playhead. */
  showNeighbours(poses: Neighbours): void;
  /** The ways of its limbs through the open group. */
  showPaths(paths: readonly (readonly PathPoint[])[]): void;
  dispose(): void;
}

export function createModel(stage: Stage, description: Description, robot: Robot): Model {
  const servos = robot.servos.map(({ servo }) => servo);
  const [body, outline] = (['body', 'ghost'] as const).map((look) =>
    createFigure(description, servos, look),
  ) as [Figure, Figure];
  const isImported = robot.model !== undefined;
  const stands = !isImported && (robot.body === 'humanoid' || robot.body === 'hexapod');
  stage.scene.add(body.robot, outline.robot);
  if (stands) stand(body, outline);
  if (isImported) lift(-lowestOf(body.robot), body, outline);
  const { reachM, heightM } = sizeOf(body.robot);
  stage.frame(reachM * ROOM, heightM);
  let selected: number | null = null;
  let ring: Ring | null = null;
  let lines: readonly PathLine[] = [];
  const skins = new Map<keyof Neighbours, Figure>();

  function showNeighbours(poses: Neighbours): void {
    for (const name of ['before', 'after'] as const) {
      const pose = poses[name];
      if (pose === null && !skins.has(name)) continue;
      const skin = skins.get(name) ?? createFigure(description, servos, 'skin');
      skins.set(name, skin);
      stage.scene.add(skin.robot);
      skin.robot.visible = pose !== null;
      skin.robot.position.copy(body.robot.position);
      if (pose !== null) skin.pose(anglesOf(robot, pose));
    }
    stage.draw();
  }

  function showPaths(paths: readonly (readonly PathPoint[])[]): void {
    for (const { line, dispose } of lines) {
      line.removeFromParent();
      dispose();
    }
    lines = paths.map(createPathLine);
    for (const { line } of lines) outline.robot.parent?.add(line);
    stage.draw();
  }

  function select(servo: number | null): void {
    if (servo === selected) return;
    ring?.dispose();
    selected = servo;
    const joint = servo === null ? undefined : body.robot.joints[jointName(servo)];
    ring = joint?.jointType === 'revolute' ? createRing(joint) : null;
    stage.draw();
  }

  return {
    stage,
    select,
    showPaths,
    showNeighbours,
    liftM: () => body.robot.position.z,
    servoAt: (x, y) => body.servoAt(stage.rayAt(x, y)),
    ring: () => ring,
    draw(motion, { pose: preview, touching }, look) {
      const target: Pose = (servo) => motion(servo).target;
      const wanted: Pose = preview === null ? target : (servo) => preview(servo) ?? target(servo);
      body.pose(
        anglesOf(robot, (servo) => motion(servo).estimated),
        {
          ...NO_MARKS,
          isReported: (servo) => motion(servo).reported !== undefined,
          isSelected: (servo) => servo === selected,
        },
      );
      outline.pose(anglesOf(robot, wanted), {
        ...NO_MARKS,
        isTouching: (servo) => touching.has(servo),
      });
      outline.robot.visible = preview !== null || !isThere(robot, motion);
      if (stands) stand(body, outline);
      paint(look);
    },
    dispose() {
      ring?.dispose();
      showPaths([]);
      for (const skin of skins.values()) skin.dispose();
      body.dispose();
      outline.dispose();
    },
  };

  function paint(look: Look): void {
    const [edge, ink, unknown] = [look.edge, look.ink, look.unknown].map(plainColour) as [
      string,
      string,
      string,
    ];
    const [estimated, commanded] = [plainColour(look.estimated), plainColour(look.commanded)];
    const reported = plainColour(look.confirmed);
    const warning = plainColour(look.warning);
    const common = { servo: edge, selected: ink, unknown, touching: warning };
    stage.paint({ line: edge });
    body.paint({ body: plainColour(look.raised), edge: estimated, reported, ...common });
    outline.paint({ body: commanded, edge: commanded, reported: commanded, ...common });
    for (const [name, skin] of skins) {
      const colour = name === 'before' ? estimated : commanded;
      skin.paint({ body: colour, edge: colour, reported: colour, ...common });
    }
    ring?.paint(commanded);
    for (const line of lines) line.paint(commanded, warning);
  }
}

const anglesOf =
  (robot: Robot, position: Pose): Angles =>
  (number) => {
    const servo = servoOf(robot, number);
    const at = position(number);
    return servo === undefined || at === null ? null : radiansOf(servo, at);
  };

const isThere = ({ servos }: Robot, motion: Motions): boolean =>
  servos.every(({ servo }) => {
    const { target, estimated } = motion(servo);
    return target === null || (estimated !== null && Math.abs(target - estimated) < SAME);
  });

/** A body on legs stands on its lowest foot. */
function stand(body: Figure, outline: Figure): void {
  body.robot.position.z = 0;
  body.robot.updateMatrixWorld(true);
  const feet = Object.entries(body.robot.links).filter(([name]) => name.startsWith(`${TIP}leg`));
  const lowest = Math.min(0, ...feet.map(([, foot]) => foot.getWorldPosition(new Vector3()).z));
  lift(-lowest, body, outline);
}

function lift(byM: number, ...figures: readonly Figure[]): void {
  for (const { robot } of figures) robot.position.z = byM;
}

const lowestOf = (robot: Object3D): number => {
  const { min } = new Box3().setFromObject(robot);
  return Number.isFinite(min.z) ? min.z : 0;
};

let pen: CanvasRenderingContext2D | null = null;
const plainColours = new Map<string, string>();

/** Three.js reads neither the system's colours nor mixed ones; a canvas says each as a hexadecimal number. */
export function plainColour(colour: string): string {
  const known = plainColours.get(colour);
  if (known !== undefined) return known;
  pen ??= document.createElement('canvas').getContext('2d');
  if (pen === null) return '#808080';
  pen.fillStyle = colour.trim();
  plainColours.set(colour, pen.fillStyle);
  return pen.fillStyle;
}
