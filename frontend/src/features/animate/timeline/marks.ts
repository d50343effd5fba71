// The marks of the ruler: as fine as fits, at round times. Pure.

export interface Mark {
  readonly atMs: number;
  /** It has its time beside it. */
  readonly isMain: boolean;
}

/** Round times, and how many parts each is divided into. */
const STEPS = [
  ...([
    [1, 1],
    [2, 2],
    [5, 5],
    [10, 2],
    [20, 2],
    [50, 5],
  ] as const),
  ...([
    [100, 5],
    [200, 4],
    [500, 5],
    [1000, 5],
    [2000, 4],
    [5000, 5],
  ] as const),
  ...([
    [10_000, 5],
    [15_000, 3],
    [30_000, 3],
    [60_000, 6],
    [120_000, 4],
  ] as const),
  ...([
    [300_000, 5],
    [600_000, 5],
    [1_800_000, 6],
    [3_600_000, 6],
  ] as const),
] as const;
/** Two of the widest labels beside each other. */
const LABEL_PX = 72;

/** Milliseconds between labels, and in how many parts they are divided. */
export function markStep(msPerPx: number): readonly [stepMs: number, parts: number] {
  return STEPS.find(([stepMs]) => stepMs >= LABEL_PX * msPerPx) ?? [3_600_000, 6];
}

export function marksWithin({ fromMs, toMs }: { fromMs: number; toMs: number }, msPerPx: number): Mark[] {
  const [stepMs, parts] = markStep(msPerPx);
  const first = Math.max(0, Math.ceil((fromMs * parts) / stepMs));
  const last = Math.floor((toMs * parts) / stepMs);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, index) => ({
    atMs: ((first + index) * stepMs) / parts,
    isMain: (first + index) % parts === 0,
  }));
}
