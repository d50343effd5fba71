// Poses to a file and from one. An import adds to what is there.

import { useRef } from 'react';
import { poseBookToText } from '#shared/profile/pose.ts';
import { saveFile } from '../../ui/saveFile.ts';
import { usePoses, useRobot, useStores } from '../stores.ts';
import { IconButton } from '../../ui/Button.tsx';
import { words } from '../../i18n/whole.ts';

export function PoseFiles() {
  const { poses, notices } = useStores();
  const book = usePoses(({ present }) => present);
  const { name } = useRobot();
  const input = useRef<HTMLInputElement>(null);

  function take(files: FileList | null): void {
    files?.[0]?.text().then(poses.importText, () => notices.tell('warning', words.poses.unreadableFile));
  }

  return (
    <>
      <input
        ref={input}
        type="file"
        accept=".json,application/json"
        hidden
        onChange={({ target }) => {
          take(target.files);
          // The same file may be chosen again.
          target.value = '';
        }}
      />
      <IconButton icon="upload" label={words.poses.import} onPress={() => input.current?.click()} />
      <IconButton
        icon="save"
        label={words.poses.export}
        isDisabled={book.poses.length === 0}
        onPress={() =>
          saveFile({ name: `${words.poses.fileName({ robot: name })}.json`, text: poseBookToText(book) })
        }
      />
    </>
  );
}
