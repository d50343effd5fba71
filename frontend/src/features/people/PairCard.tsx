// What a device that is not paired sees: one card to type the eight digits into. A reload afterwards opens the page as ever.

import { useState } from 'react';
import type { PeopleError } from './people.ts';
import type { PairWish } from '../../robot/people.generated.ts';
import { words } from '../../i18n/whole.ts';
import { EntryCard, EntryField, NAME_INPUT, nameOr } from './EntryCard.tsx';

export interface PairCardProps {
  readonly problem: PeopleError | null;
  readonly overheard: boolean;
  /** The name of whoever says none. */
  readonly suggested: string;
  onPair(wish: PairWish): void;
}

export function PairCard({ problem, overheard, suggested, onPair }: PairCardProps) {
  const [name, setName] = useState('');
  const [code, setCode] = useState('');
  const digits = code.replaceAll(/\D/g, '');
  return (
    <EntryCard
      text={words.people.pair}
      notes={[words.people.pair.first, ...(overheard ? [words.people.overheard] : [])]}
      problem={problem}
      isReady={digits.length === 8}
      onGoOn={() => onPair({ code: digits, name: nameOr(suggested, name) })}
    >
      <EntryField
        {...NAME_INPUT}
        label={words.people.pair.name}
        value={name}
        placeholder={suggested}
        onChange={setName}
      />
      <EntryField
        isLarge
        label={words.people.pair.code}
        value={code}
        inputMode="numeric"
        autoComplete="one-time-code"
        maxLength={9}
        onChange={setCode}
      />
    </EntryCard>
  );
}
