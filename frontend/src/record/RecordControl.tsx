// Recording by hand: on purpose, from a press to the next one, or after the fact, what moved in the last two minutes.

import { useEffect, useEffectEvent, useState } from 'react';
import { useStore } from 'zustand';
import type { Sample } from '#shared/actions/group/simplify.ts';
import { servoViewOf, useRobot, useServoView, useStores } from '../stores/stores.ts';
import { Button } from '../ui/Button.tsx';
import { isTextField } from '../ui/textField.ts';
import { useNow } from '../ui/useNow.ts';
import { words } from '../words/words.ts';
import { TakeDialog } from './TakeDialog.tsx';

const TAKE_KEY = 't';

export function RecordControl() {
  const { notices, tape, robots, ...stores } = useStores();
  const [taken, setTaken] = useState<readonly Sample[]>([]);
  const sinceMs = useStore(tape.store, (state) => state.recordingSinceMs);
  const take = (samples: readonly Sample[]): void => {
    if (samples.length === 0) notices.tell('info', words.record.nothing);
    setTaken(samples);
  };
  useKey(TAKE_KEY, () => take(tape.takeThat()));
  return (
    <>
      <Record
        sinceMs={sinceMs}
        onBegin={() => tape.record()}
        onEnd={() =>
          take(tape.end(armed(servoViewOf({ ...stores, robots }).selected, robots.current().robot)))
        }
      />
      <Button tone="quiet" hint={words.record.takeThatHint} onPress={() => take(tape.takeThat())}>
        {words.record.takeThat}
      </Button>
      <TakeDialog samples={taken} onClose={() => setTaken([])} />
    </>
  );
}

/** The selected servos, or, where none is selected, all of them. */
function armed(
  selected: readonly number[],
  { servos }: { readonly servos: readonly { readonly servo: number }[] },
): readonly number[] {
  return selected.length > 0 ? selected : servos.map(({ servo }) => servo);
}

interface RecordProps {
  /** null: nothing is recorded. */
  readonly sinceMs: number | null;
  onBegin(): void;
  onEnd(): void;
}

/** One button for both: the focus is still on it when the recording is to end. */
function Record({ sinceMs, onBegin, onEnd }: RecordProps) {
  const robot = useRobot();
  const selected = useServoView((view) => view.selected);
  const count = armed(selected, robot).length;
  const hint = `${words.record.recordHint}. ${words.record.armed(count, robot.servos.length)}`;
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
  return words.record.end(Math.max(0, nowMs - sinceMs));
}

/** A plain key, anywhere but where one writes. */
function useKey(wanted: string, pressed: () => void): void {
  const press = useEffectEvent((event: KeyboardEvent) => {
    const isPlain = !event.ctrlKey && !event.metaKey && !event.altKey && !event.repeat;
    if (event.key.toLowerCase() === wanted && isPlain && !isTextField(event.target)) pressed();
  });
  useEffect(() => {
    const listen = (event: KeyboardEvent): void => press(event);
    window.addEventListener('keydown', listen);
    return () => window.removeEventListener('keydown', listen);
  }, []);
}
