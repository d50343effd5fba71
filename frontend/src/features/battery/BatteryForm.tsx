// The battery settings of the current robot: its kind, its thresholds and what a low battery does. Each change is one undo step.

import { fedBy, type Supply } from '#shared/profile/battery.ts';
import { BATTERY_KINDS, BATTERY_MV, BATTERY_POLICIES, type Robot } from '#shared/profile/robot.ts';
import { useBattery, useStores } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { NumberField } from '../../ui/NumberField.tsx';
import { Choice } from '../../ui/Toggle.tsx';
import { robotFlawSentence } from '../../i18n/robotFlaws.ts';
import { words } from '../../i18n/whole.ts';
import styles from './BatteryForm.module.css';

export function BatteryForm({ robot }: { readonly robot: Robot }) {
  const { robots } = useStores();
  const { battery, batteryCare } = robot;
  const said = words.battery;
  return (
    <div className={styles.form}>
      <div className={styles.part}>
        <h3>{words.battery.kindField}</h3>
        <Choice
          label={words.battery.kindField}
          value={battery}
          options={BATTERY_KINDS.map((value) => ({ value, label: said.kind[value] }))}
          onChange={(kind) =>
            robots.edit(
              () => words.battery.steps.kind,
              (one) => fedBy(one, kind),
            )
          }
        />
        <p className={styles.hint}>{words.battery.kindHint[battery]}</p>
      </div>
      <Thresholds robot={robot} />
      <div className={styles.part}>
        <h3>{words.battery.policyField}</h3>
        <Choice
          label={words.battery.policyField}
          value={batteryCare.policy}
          options={BATTERY_POLICIES.map((value) => ({ value, label: said.policy[value] }))}
          onChange={(policy) =>
            robots.edit(
              () => words.battery.steps.policy,
              (one) => ({
                ...one,
                batteryCare: { ...one.batteryCare, policy },
              }),
            )
          }
        />
        <p className={styles.hint}>{words.battery.policyHint[batteryCare.policy]}</p>
      </div>
    </div>
  );
}

type Thresholds = Pick<Supply, 'warnMv' | 'alarmMv'>;

function Thresholds({ robot: { batteryCare } }: { readonly robot: Robot }) {
  const { robots, notices } = useStores();
  const { warnMv, alarmMv } = useBattery((state) => state.supply);
  const set = (thresholds: Thresholds | null) =>
    robots.edit(
      () => words.battery.steps.thresholds,
      (robot) => ({
        ...robot,
        batteryCare: { ...robot.batteryCare, thresholds },
      }),
    );
  const field = { ...BATTERY_MV, step: 50, unit: words.battery.millivolts };
  const refuse = (mv: number, wanted: Thresholds) =>
    notices.refuse(
      mv < BATTERY_MV.min || mv > BATTERY_MV.max
        ? words.battery.outOfRange({ min: BATTERY_MV.min, max: BATTERY_MV.max })
        : robotFlawSentence({ code: 'alarmNotBelow', ...wanted }),
    );
  return (
    <div className={styles.part}>
      <h3>{words.battery.thresholds}</h3>
      <div className={styles.fields}>
        <span className={styles.field}>
          <span aria-hidden="true">{words.battery.warnLabel}</span>
          <NumberField
            {...field}
            label={words.battery.warnField}
            value={warnMv}
            min={alarmMv + 1}
            onRefused={(mv) => refuse(mv, { warnMv: mv, alarmMv })}
            onChange={(mv) => set({ warnMv: mv, alarmMv })}
          />
        </span>
        <span className={styles.field}>
          <span aria-hidden="true">{words.battery.alarmLabel}</span>
          <NumberField
            {...field}
            label={words.battery.alarmField}
            value={alarmMv}
            max={warnMv - 1}
            onRefused={(mv) => refuse(mv, { warnMv, alarmMv: mv })}
            onChange={(mv) => set({ warnMv, alarmMv: mv })}
          />
        </span>
        <Button tone="quiet" isDisabled={batteryCare.thresholds === null} onPress={() => set(null)}>
          {words.battery.usual}
        </Button>
      </div>
    </div>
  );
}
