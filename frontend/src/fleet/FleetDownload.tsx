// Stores groups of the library on the selected robots, each in a slot of its own. What does not fit, and what is replaced, stands beside
// each group before anything is sent.

import { useEffect, useRef, useState } from 'react';
import { groupFromText, type ActionGroup } from '#shared/group/group.ts';
import { listedOf, type Listed } from '#shared/files/documentStore.ts';
import { GatewayProblem } from '#shared/client/request.ts';
import type { FleetDownloadWish, FleetRobot } from '#shared/client/http.generated.ts';
import { words } from '../i18n/whole.ts';
import { Button } from '../ui/Button.tsx';
import { Dialog } from '../ui/Dialog.tsx';
import { EmptyState } from '../ui/Panel.tsx';
import { refusalText } from './asking.ts';
import { useFleet } from './context.ts';
import { factsOf, slotOffered, slotRangeOf, wishesFor, type Picked } from './downloads.ts';
import { takesMotion } from './robots.ts';
import { RangeField } from './RangeField.tsx';
import styles from './FleetDownload.module.css';

export function FleetDownload({ robots }: { readonly robots: readonly FleetRobot[] }) {
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
        wide
        onClose={() => setOpen(false)}
      >
        {isOpen && <Choice robots={able} onDone={() => setOpen(false)} />}
      </Dialog>
    </>
  );
}

function Choice({ robots, onDone }: { readonly robots: readonly FleetRobot[]; onDone(): void }) {
  const { library } = useFleet();
  const { documents, isUnread } = useDocuments();
  const [picked, setPicked] = useState<readonly Picked[]>([]);
  const [unreadGroup, setUnreadGroup] = useState<string | null>(null);
  const { problem, isSending, send } = useSending(onDone);
  if (robots.length === 0) return <p className={styles.dim}>{words.fleet.noneTakes}</p>;
  if (documents === null)
    return <p role="status">{isUnread ? words.fleet.libraryUnread : words.fleet.readingLibrary}</p>;
  if (documents.length === 0) {
    const action = <a href="./">{words.fleet.makeGroups}</a>;
    return <EmptyState title={words.fleet.noLibrary} hint={words.fleet.noLibraryHint} action={action} />;
  }
  const facts = new Map(picked.map((one) => [one.id, factsOf(one, picked, robots)]));
  const isClear = [...facts.values()].every((each) => !each.isEmpty && !each.isSlotTwice);
  const wishes = isClear ? wishesFor(picked, robots) : [];
  const getting = wishes.reduce((sum, wish) => sum + wish.robots.length, 0);

  async function pick(id: string, name: string): Promise<void> {
    setUnreadGroup(null);
    const group = await library.read(id).then(
      ({ text }) => (groupFromText(text) as { value?: ActionGroup }).value,
      () => undefined,
    );
    if (group === undefined) {
      setUnreadGroup(name);
      return;
    }
    setPicked((before) => {
      const slot = slotOffered(
        group,
        robots,
        before.map((one) => one.slot),
      );
      return before.some((one) => one.id === id) ? before : [...before, { id, group, slot }];
    });
  }

  return (
    <>
      <p className={styles.dim}>{words.fleet.downloadHint}</p>
      <ul className={styles.groups} aria-label={words.slots.several.list}>
        {documents.map(({ id, facts: { name, frames, durationMs } }) => {
          const one = picked.find((each) => each.id === id);
          const known = facts.get(id);
          return (
            <li key={id} className={styles.group}>
              <label className={styles.choice}>
                <input
                  type="checkbox"
                  checked={one !== undefined}
                  onChange={({ target }) =>
                    target.checked
                      ? void pick(id, name)
                      : setPicked((before) => before.filter((each) => each.id !== id))
                  }
                />
                <span className={styles.name}>
                  <span>{name}</span>
                  <span className={styles.dim}>
                    {words.slots.several.about({ count: frames, durationMs })}
                  </span>
                </span>
              </label>
              {one !== undefined && known !== undefined && (
                <PickedGroup
                  {...{ one, facts: known, range: slotRangeOf(robots) }}
                  onSlot={(slot) =>
                    setPicked((before) => before.map((each) => (each.id === id ? { ...each, slot } : each)))
                  }
                />
              )}
            </li>
          );
        })}
      </ul>
      <p role="alert" className={styles.warning}>
        {unreadGroup === null ? problem : words.fleet.groupUnread({ name: unreadGroup })}
      </p>
      <Button
        tone="primary"
        icon="download"
        isDisabled={getting === 0 || isSending}
        onPress={() => send(wishes)}
      >
        {words.fleet.downloadNow({ groups: picked.length, count: getting })}
      </Button>
    </>
  );
}

interface PickedGroupProps {
  readonly one: Picked;
  readonly facts: ReturnType<typeof factsOf>;
  readonly range: { readonly min: number; readonly max: number };
  onSlot(slot: number): void;
}

/** Its slot, and what there is to know of it before it is sent. */
function PickedGroup({ one, facts, range, onSlot }: PickedGroupProps) {
  const { isEmpty, isSlotTwice, refusedBy, replacesOn } = facts;
  const { formatNames } = words.numbers;
  const notes = [
    isEmpty && words.slots.several.noFrame,
    isSlotTwice && words.slots.several.sameSlot({ slot: one.slot }),
    refusedBy.length > 0 && words.fleet.doesNotFit({ boards: formatNames(refusedBy) }),
    replacesOn.length > 0 && words.fleet.replaces({ slot: one.slot, names: formatNames(replacesOn) }),
  ].filter((note) => note !== false);
  return (
    <>
      <span className={styles.slot}>
        <span className={styles.dim} aria-hidden="true">
          {words.board.slot}
        </span>
        <RangeField
          label={words.slots.several.slotOf({ name: one.group.name })}
          size="small"
          value={one.slot}
          {...range}
          onChange={onSlot}
        />
      </span>
      {notes.map((note) => (
        <p key={note} className={styles.warning}>
          {note}
        </p>
      ))}
    </>
  );
}

/** Closes the dialog when the gateway has begun with all of it, and says why it has not. */
function useSending(onDone: () => void) {
  const fleet = useFleet();
  const [problem, setProblem] = useState('');
  const [isSending, setSending] = useState(false);
  /** What has begun is not sent again after another one was refused. */
  const begun = useRef(new Set<string>());

  async function begin(wish: FleetDownloadWish): Promise<void> {
    const key = JSON.stringify(wish);
    if (begun.current.has(key)) return;
    await fleet.api.download(wish);
    begun.current.add(key);
  }

  async function send(wishes: readonly FleetDownloadWish[]): Promise<void> {
    setSending(true);
    setProblem('');
    try {
      await Promise.all(wishes.map(begin));
      onDone();
    } catch (error) {
      if (!(error instanceof GatewayProblem)) throw error;
      setProblem(error.code === 'tooLarge' ? words.fleet.tooMuch : refusalText(error));
    } finally {
      setSending(false);
    }
  }

  return { problem, isSending, send: (wishes: readonly FleetDownloadWish[]): void => void send(wishes) };
}

/** The groups of the library of the gateway that serves this page; null while they are being read, or cannot be. */
function useDocuments() {
  const { library } = useFleet();
  const [documents, setDocuments] = useState<readonly Listed[] | null>(null);
  const [isUnread, setUnread] = useState(false);
  useEffect(() => {
    let isWanted = true;
    void library.list().then(
      (listing) => {
        if (isWanted) setDocuments(listedOf(listing, 'group').filter(({ isRemoved }) => !isRemoved));
      },
      () => {
        if (isWanted) setUnread(true);
      },
    );
    return () => {
      isWanted = false;
    };
  }, [library]);
  return { documents, isUnread };
}
