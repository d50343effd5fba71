// A group as lines over time, one for each servo: a wave looks like a wave. A picture to recognise it by, without a scale.

import { filled } from '#shared/files/fit.ts';
import { UNIT_RANGE } from '#shared/files/reading.ts';
import { totalDurationMs, type ActionGroup } from '#shared/group/group.ts';
import styles from './GroupPlot.module.css';

const WIDTH = 100;
const HEIGHT = 40;
/** Beyond that a small picture shows no more. */
const SHOWN_FRAMES = 300;
const SHOWN_SERVOS = 32;

export function GroupPlot({ group }: { readonly group: ActionGroup }) {
  return (
    <svg
      className={styles.plot}
      viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
      preserveAspectRatio="none"
      aria-hidden="true"
    >
      {linesOf(group).map((points) => (
        <polyline key={points} points={points} className={styles.line} />
      ))}
    </svg>
  );
}

function linesOf(group: ActionGroup): readonly string[] {
  const { frames } = filled({ ...group, frames: group.frames.slice(0, SHOWN_FRAMES) });
  const lengthMs = Math.max(1, totalDurationMs(frames.slice(1)));
  const { min, max } = UNIT_RANGE[group.unit];
  const lines = new Map<number, string[]>();
  let atMs = 0;
  frames.forEach(({ durationMs, targets }, index) => {
    if (index > 0) atMs += durationMs;
    for (const { servo, position } of targets) {
      const share = Math.min(1, Math.max(0, (position - min) / (max - min)));
      const point = `${((atMs / lengthMs) * WIDTH).toFixed(1)},${((1 - share) * HEIGHT).toFixed(1)}`;
      const line = lines.get(servo);
      if (line === undefined) lines.set(servo, [point]);
      else line.push(point);
    }
  });
  return [...new Set([...lines.values()].slice(0, SHOWN_SERVOS).map((points) => points.join(' ')))];
}
