// Stores a group of the library in one slot of the selected robots: compiled for each kind of board among them, with what keeps it from
// some, and what it replaces, before anything is sent.

import { useEffect, useState } from 'react';
import { compile } from '#shared/group/compile.ts';
import { groupFromText, maxErrorOf, type ActionGroup } from '#shared/group/group.ts';
import type { Listed } from '#shared/files/documentStore.ts';
import type { FleetDownloadWish, FleetRobot } from '#shared/client/http.generated.ts';
import { boardName } from '../i18n/sentences.ts';
import { words } from '../i18n/whole.ts';
import { gatewayStore } from '../features/library/gatewayStore.ts';
import { Button } from '../ui/Button.tsx';
import { Dialog } from '../ui/Dialog.tsx';
import { NumberField } from '../ui/NumberField.tsx';
import { EmptyState } from '../ui/Panel.tsx';
import { Select } from '../ui/Select.tsx';
import { SLOT } from '#shared/profile/macro.ts';
import { familyOf, robotOf } from './boards.ts';
import { useFleet } from './context.ts';
import { takesMotion } from './robots.ts';
import styles from './Fleet.module.css';

interface FleetDownloadProps {
  readonly robots: readonly FleetRobot[];
  act(work: () => Promise<unknown>): void;
}

export function FleetDownload({ robots, act }: FleetDownloadProps) {
  const [isOpen, setOpen] = useState(false);
  const able = robots.filter(takesMotion);
  return (
    <>
      <Button icon="download" isDisabled={able.length === 0} onPress={() => setOpen(true)}>
        {words.fleet.download}
      </Button>
      <Dialog
        title={words.fleet.downloadTo({ count: able.length })}
        closeLabel={words.close}
        isOpen={isOpen}
        onClose={() => setOpen(false)}
      >
        {isOpen && <Choice robots={able} act={act} onDone={() => setOpen(false)} />}
      </Dialog>
    </>
  );
}

function Choice({ robots, act, onDone }: FleetDownloadProps & { onDone(): void }) {
  const fleet = useFleet();
  const documents = useDocuments();
  const [chosen, setChosen] = useState('');
  const [slot, setSlot] = useState<number>(SLOT.min + 21);
  const document = documents.find(({ id }) => id === chosen) ?? documents[0];
  const group = useGroup(document?.id ?? null);
  if (document === undefined) {
    return <EmptyState title={words.fleet.noLibrary} hint={words.fleet.noLibraryHint} />;
  }
  const { wishes, refused } = group === null ? { wishes: [], refused: [] } : wishesFor(group, robots, slot);
  const replaced = robots.filter(({ slots }) =>
    slots.some((one) => one.slot === slot && one.name !== group?.name),
  );
  return (
    <div className={styles.choice}>
      <span className={styles.named} aria-hidden="true">
        {words.fleet.groupToStore}
      </span>
      <Select
        label={words.fleet.groupToStore}
        value={document.id}
        options={documents.map(({ id, facts }) => ({ value: id, label: facts.name }))}
        onChange={setChosen}
      />
      <span className={styles.named} aria-hidden="true">
        {words.board.slot}
      </span>
      <NumberField
        label={words.board.slot}
        value={slot}
        {...SLOT}
        onChange={setSlot}
        onRefused={() => () => undefined}
      />
      {refused.length > 0 && (
        <p className={styles.warning}>
          {words.fleet.doesNotFit({ boards: words.numbers.formatNames(refused) })}
        </p>
      )}
      {replaced.length > 0 && (
        <p className={styles.warning}>
          {words.fleet.replaces({
            slot,
            names: words.numbers.formatNames(replaced.map(({ name }) => name)),
          })}
        </p>
      )}
      <Button
        tone="primary"
        icon="download"
        isDisabled={wishes.length === 0}
        onPress={() => {
          act(() => Promise.all(wishes.map((wish) => fleet.api.download(wish))));
          onDone();
        }}
      >
        {words.fleet.downloadNow({ count: wishes.reduce((sum, one) => sum + one.robots.length, 0) })}
      </Button>
    </div>
  );
}

/** The groups of the library of the gateway that serves this page. */
function useDocuments(): readonly Listed[] {
  const [documents, setDocuments] = useState<readonly Listed[]>([]);
  useEffect(() => {
    let isWanted = true;
    void gatewayStore.list().then(({ documents: all }) => {
      if (isWanted)
        setDocuments(all.filter((one): one is Listed => one.facts.kind === 'group' && !one.isRemoved));
    });
    return () => {
      isWanted = false;
    };
  }, []);
  return documents;
}

function useGroup(id: string | null): ActionGroup | null {
  const [read, setRead] = useState<{ readonly id: string; readonly group: ActionGroup } | null>(null);
  useEffect(() => {
    if (id === null) return;
    void gatewayStore.read(id).then(({ text }) => {
      const { value } = groupFromText(text) as { value?: ActionGroup };
      if (value !== undefined) setRead({ id, group: value });
    });
  }, [id]);
  return read?.id === id ? read.group : null;
}

/** One download for all robots that take the same frames; `refused` names the boards for which the group does not fit. */
export function wishesFor(
  group: ActionGroup,
  robots: readonly FleetRobot[],
  slot: number,
): { readonly wishes: readonly FleetDownloadWish[]; readonly refused: readonly string[] } {
  const byFrames = new Map<string, FleetDownloadWish>();
  const refused = new Set<string>();
  for (const robot of robots) {
    const family = familyOf(robot.board);
    const { frames, report } = compile(group, {
      family,
      robot: robotOf(robot),
      maxErrorUnits: maxErrorOf(group, family),
    });
    if (report.problems.some(({ kind }) => kind !== 'tooFast')) {
      refused.add(boardName(family));
      continue;
    }
    const bodies = frames.map(({ durationMs, targets }) => ({
      durationMs,
      positions: Object.fromEntries(targets.map(({ servo, position }) => [servo, position])),
    }));
    const key = JSON.stringify(bodies);
    const wish = byFrames.get(key) ?? { robots: [], group: { slot, name: group.name, frames: bodies } };
    byFrames.set(key, { ...wish, robots: [...wish.robots, robot.id] });
  }
  return { wishes: [...byFrames.values()], refused: [...refused] };
}
