// The open group as the board would get it, with what does not fit: compiled in a worker between gestures, because a large group takes as long as
// ten frames of the screen, or at once by the compiler that comes with the modules that send. Moves nothing.

import { createStore, type StoreApi } from 'zustand/vanilla';
import type { CompileProblem } from '#shared/group/compileReport.ts';
import { type ActionGroup, holdsMotion, maxErrorOf, groupToText } from '#shared/group/group.ts';
import type { Clock } from '#shared/clock.ts';
import type { Device } from '../../../robot/device.ts';
import { type Document, knownFamily } from '../../groupDocument.ts';
import type { RobotStore } from '../../profiles/robots.ts';
import { setChanged } from '../../../state/store.ts';
import type { Source, CompileResult } from './compileSource.ts';
import { framesOf } from '#shared/group/fingerprint.ts';
import type { Answer, Order } from './compileWorker.ts';

export interface CompiledGroup extends CompileResult {
  readonly source: Source;
}

export interface CompiledState {
  readonly latest: CompiledGroup;
  /** False while the group is being changed: the latest is of an earlier one. */
  readonly isFresh: boolean;
}

export interface CompiledStore {
  readonly store: StoreApi<CompiledState>;
  /** Of the group as it is now. `compile` is `compileSource`, which the first load leaves out. */
  now(compile: Compile): CompiledGroup;
  /** Of another group; one that was requested before is not computed again. */
  of(group: ActionGroup, on: Pick<Source, 'family' | 'robot'>, compile: Compile): CompiledGroup;
}

type Compile = (source: Source) => CompileResult;

/** After the last change: a typing hand is faster. */
const QUIET_MS = 250;

export interface CompiledOptions {
  readonly document: Document;
  readonly device: Device;
  readonly robots: RobotStore;
  readonly clock: Clock;
  /** Compiles a group while the page continues. */
  compileElsewhere(source: Source): Promise<CompileResult>;
}

export function createCompiled({
  document,
  device,
  robots,
  clock,
  compileElsewhere,
}: CompiledOptions): CompiledStore {
  let cancelTimer = (): void => undefined;
  let isBusy = false;
  const others = new WeakMap<ActionGroup, CompiledGroup>();

  function wanted(): Source {
    const { robot } = robots.current();
    const family = knownFamily(device.store.getState().family, robot);
    return sourceOf(document.store.getState().present, { family, robot });
  }
  const store = createStore<CompiledState>(() => ({ latest: nothingOf(wanted()), isFresh: true }));

  /** The first one of a group with motion is still to come. */
  let isMade = !holdsMotion(wanted().group);

  const isLatest = (source: Source): boolean => isMade && isSame(source, store.getState().latest.source);

  function put(latest: CompiledGroup): void {
    isMade = true;
    store.setState({ latest, isFresh: true });
  }

  function now(compile: Compile): CompiledGroup {
    cancelTimer();
    const source = wanted();
    if (!isLatest(source)) put({ source, ...compile(source) });
    else setChanged(store, { isFresh: true });
    return store.getState().latest;
  }

  /** One at a time; what has changed meanwhile is worked out next. */
  async function workOut(): Promise<void> {
    if (isBusy) return;
    isBusy = true;
    const source = wanted();
    const result = await compileElsewhere(source)
      .catch(async () => (await import('./compileSource.ts')).compileSource(source))
      .catch(() => null);
    isBusy = false;
    // Neither can be had: the next change tries again.
    if (result === null) return;
    if (isSame(source, wanted()) && !isLatest(source)) put({ source, ...result });
    else touched();
  }

  function of(group: ActionGroup, on: Pick<Source, 'family' | 'robot'>, compile: Compile): CompiledGroup {
    const source = sourceOf(group, on);
    const before = others.get(group);
    if (before !== undefined && isSame(source, before.source)) return before;
    const made = { source, ...compile(source) };
    others.set(group, made);
    return made;
  }

  function touched(): void {
    const isFresh = isLatest(wanted());
    if (isFresh && store.getState().isFresh) return;
    cancelTimer();
    setChanged(store, { isFresh });
    if (!isFresh && document.store.getState().gesture === null)
      cancelTimer = clock.after(QUIET_MS, () => void workOut());
  }

  document.store.subscribe(touched);
  robots.store.subscribe(touched);
  device.store.subscribe(({ family }, before) => {
    if (family !== before.family) touched();
  });

  touched();

  return { store, now, of };
}

const sourceOf = (group: ActionGroup, { family, robot }: Pick<Source, 'family' | 'robot'>): Source => ({
  ...{ group, family, robot, maxErrorUnits: maxErrorOf(group, family) },
});

/** Before the first one is there. */
const nothingOf = (source: Source): CompiledGroup => ({
  ...{ source, frames: [], fingerprint: '' },
  report: {
    ...{ frameCount: 0, frameLimit: source.family.framesPerGroup, durationMs: 0, bytes: 0, downloadMs: null },
    ...{ worst: null, shiftedMs: 0, problems: [] },
  },
});

const isSame = (one: Source, other: Source): boolean =>
  (Object.keys(one) as (keyof Source)[]).every((key) => one[key] === other[key]);

/** Warnings that a person may accept: the servo comes later than the group says. */
const REMARKS: readonly CompileProblem['kind'][] = ['tooFast'];
/** The page sends as much as there is, in as many packets as it takes. */
const BOARD_ONLY: readonly CompileProblem['kind'][] = ['tooManyFrames', 'tooManyServos'];

/** What keeps the group from being played: from the page, or by the board. */
export function obstacles(
  { problems }: CompiledGroup['report'],
  by: 'page' | 'board',
): readonly CompileProblem[] {
  return problems.filter(
    ({ kind }) => !REMARKS.includes(kind) && (by === 'board' || !BOARD_ONLY.includes(kind)),
  );
}

/** Rejects where no worker can be had. */
export function createCompileWorker(): (source: Source) => Promise<CompileResult> {
  let beside: Beside | null = null;

  return async ({ group, ...options }) => {
    beside ??= start();
    const { worker, failed } = beside;
    const { port1, port2 } = new MessageChannel();
    const answered = new Promise<Answer>((resolve) =>
      port1.addEventListener('message', ({ data }: MessageEvent<Answer>) => resolve(data), { once: true }),
    );
    port1.start();
    // As text: to copy thousands of objects takes the page longer than what it is spared.
    worker.postMessage({ groupText: groupToText(group), options } satisfies Order, [port2]);
    const { numbers, ...rest } = await Promise.race([answered, failed]).finally(() => port1.close());
    return { ...rest, frames: framesOf(numbers) };
  };
}

interface Beside {
  readonly worker: Worker;
  readonly failed: Promise<never>;
}

function start(): Beside {
  const worker = new Worker(new URL('./compileWorker.ts', import.meta.url), { type: 'module' });
  const failed = new Promise<never>((_, reject) =>
    worker.addEventListener('error', () => reject(new Error('the worker beside the page failed')), {
      once: true,
    }),
  );
  failed.catch(() => undefined);
  return { worker, failed };
}
