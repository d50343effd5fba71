// How fast groups are played (X3): a percentage for each, lost at power-off. Knows no frame and no servo.

export interface Speeds {
  /** `group` 255 means all. A speed of 0 is not documented and changes nothing. */
  readonly set: (group: number, percent: number) => void;
  /** What becomes of a frame's time. */
  readonly played: (group: number, durationMs: number) => number;
}

const ALL_GROUPS = 255;
const GROUP_COUNT = 256;
const USUAL_PERCENT = 100;

export function createSpeeds(): Speeds {
  const percents = new Array<number>(GROUP_COUNT).fill(USUAL_PERCENT);
  return {
    set(group, percent) {
      if (percent === 0) return;
      if (group === ALL_GROUPS) percents.fill(percent);
      else percents[group] = percent;
    },
    played: (group, durationMs) =>
      Math.round((durationMs * USUAL_PERCENT) / (percents[group] ?? USUAL_PERCENT)),
  };
}
