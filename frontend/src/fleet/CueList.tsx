// The cues of a show: GO starts the current one and makes the next one current. Who is missing is named before.

import { useRef, useState } from 'react';
import type { FleetCue, FleetRobot } from '#shared/client/http.generated.ts';
import { SLOT_TIMES } from '#shared/profile/macro.ts';
import { words } from '../i18n/whole.ts';
import { Button, IconButton } from '../ui/Button.tsx';
import { Mark } from '../ui/Chip.tsx';
import { Select } from '../ui/Select.tsx';
import { useAsking } from './asking.ts';
import { useFleet, useFleetState } from './context.ts';
import { cueState, wishOf } from './cues.ts';
import { groupsIn } from './robots.ts';
import { RangeField } from './RangeField.tsx';
import styles from './Fleet.module.css';

const ALL = '';

export function CueList({ mayDrive }: { readonly mayDrive: boolean }) {
  const fleet = useFleet();
  const robots = useFleetState((state) => state.robots);
  const cues = useFleetState((state) => state.cues);
  const next = useFleetState((state) => state.nextCue);
  const setNext = (nextCue: number): void => fleet.store.setState({ nextCue });
  const { problem, ask } = useAsking();
  const isStarting = useRef(false);
  const current = cues[next];
  const wish = current === undefined ? null : wishOf(current, robots);
  async function go(): Promise<void> {
    if (wish === null || isStarting.current) return;
    isStarting.current = true;
    try {
      await fleet.api.run(wish);
      setNext(next + 1);
    } finally {
      isStarting.current = false;
    }
  }
  async function remove(at: number): Promise<void> {
    await fleet.setCues(cues.filter((_, index) => index !== at));
    if (at < next) setNext(next - 1);
  }
  if (!mayDrive || robots.length === 0) return null;
  return (
    <section className={styles.work} aria-label={words.fleet.cues}>
      <div className={styles.taskHead}>
        <h2>{words.fleet.cues}</h2>
        {cues.length > 0 && (
          <>
            <Button tone="primary" icon="play" isDisabled={wish === null} onPress={() => ask(go)}>
              {words.fleet.go}
            </Button>
            <Button isDisabled={next >= cues.length} onPress={() => setNext(next + 1)}>
              {words.fleet.skip}
            </Button>
            <Button isDisabled={next === 0} onPress={() => setNext(0)}>
              {words.fleet.backToStart}
            </Button>
          </>
        )}
      </div>
      <p role="alert" className={styles.warning}>
        {problem}
      </p>
      {cues.length > 1 && <p className={styles.dim}>{words.fleet.cueHint}</p>}
      <ol className={styles.list}>
        {cues.map((cue, index) => (
          <li
            key={`${index} ${cue.name}`}
            className={styles.cue}
            aria-current={index === next ? 'step' : undefined}
          >
            <Cue cue={cue} robots={robots} onChoose={() => setNext(index)} />
            <IconButton
              icon="trash"
              label={words.fleet.removeCue({ name: cue.name })}
              onPress={() => ask(() => remove(index))}
            />
          </li>
        ))}
      </ol>
      <AddCue robots={robots} onAdd={(cue) => ask(() => fleet.setCues([...cues, cue]))} />
    </section>
  );
}

interface CueProps {
  readonly cue: FleetCue;
  readonly robots: readonly FleetRobot[];
  /** GO starts it next. */
  onChoose(): void;
}

function Cue({ cue, robots, onChoose }: CueProps) {
  const { ready, missing } = cueState(cue, robots);
  const where = cue.robots === ALL ? words.fleet.everyGroup : cue.robots;
  return (
    <>
      <Mark truth={missing.length > 0 ? 'warning' : 'confirmed'} />
      <button type="button" className={styles.cueName} title={words.fleet.chooseCue} onClick={onChoose}>
        {words.fleet.cue({ name: cue.name, where, times: cue.times })}
      </button>
      <span className={styles.dim}>
        {words.fleet.ready({ ready: ready.length, count: ready.length + missing.length })}
        {missing.length > 0 &&
          ` ${words.fleet.missing({ names: words.numbers.formatNames(missing.map(({ name }) => name)) })}`}
      </span>
    </>
  );
}

interface AddCueProps {
  readonly robots: readonly FleetRobot[];
  onAdd(cue: FleetCue): void;
}

function AddCue({ robots, onAdd }: AddCueProps) {
  const names = [...new Set(robots.flatMap(({ slots }) => slots.map(({ name }) => name)))]
    .filter(Boolean)
    .sort();
  const [wanted, setWanted] = useState('');
  const [group, setGroup] = useState(ALL);
  const [times, setTimes] = useState(1);
  const [failing, setFailing] = useState<'stop' | 'goOn'>('stop');
  const name = names.includes(wanted) ? wanted : names[0];
  if (name === undefined) return <p className={styles.dim}>{words.fleet.noCue}</p>;
  return (
    <div className={styles.verb}>
      <Select
        label={words.fleet.groupOfCue}
        value={name}
        options={names.map((value) => ({ value, label: value }))}
        onChange={setWanted}
      />
      <Select
        label={words.fleet.robotsOfCue}
        value={group}
        options={[
          { value: ALL, label: words.fleet.everyGroup },
          ...groupsIn(robots).map((value) => ({ value, label: value })),
        ]}
        onChange={setGroup}
      />
      <RangeField
        label={words.fleet.timesOfCue}
        value={times}
        min={1}
        max={SLOT_TIMES.max}
        unit={words.macros.times}
        onChange={setTimes}
      />
      <Select<'stop' | 'goOn'>
        label={words.fleet.ifOneFails}
        value={failing}
        options={(['stop', 'goOn'] as const).map((value) => ({ value, label: words.fleet.failing[value] }))}
        onChange={setFailing}
      />
      <Button
        icon="plus"
        onPress={() => onAdd({ name, robots: group, times, stopsOthers: failing === 'stop' })}
      >
        {words.fleet.addCue}
      </Button>
    </div>
  );
}
