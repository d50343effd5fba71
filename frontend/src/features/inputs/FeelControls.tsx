// Speed, dead zone, curve and smoothing of the inputs, with a small plot of the resulting curve. A drag is one undo step.

import { useRef, useState } from 'react';
import type { Feel } from '#shared/profile/mapping.ts';
import { shaped } from '#shared/profile/mappingStep.ts';
import { useMapping, usePad, useStores } from '../stores.ts';
import { useEachFrame } from '../../ui/useEachFrame.ts';
import { words } from '../../i18n/whole.ts';
import styles from './FeelControls.module.css';

interface Control {
  readonly field: keyof Feel;
  readonly min: number;
  readonly max: number;
  readonly step: number;
  /** The unit of the value. */
  readonly unit: 'percent' | 'ms';
}

const CONTROLS: readonly Control[] = [
  { field: 'speedPercent', min: 10, max: 100, step: 5, unit: 'percent' },
  { field: 'deadZonePercent', min: 0, max: 50, step: 1, unit: 'percent' },
  { field: 'curvePercent', min: 0, max: 100, step: 5, unit: 'percent' },
  { field: 'smoothingMs', min: 0, max: 500, step: 10, unit: 'ms' },
];

export function FeelControls() {
  const { mappings } = useStores();
  const { feel: saved } = useMapping();
  const [draft, setDraft] = useState<Feel | null>(null);
  const feel = draft ?? saved;
  function keep(): void {
    if (draft !== null)
      mappings.edit(
        () => words.pad.steps.feel,
        (mapping) => ({ ...mapping, feel: draft }),
      );
    setDraft(null);
  }
  return (
    <fieldset className={styles.feel} aria-label={words.pad.feel}>
      <div className={styles.sliders}>
        {CONTROLS.map((control) => (
          <FeelSlider
            key={control.field}
            control={control}
            value={feel[control.field]}
            onChange={(value) => setDraft({ ...feel, [control.field]: value })}
            onDone={keep}
          />
        ))}
      </div>
      <CurvePlot feel={feel} />
    </fieldset>
  );
}

interface FeelSliderProps {
  readonly control: Control;
  readonly value: number;
  onChange(value: number): void;
  onDone(): void;
}

function FeelSlider({ control: { field, min, max, step, unit }, value, onChange, onDone }: FeelSliderProps) {
  const { formatMs, formatPercent } = words.numbers;
  const text = unit === 'ms' ? formatMs(value) : formatPercent(value / 100);
  return (
    <label className={styles.slider}>
      <span>{words.pad[field]}</span>
      <input
        type="range"
        className={styles.input}
        aria-valuetext={text}
        {...{ min, max, step, value }}
        onChange={(event) => onChange(event.currentTarget.valueAsNumber)}
        onPointerUp={onDone}
        onPointerCancel={onDone}
        onKeyUp={onDone}
        onBlur={onDone}
      />
      <output className={styles.value}>{text}</output>
    </label>
  );
}

/** Half the plot's side. */
const HALF = 40;

/** With a dot for the stick that is pushed farthest. */
function CurvePlot({ feel }: { readonly feel: Feel }) {
  const { pad } = useStores();
  const isPadSeen = usePad((state) => state.pad !== null);
  const dot = useRef<SVGCircleElement>(null);
  useEachFrame(() => {
    const way = farthest(pad.inputs().axes);
    const [x, y] = [way, -shaped(way, feel)].map((share) => (share * HALF).toFixed(1));
    if (dot.current !== null) dot.current.style.translate = `${x}px ${y}px`;
  });
  const points = Array.from({ length: 81 }, (_, at) => {
    const way = (at - HALF) / HALF;
    return `${(at + 1).toFixed(0)},${(HALF + 1 - shaped(way, feel) * HALF).toFixed(1)}`;
  });
  return (
    <svg className={styles.plot} viewBox="0 0 82 82" role="img" aria-label={words.pad.plot}>
      <rect x={1} y={1} width={80} height={80} className={styles.frame} />
      <rect
        x={41 - (feel.deadZonePercent / 100) * HALF}
        y={1}
        width={(feel.deadZonePercent / 50) * HALF}
        height={80}
        className={styles.dead}
      />
      <path d="M1 41h80M41 1v80" className={styles.frame} />
      <polyline points={points.join(' ')} className={styles.curve} />
      {isPadSeen && <circle ref={dot} cx={HALF + 1} cy={HALF + 1} r={4} className={styles.dot} />}
    </svg>
  );
}

const farthest = (axes: readonly number[]): number =>
  axes.reduce((one, other) => (Math.abs(other) > Math.abs(one) ? other : one), 0);
