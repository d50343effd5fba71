// Tokens for scripts and stop-only QR codes: made here, shown once.

import { useState } from 'react';
import type { PeopleWishes, Shown } from './people.ts';
import { Button } from '../../ui/Button.tsx';
import { words } from '../../i18n/whole.ts';
import { cx } from '../../ui/cx.ts';
import field from '../../ui/Field.module.css';
import styles from './People.module.css';

interface ScriptsCardProps {
  readonly wishes: PeopleWishes;
  readonly shown: Shown | null;
}

export function ScriptsCard({ shown, wishes }: ScriptsCardProps) {
  const [name, setName] = useState('');
  const wanted = name.trim();
  return (
    <section className={styles.card} aria-label={words.people.more.title}>
      <h3>{words.people.more.title}</h3>
      <div className={styles.fields}>
        <input
          className={cx(field.field, styles.input)}
          aria-label={words.people.more.name}
          placeholder={words.people.more.name}
          value={name}
          maxLength={64}
          autoComplete="off"
          onChange={({ target }) => setName(target.value)}
        />
        <Button isDisabled={wanted === ''} onPress={() => wishes.makeToken(wanted, 'driver')}>
          {words.people.more.token}
        </Button>
        <Button isDisabled={wanted === ''} onPress={() => wishes.makeStopLink(wanted)}>
          {words.people.more.stopLink}
        </Button>
      </div>
      {shown !== null && <Once shown={shown} onClose={wishes.closeShown} />}
    </section>
  );
}

function Once({ shown, onClose }: { readonly shown: Shown; onClose(): void }) {
  const { more } = words.people;
  const isToken = shown.kind === 'token';
  return (
    <div className={styles.open} role="group" aria-label={isToken ? more.tokenTitle : more.stopTitle}>
      {shown.kind === 'stopLink' && <img className={styles.qr} src={shown.picture} alt={more.qr} />}
      <div className={styles.ways}>
        <strong>{isToken ? more.tokenTitle : more.stopTitle}</strong>
        <p className={styles.dim}>{isToken ? more.tokenText : more.stopText}</p>
        <code className={styles.link}>{shown.kind === 'token' ? shown.token : shown.link}</code>
        <Button tone="quiet" icon="close" onPress={onClose}>
          {more.hide}
        </Button>
      </div>
    </div>
  );
}
