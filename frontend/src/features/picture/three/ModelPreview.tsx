// An imported model with its servos at home, and one joint of it turned by hand to see which one it is. Moves nothing.

import { useEffect, useEffectEvent, useMemo, useRef } from 'react';
import { Box3 } from 'three';
import type { Robot } from '#shared/profile/robot.ts';
import { words } from '../../../i18n/whole.ts';
import { lookOf } from '../Canvas.tsx';
import { createFigure, type Figure, NO_MARKS } from './figure.ts';
import { plainColour } from './model.ts';
import type { ModelFile } from './modelFile.ts';
import { createStage, sizeOf, type Stage } from './stage.ts';
import { describe } from './useModel.ts';
import styles from './RobotView.module.css';

interface ModelPreviewProps {
  readonly robot: Robot;
  readonly file: ModelFile;
  /** The servo that is turned, and how far from home. */
  readonly turned: { readonly servo: number; readonly degrees: number } | null;
}

const ROOM = 1.05;

export function ModelPreview({ robot, file, turned }: ModelPreviewProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const shown = useRef<{ readonly stage: Stage; readonly figure: Figure } | null>(null);
  const description = useMemo(() => describe(file, robot), [file, robot]);

  const beforeDraw = useEffectEvent(() => {
    if (shown.current === null || canvas.current === null) return;
    const look = lookOf(canvas.current);
    const edge = plainColour(look.edge);
    shown.current.figure.pose((servo) => (servo === turned?.servo ? (turned.degrees * Math.PI) / 180 : 0), {
      ...NO_MARKS,
      isSelected: (servo) => servo === turned?.servo,
    });
    shown.current.stage.paint({ line: edge });
    shown.current.figure.paint({
      ...{ body: plainColour(look.raised), edge, servo: edge, reported: edge, unknown: edge, touching: edge },
      selected: plainColour(look.commanded),
    });
  });

  useEffect(() => {
    if (canvas.current === null || description === null) return undefined;
    let stage: Stage;
    try {
      stage = createStage(canvas.current, () => beforeDraw());
    } catch {
      return undefined; // no WebGL: the table says as much
    }
    const figure = createFigure(
      description,
      robot.servos.map(({ servo }) => servo),
      'body',
    );
    const { min } = new Box3().setFromObject(figure.robot);
    if (Number.isFinite(min.z)) figure.robot.position.z = -min.z;
    stage.scene.add(figure.robot);
    const { reachM, heightM } = sizeOf(figure.robot);
    stage.frame(reachM * ROOM, heightM);
    shown.current = { stage, figure };
    return () => {
      shown.current = null;
      figure.dispose();
      stage.dispose();
    };
  }, [description, robot]);
  useEffect(() => shown.current?.stage.draw(), [turned]);

  return (
    <canvas
      ref={canvas}
      className={styles.preview}
      role="img"
      aria-label={words.robotModel.picture({ robot: robot.name })}
    />
  );
}
