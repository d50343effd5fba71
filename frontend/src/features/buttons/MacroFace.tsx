// What a button shows: its name, its key, the pose it leads to first, and how far it is.

import type { Macro } from '#shared/profile/macro.ts';
import { PoseThumb } from '../picture/PoseThumb.tsx';
import type { MacroProgress } from './macroRun.ts';
import { poseName } from '../poses/poses.ts';
import { useDevice, usePoses, useStores } from '../stores.ts';
import { stepText } from './macroText.ts';
import { words } from '../../i18n/whole.ts';
import styles from './Macros.module.css';

export interface MacroFaceProps {
  readonly macro: Macro;
  readonly progress: MacroProgress | null;
}

export function MacroFace({ macro, progress }: MacroFaceProps) {
  return (
    <>
      <Picture macro={macro} />
      <span className={styles.text}>
        <span className={styles.name}>{macro.name}</span>
        <span className={styles.about} role={progress === null ? undefined : 'status'}>
          {progress === null ? (
            <About {...macro} />
          ) : (
            words.macros.atWork({ step: progress.stepIndex + 1, count: progress.stepCount })
          )}
        </span>
      </span>
      {macro.key !== null && (
        <kbd className={styles.key} aria-hidden="true">
          {macro.key.toUpperCase()}
        </kbd>
      )}
      {progress !== null && <Steps {...progress} />}
    </>
  );
}

function About({ name, steps }: Macro) {
  const book = usePoses(({ present }) => present);
  const [first] = steps;
  if (first === undefined) return words.macros.empty;
  if (steps.length > 1) return words.macros.stepCount({ count: steps.length });
  const pose = first.kind === 'pose' ? poseName(book, first.pose) : '';
  // Usually the button is called like the pose, and once is enough.
  return stepText(first, pose === name ? '' : pose);
}

function Picture({ macro }: { readonly macro: Macro }) {
  const { poses } = useStores();
  const family = useDevice((state) => state.family);
  // The picture changes with the poses it is taken from.
  usePoses(({ present }) => present);
  const step = macro.steps.find(({ kind }) => kind === 'pose');
  const targets = step?.kind === 'pose' ? poses.targetsOf(step.pose) : null;
  if (targets === null) return null;
  return (
    <span className={styles.picture}>
      <PoseThumb
        pose={new Map(targets.map(({ servo, position }) => [servo, position]))}
        changed={[]}
        family={family}
      />
    </span>
  );
}

function Steps({ stepIndex, stepCount }: MacroProgress) {
  return (
    <span className={styles.steps} aria-hidden="true">
      {Array.from({ length: stepCount }, (_, index) => (
        <span key={index} data-done={index <= stepIndex} />
      ))}
    </span>
  );
}
