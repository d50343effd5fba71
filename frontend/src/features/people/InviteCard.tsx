// The open invitation as QR code, link and eight digits, with the remaining time.

import { useState } from 'react';
import { PERSON_ROLES, type OpenInvitation, type PeopleWishes, type PersonRole } from './people.ts';
import { Button } from '../../ui/Button.tsx';
import { Select } from '../../ui/Select.tsx';
import { useNow } from '../../ui/useEachFrame.ts';
import { words } from '../../i18n/whole.ts';
import { cx } from '../../ui/cx.ts';
import field from '../../ui/Field.module.css';
import styles from './People.module.css';

interface InviteCardProps {
  readonly wishes: PeopleWishes;
  now(): number;
  readonly invitation: OpenInvitation | null;
}

export function InviteCard({ invitation, wishes, now }: InviteCardProps) {
  const [role, setRole] = useState<PersonRole>('viewer');
  const [name, setName] = useState('');
  /** Withdraws the invitation when another role is chosen, so that the code always matches the role above it. */
  const choose = (wanted: PersonRole): void => {
    setRole(wanted);
    if (invitation !== null) wishes.invite(wanted, name.trim());
  };
  const options = PERSON_ROLES.map((value) => ({ value, label: words.people.roles[value] }));
  return (
    <section className={styles.card} aria-label={words.people.invite.title}>
      <h3>{words.people.invite.title}</h3>
      <div className={styles.fields}>
        <Select label={words.people.invite.role} value={role} options={options} onChange={choose} />
        <input
          className={cx(field.field, styles.input)}
          aria-label={words.people.invite.name}
          placeholder={words.people.invite.nameHint}
          value={name}
          maxLength={64}
          autoComplete="off"
          onChange={({ target }) => setName(target.value)}
        />
        <Button
          tone="primary"
          onPress={() => {
            wishes.invite(role, name.trim());
            setName('');
          }}
        >
          {invitation === null ? words.people.invite.create : words.people.invite.again}
        </Button>
      </div>
      {invitation !== null && <Open invitation={invitation} now={now} onEnd={wishes.endInvitation} />}
    </section>
  );
}

interface OpenProps {
  now(): number;
  readonly invitation: OpenInvitation;
  onEnd(): void;
}

function Open({ invitation, now, onEnd }: OpenProps) {
  const leftMs = Math.ceil((invitation.untilMs - useNow(now, 1000)) / 1000) * 1000;
  if (leftMs <= 0) return <p role="status">{words.people.invite.over}</p>;
  const { picture, link, code } = invitation;
  return (
    <div className={styles.open}>
      <img className={styles.qr} src={picture} alt={words.people.invite.qr} />
      <dl className={styles.ways}>
        <dt>{words.people.invite.code}</dt>
        <dd className={styles.code}>
          {code === null ? words.people.invite.noCode : `${code.slice(0, 4)} ${code.slice(4)}`}
        </dd>
        <dt>{words.people.invite.link}</dt>
        <dd className={styles.link}>{link}</dd>
        <dd className={styles.dim}>{words.people.invite.left({ seconds: leftMs / 1000 })}</dd>
        <dd>
          <Button tone="quiet" icon="close" onPress={onEnd}>
            {words.people.invite.end}
          </Button>
        </dd>
      </dl>
    </div>
  );
}
