// Stores the group of this page, as it was compiled, in its slot, or in a free one where the person prefers that.

import { obstacles } from '../animate/group/compiled.ts';
import { problemText } from '../animate/group/problemText.ts';
import { startHindrance } from '../../robot/readiness.ts';
import { useCompiled, useDevice, useDocument, useSnapshot, useStores, useSlot } from '../stores.ts';
import { Button } from '../../ui/Button.tsx';
import { words } from '../../i18n/words.ts';

export function DownloadControl() {
  const { compiled, library, notices, replacing, view } = useStores();
  const unit = useDocument(({ present }) => present.unit);
  const isEmpty = useDocument(({ present }) => present.frames.length === 0);
  const slot = useSlot();
  const frameCount = useCompiled((state) => state.latest.frames.length);
  const sameUnit = useDevice((state) => state.family.unit === unit);
  const mayStart = useSnapshot((snapshot) => startHindrance(snapshot) === null);
  const download = (): void => {
    const group = compiled.now();
    const { name } = group.source.group;
    const [problem] = obstacles(group.report, 'board');
    const { openId: documentId } = library.store.getState();
    if (problem !== undefined) return notices.tell('warning', problemText(problem, group.source));
    replacing.download([{ slot, name, documentId, frames: group.frames }], {
      // The slot stays in sight, also when the download breaks it.
      began: ([stored]) => view.setState({ slot: stored?.slot ?? slot }),
    });
  };
  return (
    <Button
      icon="download"
      hint={words.board.downloadHint({ count: frameCount, slot })}
      isDisabled={!mayStart || !sameUnit || isEmpty}
      onPress={download}
    >
      {words.board.download}
    </Button>
  );
}
