// Who somebody is here who lets nobody in: their name, which is theirs to change, and what they may do.

import type { Me } from '../../robot/people.generated.ts';
import { NameField } from '../../ui/NameField.tsx';
import { words } from '../../i18n/whole.ts';
import { AddressNotes } from './AddressNotes.tsx';
import styles from './People.module.css';

interface OwnViewProps {
  readonly me: Me | null;
  onRename(name: string): void;
}

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
