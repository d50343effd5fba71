import { beforeEach, expect, test } from 'vitest';
import { createPeople, PeopleError, type PeopleApi, type PeopleStore } from './people.ts';
import type { Me } from '#shared/client/http.generated.ts';

const BEN = { id: 'ben', name: 'Android', role: 'driver' } as const;
const ANNA = {
  ...({ mode: 'lan', overheard: true, you: { id: 'anna', name: 'Anna', role: 'owner' } } as const),
  pages: ['robot' as const],
};
const HOLDS_MS = 120_000;

/** A gateway as far as invitations go: what it was asked, and those it still holds. */
function gateway() {
  let nextId = 1;
  const requested: string[] = [];
  const open = new Set<string>();
  /** Those whose digits were not guessed at too often. */
  const countsCodes = { is: true };
  const api: PeopleApi = {
    me: () => Promise.resolve(ANNA),
    sayName: (name) => Promise.resolve({ ...BEN, name }),
    list: () =>
      Promise.resolve({ people: [], openInvites: [...open], openCodes: countsCodes.is ? [...open] : [] }),
    invite({ role, name = '' }) {
      const id = String(nextId++);
      requested.push(`invite ${role} ${name}`);
      open.add(id);
      return Promise.resolve({
        id,
        link: `#pair=${id}`,
        code: '12345678',
        picture: '',
        expiresInMs: HOLDS_MS,
      });
    },
    withdraw(id) {
      requested.push(`withdraw ${id}`);
      open.delete(id);
      return Promise.resolve();
    },
    change: () => Promise.reject(new PeopleError('refused', 'This is the last owner')),
    revoke: () => Promise.reject(new PeopleError('unreachable', '')),
    makeToken({ name, expiresInDays }) {
      requested.push(`token ${name} for ${expiresInDays}`);
      return Promise.resolve({ id: 'token', token: `secret of ${name}` });
    },
    makeStopLink: () => Promise.resolve({ id: 'link', link: '#stop=x', picture: '' }),
  };
  return { api, requested, open, countsCodes };
}

const settled = (): Promise<void> => new Promise((resolve) => setTimeout(resolve));

let nowMs = 0;
let texts: string[] = [];
let robot: ReturnType<typeof gateway>;
let people: PeopleStore;

beforeEach(() => {
  nowMs = 0;
  texts = [];
  robot = gateway();
  const notices = { show: (_tone: string, text: string) => void texts.push(text) };
  people = createPeople({ api: robot.api, me: ANNA, notices, now: () => nowMs });
});

test('an invitation that was used is followed by a new one of that role, without the name', async () => {
  people.invite('driver', 'Ben');
  await settled();
  robot.open.clear();
  await people.refresh();
  expect(robot.requested).toEqual(['invite driver Ben', 'invite driver ']);
  expect(people.store.getState().invitation).toMatchObject({ id: '2', role: 'driver' });
});

test('digits that count no more, because others guessed, are not shown; the link still holds', async () => {
  people.invite('driver', '');
  await settled();
  await people.refresh();
  expect(people.store.getState().invitation).toMatchObject({ code: '12345678' });
  robot.countsCodes.is = false;
  await people.refresh();
  expect(people.store.getState().invitation).toMatchObject({ id: '1', link: '#pair=1', code: null });
  expect(robot.requested).toHaveLength(1);
});

test('one that is over is not followed by another', async () => {
  people.invite('viewer', '');
  await settled();
  robot.open.clear();
  nowMs = HOLDS_MS;
  await people.refresh();
  expect(robot.requested).toHaveLength(1);
});

test('a new invitation and the end of it take the one before back', async () => {
  people.invite('viewer', '');
  await settled();
  people.invite('owner', '');
  await settled();
  people.endInvitation();
  await settled();
  expect(robot.requested).toEqual(['invite viewer ', 'withdraw 1', 'invite owner ', 'withdraw 2']);
  expect(people.store.getState().invitation).toBeNull();
  await people.refresh();
  expect(robot.requested).toHaveLength(4);
});

test('a token is made for as long as was chosen, and shown until it is closed', async () => {
  people.makeToken('Fair', 'driver', 'unlimited');
  people.makeToken('Script', 'driver', 'month');
  await settled();
  expect(robot.requested).toEqual(['token Fair for null', 'token Script for 30']);
  expect(people.store.getState().shown).toEqual({ kind: 'token', name: 'Script', token: 'secret of Script' });
  people.closeShown();
  expect(people.store.getState().shown).toBeNull();
});

test('what the gateway refuses is reported with its reason', async () => {
  people.change('anna', { role: 'viewer' });
  people.revoke('ben', false);
  await settled();
  expect(texts).toEqual([
    'The gateway refused this: This is the last owner',
    'The gateway does not answer. Is this device still on the robot’s network?',
  ]);
});

test('a person who lets no one in says their own name, and hears when an owner changes it', async () => {
  const { api, requested } = gateway();
  const guest = { ...ANNA, you: BEN };
  const notices = { show: (_tone: string, text: string) => void texts.push(text) };
  let now: Me | null = { ...guest, you: { ...BEN, name: 'Ben' } };
  people = createPeople({
    api: { ...api, me: () => Promise.resolve(now) },
    me: guest,
    notices,
    now: () => 0,
  });
  people.sayName('Ben');
  await settled();
  expect(people.store.getState().me).toEqual({ ...guest, you: { ...BEN, name: 'Ben' } });
  now = { ...guest, you: { ...BEN, name: 'Benno' } };
  await people.refresh();
  expect(people.store.getState().me?.you?.name).toBe('Benno');
  now = null;
  await people.refresh();
  expect(people.store.getState().me?.you?.name).toBe('Benno');
  expect([requested, texts]).toEqual([[], []]);
});
