// The page of whoever may not see the dashboard: a stranger's card, or the one button of a stop-only link.

import { useState } from 'react';
import { I18nProvider } from 'react-aria-components/I18nProvider';
import { PeopleError } from '../stores/people.ts';
import type { PairWish } from '../stores/people.generated.ts';
import { useSpokenLocale } from '../ui/useSpokenLocale.ts';
import { PairCard } from './PairCard.tsx';
import { StopPage } from './StopPage.tsx';
import styles from './Outside.module.css';

export interface OutsideProps {
  readonly mayStop: boolean;
  readonly overheard: boolean;
  readonly problem: PeopleError | null;
  /** Comes in: the page begins anew. Rejects with a PeopleError. */
  pair(wish: PairWish): Promise<void>;
  stop(): Promise<void>;
}

export function Outside({ mayStop, overheard, problem, pair, stop }: OutsideProps) {
  const locale = useSpokenLocale();
  const [failed, setFailed] = useState(problem);
  return (
    <I18nProvider locale={locale}>
      <main className={styles.outside}>
        {mayStop ? (
          <StopPage stop={() => stop().then(() => 'sent' as const, toProblem)} />
        ) : (
          <PairCard
            problem={failed}
            overheard={overheard}
            onPair={(wish) => void pair(wish).catch((error: unknown) => setFailed(toProblem(error)))}
          />
        )}
      </main>
    </I18nProvider>
  );
}

function toProblem(error: unknown): PeopleError {
  if (error instanceof PeopleError) return error;
  throw error;
}
