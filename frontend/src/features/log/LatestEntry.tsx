// The latest packet, or the stop that holds, in one line: its words and its bytes.

import { useMemo } from 'react';
import { useStores } from '../stores.ts';
import { LiveText } from '../../ui/LiveText.tsx';
import { READABLE_MS } from '../../ui/useEachFrame.ts';
import { words } from '../../i18n/whole.ts';
import { arrowOf, bytesText, meaning } from './describe.ts';
import { createStrip } from './strip.ts';
import styles from './LogDrawer.module.css';

export function LatestEntry() {
  const { traffic } = useStores().device;
  const strip = useMemo(() => createStrip(traffic), [traffic]);
  const said = (): string => {
    const now = strip.latest();
    return now === null ? words.log.empty : `${arrowOf(now.entry)} ${meaning(now)}`;
  };
  const bytes = (): string => {
    const now = strip.latest();
    return now === null ? '' : bytesText(now);
  };
  const how = {
    ...{ isFixed: true, eachMs: READABLE_MS },
    isCalm: () => !strip.isStopped(),
    about: () => strip.latest()?.id,
  };
  return (
    <>
      <LiveText className={styles.latest} text={said} {...how} />
      <LiveText className={styles.bytes} text={bytes} {...how} />
    </>
  );
}
