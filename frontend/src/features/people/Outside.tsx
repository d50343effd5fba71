// The page of whoever does not see the dashboard: a stranger's card, the one button of a stop-only link, or a guest's name.

import { useState, type ReactNode } from 'react';
import { I18nProvider } from 'react-aria-components/I18nProvider';
import { PeopleError } from './people.ts';
import type { PairWish } from '../../robot/people.generated.ts';
import { useSpokenLocale } from '../../ui/useSpokenLocale.ts';
import { NameCard } from './NameCard.tsx';
import { PairCard } from './PairCard.tsx';
import { StopPage } from './StopPage.tsx';
import styles from './Outside.module.css';

export interface OutsideProps {
  readonly mayStop: boolean;
  readonly overheard: boolean;
  readonly suggested: string;
  readonly problem: PeopleError | null;
  /** Comes in: the page begins anew. Rejects with a PeopleError. */
  pair(wish: PairWish): Promise<void>;
  stop(): Promise<void>;
}

export function Outside({ mayStop, overheard, suggested, problem, pair, stop }: OutsideProps) {
  const [failed, setFailed] = useState(problem);
  return (
    <Alone>
      {mayStop ? (
        <StopPage stop={() => stop().then(() => 'sent' as const, toProblem)} />
      ) : (
        <PairCard
          problem={failed}
          overheard={overheard}
          suggested={suggested}
          onPair={(wish) => void pair(wish).catch((error: unknown) => setFailed(toProblem(error)))}
        />
      )}
    </Alone>
  );
}

interface GuestProps {
  readonly suggested: string;
  /** Takes the name over and opens the dashboard. Rejects with a PeopleError. */
  enter(name: string): Promise<void>;
}

/** Somebody whom a link has let in. */
export function Guest({ suggested, enter }: GuestProps) {
  const [problem, setProblem] = useState<PeopleError | null>(null);
  return (
    <Alone>
      <NameCard
        suggested={suggested}
        problem={problem}
        onName={(name) => void enter(name).catch((error: unknown) => setProblem(toProblem(error)))}
      />
    </Alone>
  );
}

function Alone({ children }: { readonly children: ReactNode }) {
  const locale = useSpokenLocale();
  return (
    <I18nProvider locale={locale}>
      <main className={styles.outside}>{children}</main>
    </I18nProvider>
  );
}

function toProblem(error: unknown): PeopleError {
  if (error instanceof PeopleError) return error;
  throw error;
}
