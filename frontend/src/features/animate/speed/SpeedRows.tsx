// How fast the compiled group turns each servo, beside what the servo can do, and about how much current all of them take together: rows below
// the tracks over the same time, shown on request. Changes nothing.

import { memo, type ReactNode, useMemo } from 'react';
import { createStore, type StoreApi, useStore } from 'zustand';
import { type GroupLoad, loadOf, staggered } from '#shared/group/load.ts';
import { type Robot, SUPPLY_MA } from '#shared/profile/robot.ts';
import { RANGE_MS } from '#shared/robot/timings.ts';
import { servoName } from '../../../i18n/sentences.ts';
import { words } from '../../../i18n/whole.ts';
import { Button, IconButton } from '../../../ui/Button.tsx';
import { CheckedNumber } from '../../CheckedNumber.tsx';
import { Mark } from '../../../ui/Chip.tsx';
import { cx } from '../../../ui/cx.ts';
import { Canvas, type Pen } from '../../picture/Canvas.tsx';
import { type Stores, useCompiled, useRobot, useStores } from '../../stores.ts';
import { isLocked } from '../../servoView.ts';
import type { TimeView } from '../timeline/timeline.ts';
import { xOf } from '../timeline/timeScale.ts';
import styles from './SpeedRows.module.css';

interface SpeedState {
  readonly isShown: boolean;
}

const all = new WeakMap<Stores['timeline'], StoreApi<SpeedState>>();

function speedOf({ timeline }: Pick<Stores, 'timeline'>): StoreApi<SpeedState> {
  const made = all.get(timeline) ?? createStore<SpeedState>(() => ({ isShown: false }));
  all.set(timeline, made);
  return made;
}

export function toggleSpeed(stores: Pick<Stores, 'timeline'>): void {
  const store = speedOf(stores);
  store.setState({ isShown: !store.getState().isShown });
}

/** `children`: what is drawn over them, as over the tracks. */
export const SpeedRows = memo(function SpeedRows({ children }: { readonly children: ReactNode }) {
  const isShown = useStore(speedOf(useStores()), (state) => state.isShown);
  return isShown ? <Shown>{children}</Shown> : null;
});

function Shown({ children }: { readonly children: ReactNode }) {
  const stores = useStores();
  const { frames, source } = useCompiled((state) => state.latest);
  const { robot, family, group } = source;
  const load = useMemo(
    () => loadOf(group.unit === family.unit ? frames : [], { robot, family, rangeMs: RANGE_MS }),
    [frames, robot, family, group],
  );
  const rows = load.servos.length + 1;
  const { supplyMa } = useRobot().batteryCare;
  return (
    <section className={styles.area} aria-label={words.speed.title}>
      <header className={styles.top}>
        <h3 className={styles.title}>{words.speed.title}</h3>
        <p className={styles.hint}>{words.speed.hint}</p>
        <SupplyField />
        {group.unit === family.unit && (
          <Button tone="quiet" hint={words.speed.staggerHint} onPress={() => stagger(stores)}>
            {words.speed.stagger}
          </Button>
        )}
        <IconButton icon="close" label={words.speed.close} onPress={() => toggleSpeed(stores)} />
      </header>
      <div className={styles.scroller} tabIndex={0}>
        <div className={styles.rows}>
          <ul className={styles.heads}>
            <li className={cx(styles.head, styles.sum)}>
              <span className={styles.name}>{words.speed.together}</span>
              <span className={styles.figure}>
                {supplyMa !== undefined && load.mostMa > supplyMa && <Mark truth="warning" />}
                {supplyMa === undefined
                  ? words.speed.current({ amps: amps(load.mostMa) })
                  : words.speed.ofSupply({ amps: amps(load.mostMa), supply: amps(supplyMa) })}
              </span>
            </li>
            {load.servos.map(({ servo, fastest, limit }) => (
              <li key={servo} className={styles.head}>
                <span className={styles.name}>{servoName(robot, servo)}</span>
                <span className={styles.figure}>
                  {fastest > limit && <Mark truth="warning" />}
                  {words.speed.degrees({ fastest: Math.round(fastest), limit: Math.round(limit) })}
                </span>
              </li>
            ))}
          </ul>
          <div className={styles.track} style={{ height: `calc(${rows} * var(--row))` }}>
            <Canvas
              className={styles.canvas}
              shown={() => [load, stores.timeline.getState().time, supplyMa] as const}
              paint={paintLoad}
            />
            {children}
          </div>
        </div>
      </div>
    </section>
  );
}

const amps = (milliamperes: number): string => (milliamperes / 1000).toFixed(1);

function SupplyField() {
  const { robots } = useStores();
  const { supplyMa } = useRobot().batteryCare;
  const range = { min: SUPPLY_MA.min / 1000, max: SUPPLY_MA.max / 1000 };
  const set = (amperes: number): void =>
    void robots.edit(
      () => words.speed.steps.supply,
      (robot): Robot => ({
        ...robot,
        batteryCare: { ...robot.batteryCare, supplyMa: Math.round(amperes * 1000) },
      }),
    );
  return (
    <span className={styles.supply} title={words.speed.supplyHint}>
      <span aria-hidden="true">{words.speed.supply}</span>
      <CheckedNumber
        label={words.speed.supplyField}
        value={supplyMa === undefined ? null : supplyMa / 1000}
        placeholder={words.speed.unknown}
        step={0.5}
        decimals={1}
        start={2}
        size="small"
        unit={words.speed.amperes}
        {...range}
        onChange={set}
      />
    </span>
  );
}

/** One step of the history. */
function stagger(stores: Stores): void {
  const { document, compiled, notices } = stores;
  const { robot, family, maxErrorUnits } = compiled.store.getState().latest.source;
  const found = staggered(document.store.getState().present, {
    ...{ robot, family, maxErrorUnits, rangeMs: RANGE_MS },
    isFree: (servo) => !isLocked(stores, servo),
  });
  if (found === null) return notices.show('info', words.speed.noStagger);
  document.edit(
    () => words.speed.steps.stagger,
    () => found.group,
  );
  const { stepMs, beforeMa, afterMa } = found;
  notices.show('info', words.speed.staggered({ ms: stepMs, before: amps(beforeMa), after: amps(afterMa) }));
}

const GAP_PX = 3;
const STRIPE_PX = 4;

/**
 * The sum first, beside what the supply gives where that is known, else beside its peak; then a row for each servo: as high as the share of
 * what it can do, striped where that is more.
 */
function paintLoad(
  { ctx, look, size }: Pen,
  [load, time, supplyMa]: readonly [GroupLoad, TimeView, number | undefined],
): void {
  const { spans, servos, mostMa } = load;
  const rowPx = size.height / (servos.length + 1);
  const most = rowPx - GAP_PX;
  ctx.fillStyle = look.line;
  for (let row = 1; row <= servos.length; row++) ctx.fillRect(0, Math.round(row * rowPx), size.width, 1);
  for (const { fromMs, toMs, speeds, currentMa } of spans) {
    const [left, right] = [Math.max(0, xOf(time, fromMs)), Math.min(size.width, xOf(time, toMs))];
    if (right <= left) continue;
    const bar = (row: number, share: number): readonly [number, number, number, number] => {
      const height = Math.max(1, most * Math.min(1, share));
      return [left, (row + 1) * rowPx - height, right - left, height];
    };
    const draw = (row: number, share: number, colour: string): void => {
      if (share === 0) return;
      ctx.fillStyle = share > 1 ? look.warning : colour;
      const [x, y, width, height] = bar(row, share);
      if (share <= 1) return ctx.fillRect(x, y, width, height);
      for (let at = x; at < x + width; at += 2 * STRIPE_PX)
        ctx.fillRect(at, y, Math.min(STRIPE_PX, x + width - at), height);
    };
    const fullMa = supplyMa ?? mostMa;
    if (fullMa > 0) draw(0, currentMa / fullMa, look.estimated);
    for (const [index, { servo, limit }] of servos.entries())
      draw(index + 1, (speeds.get(servo) ?? 0) / limit, look.commanded);
  }
}
