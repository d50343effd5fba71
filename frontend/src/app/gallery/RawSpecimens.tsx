// The sender of packets by hand in each of its cases.

import { FAMILIES, type FamilyId } from '#shared/codec/families.ts';
import { RawForm } from '../../features/log/LogPanel.tsx';
import { judgeText } from '../../features/log/packetText.ts';
import { words } from '../../i18n/whole.ts';
import type { Exhibit } from './exhibit.ts';

interface Case {
  readonly name: string;
  readonly text: string;
  readonly board?: FamilyId;
  readonly isConsented?: boolean;
  readonly isStopped?: boolean;
}

const CASES: readonly Case[] = [
  { name: 'By hand, empty', text: '' },
  { name: 'By hand, not whole', text: '55 55 08 03 01' },
  { name: 'By hand, refused', text: '55 55 02 0C', board: 'learm-esp32', isConsented: true },
  { name: 'By hand, not switched on', text: '55 55 02 0F' },
  { name: 'By hand, ready', text: '55 55 02 0F', isConsented: true },
  {
    name: 'By hand, stopped',
    text: '55 55 05 06 08 01 00',
    isConsented: true,
    isStopped: true,
  },
];

export const RAW: readonly Exhibit[] = CASES.map(({ name, ...rest }) => ({
  name,
  content: <Typed {...rest} />,
}));

function Typed({ text, board = 'doc', isConsented = false, isStopped = false }: Omit<Case, 'name'>) {
  const nothing = (): void => undefined;
  const obstacle = isStopped ? words.raw.waits : null;
  const judged = judgeText(text, FAMILIES[board]);
  return (
    <RawForm
      {...{ text, judged, obstacle, isConsented }}
      maySend={isConsented && judged.packet !== null && obstacle === null}
      onText={nothing}
      onConsent={nothing}
      onSend={nothing}
    />
  );
}
