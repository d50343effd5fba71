// The list of robots, those of the connected board first, with templates for new ones and import from files. Every change is an undo step.

import { useEffect, useRef, type RefObject, useState, useId } from 'react';
import { useStore } from 'zustand';
import { type ReadyRobotId, READY_ROBOTS } from '#shared/profile/readyRobots.ts';
import { robotToText, robotFromText } from '#shared/profile/robotText.ts';
import { FAMILIES, type FamilyId } from '#shared/codec/families.ts';
import { type Robots, type OwnRobot, freshRobot, currentOf } from './robots.ts';
import { useStores, useDevice, useSnapshot } from '../stores.ts';
import { Button, IconButton } from '../../ui/Button.tsx';
import { saveFile, FileZone } from '../../ui/localFiles.tsx';
import { words } from '../../i18n/whole.ts';
import { robotFlawText } from '../../i18n/robotFlaws.ts';
import { boardName } from '../../i18n/sentences.ts';
import { pressOnce } from '../../ui/inputEvents.ts';
import { RobotPicture } from './RobotPicture.tsx';
import { Chip } from '../../ui/Chip.tsx';
import { UndoTools } from '../undo/UndoTools.tsx';
import styles from './RobotList.module.css';
import dialog from './RobotDialog.module.css';

/** Products with their own name that are built like a template (boards.md section 9). Product names are the same in every language. */
const PRODUCTS: Partial<Readonly<Record<ReadyRobotId, string>>> = {
  arm: 'LeArm, OpenArm, xArm',
  hand: 'uHand',
  humanoid16: 'Tonybot',
  humanoid18: 'TonyPi',
  hexapod18: 'SpiderPi',
};

type Place = RefObject<HTMLElement | null>;

/**
 * Scrolls to a robot that was added. The focus goes to the tools of the current robot when it was added, or when another one was deleted;
 * after Undo it stays there.
 */
function useNewcomerSeen(
  list: Place,
  undo: Place,
  { own, currentId }: Pick<Robots, 'own' | 'currentId'>,
): void {
  const before = useRef({ own, currentId });
  useEffect(() => {
    const former = before.current;
    before.current = { own, currentId };
    if (own.length === former.own.length && currentId === former.currentId) return;
    const came = own.findLast(({ id }) => !former.own.some((one) => one.id === id))?.id ?? currentId;
    const card = list.current?.querySelector<HTMLElement>(`[data-robot='${came}']`);
    card?.scrollIntoView({ block: 'nearest' });
    if (came === currentId && undo.current?.contains(document.activeElement) === false)
      card?.querySelector('button')?.focus({ preventScroll: true });
  }, [list, undo, own, currentId]);
}

function RobotTools({ id, robot, isLast }: OwnRobot & { readonly isLast: boolean }) {
  const { robots, view } = useStores();
  return (
    <div className={styles.tools}>
      <Button tone="primary" icon="dial" onPress={() => view.setState({ robotView: 'calibrate' })}>
        {words.robots.calibrate}
      </Button>
      <Button icon="edit" onPress={() => view.setState({ robotView: 'edit' })}>
        {words.robots.edit}
      </Button>
      <Button tone="quiet" icon="copy" onPress={robots.duplicate}>
        {words.robots.duplicate}
      </Button>
      <Button
        tone="quiet"
        icon="download"
        onPress={() => saveFile({ name: fileName(robot.name), text: robotToText(robot) })}
      >
        {words.robots.export}
      </Button>
      <Button tone="quiet" icon="trash" isDisabled={isLast} onPress={() => robots.remove(id)}>
        {words.robots.remove}
      </Button>
    </div>
  );
}

/** Without characters that file systems forbid. */
function fileName(robot: string): string {
  const plain = robot.replaceAll(/[^\p{L}\p{N} ._-]/gu, '').trim();
  return `${plain === '' ? 'robot' : plain}.json`;
}

/** Imports robot files by choosing or dropping them. A file that cannot be read changes nothing and says why. */
function ImportRobot({ connected }: { readonly connected: FamilyId | null }) {
  const { robots } = useStores();
  const [outcomes, setOutcomes] = useState<readonly string[]>([]);

  async function take(files: readonly File[]): Promise<void> {
    const read = await Promise.all(files.map(async (file) => ({ file: file.name, text: await file.text() })));
    setOutcomes(read.flatMap(({ file, text }) => imported(file, text) ?? []));
  }

  /** null if the store has already reported why not. */
  function imported(file: string, text: string): string | null {
    const found = robotFromText(text);
    if ('problem' in found) return words.robots.notImported({ file, flaw: robotFlawText(found.problem) });
    if (!robots.add(() => words.robots.steps.import, found.robot)) return null;
    const { name, board } = robots.current().robot;
    return connected === null || board === connected
      ? words.robots.imported({ name })
      : words.robots.importedElsewhere({ name, board: boardName(FAMILIES[board]) });
  }

  return (
    <FileZone
      accept=".json,application/json"
      multiple
      takesDrop
      hint={words.robots.importHint}
      onChoose={(files) => void take(files)}
      below={
        <ul className={styles.outcomes} aria-live="polite">
          {outcomes.map((outcome) => (
            <li key={outcome}>{outcome}</li>
          ))}
        </ul>
      }
    >
      {words.robots.import}
    </FileZone>
  );
}

/** The templates for a board, each with its picture. Adding one makes it the current robot. */
function NewRobot({ board }: { readonly board: FamilyId }) {
  const { robots } = useStores();
  const headingId = useId();
  return (
    <section aria-labelledby={headingId}>
      <h3 id={headingId}>{words.robots.fresh}</h3>
      <p className={styles.dim}>{words.robots.freshHint({ board: boardName(FAMILIES[board]) })}</p>
      <ul className={styles.ready}>
        {fitting(board).map((id) => (
          <li key={id}>
            <button
              type="button"
              className={styles.card}
              aria-label={words.robots.add({ name: words.robots.ready[id] })}
              aria-describedby={`${headingId}-${id}`}
              onClick={() => robots.add(() => words.robots.steps.add, freshRobot(id, board))}
              onKeyDown={pressOnce}
            >
              <RobotPicture robot={freshRobot(id, board)} />
              {words.robots.ready[id]}
              <span id={`${headingId}-${id}`} className={styles.dim}>
                {PRODUCTS[id]}
              </span>
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}

function fitting(board: FamilyId): readonly ReadyRobotId[] {
  const ids = Object.keys(READY_ROBOTS) as ReadyRobotId[];
  return ids.filter((id) => (READY_ROBOTS[id].boards as readonly FamilyId[]).includes(board));
}

export function RobotList() {
  const { robots, robotSync } = useStores();
  const { own, currentId } = useStore(robots.store, ({ present }) => present);
  const place = useStore(robotSync.store, (state) => state.place);
  const isEveryones = useSnapshot(
    ({ robotOnBoard }) => robotOnBoard !== null && robotOnBoard.document !== null,
  );
  const current = currentOf({ own, currentId, nextId: 0 });
  const connected = useDevice(({ snapshot: { family } }) => (family.id === 'unknown' ? null : family.id));
  const headingId = useId();
  const list = useRef<HTMLUListElement>(null);
  const undo = useRef<HTMLDivElement>(null);
  const others = own.filter((one) => one !== current);
  const fits = ({ robot: { board } }: OwnRobot): boolean => connected === null || board === connected;
  const isLast = others.length === 0;
  useNewcomerSeen(list, undo, { own, currentId: current.id });
  return (
    <>
      <section aria-labelledby={headingId}>
        <div className={styles.heading}>
          <h3 id={headingId}>{words.robots.own}</h3>
          <div ref={undo} className={dialog.undo}>
            <UndoTools of={robots} />
          </div>
        </div>
        {place !== null && <p className={styles.dim}>{words.robots.place[place]}</p>}
        <ul ref={list} className={styles.own}>
          <li data-robot={current.id} className={styles.current}>
            <Described {...current} />
            <Chip truth="confirmed">{isEveryones ? words.robots.everyones : words.robots.inUse}</Chip>
            <RobotTools {...current} isLast={isLast} />
          </li>
          {others
            .toSorted((one, other) => Number(fits(other)) - Number(fits(one)))
            .map((one) => (
              <Other key={one.id} {...one} fits={fits(one)} />
            ))}
        </ul>
      </section>
      <NewRobot board={connected ?? current.robot.board} />
      <ImportRobot connected={connected} />
    </>
  );
}

function Described({ robot }: OwnRobot) {
  return (
    <div className={styles.described}>
      <RobotPicture robot={robot} />
      <div className={styles.words}>
        <span className={styles.name}>{robot.name}</span>
        <span className={styles.dim}>
          {boardName(FAMILIES[robot.board])} · {words.robots.count({ servos: robot.servos.length })}
        </span>
      </div>
    </div>
  );
}

function Other({ id, robot, fits }: OwnRobot & { readonly fits: boolean }) {
  const { robots } = useStores();
  return (
    <li data-robot={id} className={styles.other}>
      <Described id={id} robot={robot} />
      {fits ? (
        <Button aria-label={words.robots.use({ name: robot.name })} onPress={() => robots.takeUp(id)}>
          {words.robots.useVerb}
        </Button>
      ) : (
        <span className={styles.dim}>
          {words.robots.otherBoard({ board: boardName(FAMILIES[robot.board]) })}
        </span>
      )}
      <IconButton
        icon="trash"
        label={words.robots.removeNamed({ name: robot.name })}
        onPress={() => robots.remove(id)}
      />
    </li>
  );
}
