// Asked before another group goes from the slot that the group at hand is to run from. Knows no board.

import { usePlayback, useStores } from '../stores/stores.ts';
import { ConfirmContent, ConfirmDialog } from '../ui/Confirm.tsx';
import { words } from '../words/words.ts';

export function ReplaceQuestion({ isDisabled }: { readonly isDisabled: boolean }) {
  const isOpen = usePlayback((state) => state.replacing !== null);
  const { title, ...content } = useQuestion(isDisabled);
  return <ConfirmDialog {...content} title={title} isOpen={isOpen} closeLabel={words.close} />;
}

/** What stands in the dialog. */
export function ReplaceContent({ isDisabled }: { readonly isDisabled: boolean }) {
  const { title: _, ...content } = useQuestion(isDisabled);
  return <ConfirmContent {...content} />;
}

function useQuestion(isDisabled: boolean) {
  const { playback } = useStores();
  const replacing = usePlayback((state) => state.replacing);
  const slot = replacing?.slot ?? 0;
  return {
    icon: 'board',
    isDisabled,
    title: words.play.replaceTitle(slot),
    text: words.play.replaceText(slot, replacing?.held ?? '', replacing?.name ?? ''),
    keepLabel: words.play.replaceKeep,
    confirmLabel: words.play.replace,
    onClose: () => playback.answer(false),
    onConfirm: () => playback.answer(true),
  } as const;
}
