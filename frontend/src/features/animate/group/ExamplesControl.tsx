// Groups to begin with, as pictures; the one that is chosen takes the place of the open group, as one step.

import { useState } from 'react';
import { exampleGroup, examplesFor, type ExampleId } from '#shared/group/examples/examples.ts';
import { poseAt, totalDurationMs } from '#shared/group/group.ts';
import { PoseThumb } from '../../picture/PoseThumb.tsx';
import { useDevice, useHoldsMotion, useRobot, useStores, type Stores } from '../../stores.ts';
import { Button } from '../../../ui/Button.tsx';
import { Dialog } from '../../../ui/Dialog.tsx';
import { words } from '../../../i18n/whole.ts';
import styles from './Examples.module.css';

export function ExamplesControl() {
  const [isOpen, setOpen] = useState(false);
  const isEmpty = !useHoldsMotion();
  const isUnit = useDevice((state) => state.family.id !== 'unknown');
  return (
    <>
      <Button tone={isEmpty ? 'plain' : 'quiet'} isDisabled={!isUnit} onPress={() => setOpen(true)}>
        {isEmpty ? words.examples.begin : words.examples.open}
      </Button>
      <Dialog
        wide
        title={words.examples.title}
        closeLabel={words.close}
        isOpen={isOpen}
        onClose={() => setOpen(false)}
      >
        <p className={styles.intro}>{words.examples.intro}</p>
        <ExampleList onChosen={() => setOpen(false)} />
      </Dialog>
    </>
  );
}

export function ExampleList({ onChosen }: { onChosen(): void }) {
  const robot = useRobot();
  return (
    <ul className={styles.list} aria-label={words.examples.title}>
      {examplesFor(robot).map((id) => (
        <li key={id}>
          <ExampleCard id={id} onChosen={onChosen} />
        </li>
      ))}
    </ul>
  );
}

/** It takes the place of the open group, as one step. */
export function takeExample({ document, view, playhead, robots }: Stores, id: ExampleId): void {
  const name = words.examples.names[id];
  const group = exampleGroup(id, robots.current().robot, name);
  document.edit(
    () => words.examples.step({ name: words.examples.names[id] }),
    () => group,
  );
  view.setState({ selectedFrame: null });
  playhead.show(0);
}

function ExampleCard({ id, onChosen }: { readonly id: ExampleId; onChosen(): void }) {
  const stores = useStores();
  const robot = useRobot();
  const family = useDevice((state) => state.family);
  const name = words.examples.names[id];
  const group = exampleGroup(id, robot, name);
  const { frames } = group;
  const choose = (): void => {
    takeExample(stores, id);
    onChosen();
  };
  return (
    <button type="button" className={styles.card} onClick={choose}>
      <PoseThumb pose={poseAt(frames, Math.floor(frames.length / 2))} changed={[]} family={family} />
      <span className={styles.name}>{name}</span>
      <span className={styles.about}>
        {words.examples.about({ frameCount: frames.length, durationMs: totalDurationMs(frames) })}
      </span>
    </button>
  );
}
