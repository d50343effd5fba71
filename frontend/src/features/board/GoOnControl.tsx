// Whether the next run may go on without this page, and how long at most. Only where others can see and stop it: at the
// gateway.

import { useSnapshot, useStores, useView } from '../stores.ts';
import { NumberField } from '../../ui/NumberField.tsx';
import { Toggle } from '../../ui/Toggle.tsx';
import { words } from '../../i18n/whole.ts';
import field from '../../ui/Field.module.css';
import styles from './BoardPanel.module.css';

const LONGEST_MINUTES = 60;

export function GoOnControl() {
  const { view } = useStores();
  const isShared = useSnapshot((snapshot) => snapshot.lease !== null);
  const isOn = useView((state) => state.goesOn);
  if (!isShared) return null;
  return (
    <div className={styles.row}>
      <MinutesField isDisabled={!isOn} />
      <div className={styles.actions}>
        <Toggle label={words.board.goOn} isOn={isOn} onChange={(goesOn) => view.setState({ goesOn })} />
        <p className={styles.hint}>{isOn ? words.board.goOnHint : ''}</p>
      </div>
    </div>
  );
}

function MinutesField({ isDisabled }: { readonly isDisabled: boolean }) {
  const { view, notices } = useStores();
  const minutes = useView((state) => state.goOnMinutes);
  return (
    <div className={field.named}>
      <span className={styles.label} aria-hidden="true">
        {words.board.goOnAtMost}
      </span>
      <NumberField
        label={words.board.goOnMinutes}
        value={minutes}
        min={1}
        max={LONGEST_MINUTES}
        unit={words.board.goOnUnit}
        isDisabled={isDisabled}
        onChange={(goOnMinutes) => view.setState({ goOnMinutes })}
        onRefused={(value) =>
          notices.refuse(
            words.refused({ name: words.board.goOnMinutes, value, min: 1, max: LONGEST_MINUTES }),
          )
        }
      />
    </div>
  );
}
