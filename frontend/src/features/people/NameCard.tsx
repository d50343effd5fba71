// What a link's guest sees first: what the others shall call them, filled in, so that one press goes on.

import { useState } from 'react';
import type { PeopleError } from './people.ts';
import { words } from '../../i18n/whole.ts';
import { EntryCard, EntryField, NAME_INPUT, nameOr } from './EntryCard.tsx';

export interface NameCardProps {
  readonly suggested: string;
  readonly problem: PeopleError | null;
  onName(name: string): void;
}

export function NameCard({ suggested, problem, onName }: NameCardProps) {
  const [name, setName] = useState(suggested);
  return (
    <EntryCard text={words.people.named} problem={problem} onGoOn={() => onName(nameOr(suggested, name))}>
      <EntryField
        {...NAME_INPUT}
        label={words.people.pair.name}
        value={name}
        autoFocus
        onFocus={({ target }) => target.select()}
        onChange={setName}
      />
    </EntryCard>
  );
}
