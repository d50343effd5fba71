// The dialog before a download replaces another group on the board: what the slot holds, whether it is lost, and which slot is free.

import { useStore } from 'zustand';
import { slotTrigger } from '#shared/codec/families.ts';
import { startHindrance } from '../../../robot/readiness.ts';
import type { Conflict, ReplaceQuestion as Question } from './replacing.ts';
import { useDevice, useLibrary, useSnapshot, useStores } from '../../stores.ts';
import { Button } from '../../../ui/Button.tsx';
import { Dialog } from '../../../ui/Dialog.tsx';
import { triggerText } from '../../../i18n/sentences.ts';
import { words } from '../../../i18n/whole.ts';
import confirm from '../../../ui/Confirm.module.css';

export function ReplaceQuestion() {
  const { replacing } = useStores();
  const question = useStore(replacing.store, (state) => state.question);
  const slots = question?.conflicts.map(({ slot }) => slot) ?? [];
  return (
    <Dialog
      role="alertdialog"
      title={titleOf(slots)}
      closeLabel={words.close}
      isOpen={question !== null}
      onClose={() => replacing.answer('leave')}
    >
      {question !== null && <ReplaceContent autoFocus question={question} />}
    </Dialog>
  );
}

export interface ReplaceContentProps {
  readonly question: Question;
  /** Focuses the button that leaves everything as it is. */
  readonly autoFocus?: boolean;
}

/** The content of the dialog. */
export function ReplaceContent({ question: { conflicts, free }, autoFocus = false }: ReplaceContentProps) {
  const { replacing } = useStores();
  const isDisabled = useSnapshot((snapshot) => startHindrance(snapshot) !== null);
  return (
    <>
      {conflicts.map((conflict) => (
        <Lost key={conflict.slot} {...conflict} />
      ))}
      <div className={confirm.actions}>
        <Button autoFocus={autoFocus} onPress={() => replacing.answer('leave')}>
          {words.slots.replaceLeave}
        </Button>
        {free !== null && (
          <Button icon="download" isDisabled={isDisabled} onPress={() => replacing.answer('free')}>
            {words.slots.replaceFree({ count: free.length, slots: slotList(free) })}
          </Button>
        )}
        <Button
          icon="board"
          tone="danger"
          isDisabled={isDisabled}
          onPress={() => replacing.answer('replace')}
        >
          {words.slots.replace}
        </Button>
      </div>
    </>
  );
}

function Lost({ slot, held, heldId, name }: Conflict) {
  const board = useDevice((state) => state.family.id);
  const isInLibrary = useLibrary(({ documents }) =>
    documents.some(({ id, isRemoved }) => id === heldId && !isRemoved),
  );
  const trigger = slotTrigger(board, slot);
  const text = words.slots.replaceText({ slot, held, name, isNamed: held !== '', isInLibrary });
  return (
    <p className={confirm.text}>
      {trigger === null ? text : words.slots.replaceTriggered({ text, trigger: triggerText(trigger) })}
    </p>
  );
}

function titleOf(slots: readonly number[]): string {
  const [slot = 0] = slots;
  return slots.length === 1
    ? words.slots.replaceTitle({ slot })
    : words.slots.replaceTitleSeveral({ count: slots.length });
}

function slotList(slots: readonly number[]): string {
  return words.numbers.formatNames(slots.map(words.numbers.formatWhole));
}
