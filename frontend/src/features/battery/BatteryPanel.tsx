// The battery in full: volts on a gauge, what is left, what that means, how old the reading is, how it went in this visit.

import { useState } from 'react';
import { isPlain, readingKind, percentOf } from '#shared/profile/battery.ts';
import { canReadBattery } from './batteryPoll.ts';
import { useBattery, useDevice, useRobot, useSnapshot, useStores } from '../stores.ts';
import { IconButton } from '../../ui/Button.tsx';
import { Chip } from '../../ui/Chip.tsx';
import { laterComponent } from '../../ui/later.tsx';
import { Panel } from '../../ui/Panel.tsx';
import { useNow } from '../../ui/useNow.ts';
import { words } from '../../i18n/whole.ts';
import { BatterySettings } from './BatterySettings.tsx';
import { lastMv, levelWord, LEVEL_TRUTH, voltsText } from './readings.ts';
import { VoltMeter } from './VoltMeter.tsx';
import styles from './BatteryPanel.module.css';

const BatteryPlot = laterComponent(async () => (await import('./BatteryPlot.tsx')).BatteryPlot, '112px');

export function BatteryPanel() {
  const { battery: kind } = useRobot();
  const canTell = useDevice(canReadBattery);
  const batteryMv = useSnapshot(({ battery }) => lastMv(battery));
  const supply = useBattery((state) => state.supply);
  const isUnread = useSnapshot(({ battery }) => battery.kind === 'unread');
  const hasVolts = useBattery(({ readings, supply }) => readings.some((one) => isPlain(one, supply)));
  const showsPlot = canTell && (isUnread || hasVolts);
  return (
    <Panel title={words.battery.title} tools={<Tools />}>
      <div className={styles.reading}>
        <div className={styles.figures}>
          <div className={styles.volts} role="group" title={words.battery.measured}>
            {voltsText(batteryMv, supply)}
          </div>
          <p className={styles.kind}>
            <Share />
            {words.battery.kind[kind]}
          </p>
        </div>
        {canTell && <VoltMeter batteryMv={batteryMv} supply={supply} />}
        <div className={styles.about}>
          <About />
        </div>
        {showsPlot && <BatteryPlot />}
      </div>
    </Panel>
  );
}

function Tools() {
  const { device } = useStores();
  const canTell = useDevice(canReadBattery);
  const mayAsk = useDevice(
    ({ snapshot }) => snapshot.link.status === 'ready' && !isBusy(snapshot.activity.kind),
  );
  const [isOpen, setOpen] = useState(false);
  return (
    <>
      {canTell && (
        <IconButton
          icon="refresh"
          label={words.battery.refresh}
          isDisabled={!mayAsk}
          onPress={() => device.readBattery()}
        />
      )}
      <IconButton icon="tune" label={words.battery.settings} onPress={() => setOpen(true)} />
      <BatterySettings isOpen={isOpen} onClose={() => setOpen(false)} />
    </>
  );
}

const isBusy = (activity: string): boolean => activity === 'downloading' || activity === 'erasing';

/** What is left of a pack, once enough readings agree. */
function Share() {
  const { gauge, supply } = useBattery((state) => state);
  const share = gauge.isSettled && gauge.restMv !== null ? percentOf(gauge.restMv, supply) : null;
  if (share === null) return null;
  return (
    <span className={styles.share} role="group" title={words.battery.estimated}>
      {words.battery.percent({ percent: Math.round(share) })}
    </span>
  );
}

function About() {
  const battery = useSnapshot((snapshot) => snapshot.battery);
  const canTell = useDevice(canReadBattery);
  const { gauge, supply } = useBattery((state) => state);
  if (!canTell || battery.kind === 'silent') {
    const hint = canTell ? words.battery.silentHint : words.battery.absentHint;
    return <Unknown word={words.battery.silent} hint={hint} />;
  }
  if (battery.kind !== 'read') return <Chip truth="unknown">{words.battery.unread}</Chip>;
  const kind = readingKind(battery.batteryMv, supply);
  if (kind === 'zero') return <Unknown word={words.battery.zero} hint={words.battery.zeroHint} />;
  if (kind === 'saturated')
    return <Unknown word={words.battery.saturated} hint={words.battery.saturatedHint} />;
  return (
    <>
      {gauge.level === null ? (
        <Chip truth="unknown">{words.battery.moving}</Chip>
      ) : (
        <Chip truth={LEVEL_TRUTH[gauge.level]}>{levelWord(gauge.level, supply)}</Chip>
      )}
      <Age atMs={battery.atMs} />
    </>
  );
}

function Unknown({ word, hint }: { readonly word: string; readonly hint: string }) {
  return (
    <>
      <Chip truth="unknown">{word}</Chip>
      <span>{hint}</span>
    </>
  );
}

function Age({ atMs }: { readonly atMs: number }) {
  const { device } = useStores();
  const nowMs = useNow(device.clock.now, 1000);
  return <span className={styles.age}>{words.numbers.formatAge(nowMs - atMs)}</span>;
}
