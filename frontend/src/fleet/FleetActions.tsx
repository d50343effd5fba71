// What can be asked of the selected robots: stop, run a group that all of them have, store one of the library's, resume, and put them into a
// group of robots. A robot that cannot take part is named with the reason before anything is sent.

import { useState } from 'react';
import type { FleetRobot } from '#shared/client/http.generated.ts';
import { words } from '../i18n/whole.ts';
import { Button } from '../ui/Button.tsx';
import { Select } from '../ui/Select.tsx';
import field from '../ui/Field.module.css';
import { cx } from '../ui/cx.ts';
import { SLOT_TIMES } from '#shared/profile/macro.ts';
import { useAsking } from './asking.ts';
import { useFleet, useFleetState } from './context.ts';
import { FleetDownload } from './FleetDownload.tsx';
import { conditionOf, takesMotion } from './robots.ts';
import { choiceFor, commonGroups, slotOf, type Choice } from './slots.ts';
import { RangeField } from './RangeField.tsx';
import styles from './Fleet.module.css';

interface FleetActionsProps {
  readonly mayDrive: boolean;
  /** The robots in view: search and group hide the others, also selected ones. */
  readonly shown: readonly FleetRobot[];
}

export function FleetActions({ mayDrive, shown }: FleetActionsProps) {
  const fleet = useFleet();
  const robots = useFleetState((state) => state.robots);
  const selected = useFleetState((state) => state.selected);
  const chosen = robots.filter(({ id }) => selected.has(id));
  const ids = chosen.map(({ id }) => id);
  const { problem, ask } = useAsking();
  const act = (work: () => Promise<unknown>): void => {
    fleet.store.setState({ stopping: null }); // what the latest stop did is no news any more
    ask(work);
  };
  return (
    <div className={styles.actions} role="group" aria-label={words.fleet.selected({ count: chosen.length })}>
      <strong>{words.fleet.selected({ count: chosen.length })}</strong>
      <Button tone="danger" onPress={() => void fleet.stop(ids)}>
        {words.fleet.stopSelected({ count: chosen.length })}
      </Button>
      {mayDrive && (
        <>
          {chosen.some((one) => conditionOf(one) === 'stopped') && (
            <Button onPress={() => act(() => fleet.api.resume(stoppedIn(chosen)))}>
              {words.fleet.resume({ count: stoppedIn(chosen).length })}
            </Button>
          )}
          <Run robots={chosen} selection={[...selected].sort().join(' ')} act={act} />
          <FleetDownload robots={chosen} />
          <Grouping robots={chosen} act={ask} />
        </>
      )}
      <Unable robots={chosen} />
      <Hidden robots={chosen.filter((one) => !shown.includes(one))} />
      <p role="alert" className={styles.warning}>
        {problem}
      </p>
    </div>
  );
}

const stoppedIn = (robots: readonly FleetRobot[]): readonly string[] =>
  robots.filter((one) => conditionOf(one) === 'stopped').map(({ id }) => id);

interface PartProps {
  readonly robots: readonly FleetRobot[];
  act(work: () => Promise<unknown>): void;
}

function Run({ robots, selection, act }: PartProps & Pick<Choice, 'selection'>) {
  const fleet = useFleet();
  const able = robots.filter(takesMotion);
  const names = commonGroups(able);
  const [before, setChoice] = useState<Choice>({ selection, name: '' });
  const choice = choiceFor(before, selection, names);
  if (choice !== before) setChoice(choice);
  const [times, setTimes] = useState(1);
  const [wantsTogether, setTogether] = useState(true);
  const together = wantsTogether && able.length > 1;
  const { name } = choice;
  const isCommon = names.includes(name);
  if (names.length === 0)
    return able.length === 0 ? null : <p className={styles.dim}>{words.fleet.noCommon}</p>;
  const runs = able.map((robot) => ({ robot: robot.id, slot: slotOf(robot, name) }));
  return (
    <div className={styles.verb}>
      <Select
        label={words.fleet.groupToRun}
        value={name}
        options={(isCommon ? names : [name, ...names]).map((value) => ({ value, label: value }))}
        onChange={(wanted) => setChoice({ selection, name: wanted })}
      />
      <RangeField
        label={words.fleet.times}
        value={times}
        min={1}
        max={SLOT_TIMES.max}
        unit={words.macros.times}
        onChange={setTimes}
      />
      {able.length > 1 && (
        <label className={styles.check}>
          <input
            type="checkbox"
            checked={wantsTogether}
            onChange={({ target }) => setTogether(target.checked)}
          />
          {words.fleet.together}
        </label>
      )}
      <Button
        icon="play"
        tone="primary"
        isDisabled={!isCommon}
        onPress={() => act(() => fleet.api.run({ name, runs, times, together }))}
      >
        {words.fleet.run({ count: able.length })}
      </Button>
      {!isCommon && <p className={styles.warning}>{words.fleet.notCommon({ name })}</p>}
    </div>
  );
}

/** Puts the selected robots into a group by its name, or takes them out of all. */
function Grouping({ robots, act }: PartProps) {
  const fleet = useFleet();
  const ids = robots.map(({ id }) => id);
  const [name, setName] = useState('');
  const put = (group: string): void =>
    act(async () => {
      await fleet.group(ids, group);
      setName('');
    });
  return (
    <form
      className={styles.verb}
      onSubmit={(event) => {
        event.preventDefault();
        if (name.trim() !== '') put(name.trim());
      }}
    >
      <input
        className={cx(field.field, styles.groupName)}
        aria-label={words.fleet.groupName}
        placeholder={words.fleet.groupName}
        maxLength={64}
        value={name}
        onChange={({ target }) => setName(target.value)}
      />
      <Button type="submit" isDisabled={name.trim() === ''}>
        {words.fleet.putIntoGroup}
      </Button>
      {robots.some(({ groups }) => groups.length > 0) && (
        <Button tone="quiet" onPress={() => put('')}>
          {words.fleet.ungroup}
        </Button>
      )}
    </form>
  );
}

/** Those of the selected robots that search or group hide. */
function Hidden({ robots }: { readonly robots: readonly FleetRobot[] }) {
  if (robots.length === 0) return null;
  const names = words.numbers.formatNames(robots.map(({ name }) => name));
  return <p className={styles.warning}>{words.fleet.hidden({ names })}</p>;
}

/** Those of the selected robots that take no part, by name and reason. */
function Unable({ robots }: { readonly robots: readonly FleetRobot[] }) {
  const unable = robots.filter((one) => !takesMotion(one));
  if (unable.length === 0) return null;
  const reasons = unable.map((one) => words.fleet.conditions[conditionOf(one)]);
  const [reason = ''] = reasons;
  const isOneReason =
    unable.length > 1 && unable.length === robots.length && reasons.every((one) => one === reason);
  const names = (): string =>
    words.numbers.formatNames(
      unable.map(({ name }, at) => words.fleet.because({ name, reason: reasons[at] ?? '' })),
    );
  return (
    <p className={styles.dim}>
      {isOneReason ? words.fleet.noneAble({ reason }) : words.fleet.unable({ names: names() })}
    </p>
  );
}
