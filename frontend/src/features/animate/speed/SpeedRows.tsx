// How fast the compiled group turns each servo, beside what the servo can do, and about how much current all of them take together: rows below
// the tracks over the same time, shown on request. Changes nothing.

import { memo, type ReactNode, useMemo } from 'react';
import { createStore, type StoreApi, useStore } from 'zustand';
import { type GroupLoad, loadOf } from '#shared/group/load.ts';
import { RANGE_MS } from '#shared/robot/timings.ts';
import { servoName } from '../../../i18n/sentences.ts';
import { words } from '../../../i18n/whole.ts';
import { IconButton } from '../../../ui/Button.tsx';
import { Mark } from '../../../ui/Chip.tsx';
import { cx } from '../../../ui/cx.ts';
import { Canvas, type Pen } from '../../picture/Canvas.tsx';
import { type Stores, useCompiled, useStores } from '../../stores.ts';
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
  return (
    <section className={styles.area} aria-label={words.speed.title}>
      <header className={styles.top}>
        <h3 className={styles.title}>{words.speed.title}</h3>
        <p className={styles.hint}>{words.speed.hint}</p>
        <IconButton icon="close" label={words.speed.close} onPress={() => toggleSpeed(stores)} />
      </header>
      <div className={styles.scroller} tabIndex={0}>
        <div className={styles.rows}>
          <ul className={styles.heads}>
            <li className={cx(styles.head, styles.sum)}>
              <span className={styles.name}>{words.speed.together}</span>
              <span className={styles.figure}>{words.speed.current({ amps: amps(load.mostMa) })}</span>
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
              shown={() => [load, stores.timeline.getState().time] as const}
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

const GAP_PX = 3;
const STRIPE_PX = 4;

/** The sum first, then a row for each servo: as high as the share of what it can do, striped where that is more. */
function paintLoad({ ctx, look, size }: Pen, [load, time]: readonly [GroupLoad, TimeView]): void {
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
    ctx.fillStyle = look.estimated;
    if (mostMa > 0) ctx.fillRect(...bar(0, currentMa / mostMa));
    for (const [index, { servo, limit }] of servos.entries()) {
      const share = (speeds.get(servo) ?? 0) / limit;
      if (share === 0) continue;
      ctx.fillStyle = share > 1 ? look.warning : look.commanded;
      const [x, y, width, height] = bar(index + 1, share);
      if (share <= 1) ctx.fillRect(x, y, width, height);
      else
        for (let at = x; at < x + width; at += 2 * STRIPE_PX)
          ctx.fillRect(at, y, Math.min(STRIPE_PX, x + width - at), height);
    }
  }
}
