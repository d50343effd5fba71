// What the group becomes on the board: whether it fits, what it costs, how far off it is and where, and what does not fit. A click
// on a place goes there.

import { blockIdOf, blocksOf } from '#shared/group/blocks.ts';
import { collisionText, problemText } from '../../board/compile/problems.tsx';
import { useState } from 'react';
import type { CompileProblem } from '#shared/group/compileReport.ts';
import { type ActionGroup, holdsMotion, MOST_ERROR_UNITS, maxErrorOf } from '#shared/group/group.ts';
import { tracksOf, type KeyRef } from '#shared/group/tracks.ts';
import { setMeta } from '#shared/group/groupEdits.ts';
import { select } from '../../servoView.ts';
import {
  editServoView,
  type Stores,
  useCollisions,
  useCompiled,
  useStores,
  useDocument,
  useKnownFamily,
} from '../../stores.ts';
import { showKey } from '../timeline/inStep.ts';
import { obstacles } from '../../board/compile/compiled.ts';
import { words } from '../../../i18n/whole.ts';
import { servoName } from '../../../i18n/sentences.ts';
import { Chip } from '../../../ui/Chip.tsx';
import { cx } from '../../../ui/cx.ts';
import { CheckedNumber } from '../../CheckedNumber.tsx';
import { useInFrame } from '../../../ui/useInFrame.ts';
import styles from './CompileRow.module.css';
import field from '../../../ui/Field.module.css';

// Where a line about the compiled group leads: the timeline comes to the front, the servo is selected, and its key
// where the line is about one, so that what is typed next mends it.

type Place = CompileProblem | { readonly servo: number; readonly atMs: number };

function goToPlace(stores: Stores, place: Place, group: ActionGroup): void {
  stores.view.setState({ tab: 'actions', authoring: 'group' });
  if ('servo' in place) editServoView(stores, (view) => select(view, [place.servo]));
  const key = keyOf(place, group);
  const block = 'frameId' in place ? blockOf(place, group) : undefined;
  if (key !== null) showKey(stores, key);
  else if (block !== undefined) stores.playhead.show(block.startMs);
  else if ('atMs' in place) stores.playhead.show(Math.round(place.atMs));
}

const blockOf = ({ frameId }: Pick<KeyRef, 'frameId'>, group: ActionGroup) =>
  blocksOf(group).find(({ id }) => id === blockIdOf(frameId));

/** Of a way that is too fast the key where it ends. */
function keyOf(place: Place, group: ActionGroup): KeyRef | null {
  if ('frameId' in place) return blockIdOf(place.frameId) === null ? place : null;
  if (!('kind' in place) || place.kind !== 'tooFast') return null;
  const { servo, atMs } = place;
  const keys = tracksOf(group).get(servo)?.keys ?? [];
  const offMs = (key: { readonly atMs: number }): number => Math.abs(key.atMs - atMs);
  return keys.toSorted((one, other) => offMs(one) - offMs(other))[0] ?? null;
}

// The list of what the board cannot do with the group, what is about all of it first; each line leads to its place.

const SHOWN = 4;
/** With each press; a group may have thousands. */
const MORE = 100;

function Problems() {
  const stores = useStores();
  const { report, source } = useCompiled((state) => state.latest);
  const [shown, setShown] = useState(SHOWN);
  const must = new Set(obstacles(report, 'board'));
  const rankOf = (problem: CompileProblem): number => (must.has(problem) ? Number('servo' in problem) : 2);
  const problems = report.problems.toSorted((one, other) => rankOf(one) - rankOf(other));
  const more = problems.length - shown;
  if (problems.length === 0) return null;
  return (
    <ul className={styles.problems} aria-label={words.compile.problems}>
      {problems.slice(0, shown).map((problem, index) => (
        <li key={index}>
          <button
            type="button"
            className={styles.place}
            onClick={() => goToPlace(stores, problem, source.group)}
          >
            {problemText(problem, source)}
          </button>
        </li>
      ))}
      {more > 0 && (
        <li>
          <button type="button" className={styles.place} onClick={() => setShown(shown + MORE)}>
            {words.compile.more({ count: more })}
          </button>
        </li>
      )}
    </ul>
  );
}

/** Warnings that a person may accept: where the robot may touch itself or the floor. */
function Collisions() {
  const stores = useStores();
  const { robot } = useCompiled((state) => state.latest.source);
  const places = useCollisions((state) => state.places);
  const [shown, setShown] = useState(SHOWN);
  const more = places.length - shown;
  if (places.length === 0) return null;
  const show = ({ servos, fromMs }: (typeof places)[number]): void => {
    stores.view.setState({ tab: 'actions', authoring: 'group' });
    editServoView(stores, (view) =>
      select(
        view,
        [...new Set(servos)].filter((servo) => servo !== null),
      ),
    );
    stores.playhead.show(Math.ceil(fromMs));
  };
  return (
    <ul className={cx(styles.problems, styles.warnings)} aria-label={words.collision.places}>
      {places.slice(0, shown).map((place, index) => (
        <li key={index}>
          <button type="button" className={styles.place} onClick={() => show(place)}>
            {collisionText(place, { robot })}
          </button>
        </li>
      ))}
      {more > 0 && (
        <li>
          <button type="button" className={styles.place} onClick={() => setShown(shown + MORE)}>
            {words.compile.more({ count: more })}
          </button>
        </li>
      )}
    </ul>
  );
}

export function CompileRow() {
  const { compiled } = useStores();
  const { latest, isFresh } = useInFrame(compiled.store, (state) => state);
  const { report, source } = latest;
  const isEmpty = !holdsMotion(source.group);
  const fits = obstacles(report, 'board').length === 0;
  return (
    <div className={styles.row} aria-busy={!isFresh}>
      <ErrorField />
      <div className={styles.report}>
        {isEmpty ? (
          <p className={styles.dim}>{words.compile.empty}</p>
        ) : (
          <>
            <p className={styles.figures}>
              <Chip truth={!isFresh ? 'neutral' : fits ? 'confirmed' : 'danger'}>
                {!isFresh ? words.compile.stale : fits ? words.compile.fits : words.compile.fitsNot}
              </Chip>
              <span>{words.compile.frames({ count: report.frameCount, limit: report.frameLimit })}</span>
              {report.downloadMs !== null && (
                <>
                  <span>{words.compile.bytes({ bytes: report.bytes })}</span>
                  <span>{words.compile.download({ ms: report.downloadMs })}</span>
                </>
              )}
            </p>
            <Worst />
            <Problems />
            <Collisions />
          </>
        )}
      </div>
    </div>
  );
}

/** The largest error that may be: how many frames it takes depends on it. The group keeps it. */
function ErrorField() {
  const { document } = useStores();
  const family = useKnownFamily();
  const value = useDocument(({ present }) => maxErrorOf(present, family));
  const isOfGroup = useDocument(({ present }) => !holdsMotion(present) || present.unit === family.unit);
  return (
    <div className={field.named} role="group" aria-label={words.compile.label}>
      <span className={styles.dim} aria-hidden="true">
        {words.compile.error}
      </span>
      <CheckedNumber
        label={words.compile.errorField}
        value={value}
        min={1}
        max={MOST_ERROR_UNITS}
        unit={words.units[family.unit]}
        isDisabled={!isOfGroup}
        onChange={(maxErrorUnits) =>
          document.edit(
            () => words.compile.step,
            (group) =>
              setMeta(holdsMotion(group) ? group : { ...group, unit: family.unit }, { maxErrorUnits }),
          )
        }
      />
    </div>
  );
}

function Worst() {
  const stores = useStores();
  const { worst, shiftedMs } = useCompiled((state) => state.latest.report);
  const { group, robot } = useCompiled((state) => state.latest.source);
  if (worst === null) return <p className={styles.dim}>{words.compile.exact}</p>;
  const { servo, atMs, units, degrees } = worst;
  return (
    <p className={styles.figures}>
      <button
        type="button"
        className={styles.place}
        onClick={() => goToPlace(stores, { servo, atMs }, group)}
      >
        {words.compile.worst({
          error: words.position[group.unit]({ position: Math.round(units) }),
          degrees: words.numbers.formatDegrees(degrees, 1),
          name: servoName(robot, servo),
          atMs,
        })}
      </button>
      {shiftedMs > 0 && <span>{words.compile.shifted({ ms: Math.ceil(shiftedMs) })}</span>}
    </p>
  );
}
