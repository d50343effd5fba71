// The battery in full: volts on a gauge, what they mean, how old the reading is, and a way to ask again.

import { canReadBattery } from '../stores/batteryPoll.ts';
import { useDevice, useSnapshot, useStores } from '../stores/stores.ts';
import { IconButton } from '../ui/Button.tsx';
import { Chip } from '../ui/Chip.tsx';
import { Panel } from '../ui/Panel.tsx';
import { useNow } from '../ui/useNow.ts';
import { words } from '../words/en.ts';
import { gaugeFraction, levelOf, supplyOf, type Supply } from './levels.ts';
import { lastMv, LEVEL_TRUTH } from './readings.ts';
import styles from './BatteryPanel.module.css';

export function BatteryPanel() {
  const { device } = useStores();
  const battery = useSnapshot((snapshot) => snapshot.battery);
  const canTell = useDevice(canReadBattery);
  const mayAsk = useDevice(
    ({ snapshot }) => snapshot.link.status === 'ready' && !isBusy(snapshot.activity.kind),
  );
  const supply = useDevice((state) => supplyOf(state.family));
  const batteryMv = lastMv(battery);
  return (
    <Panel
      title={words.battery.title}
      tools={
        canTell && (
          <IconButton
            icon="refresh"
            label={words.battery.refresh}
            isDisabled={!mayAsk}
            onPress={() => device.readBattery()}
          />
        )
      }
    >
      <div className={styles.reading}>
        <p className={styles.volts}>
          {batteryMv === null ? words.battery.noVolts : words.battery.volts(batteryMv)}
        </p>
        {canTell && <Gauge batteryMv={batteryMv} supply={supply} />}
        <p className={styles.about}>
          <About batteryMv={batteryMv} supply={supply} />
        </p>
      </div>
    </Panel>
  );
}

const isBusy = (activity: string): boolean => activity === 'downloading' || activity === 'erasing';

function About({ batteryMv, supply }: { readonly batteryMv: number | null; readonly supply: Supply }) {
  const battery = useSnapshot((snapshot) => snapshot.battery);
  const canTell = useDevice(canReadBattery);
  if (!canTell || battery.kind === 'silent') {
    return (
      <>
        <Chip truth="unknown">{words.battery.silent}</Chip>
        <span>{canTell ? words.battery.silentHint : words.battery.absentHint}</span>
      </>
    );
  }
  if (batteryMv === null || battery.kind !== 'read')
    return <Chip truth="unknown">{words.battery.unread}</Chip>;
  const level = levelOf(batteryMv, supply);
  return (
    <>
      <Chip truth={LEVEL_TRUTH[level]}>{words.battery.level[level]}</Chip>
      <Age atMs={battery.atMs} />
    </>
  );
}

function Age({ atMs }: { readonly atMs: number }) {
  const { device } = useStores();
  const nowMs = useNow(device.clock.now, 1000);
  return <span className={styles.age}>{words.battery.age(nowMs - atMs)}</span>;
}

function Gauge({ batteryMv, supply }: { readonly batteryMv: number | null; readonly supply: Supply }) {
  const mark = (mv: number): number => gaugeFraction(mv, supply) * 200;
  return (
    <svg
      className={styles.gauge}
      viewBox="0 0 200 20"
      preserveAspectRatio="none"
      role="meter"
      aria-label={words.battery.gauge}
      aria-valuemin={supply.lowMv / 1000}
      aria-valuemax={supply.highMv / 1000}
      aria-valuenow={(batteryMv ?? supply.lowMv) / 1000}
      aria-valuetext={batteryMv === null ? words.battery.unread : words.battery.volts(batteryMv)}
    >
      <rect className={styles.scale} y="6" width="200" height="8" />
      {batteryMv !== null && <rect className={styles.charge} y="6" width={mark(batteryMv)} height="8" />}
      <rect className={styles.alarm} x={mark(supply.alarmMv)} width="2" height="20" />
      <rect className={styles.warn} x={mark(supply.warnMv)} width="2" height="20" />
    </svg>
  );
}
