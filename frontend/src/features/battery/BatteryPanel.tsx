// The battery panel: voltage on a gauge, percentage, level, age of the reading, and the plot of this visit.

import { useState } from 'react';
import { readingKind, gaugeFraction, type Supply, isPlain, percentOf } from '#shared/profile/battery.ts';
import { useRobot, useBattery, useDevice, useSnapshot, useStores } from '../stores.ts';
import { Dialog } from '../../ui/Dialog.tsx';
import { laterComponent } from '../../ui/later.tsx';
import { words } from '../../i18n/whole.ts';
import { voltsText, lastMv, levelWord, LEVEL_TRUTH } from './BatteryReadout.tsx';
import { canReadBattery } from './battery.ts';
import { IconButton } from '../../ui/Button.tsx';
import { Chip } from '../../ui/Chip.tsx';
import { Panel } from '../../ui/Panel.tsx';
import { useNow } from '../../ui/useEachFrame.ts';
import styles from './BatteryPanel.module.css';

const BatteryForm = laterComponent(async () => (await import('./BatteryForm.tsx')).BatteryForm, '40vh');

interface BatterySettingsProps {
  readonly isOpen: boolean;
  onClose(): void;
}

function BatterySettings({ isOpen, onClose }: BatterySettingsProps) {
  const robot = useRobot();
  return (
    <Dialog
      title={words.battery.settingsOf({ robot: robot.name })}
      closeLabel={words.close}
      {...{ isOpen, onClose }}
    >
      <BatteryForm robot={robot} />
    </Dialog>
  );
}

const WIDTH = 200;

interface VoltMeterProps {
  readonly batteryMv: number | null;
  readonly supply: Supply;
}

/** The voltage on the range of the supply, with marks at both thresholds. */
function VoltMeter({ batteryMv, supply }: VoltMeterProps) {
  const mark = (mv: number): number => gaugeFraction(mv, supply) * WIDTH;
  const isPlain = batteryMv !== null && readingKind(batteryMv, supply) === 'plain';
  return (
    <svg
      className={styles.meter}
      viewBox={`0 0 ${WIDTH} 20`}
      preserveAspectRatio="none"
      role="meter"
      aria-label={words.battery.gauge}
      aria-valuemin={supply.lowMv / 1000}
      aria-valuemax={supply.highMv / 1000}
      aria-valuenow={(batteryMv ?? supply.lowMv) / 1000}
      aria-valuetext={batteryMv === null ? words.battery.unread : voltsText(batteryMv, supply)}
    >
      <rect className={styles.scale} y="6" width={WIDTH} height="8" />
      {isPlain && <rect className={styles.charge} y="6" width={mark(batteryMv)} height="8" />}
      <rect className={styles.alarm} x={mark(supply.alarmMv)} width="2" height="20" />
      <rect className={styles.warn} x={mark(supply.warnMv)} width="2" height="20" />
    </svg>
  );
}

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

/** The charge of a pack in percent, once enough readings agree. */
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
