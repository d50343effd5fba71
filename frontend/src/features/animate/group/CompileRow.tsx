// What the group becomes on the board: whether it fits, what it costs, how far off it is and where, and what does not fit. A click
// on a place goes there.

import { MOST_ERROR_UNITS, maxErrorOf } from '#shared/group/group.ts';
import { setMeta } from '#shared/group/groupEdits.ts';
import { obstacles } from './compiled.ts';
import { useCompiled, useDocument, useKnownFamily, useStores } from '../../stores.ts';
import { servoName } from '../../profiles/servoName.ts';
import { Chip } from '../../../ui/Chip.tsx';
import { NumberField } from '../../../ui/NumberField.tsx';
import { useInFrame } from '../../../ui/useInFrame.ts';
import { words } from '../../../i18n/whole.ts';
import { goToPlace } from './places.ts';
import { Problems } from './Problems.tsx';
import field from '../../../ui/Field.module.css';
import styles from './CompileRow.module.css';

export function CompileRow() {
  const { compiled } = useStores();
  const { latest, isFresh } = useInFrame(compiled.store, (state) => state);
  const { report, source } = latest;
  const isEmpty = source.group.frames.length === 0;
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
          </>
        )}
      </div>
    </div>
  );
}

/** The largest error that may be: how many frames it takes depends on it. The group keeps it. */
function ErrorField() {
  const { document, notices } = useStores();
  const family = useKnownFamily();
  const value = useDocument(({ present }) => maxErrorOf(present, family));
  const isOfGroup = useDocument(({ present }) => present.frames.length === 0 || present.unit === family.unit);
  return (
    <div className={field.named} role="group" aria-label={words.compile.label}>
      <span className={styles.dim} aria-hidden="true">
        {words.compile.error}
      </span>
      <NumberField
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
              setMeta(group.frames.length === 0 ? { ...group, unit: family.unit } : group, { maxErrorUnits }),
          )
        }
        onRefused={(units) =>
          notices.refuse(
            words.refused({ name: words.compile.errorField, value: units, min: 1, max: MOST_ERROR_UNITS }),
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
