// Recording by hand: on purpose, from a press to the next one, over the motion that plays meanwhile, or after the fact, what moved in
// the last two minutes.

import { useStore } from 'zustand';
import { holdsMotion } from '#shared/group/group.ts';
import { recorded } from '../../servoView.ts';
import {
  useDevice,
  useDocument,
  usePlayback,
  useRobot,
  useServoView,
  useSnapshot,
  useStores,
} from '../../stores.ts';
import { startHindrance } from '../../../robot/readiness.ts';
import { Button, ActionButton } from '../../../ui/Button.tsx';
import { useNow } from '../../../ui/useEachFrame.ts';
import { say } from '../../../i18n/sentences.ts';
import { words } from '../../../i18n/whole.ts';
import { RECORD_OVER } from './recordOver.ts';
import { endRecording, KEEP_LAST } from './TakeDialog.tsx';

export function RecordControl() {
  const stores = useStores();
  const { tape } = stores;
  const sinceMs = useStore(tape.store, (state) => state.recordingSinceMs);
  return (
    <>
      <Record sinceMs={sinceMs} onBegin={() => tape.record()} onEnd={() => endRecording(stores)} />
      <ActionButton
        tone="quiet"
        hint={words.record.takeThatHint}
        action={KEEP_LAST}
        shown={stores}
        context={() => stores}
      />
      <RecordOver />
    </>
  );
}

/** There once rows are armed. */
function RecordOver() {
  const stores = useStores();
  const isShown = useServoView(({ armed, overdubbed }) => armed.length + overdubbed.length > 0);
  const isOn = useServoView(({ overdubbed }) => overdubbed.length > 0);
  usePlayback(({ phase }) => phase === null);
  useDocument(({ present }) => `${present.unit} ${holdsMotion(present)}`);
  useSnapshot(startHindrance);
  useDevice(({ family }) => family);
  useDevice(({ known }) => known);
  if (!isShown) return null;
  const may = RECORD_OVER.enabled(stores);
  return (
    <Button
      tone={isOn ? 'plain' : 'quiet'}
      icon={isOn ? 'end' : RECORD_OVER.icon}
      hint={words.record.overMotion.hint}
      whyNot={may === true ? undefined : may}
      onPress={() => RECORD_OVER.run(stores)}
    >
      {RECORD_OVER.label(stores)}
    </Button>
  );
}

interface RecordProps {
  /** null: nothing is recorded. */
  readonly sinceMs: number | null;
  onBegin(): void;
  onEnd(): void;
}

/** One button for both: the focus is still on it when the recording is to end. */
function Record({ sinceMs, onBegin, onEnd }: RecordProps) {
  const all = useRobot().servos.map(({ servo }) => servo);
  const { servos, by } = recorded(
    useServoView((view) => view),
    all,
  );
  const hint = `${words.record.recordHint}. ${say(words.record.keeps[by], { count: servos.length, all: all.length })}`;
  return (
    <Button
      tone={sinceMs === null ? 'quiet' : 'plain'}
      icon={sinceMs === null ? 'record' : 'end'}
      hint={hint}
      onPress={sinceMs === null ? onBegin : onEnd}
    >
      {sinceMs === null ? words.record.record : <EndWords sinceMs={sinceMs} />}
    </Button>
  );
}

function EndWords({ sinceMs }: { readonly sinceMs: number }) {
  const { device } = useStores();
  const nowMs = useNow(device.clock.now, 500);
  return words.record.end({ ms: Math.max(0, nowMs - sinceMs) });
}
