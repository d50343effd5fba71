// Which board answers like that: what was heard, weighed against the family table (boards.md 2.5). Pure; knows no link and
// no time. Answers never name one family for certain, so a person chooses among those that fit, once a board.

import { FAMILIES, type Family, type FamilyId, type Question } from '../codec/families.ts';
import type { Report } from '../codec/reports.ts';

export type Evidence =
  | { readonly kind: 'answered'; readonly question: Question; readonly report: Report }
  | { readonly kind: 'silent'; readonly question: Question }
  /** The question itself came back: the line is looped, or something else listens there (S14). */
  | { readonly kind: 'echoed' }
  /** Bytes that are no packets: a board that starts, another speed, a broken line. */
  | { readonly kind: 'noise'; readonly byteCount: number };

export interface Identity {
  readonly evidence: readonly Evidence[];
  /** Families that answer like this. */
  readonly candidates: readonly FamilyId[];
}

/** `silent`: such a board answers something that this one did not; it may be off. `contradicts`: it never answers so. */
export type Fit = 'fits' | 'silent' | 'contradicts';

export const NOTHING_HEARD: Identity = { evidence: [], candidates: [] };

export function identityFrom(evidence: readonly Evidence[]): Identity {
  const fitting = Object.values(FAMILIES).filter((family) => fitOf(family, evidence) === 'fits');
  return { evidence, candidates: fitting.map(({ id }) => id as FamilyId) };
}

export function fitOf(family: Family, evidence: readonly Evidence[]): Fit {
  if (evidence.some((one) => contradicts(family, one))) return 'contradicts';
  return evidence.some((one) => missing(family, one)) ? 'silent' : 'fits';
}

function contradicts({ answers, unit }: Family, evidence: Evidence): boolean {
  if (evidence.kind === 'echoed') return true;
  if (evidence.kind !== 'answered') return false;
  const { question, report } = evidence;
  return !answers.includes(question) || (report.kind === 'version' && report.unit !== unit);
}

function missing({ certainAnswers }: Family, evidence: Evidence): boolean {
  return evidence.kind === 'silent' && certainAnswers.includes(evidence.question);
}
