// The robots a person has, those of the connected board first, the ready ones to begin with, and files. What is done here is
// taken back by Undo above.

import { useId, useRef } from 'react';
import { useStore } from 'zustand';
import { FAMILIES } from '#shared/codec/families.ts';
import { currentOf, type OwnRobot } from './robots.ts';
import { useDevice, useSnapshot, useStores } from '../stores.ts';
import { Button, IconButton } from '../../ui/Button.tsx';
import { Chip } from '../../ui/Chip.tsx';
import { boardName } from '../../i18n/sentences/boards.ts';
import { words } from '../../i18n/whole.ts';
import { ImportRobot } from './ImportRobot.tsx';
import { NewRobot } from './NewRobot.tsx';
import { RobotPicture } from './RobotPicture.tsx';
import { RobotTools } from './RobotTools.tsx';
import { UndoTools } from '../undo/UndoTools.tsx';
import { useNewcomerSeen } from './useNewcomerSeen.ts';
import dialog from './RobotDialog.module.css';
import styles from './RobotList.module.css';

export function RobotList() {
  const { robots, keeping } = useStores();
  const { own, currentId } = useStore(robots.store, ({ present }) => present);
  const place = useStore(keeping.store, (state) => state.place);
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
            <Chip truth="confirmed">{isEveryones ? words.robots.everyones : words.robots.atHand}</Chip>
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
