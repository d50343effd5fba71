// A packet written by hand: says while it is typed what the board would make of it, and sends it only behind a switch that is
// off whenever the log is opened anew. The session has the last word.

import { useId, useState, type SyntheticEvent } from 'react';
import { useDevice, useSnapshot, useStores } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { Toggle } from '../../ui/Toggle.tsx';
import { cx } from '../../ui/cx.ts';
import { words } from '../../i18n/whole.ts';
import { judgeText, obstacleFor, type Judged } from './judgeText.ts';
import styles from './RawSender.module.css';

export function RawSender() {
  const { device } = useStores();
  const family = useDevice((state) => state.family);
  const snapshot = useSnapshot((state) => state);
  const [text, setText] = useState('');
  const [isConsented, setConsented] = useState(false);
  const judged = judgeText(text, family);
  const obstacle = obstacleFor(judged, snapshot);
  const packet = isConsented && obstacle === null ? judged.packet : null;
  return (
    <RawForm
      {...{ text, judged, obstacle, isConsented }}
      maySend={packet !== null}
      onText={setText}
      onConsent={setConsented}
      onSend={() => {
        if (packet !== null) device.sendRaw(packet);
      }}
    />
  );
}

export interface RawFormProps {
  readonly text: string;
  readonly judged: Judged;
  /** Why it cannot go now, whatever it says. */
  readonly obstacle: string | null;
  readonly isConsented: boolean;
  readonly maySend: boolean;
  onText(text: string): void;
  onConsent(isConsented: boolean): void;
  onSend(): void;
}

export function RawForm({ text, judged, obstacle, isConsented, maySend, ...on }: RawFormProps) {
  const explanationId = useId();
  function submit(event: SyntheticEvent): void {
    event.preventDefault();
    on.onSend();
  }
  return (
    <form className={styles.form} aria-label={words.raw.title} onSubmit={submit}>
      <input
        className={styles.field}
        aria-label={words.raw.field}
        aria-describedby={explanationId}
        placeholder={words.raw.example}
        autoComplete="off"
        autoCapitalize="characters"
        spellCheck={false}
        value={text}
        onChange={(event) => on.onText(event.target.value)}
      />
      <p
        id={explanationId}
        className={cx(styles.explanation, judged.isRefused && styles.refused)}
        aria-live="polite"
      >
        {judged.explanation}
        {obstacle !== null && <span className={styles.obstacle}> {obstacle}</span>}
      </p>
      <Toggle label={words.raw.consent} isOn={isConsented} onChange={on.onConsent} />
      <Button type="submit" isDisabled={!maySend}>
        {words.raw.send}
      </Button>
    </form>
  );
}
