// What is selected, or what may be. As high in both cases.

import { select, type ServoView } from './servoView.ts';
import { editServoView, useRobot, useServoView, useStores } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { laterComponent } from '../../ui/later.tsx';
import { words } from '../../i18n/words.ts';
import styles from './SelectionBar.module.css';

const Selected = laterComponent(
  async () => (await import('./Selected.tsx')).Selected,
  'calc(var(--control) + 2px)',
);

/** `hint` is what is said while nothing is selected. */
export function SelectionBar({ hint }: { readonly hint: string }) {
  const selected = useServoView((view) => view.selected);
  return (
    <div className={styles.bar} role="group" aria-label={words.servoPanel.selection}>
      {selected.length === 0 ? <NothingSelected hint={hint} /> : <Selected selected={selected} />}
    </div>
  );
}

function NothingSelected({ hint }: { readonly hint: string }) {
  const stores = useStores();
  const { servos } = useRobot();
  const hidden = useServoView((view) => view.hidden);
  const isSomeHeld = useServoView(({ locked, solo }) => locked.length + solo.length > 0);
  const edit = (change: Partial<ServoView>): void =>
    editServoView(stores, (view) => ({ ...view, ...change }));
  const shown = servos.map(({ servo }) => servo).filter((servo) => !hidden.includes(servo));
  return (
    <div className={styles.line}>
      <Button tone="quiet" onPress={() => editServoView(stores, (view) => select(view, shown))}>
        {words.servoPanel.selectAll}
      </Button>
      {isSomeHeld && (
        <Button tone="quiet" icon="lock" onPress={() => edit({ locked: [], solo: [] })}>
          {words.servoPanel.unlockAll}
        </Button>
      )}
      {hidden.length > 0 && (
        <Button tone="quiet" onPress={() => edit({ hidden: [] })}>
          {words.servoPanel.showHidden({ count: hidden.length })}
        </Button>
      )}
      {!isSomeHeld && hidden.length === 0 && <span className={styles.hint}>{hint}</span>}
    </div>
  );
}
