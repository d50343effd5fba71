// The buttons in use: large, for fingers, keys and children. One is at work at a time.

import { useStore } from 'zustand';
import type { Macro } from '#shared/profile/macro.ts';
import { startHindrance } from '../../robot/readiness.ts';
import { useMacros, useSnapshot, useStores } from '../stores.ts';
import { nameAndKey } from './macroText.ts';
import { words } from '../../i18n/whole.ts';
import { MacroFace } from './MacroFace.tsx';
import { useMacroKeys } from './useMacroKeys.ts';
import { useMacroPress } from './useMacroPress.ts';
import styles from './Macros.module.css';

export function MacroGrid() {
  const macros = useMacros(({ present }) => present.macros);
  const press = useMacroPress();
  useMacroKeys((key) => {
    const macro = macros.find((one) => one.key === key);
    if (macro !== undefined) press(macro);
  });
  return (
    <ul className={styles.grid} aria-label={words.macros.list}>
      {macros.map((macro) => (
        <li key={macro.id}>
          <MacroButton macro={macro} onPress={() => press(macro)} />
        </li>
      ))}
    </ul>
  );
}

function MacroButton({ macro, onPress }: { readonly macro: Macro; readonly onPress: () => void }) {
  const { macroRun } = useStores();
  const progress = useStore(macroRun.store);
  const mayStart = useSnapshot((snapshot) => startHindrance(snapshot) === null);
  const isAtWork = progress?.macroId === macro.id;
  const isWaiting = !isAtWork && (progress !== null || !mayStart);
  return (
    <button
      type="button"
      className={styles.button}
      data-colour={macro.colour}
      data-at-work={isAtWork}
      aria-label={nameAndKey(macro)}
      aria-pressed={isAtWork}
      aria-disabled={isWaiting}
      {...(macro.key !== null && { 'aria-keyshortcuts': macro.key.toUpperCase() })}
      onClick={onPress}
    >
      <MacroFace macro={macro} progress={isAtWork ? progress : null} />
    </button>
  );
}
