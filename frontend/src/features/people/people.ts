// This page's identity at the gateway, and for owners the devices, tokens, stop-only links and the open invitation. A used invitation is
// replaced by a new one, so that a class can join one after the other. Knows no HTTP.

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
} from '../../robot/http.generated.ts';

/** Why pairing or a change of people failed. */
export type PeopleErrorCode = 'unreachable' | 'notPaired' | 'failed' | 'locked' | 'refused';

export function peopleProblem(code: PeopleErrorCode, detail: string): string {
  return code === 'refused' && detail !== ''
    ? words.people.refusedBecause({ detail })
    : words.people.problems[code];
}

export type PersonRole = InviteWish['role'];
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
  makeToken(name: string, role: PersonRole): void;
  makeStopLink(name: string): void;
  closeShown(): void;
}

/** The actions of the views. */
export type PeopleWishes = Omit<PeopleStore, 'store' | 'refresh'>;

interface PeopleOptions {
  readonly api: PeopleApi;
  readonly me: Me | null;
  readonly notices: Pick<Notices, 'tell'>;
  now(): number;
}

export const managesPeople = (me: Me | null): boolean => me?.mode !== 'local' && me?.you?.role === 'owner';

export function createPeople({ api, me, notices, now }: PeopleOptions): PeopleStore {
  const store = createStore<PeopleState>(() => ({ me, people: [], invitation: null, shown: null }));

  const tellError = (error: unknown): void => {
    if (!(error instanceof PeopleError)) throw error;
    notices.tell('danger', peopleProblem(error.code, error.message));
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
    work().then(refresh).catch(tellError);
  }

  async function withdraw(): Promise<void> {
    const { invitation } = store.getState();
    store.setState({ invitation: null });
    // A used or expired invitation cannot be withdrawn.
    if (invitation !== null) await api.withdraw(invitation.id).catch(() => undefined);
  }

  return {
    store,
    refresh: () => refresh().catch(tellError),
    sayName: (name) => act(async () => known(await api.sayName(name))),
    invite: (role, name) =>
      act(async () => {
        await withdraw();
        await open(role, name);
      }),
    endInvitation: () => void withdraw(),
    change: (person, wanted) => act(() => api.change(person, wanted)),
    revoke: (person, continues) => act(() => api.revoke(person, continues)),
    makeToken: (name, role) =>
      act(async () => {
        const { token } = await api.makeToken({ name, role });
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
