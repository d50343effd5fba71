// Stores the group of this page, as it was compiled, in the chosen slot.

import { obstacles } from '../stores/group/compiled.ts';
import { problemText } from '../stores/group/problemText.ts';
import { startHindrance } from '../stores/device/readiness.ts';
import { useCompiled, useDevice, useDocument, useSnapshot, useStores, useView } from '../stores/stores.ts';
import { Button } from '../ui/Button.tsx';
import { words } from '../words/words.ts';

export function DownloadControl() {
  const { compiled, library, notices, slots } = useStores();
  const unit = useDocument(({ present }) => present.unit);
  const isEmpty = useDocument(({ present }) => present.frames.length === 0);
  const slot = useView((state) => state.slot);
  const frameCount = useCompiled((state) => state.latest.frames.length);
  const sameUnit = useDevice((state) => state.family.unit === unit);
  const mayStart = useSnapshot((snapshot) => startHindrance(snapshot) === null);
  const download = (): void => {
    const group = compiled.now();
    const { name } = group.source.group;
    const [problem] = obstacles(group.report, 'board');
    const { openId: documentId } = library.store.getState();
    if (problem === undefined) slots.download([{ slot, name, documentId, frames: group.frames }]);
    else notices.tell('warning', problemText(problem, group.source));
  };
  return (
    <Button
      icon="download"
      hint={words.board.downloadHint(frameCount, slot)}
      isDisabled={!mayStart || !sameUnit || isEmpty}
      onPress={download}
    >
      {words.board.download}
    </Button>
  );
}
