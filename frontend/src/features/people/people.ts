// This page's identity at the gateway, and for owners the devices, tokens, stop-only links and the open invitation, with the HTTP requests
// for them. A used invitation is replaced by a new one, so that a class can join one after the other. Every failure is a PeopleError.

import { createStore, type StoreApi } from 'zustand/vanilla';
import { words } from '../../i18n/words.ts';
import type { Notices } from '../../state/notices.ts';
import type {
  Invitation,
  InviteWish,
  Me,
  People,
  PersonChange,
  StopLink,
  Token,
  TokenWish,
  You,
  PairWish,
} from '#shared/client/http.generated.ts';
import * as v from 'valibot';
import { requestsOf } from '../../robot/request.ts';

/** Why pairing or a change of people failed. */
export type PeopleErrorCode = 'unreachable' | 'notPaired' | 'failed' | 'locked' | 'refused';

export function peopleProblem(code: PeopleErrorCode, detail: string): string {
  return code === 'refused' && detail !== ''
    ? words.people.refusedBecause({ detail })
    : words.people.problems[code];
}

export type PersonRole = InviteWish['role'];
/** Days for which a token is valid; null: until it is revoked. */
export const VALIDITIES = { day: 1, month: 30, year: 365, unlimited: null } as const;
export type Validity = keyof typeof VALIDITIES;

export const PERSON_ROLES: readonly PersonRole[] = ['viewer', 'driver', 'owner'];

/** Each rejects with a PeopleError. */
export interface PeopleApi {
  /** null where no gateway answers. */
  me(): Promise<Me | null>;
  sayName(name: string): Promise<You>;
  list(): Promise<People>;
  invite(wish: InviteWish): Promise<Invitation>;
  withdraw(invitation: string): Promise<void>;
  change(person: string, wanted: PersonChange): Promise<void>;
  /** `continues`: the device's unattended run is not stopped. */
  revoke(person: string, continues: boolean): Promise<void>;
  makeToken(wish: TokenWish): Promise<Token>;
  makeStopLink(name: string): Promise<StopLink>;
}

export class PeopleError extends Error {
  constructor(
    readonly code: PeopleErrorCode,
    message: string,
    options?: ErrorOptions,
  ) {
    super(message, options);
  }
}

export interface OpenInvitation extends Invitation {
  readonly role: PersonRole;
  /** On the page's clock. */
  readonly untilMs: number;
}

/** Shown once: a token, or a stop-only link to print. */
export type Shown =
  | { readonly kind: 'token'; readonly name: string; readonly token: string }
  | { readonly kind: 'stopLink'; readonly name: string; readonly link: string; readonly picture: string };

export interface PeopleState {
  /** null without a gateway. */
  readonly me: Me | null;
  readonly people: People['people'];
  readonly invitation: OpenInvitation | null;
  readonly shown: Shown | null;
}

export interface PeopleStore {
  readonly store: StoreApi<PeopleState>;
  refresh(): Promise<void>;
  sayName(name: string): void;
  invite(role: PersonRole, name: string): void;
  endInvitation(): void;
  change(person: string, wanted: PersonChange): void;
  revoke(person: string, continues: boolean): void;
  makeToken(name: string, role: PersonRole, validity: Validity): void;
  makeStopLink(name: string): void;
  closeShown(): void;
}

/** The actions of the views. */
export type PeopleWishes = Omit<PeopleStore, 'store' | 'refresh'>;

interface PeopleOptions {
  readonly api: PeopleApi;
  readonly me: Me | null;
  readonly notices: Pick<Notices, 'show'>;
  now(): number;
}

export const managesPeople = (me: Me | null): boolean => me?.mode !== 'local' && me?.you?.role === 'owner';

export const titleFor = (me: Me | null): string =>
  managesPeople(me) ? words.people.title : words.people.own.title;

export function createPeople({ api, me, notices, now }: PeopleOptions): PeopleStore {
  const store = createStore<PeopleState>(() => ({ me, people: [], invitation: null, shown: null }));

  const showError = (error: unknown): void => {
    if (!(error instanceof PeopleError)) throw error;
    notices.show('danger', peopleProblem(error.code, error.message));
  };

  function known(you: You): void {
    const { me: before } = store.getState();
    if (before !== null) store.setState({ me: { ...before, you } });
  }

  /** Only owners can list other people. */
  async function refresh(): Promise<void> {
    if (!managesPeople(store.getState().me)) {
      const now = await api.me();
      if (now?.you) known(now.you);
      return;
    }
    const { people, openInvites, openCodes } = await api.list();
    store.setState({ people });
    const { invitation } = store.getState();
    const isUsed = invitation !== null && now() < invitation.untilMs && !openInvites.includes(invitation.id);
    if (isUsed) await open(invitation.role, '');
    else if (invitation !== null && !openCodes.includes(invitation.id))
      store.setState({ invitation: { ...invitation, code: null } });
  }

  async function open(role: PersonRole, name: string): Promise<void> {
    const made = await api.invite({ role, name });
    store.setState({ invitation: { ...made, role, untilMs: now() + made.expiresInMs } });
  }

  function act(work: () => Promise<void>): void {
    work().then(refresh).catch(showError);
  }

  async function withdraw(): Promise<void> {
    const { invitation } = store.getState();
    store.setState({ invitation: null });
    // A used or expired invitation cannot be withdrawn.
    if (invitation !== null) await api.withdraw(invitation.id).catch(() => undefined);
  }

  return {
    store,
    refresh: () => refresh().catch(showError),
    sayName: (name) => act(async () => known(await api.sayName(name))),
    invite: (role, name) =>
      act(async () => {
        await withdraw();
        await open(role, name);
      }),
    endInvitation: () => void withdraw(),
    change: (person, wanted) => act(() => api.change(person, wanted)),
    revoke: (person, continues) => act(() => api.revoke(person, continues)),
    makeToken: (name, role, validity) =>
      act(async () => {
        const { token } = await api.makeToken({ name, role, expiresInDays: VALIDITIES[validity] });
        store.setState({ shown: { kind: 'token', name, token } });
      }),
    makeStopLink: (name) =>
      act(async () => {
        const { link, picture } = await api.makeStopLink(name);
        store.setState({ shown: { kind: 'stopLink', name, link, picture } });
      }),
    closeShown: () => store.setState({ shown: null }),
  };
}

const ANSWER_WITHIN_MS = 4000;
/** Without an answer the page simulates a robot, so a busy gateway gets more time. */
const HERE_WITHIN_MS = 10_000;

const CODES: Readonly<Record<string, PeopleErrorCode>> = {
  notPaired: 'notPaired',
  pairingFailed: 'failed',
  pairingLocked: 'locked',
};

const number = v.pipe(v.number(), v.finite());
const role = v.picklist(['stopper', 'viewer', 'driver', 'owner']);
const youSchema: v.GenericSchema<unknown, You> = v.object({ id: v.string(), name: v.string(), role });
const meSchema: v.GenericSchema<unknown, Me> = v.object({
  mode: v.picklist(['local', 'lan', 'proxy']),
  overheard: v.boolean(),
  you: v.nullable(youSchema),
  pages: v.array(v.picklist(['robot', 'fleet'])),
});
const peopleSchema: v.GenericSchema<unknown, People> = v.object({
  people: v.array(
    v.object({
      id: v.string(),
      kind: v.picklist(['device', 'token', 'stopLink']),
      name: v.string(),
      role,
      pairedAtMs: number,
      lastSeenMs: v.nullable(number),
      expiresInMs: v.nullable(number),
      here: v.boolean(),
      drives: v.boolean(),
      unattendedSlot: v.nullable(number),
    }),
  ),
  openInvites: v.array(v.string()),
  openCodes: v.array(v.string()),
});
const link = { id: v.string(), link: v.string(), picture: v.string() };
const invitationSchema: v.GenericSchema<unknown, Invitation> = v.object({
  ...link,
  code: v.nullable(v.string()),
  expiresInMs: number,
});
const stopLinkSchema: v.GenericSchema<unknown, StopLink> = v.object(link);
const tokenSchema: v.GenericSchema<unknown, Token> = v.object({ id: v.string(), token: v.string() });

const { ask, send } = requestsOf({
  withinMs: ANSWER_WITHIN_MS,
  failed: ({ code, message }, options) =>
    new PeopleError(code === null ? 'unreachable' : (CODES[code] ?? 'refused'), message, options),
  unreadable: () => new PeopleError('unreachable', 'no gateway is at this address'),
});

/** null if no gateway answers: the page was served from elsewhere. */
export async function readMe(): Promise<Me | null> {
  return ask('get', '/api/me', meSchema, {}, HERE_WITHIN_MS).catch(() => null);
}

export const pair = (wish: PairWish): Promise<You> => ask('post', '/api/pair', youSchema, { body: wish });

/** Sets the name of this device. */
export const sayName = (name: string): Promise<You> => ask('patch', '/api/me', youSchema, { body: { name } });

/** Resolves when the stops have left the wire, or when there was no port to send them to. */
export async function stopRobot(): Promise<void> {
  await send('post', '/api/stop', {});
}

export const peopleApi: PeopleApi = {
  me: readMe,
  sayName,
  list: () => ask('get', '/api/people', peopleSchema, {}),
  invite: (wish) => ask('post', '/api/invites', invitationSchema, { body: wish }),
  withdraw: (id) => send('delete', '/api/invites/{invitation}', { values: { invitation: id } }),
  change: (id, wanted) => send('patch', '/api/people/{person}', { values: { person: id }, body: wanted }),
  revoke: (id, continues) =>
    send('delete', '/api/people/{person}', { values: { person: id }, query: continues ? { continues } : {} }),
  makeToken: (wish) => ask('post', '/api/tokens', tokenSchema, { body: wish }),
  makeStopLink: (name) => ask('post', '/api/stop-links', stopLinkSchema, { body: { name } }),
};
