// HTTP requests about people: identity, pairing, invitations, tokens. Validates every answer; every failure is a PeopleError.

import * as v from 'valibot';
import { requestsOf } from '../../robot/request.ts';
import { PeopleError, type PeopleApi, type PeopleErrorCode } from './people.ts';
import type { Invitation, Me, PairWish, People, StopLink, Token, You } from '../../robot/http.generated.ts';

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
