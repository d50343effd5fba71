// Motions to try on a simulated robot, one press each: an example becomes the open group, as one step, and is played.

import { examplesFor, type ExampleId } from '#shared/group/examples/examples.ts';
import { useStore } from 'zustand';
import { takeExample } from '../../features/animate/group/ExamplesControl.tsx';
import { PLAY } from '../../features/animate/play/playActions.ts';
import {
  useDevice,
  useDocument,
  useHoldsMotion,
  useRobot,
  useSnapshot,
  useStores,
} from '../../features/stores.ts';
import { words } from '../../i18n/whole.ts';
import { startHindrance } from '../../robot/readiness.ts';
import { Button } from '../../ui/Button.tsx';
import styles from './TryMotion.module.css';

const SHOWN = 3;

/** While nothing of one's own is written. */
export function TryMotion() {
  const stores = useStores();
  const { device, document, playback, view, playhead } = stores;
  const robot = useRobot();
  const isSimulated = useDevice(({ way }) => way?.isSimulated === true);
  const name = useDocument(({ present }) => present.name);
  const isEmpty = !useHoldsMotion();
  const isBlocked = useSnapshot((snapshot) => startHindrance(snapshot) !== null);
  const isPlaying = useStore(playback.store, ({ phase }) => phase !== null);
  const ids = examplesFor(robot);
  const opened = isEmpty ? undefined : ids.find((id) => words.examples.names[id] === name);
  if (!isSimulated || (!isEmpty && opened === undefined) || ids.length === 0) return null;

  function play(id: ExampleId): void {
    if (id === opened) playhead.show(0);
    else takeExample(stores, id);
    const context = { playback, device, document };
    if (PLAY.enabled(context) === true) PLAY.run(context);
  }
  return (
    <div className={styles.row} role="group" aria-label={words.workspace.try}>
      <span className={styles.label}>{words.workspace.try}</span>
      {ids.slice(0, SHOWN).map((id) => (
        <Button key={id} icon="play" isDisabled={isPlaying || isBlocked} onPress={() => play(id)}>
          {words.examples.names[id]}
        </Button>
      ))}
      {opened !== undefined && (
        <Button
          tone="quiet"
          icon="frames"
          onPress={() => view.setState({ tab: 'actions', authoring: 'group' })}
        >
          {words.workspace.seeHow}
        </Button>
      )}
    </div>
  );
}
