// Saves the open group in a chosen format, and says before what the format cannot store.

import { useMemo, useState } from 'react';
import { fileNameOf } from '#shared/files/fileName.ts';
import type { Misfit } from '#shared/files/fit.ts';
import {
  lossesIn,
  EXTENSIONS,
  SAVE_FORMATS,
  writeGroupFile,
  type SaveFormat,
} from '#shared/files/writeGroupFile.ts';
import { useGroup, useKnownFamily, useRobot, useStores } from '../../stores.ts';
import { Button } from '../../../ui/Button.tsx';
import { saveBlob } from '../../../ui/localFiles.tsx';
import { Choice } from '../../../ui/Toggle.tsx';
import { lossText, misfitText } from './fileText.ts';
import { boardName } from '../../../i18n/sentences.ts';
import { words } from '../../../i18n/whole.ts';
import { fileMeans, loadSqlite } from './means.ts';
import styles from './SaveAs.module.css';

export function SaveAs() {
  const group = useGroup();
  const [format, setFormat] = useState<SaveFormat>('json');
  const losses = useMemo(() => lossesIn(format, group), [format, group]);
  if (group.frames.length === 0) return <p className={styles.dim}>{words.files.nothing}</p>;
  return (
    <>
      <div>
        <Choice<SaveFormat>
          label={words.files.save}
          value={format}
          options={SAVE_FORMATS.map((value) => ({ value, label: words.files.formats[value] }))}
          onChange={setFormat}
        />
      </div>
      <p>{words.files.formatAbout[format]}</p>
      {losses.length > 0 && (
        <ul className={styles.losses}>
          {losses.map((loss) => (
            <li key={loss.code}>{lossText(loss)}</li>
          ))}
        </ul>
      )}
      <Save key={format} format={format} />
    </>
  );
}

const isProgram = (format: SaveFormat): boolean => format === 'python' || format === 'arduino';

function Save({ format }: { readonly format: SaveFormat }) {
  const { notices } = useStores();
  const group = useGroup();
  const family = useKnownFamily();
  const robot = useRobot();
  const [misfits, setMisfits] = useState<readonly Misfit[]>([]);

  async function save(): Promise<void> {
    const { makeDatabase } = fileMeans(loadSqlite);
    const saved = await writeGroupFile(format, group, { family, robot }, makeDatabase);
    setMisfits('misfits' in saved ? saved.misfits : []);
    if ('content' in saved) saveBlob(saved.name, new Blob([saved.content]));
  }

  return (
    <>
      {isProgram(format) && (
        <p className={styles.dim}>{words.files.forBoard({ board: boardName(family) })}</p>
      )}
      <div>
        <Button
          icon="save"
          onPress={() => void save().catch(() => notices.tell('warning', words.files.saveFailed))}
        >
          {words.files.saveVerb({ name: fileNameOf(group, EXTENSIONS[format]) })}
        </Button>
      </div>
      <div role="status">
        {misfits.length > 0 && (
          <>
            <p className={styles.refused}>{words.files.notSaved}</p>
            <ul className={styles.losses}>
              {misfits.map((misfit) => (
                <li key={`${misfit.code} ${misfit.servo}`}>{misfitText(misfit)}</li>
              ))}
            </ul>
          </>
        )}
      </div>
    </>
  );
}
