// The dialog about files, with those that were opened and not yet taken over: it is there while it is closed.

import { useCallback, useEffect, useRef, useState } from 'react';
import { useStore } from 'zustand';
import type { ActionGroup } from '#shared/group/group.ts';
import { useStores } from '../../stores.ts';
import { Dialog } from '../../../ui/Dialog.tsx';
import { words } from '../../../i18n/whole.ts';
import { countsOf, type FileCounts, type ReadyGroup } from './answers.ts';
import { createFileReader } from './fileReader.ts';
import { FilesContent } from './FilesContent.tsx';
import { createOpenedFiles } from './openedFiles.ts';
import { takeGroup, takeGroups } from './takeGroups.ts';

interface FilesDialogProps {
  /** Each list of them is opened once. */
  readonly dropped: readonly File[];
  readonly isOpen: boolean;
  onClose(): void;
  onCounts(counts: FileCounts): void;
}

export function FilesDialog({ dropped, isOpen, onClose, onCounts }: FilesDialogProps) {
  const stores = useStores();
  const [files] = useState(() => createOpenedFiles(createFileReader()));
  const opened = useStore(files.store, ({ list }) => countsOf(list).opened);
  const refused = useStore(files.store, ({ list }) => countsOf(list).refused);
  useEffect(() => onCounts({ opened, refused }), [opened, refused, onCounts]);
  const seen = useRef<readonly File[]>(null);
  useEffect(() => {
    if (seen.current !== dropped) files.open(dropped);
    seen.current = dropped;
  }, [files, dropped]);
  const take = useCallback(
    (group: ActionGroup): void => {
      takeGroup(stores, group);
      onClose();
    },
    [stores, onClose],
  );
  async function takeAll(ready: readonly ReadyGroup[]): Promise<void> {
    const isDone = await files.take(ready, (groups, course) => takeGroups(stores, groups, course));
    if (isDone) onClose();
  }
  return (
    <Dialog title={words.files.title} closeLabel={words.close} wide isOpen={isOpen} onClose={onClose}>
      <FilesContent files={files} onTake={take} onTakeAll={(ready) => void takeAll(ready)} />
    </Dialog>
  );
}
