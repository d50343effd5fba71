// What a board answered when it was asked who it is, and what that means.

import type { Family } from '#shared/codec/families.ts';
import type { ServoOffset } from '#shared/codec/reports.ts';
import type { Evidence } from '#shared/robot/identity.ts';
import { words } from '../../../i18n/whole.ts';

export function answerText(evidence: Evidence): string {
  const { answers } = words.identity;
  switch (evidence.kind) {
    case 'silent':
      return silentText(evidence.question);
    case 'echoed':
      return answers.echoed;
    case 'noise':
      return answers.noise({ count: evidence.byteCount });
    case 'answered':
      return reportText(evidence.report);
  }
}

function silentText(question: Extract<Evidence, { kind: 'silent' }>['question']): string {
  const { noBattery, noVersion, noPositions } = words.identity.answers;
  const texts: Readonly<Record<string, string>> = {
    readBattery: noBattery,
    readVersion: noVersion,
    readPositions: noPositions,
  };
  return texts[question] ?? '';
}

function reportText(report: Extract<Evidence, { kind: 'answered' }>['report']): string {
  const { answers } = words.identity;
  switch (report.kind) {
    case 'battery':
      return answers.battery({ mv: report.batteryMv });
    case 'version':
      return answers.version(report);
    case 'positions': {
      const positions = report.positions.map(({ position }) => words.numbers.formatWhole(position));
      return answers.positions({ positions: positions.join(words.comma) });
    }
    default:
      return answers.other;
  }
}

/** The whole in a sentence that says what to do. `isOwnCable`: the board's own, on which every board answers. */
export function summaryText(evidence: readonly Evidence[], isOwnCable: boolean): string {
  const { summaries } = words.identity;
  const has = (kind: Evidence['kind']): boolean => evidence.some((one) => one.kind === kind);
  if (has('echoed')) return summaries.echoed;
  if (has('answered')) return summaries.answered;
  if (has('noise')) return summaries.noise;
  return isOwnCable ? summaries.silentOnOwnCable : summaries.silent;
}

/** A family in one line. */
export function familyText({ id, position, unit }: Family): string {
  const description = id === 'unknown' ? '' : words.identity.described[id];
  return words.identity.about({ description, min: position.min, max: position.max, unit: words.units[unit] });
}

export function offsetsText(offsets: readonly ServoOffset[]): string {
  const set = offsets.filter(({ offset }) => offset !== 0).map(words.identity.offset);
  return set.length === 0
    ? words.identity.noOffsets
    : words.identity.offsets({ offsets: set.join(words.comma) });
}
