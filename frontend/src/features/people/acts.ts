// What people did at the gateway, for owners: read by pages, the newest first, and as a file. Failures reach `failed`.

import * as v from 'valibot';
import { createStore, type StoreApi } from 'zustand/vanilla';
import type { AuditEntry, AuditPage } from '#shared/client/http.generated.ts';
import { words } from '../../i18n/whole.ts';
import { request, requestText } from '../../robot/request.ts';

export type Act = AuditEntry['act'];

/** '' is any. */
export interface ActFilter {
  readonly act: Act | '';
  readonly who: string;
}

export interface ActsState {
  /** null until they were read. */
  readonly entries: readonly AuditEntry[] | null;
  readonly hasOlder: boolean;
  readonly names: readonly string[];
  /** Why the list is not stored at present. */
  readonly problem: string | null;
  readonly filter: ActFilter;
}

/** Each rejects with a GatewayProblem, or a ValiError. */
export interface ActsApi {
  /** `before`: only older ones than that entry. */
  read(filter: ActFilter, before?: number): Promise<AuditPage>;
  /** All that the filter lets through, as CSV. */
  file(filter: ActFilter): Promise<string>;
}

export interface Acts {
  readonly store: StoreApi<ActsState>;
  refresh(): Promise<void>;
  showOlder(): Promise<void>;
  setFilter(filter: ActFilter): Promise<void>;
  /** null where it cannot be read. */
  file(): Promise<string | null>;
}

const EVERYTHING: ActFilter = { act: '', who: '' };

export function createActs(api: ActsApi, failed: (error: unknown) => void): Acts {
  const store = createStore<ActsState>(() => ({
    entries: null,
    hasOlder: false,
    names: [],
    problem: null,
    filter: EVERYTHING,
  }));

  /** What is read under a filter that has been replaced meanwhile is dropped. */
  async function read(before?: number): Promise<AuditPage | null> {
    const { filter } = store.getState();
    try {
      const page = await api.read(filter, before);
      return store.getState().filter === filter ? page : null;
    } catch (error) {
      failed(error);
      return null;
    }
  }

  /** Older pages that were read stay, unless more has happened since than a page holds. */
  async function refresh(): Promise<void> {
    const page = await read();
    if (page === null) return;
    const { entries, hasOlder } = store.getState();
    const last = page.entries.at(-1)?.id ?? 0;
    const older = entries?.filter(({ id }) => id < last) ?? [];
    const isJoined = entries?.some(({ id }) => id >= last) === true;
    store.setState({
      entries: isJoined ? [...page.entries, ...older] : page.entries,
      hasOlder: isJoined && older.length > 0 ? hasOlder : page.more,
      names: page.names,
      problem: page.problem,
    });
  }

  return {
    store,
    refresh,
    async showOlder() {
      const page = await read(store.getState().entries?.at(-1)?.id);
      const { entries } = store.getState();
      if (page !== null)
        store.setState({ entries: [...(entries ?? []), ...page.entries], hasOlder: page.more });
    },
    async setFilter(filter) {
      store.setState({ filter, entries: null, hasOlder: false });
      await refresh();
    },
    file: () =>
      api.file(store.getState().filter).catch((error: unknown) => {
        failed(error);
        return null;
      }),
  };
}

const DAY_MS = 86_400_000;
const WITH_SLOT: ReadonlySet<Act> = new Set(['ran', 'downloaded', 'downloadFailed', 'setSpeed']);

/** To whom or about what, and how often until when. */
export function detailsOf({ act, whom, about, count, atMs, untilMs }: AuditEntry): string {
  const { formatTimeOfDay, formatMoment } = words.dates;
  const when = untilMs - atMs < DAY_MS ? formatTimeOfDay(untilMs) : formatMoment(untilMs);
  const times = count > 1 ? [words.acts.times({ count }), words.acts.until({ when })] : [];
  return [whom, aboutText(act, about), ...times].filter((part) => part !== '').join(' · ');
}

function aboutText(act: Act, about: string): string {
  if (about === '') return '';
  if (WITH_SLOT.has(act)) return words.acts.slot({ slot: about });
  if (act === 'calibrated') return words.acts.servo({ servo: about });
  const { causes } = words.acts;
  const { roleNames } = words.people;
  if (act === 'stopped' && about in causes) return causes[about as keyof typeof causes];
  return about in roleNames ? roleNames[about as keyof typeof roleNames] : about;
}

export const actNames = (): readonly Act[] => Object.keys(words.acts.kinds) as Act[];

const WITHIN_MS = 4000;
const FILE_WITHIN_MS = 20_000;

const number = v.pipe(v.number(), v.finite());
const pageSchema: v.GenericSchema<unknown, AuditPage> = v.object({
  entries: v.array(
    v.object({
      id: number,
      act: v.pipe(
        v.string(),
        v.check((act) => act in words.acts.kinds),
        v.transform((act) => act as Act),
      ),
      who: v.nullable(v.string()),
      whom: v.string(),
      about: v.string(),
      atMs: number,
      untilMs: number,
      count: number,
    }),
  ),
  more: v.boolean(),
  names: v.array(v.string()),
  problem: v.nullable(v.string()),
});

const queryOf = ({ act, who }: ActFilter) => ({ ...(act !== '' && { act }), ...(who !== '' && { who }) });

export const actsApi: ActsApi = {
  async read(filter, before) {
    const query = { ...queryOf(filter), ...(before !== undefined && { before }) };
    return v.parse(pageSchema, await request('get', '/api/audit', { query, withinMs: WITHIN_MS }));
  },
  file: (filter) =>
    requestText(
      `api/audit/file?${new URLSearchParams({ format: 'csv', ...queryOf(filter) }).toString()}`,
      FILE_WITHIN_MS,
    ),
};
