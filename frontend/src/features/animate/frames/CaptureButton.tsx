// Captures the pose that the robot was asked for or that its board has said; says why it cannot while none is known.

import { tellsPositions } from '../../../robot/readiness.ts';
import { useDevice, useKnownFamily } from '../../stores.ts';
import { Button, type ButtonProps } from '../../../ui/Button.tsx';
import { words } from '../../../i18n/words.ts';
import styles from './CaptureButton.module.css';

interface CaptureButtonProps extends Required<Pick<ButtonProps, 'hint' | 'onPress'>> {
  readonly label: string;
}

export function CaptureButton({ label, hint, onPress }: CaptureButtonProps) {
  const isKnown = useKnowsPose();
  const unknown = useUnknownText();
  return (
    <>
      <Button tone="primary" icon="plus" hint={hint} isDisabled={!isKnown} onPress={onPress}>
        {label}
      </Button>
      {!isKnown && <p className={styles.hint}>{unknown}</p>}
    </>
  );
}

/** What makes a pose known. */
export const useUnknownText = (): string =>
  tellsPositions(useKnownFamily()) ? words.actions.nothingKnownOrRead : words.actions.nothingKnown;

export const useKnowsPose = (): boolean => useDevice(({ known }) => known.length > 0);
