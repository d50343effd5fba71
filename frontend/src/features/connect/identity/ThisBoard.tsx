// The connected board: the name that the person gave it, its assumed kind with the answers that it is based on, and the choice of another.

import { useState } from 'react';
import { useStore } from 'zustand';
import type { Evidence } from '#shared/robot/identity.ts';
import { Mark, type Truth } from '../../../ui/Chip.tsx';
import { heardIn } from '../doctor.ts';
import { words } from '../../../i18n/whole.ts';
import { mayAsk } from '../../../robot/readiness.ts';
import { useDevice, useSnapshot, useStores } from '../../stores.ts';
import { Button } from '../../../ui/Button.tsx';
import { nameOf } from '../../../robot/device.ts';
import { NICKNAME_LENGTH } from '../../../robot/remembered.ts';
import { boardName } from '../../../i18n/sentences.ts';
import whichBoardStyles from './WhichBoard.module.css';
import field from '../../../ui/Field.module.css';
import styles from './ThisBoard.module.css';
import type { Family } from '#shared/codec/families.ts';
import type { ServoOffset } from '#shared/codec/reports.ts';

// The answers of a board to the queries of its identity, a line for each query.

const TRUTH: Readonly<Record<Evidence['kind'], Truth>> = {
  answered: 'confirmed',
  silent: 'unknown',
  echoed: 'danger',
  noise: 'warning',
};

export function EvidenceList({ evidence }: { readonly evidence: readonly Evidence[] }) {
  return (
    <ul className={whichBoardStyles.evidence} aria-label={words.identity.evidence}>
      {evidence.map((one) => (
        <li key={`${one.kind} ${'question' in one ? one.question : ''}`}>
          <Mark truth={TRUTH[one.kind]} />
          {answerText(one)}
        </li>
      ))}
    </ul>
  );
}

// Firmware and trims of boards that report them, on a person's request.

export function BoardDetails() {
  const { device } = useStores();
  const family = useDevice((state) => state.family);
  const version = useSnapshot((snapshot) => snapshot.version);
  const offsets = useSnapshot((snapshot) => snapshot.offsets);
  const isAllowed = useSnapshot((snapshot) => mayAsk(snapshot, family));
  if (!family.commands.includes('readOffsets')) return null;
  return (
    <>
      {version !== null && <p>{words.identity.version({ version })}</p>}
      {offsets !== null && <p>{offsetsText(offsets)}</p>}
      <Button tone="quiet" isDisabled={!isAllowed} onPress={device.readDetails}>
        {words.identity.askDetails}
      </Button>
    </>
  );
}

export function ThisBoard() {
  const { device, boards } = useStores();
  const way = useDevice((state) => state.way);
  const family = useDevice((state) => state.family);
  const evidence = useSnapshot((snapshot) => snapshot.identity.evidence);
  const [{ answeredMs }] = useState(() => heardIn(device.traffic));
  const known = useStore(boards.store, (all) => (way === null ? undefined : all[nameOf(way)]));
  if (way === null || way.isSimulated || known === undefined) return null;
  return (
    <section className={styles.board} aria-label={words.identity.thisBoard}>
      <label className={styles.field}>
        <span>{words.identity.nickname}</span>
        <input
          key={known.nickname}
          className={field.field}
          defaultValue={known.nickname}
          maxLength={NICKNAME_LENGTH}
          placeholder={words.identity.nicknameHint}
          autoComplete="off"
          spellCheck={false}
          onBlur={(event) => boards.rename(way, event.target.value)}
          onKeyDown={(event) => {
            if (event.key === 'Enter') event.currentTarget.blur();
          }}
        />
      </label>
      <div className={styles.family}>
        <p>{words.identity.takenFor({ name: boardName(family) })}</p>
        <EvidenceList evidence={evidence} />
        {answeredMs !== null && <p>{words.identity.answeredIn({ ms: Math.round(answeredMs) })}</p>}
        <BoardDetails />
        {family.certainAnswers.length === 0 && <p className={styles.dim}>{words.identity.unproven}</p>}
      </div>
      <Button tone="quiet" icon="refresh" onPress={device.identify}>
        {words.identity.notThis}
      </Button>
    </section>
  );
}

function answerText(evidence: Evidence): string {
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

function offsetsText(offsets: readonly ServoOffset[]): string {
  const set = offsets.filter(({ offset }) => offset !== 0).map(words.identity.offset);
  return set.length === 0
    ? words.identity.noOffsets
    : words.identity.offsets({ offsets: set.join(words.comma) });
}
