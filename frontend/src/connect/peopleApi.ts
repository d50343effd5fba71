// The gateway's HTTP interface as far as coming in and letting in need it. Trusts no answer's shape; every failure is a
// PeopleError.

import * as z from 'zod/mini';
import { GatewayProblem, request, type Method } from '../gateway/request.ts';
import { PeopleError, type PeopleApi, type PeopleErrorCode } from '../stores/people/people.ts';
import type {
  Invitation,
  Me,
  PairWish,
  People,
  StopLink,
  Token,
  You,
} from '../stores/people/people.generated.ts';

const ANSWER_WITHIN_MS = 4000;
/** Who does not say so is taken for absent, and the page simulates a robot of its own: a busy gateway takes its time. */
const HERE_WITHIN_MS = 10_000;

const CODES: Readonly<Record<string, PeopleErrorCode>> = {
  notPaired: 'notPaired',
  pairingFailed: 'failed',
  pairingLocked: 'locked',
};

const role = z.enum(['stopper', 'viewer', 'driver', 'owner']);
const youSchema: z.ZodMiniType<You> = z.object({ id: z.string(), name: z.string(), role });
const meSchema: z.ZodMiniType<Me> = z.object({
  mode: z.enum(['local', 'lan', 'proxy']),
  overheard: z.boolean(),
  you: z.nullable(youSchema),
});
const peopleSchema: z.ZodMiniType<People> = z.object({
  people: z.array(
    z.object({
      id: z.string(),
      kind: z.enum(['device', 'token', 'stopLink']),
      name: z.string(),
      role,
      pairedAtMs: z.number(),
      lastSeenMs: z.nullable(z.number()),
      here: z.boolean(),
      drives: z.boolean(),
      unattendedSlot: z.nullable(z.number()),
    }),
  ),
  openInvites: z.array(z.string()),
  openCodes: z.array(z.string()),
});
const link = { id: z.string(), link: z.string(), picture: z.string() };
const invitationSchema: z.ZodMiniType<Invitation> = z.object({
  ...link,
  code: z.nullable(z.string()),
  expiresInMs: z.number(),
});
const stopLinkSchema: z.ZodMiniType<StopLink> = z.object(link);
const tokenSchema: z.ZodMiniType<Token> = z.object({ id: z.string(), token: z.string() });
const nothing = z.unknown();

/** null where no gateway answers: the page came from elsewhere. */
export async function readMe(): Promise<Me | null> {
  return ask('me', 'GET', meSchema, undefined, HERE_WITHIN_MS).catch(() => null);
}

export const pair = (wish: PairWish): Promise<You> => ask('pair', 'POST', youSchema, wish);

/** What others call this device from now on. */
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
  revoke: async (id, groupGoesOn) => {
    await ask(`people/${id}${groupGoesOn ? '?groupGoesOn=true' : ''}`, 'DELETE', nothing);
  },
  makeToken: (wish) => ask('tokens', 'POST', tokenSchema, wish),
  makeStopLink: (name) => ask('stop-links', 'POST', stopLinkSchema, { name }),
};

async function ask<T>(
  path: string,
  method: Method,
  schema: z.ZodMiniType<T>,
  body?: object,
  withinMs = ANSWER_WITHIN_MS,
): Promise<T> {
  const answer = await request(`api/${path}`, { method, body, withinMs }).catch((error: unknown) => {
    throw asPeopleError(error);
  });
  const read = schema.safeParse(answer);
  if (!read.success) throw new PeopleError('unreachable', 'no gateway is at this address');
  return read.data;
}

function asPeopleError(error: unknown): unknown {
  if (!(error instanceof GatewayProblem)) return error;
  const code = error.code === null ? 'unreachable' : (CODES[error.code] ?? 'refused');
  return new PeopleError(code, error.message, { cause: error });
}
