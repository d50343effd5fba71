// HTTP requests about people: identity, pairing, invitations, tokens. Validates every answer; every failure is a PeopleError.

import * as v from 'valibot';
import { GatewayProblem, request, type Method } from '../../robot/request.ts';
import { PeopleError, type PeopleApi, type PeopleErrorCode } from './people.ts';
import type { Invitation, Me, PairWish, People, StopLink, Token, You } from '../../robot/people.generated.ts';

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
const nothing = v.unknown();

/** null if no gateway answers: the page was served from elsewhere. */
export async function readMe(): Promise<Me | null> {
  return ask('me', 'GET', meSchema, undefined, HERE_WITHIN_MS).catch(() => null);
}

export const pair = (wish: PairWish): Promise<You> => ask('pair', 'POST', youSchema, wish);

/** Sets the name of this device. */
export const sayName = (name: string): Promise<You> => ask('me', 'PATCH', youSchema, { name });

/** Resolves when the stops have left the wire, or when there was no port to send them to. */
export async function stopRobot(): Promise<void> {
  await ask('stop', 'POST', nothing);
}

export const peopleApi: PeopleApi = {
  me: readMe,
  sayName,
  list: () => ask('people', 'GET', peopleSchema),
  invite: (wish) => ask('invites', 'POST', invitationSchema, wish),
  withdraw: async (id) => {
    await ask(`invites/${id}`, 'DELETE', nothing);
  },
  change: async (id, wanted) => {
    await ask(`people/${id}`, 'PATCH', nothing, wanted);
  },
  revoke: async (id, continues) => {
    await ask(`people/${id}${continues ? '?continues=true' : ''}`, 'DELETE', nothing);
  },
  makeToken: (wish) => ask('tokens', 'POST', tokenSchema, wish),
  makeStopLink: (name) => ask('stop-links', 'POST', stopLinkSchema, { name }),
};

async function ask<T>(
  path: string,
  method: Method,
  schema: v.GenericSchema<unknown, T>,
  body?: object,
  withinMs = ANSWER_WITHIN_MS,
): Promise<T> {
  const answer = await request(`api/${path}`, { method, body, withinMs }).catch((error: unknown) => {
    throw asPeopleError(error);
  });
  const read = v.safeParse(schema, answer);
  if (!read.success) throw new PeopleError('unreachable', 'no gateway is at this address');
  return read.output;
}

function asPeopleError(error: unknown): unknown {
  if (!(error instanceof GatewayProblem)) return error;
  const code = error.code === null ? 'unreachable' : (CODES[error.code] ?? 'refused');
  return new PeopleError(code, error.message, { cause: error });
}
