// The robot as the picture of the workspace Drive: as a model, a drawing, or with its servos at their places; and the legend of the marks
// of a position.

import type { ReactNode } from 'react';
import type { BodyKind } from '#shared/profile/robot.ts';
import { words } from '../../i18n/words.ts';
import { laterComponent } from '../../ui/later.tsx';
import { Panel } from '../../ui/Panel.tsx';
import { Choice } from '../../ui/Toggle.tsx';
import { Body, RobotView } from '../picture/Body.tsx';
import { useRobot, useStores, useView, useIsGuessing, useKnownFamily } from '../stores.ts';
import type { ServoLayout, ViewState } from '../view.ts';
import styles from './RobotPanel.module.css';
import { tellsPositions } from '../../robot/readiness.ts';
import { Chip } from '../../ui/Chip.tsx';
import legend from './Legend.module.css';

export const BodyMap = laterComponent(async () => (await import('../picture/BodyMap.tsx')).BodyMap, '100%');

type Picture = Exclude<ViewState['picture'], 'auto'>;

const PICTURES = ['model', 'drawing', 'body', 'camera'] as const;

/** A body that is not described has no model. */
const picturesOf = (body: BodyKind): readonly Picture[] =>
  PICTURES.filter((picture) => picture !== 'model' || body !== 'plain');

const SOFTWARE = /swiftshader|llvmpipe|software|basic render/i;
let isFast: boolean | undefined;

/** Whether the machine draws three dimensions by its graphics processor. */
function drawsFast(): boolean {
  isFast ??= isByHardware(document.createElement('canvas').getContext('webgl2'));
  return isFast;
}

function isByHardware(gl: WebGL2RenderingContext | null): boolean {
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  const name: unknown = gl?.getParameter(info?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER);
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return typeof name === 'string' && !SOFTWARE.test(name);
}

function usePicture(): Picture {
  const { body } = useRobot();
  const chosen = useView(({ picture }) => picture);
  const wanted = chosen === 'auto' ? (drawsFast() ? 'model' : 'drawing') : chosen;
  return picturesOf(body).includes(wanted) ? wanted : 'drawing';
}

/** Large and not always wanted. */
export const CameraView = laterComponent(
  async () => (await import('../camera/CameraView.tsx')).CameraView,
  '100%',
  'onDemand',
);

const SHOWN = { drawing: Body, body: BodyMap, model: RobotView, camera: CameraView };

interface RobotPanelProps {
  /** Above the timeline: without a legend, so that the picture has the room. */
  readonly isPreview?: boolean;
  /** At its foot, beside the legend. */
  readonly children?: ReactNode;
}

export function RobotPanel({ isPreview = false, children }: RobotPanelProps) {
  const { view } = useStores();
  const robot = useRobot();
  const picture = usePicture();
  const Shown = SHOWN[picture];
  return (
    <Panel
      title={robot.name === '' ? words.workspace.robot : robot.name}
      className={styles.panel}
      tools={
        <Choice
          label={words.workspace.picture}
          value={picture}
          options={picturesOf(robot.body).map((value) => ({ value, label: labelOf(value) }))}
          onChange={(chosen) => view.setState({ picture: chosen })}
        />
      }
    >
      <div className={styles.picture}>
        <Shown />
      </div>
      {!isPreview && (
        <div className={styles.foot}>
          {children}
          {picture !== 'camera' && <Legend />}
        </div>
      )}
    </Panel>
  );
}

export const labelOf = (picture: Picture | ServoLayout): string =>
  picture === 'drawing' || picture === 'camera'
    ? words.workspace[picture]
    : words.servoPanel.layouts[picture];

const COMPUTED = ['commanded', 'estimated', 'unknown'] as const;
const ALL = ['commanded', 'estimated', 'confirmed', 'unknown'] as const;

export function Legend() {
  const family = useKnownFamily();
  const isGuessing = useIsGuessing();
  return (
    <ul className={legend.legend} aria-label={words.truth.legend}>
      {(tellsPositions(family) ? ALL : COMPUTED).map((truth) => (
        <li key={truth}>
          <Chip truth={truth}>{words.truth[truth]}</Chip>
        </li>
      ))}
      {isGuessing && (
        <li>
          <Chip truth="guessed">{words.firstMoves.guess}</Chip>
        </li>
      )}
    </ul>
  );
}

export function UnitChoice() {
  const { view } = useStores();
  const family = useKnownFamily();
  const positionsIn = useView((state) => state.positionsIn);
  return (
    <Choice
      label={words.servoPanel.positionsIn}
      value={positionsIn}
      options={[
        { value: 'board', label: words.units[family.unit] },
        { value: 'degrees', label: words.servoPanel.degrees },
      ]}
      onChange={(wanted) => view.setState({ positionsIn: wanted })}
    />
  );
}
