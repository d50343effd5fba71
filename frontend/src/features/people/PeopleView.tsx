// The people and devices of a gateway with their roles, tokens and stop-only links, and the open invitation as QR code, link and eight digits.
// Plain values and callbacks.

import { useState } from 'react';
import type { Candidate } from '#shared/robot/lease.ts';
import { words } from '../../i18n/whole.ts';
import type { Me, Person } from '#shared/client/http.generated.ts';
import { NameField } from '../../ui/NameField.tsx';
import {
  type PeopleWishes,
  type Shown,
  PERSON_ROLES,
  VALIDITIES,
  type Validity,
  type PeopleState,
  type PersonRole,
  type OpenInvitation,
} from './people.ts';
import { Button } from '../../ui/Button.tsx';
import { cx } from '../../ui/cx.ts';
import { Chip } from '../../ui/Chip.tsx';
import { Confirm } from '../../ui/Confirm.tsx';
import { Select } from '../../ui/Select.tsx';
import styles from './People.module.css';
import field from '../../ui/Field.module.css';
import { useNow } from '../../ui/useEachFrame.ts';

/** What the page's address means: who can read the traffic, and which features the browser withholds there. */
export function AddressNotes({ overheard }: { readonly overheard: boolean }) {
  return (
    <>
      {overheard && <p className={styles.dim}>{words.people.overheard}</p>}
      {!window.isSecureContext && <p className={styles.dim}>{words.people.insecure}</p>}
    </>
  );
}

interface OwnViewProps {
  readonly me: Me | null;
  onRename(name: string): void;
}

/** For people who are not owners: their name, which they can change, and their role. */
export function OwnView({ me, onRename }: OwnViewProps) {
  if (!me?.you) return null;
  const { name, role } = me.you;
  return (
    <div className={styles.people}>
      <NameField isFramed label={words.people.own.title} name={name} onRename={onRename} />
      <p>{words.people.own.about}</p>
      {role !== 'stopper' && <p>{words.people.roles[role]}</p>}
      <AddressNotes overheard={me.overheard} />
    </div>
  );
}

const VALIDITY_NAMES = Object.keys(VALIDITIES) as readonly Validity[];

/** Tokens for scripts and stop-only QR codes. Each is shown only once. */
interface ScriptsCardProps {
  readonly wishes: PeopleWishes;
  readonly shown: Shown | null;
}

function ScriptsCard({ shown, wishes }: ScriptsCardProps) {
  const [name, setName] = useState('');
  const [validity, setValidity] = useState<Validity>('month');
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
        <Select<Validity>
          label={words.people.more.validity}
          value={validity}
          options={VALIDITY_NAMES.map((value) => ({ value, label: words.people.more.validities[value] }))}
          onChange={setValidity}
        />
        <Button isDisabled={wanted === ''} onPress={() => wishes.makeToken(wanted, 'driver', validity)}>
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

interface PeopleViewProps {
  readonly state: PeopleState;
  readonly wishes: PeopleWishes;
  /** The people who can get the robot now. */
  readonly candidates: readonly Candidate[];
  onHandOver(person: string): void;
  now(): number;
}

export function PeopleView({ state, wishes, candidates, onHandOver, now }: PeopleViewProps) {
  return (
    <div className={styles.people}>
      <InviteCard invitation={state.invitation} wishes={wishes} now={now} />
      <section className={styles.card} aria-label={words.people.list}>
        <h3>{words.people.list}</h3>
        <ul className={styles.list}>
          {state.people.map((person) => (
            <PersonRow
              key={person.id}
              person={person}
              isYou={person.id === state.me?.you?.id}
              wishes={wishes}
              onHandOver={candidates.some(({ id }) => id === person.id) ? onHandOver : null}
            />
          ))}
        </ul>
      </section>
      <ScriptsCard shown={state.shown} wishes={wishes} />
      <AddressNotes overheard={state.me?.overheard === true} />
    </div>
  );
}

interface PersonProps {
  readonly wishes: PeopleWishes;
  readonly person: Person;
}

interface PersonRowProps extends PersonProps {
  readonly isYou: boolean;
  /** null if they cannot get the robot now. */
  readonly onHandOver: ((person: string) => void) | null;
}

function PersonRow({ person, isYou, wishes, onHandOver }: PersonRowProps) {
  const { id, kind, name, role, expiresInMs } = person;
  return (
    <li className={styles.person}>
      <div className={styles.who}>
        <NameField
          isFramed
          label={words.people.rename({ name })}
          name={name}
          onRename={(wanted) => wishes.change(id, { name: wanted })}
        />
        <span className={styles.dim}>{isYou ? words.people.you : words.people.kinds[kind]}</span>
        {expiresInMs !== null && (
          <span className={expiresInMs > 0 ? styles.dim : styles.expired}>
            {expiresInMs > 0
              ? words.people.expires({ when: words.dates.formatLongWait(expiresInMs) })
              : words.people.expired}
          </span>
        )}
      </div>
      {role === 'stopper' ? (
        <span className={styles.role}>{words.people.roleNames.stopper}</span>
      ) : (
        <RoleSelect
          label={words.people.roleOf({ name })}
          role={role}
          onChange={(wanted) => wishes.change(id, { role: wanted })}
        />
      )}
      <div className={styles.presence}>
        <Presence person={person} />
        {onHandOver !== null && (
          <Button
            tone="quiet"
            aria-label={words.people.handOverTo({ name })}
            hint={words.people.handOverHint}
            onPress={() => onHandOver(id)}
          >
            {words.people.handOver}
          </Button>
        )}
      </div>
      <RevokeControl person={person} wishes={wishes} />
    </li>
  );
}

/** Revoking a device stops its unattended run, unless the owner chooses otherwise here. */
function RevokeControl({ person: { id, name, unattendedSlot }, wishes }: PersonProps) {
  const runs = unattendedSlot !== null;
  return (
    <Confirm
      tone="quiet"
      icon="trash"
      label={words.people.revoke}
      title={words.people.revokeOf({ name })}
      text={runs ? words.people.revokeTextOfRun({ slot: unattendedSlot }) : words.people.revokeText}
      keepLabel={words.people.keep}
      otherwise={
        runs ? { label: words.people.revokeOnly, onConfirm: () => wishes.revoke(id, true) } : undefined
      }
      confirmLabel={runs ? words.people.revokeAndStop : words.people.revoke}
      closeLabel={words.close}
      onConfirm={() => wishes.revoke(id, false)}
    />
  );
}

function Presence({ person: { kind, here, drives, lastSeenMs } }: { readonly person: Person }) {
  if (drives) return <Chip truth="commanded">{words.people.drives}</Chip>;
  if (here) return <Chip truth="confirmed">{words.people.here}</Chip>;
  return <span className={styles.dim}>{lastSeenText(kind, lastSeenMs)}</span>;
}

/** A script that runs each minute says more by an age than by a moment. */
function lastSeenText(kind: Person['kind'], atMs: number | null): string {
  if (atMs === null) return words.people.never;
  return kind === 'token'
    ? words.people.used({ when: words.dates.formatLongAge(Date.now() - atMs) })
    : words.people.seen({ when: words.dates.formatMoment(atMs) });
}

interface RoleSelectProps {
  readonly label: string;
  readonly role: PersonRole;
  onChange(role: PersonRole): void;
}

function RoleSelect({ label, role, onChange }: RoleSelectProps) {
  const options = PERSON_ROLES.map((value) => ({ value, label: words.people.roleNames[value] }));
  return <Select label={label} value={role} options={options} onChange={onChange} />;
}

interface InviteCardProps {
  readonly wishes: PeopleWishes;
  now(): number;
  readonly invitation: OpenInvitation | null;
}

function InviteCard({ invitation, wishes, now }: InviteCardProps) {
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
