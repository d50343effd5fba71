import { describe, expect, test } from 'vitest';
import { family } from '../codec/families.ts';
import { fromHex, toHex } from '../codec/packet.ts';
import { createRig, type Rig } from './rig.ts';

/** Sends and lets time pass; gives the code it was refused with, or null. */
async function send({ session, clock }: Rig, hex: string): Promise<string | null> {
  const outcome = session.sendRaw(fromHex(hex)).then(
    () => null,
    (error: unknown) => (error as { code: string }).code,
  );
  await clock.advance(1_000);
  return outcome;
}

function sentBy({ session }: Rig): string[] {
  const sent: string[] = [];
  session.subscribe({
    traffic: ({ direction, bytes }) => {
      if (direction === 'out') sent.push(toHex(bytes));
    },
  });
  return sent;
}

const MOVE_SLOWLY = '55 55 08 03 01 DC 05 01 D0 07';
const MOVE_FAST = '55 55 08 03 01 64 00 01 D0 07';

describe('a packet sent by hand', () => {
  test('leaves as it was written, and the estimate learns of it', async () => {
    const rig = await createRig();
    const sent = sentBy(rig);
    expect(await send(rig, MOVE_SLOWLY)).toBeNull();
    expect(sent).toEqual([MOVE_SLOWLY]);
    expect(rig.session.motions()(1).target).toBe(2_000);
    expect(rig.channel.board.target(1)).toBe(2_000);
  });

  test('does not move a servo of unknown position faster than the first move may be', async () => {
    const rig = await createRig();
    expect(await send(rig, MOVE_FAST)).toBe('outOfRange');
    expect(rig.heard).toEqual([]);
    await send(rig, MOVE_SLOWLY);
    await rig.clock.advance(1_000);
    expect(await send(rig, MOVE_FAST)).toBeNull();
  });

  test('does not make two servos of unknown position start at once', async () => {
    const rig = await createRig();
    expect(await send(rig, '55 55 0B 03 02 D0 07 01 DC 05 02 DC 05')).toBe('outOfRange');
    expect(rig.heard).toEqual([]);
    await send(rig, MOVE_SLOWLY);
    expect(await send(rig, '55 55 0B 03 02 D0 07 01 DC 05 02 DC 05')).toBeNull();
  });

  test('is not undone by a value that waited for its servo; other servos’ values leave', async () => {
    const rig = await createRig();
    const sent = sentBy(rig);
    const targets = [3, 1, 2].map((servo) => ({ servo, position: 1_200 }));
    rig.session.move(targets, 1_500);
    await rig.clock.advance(0);
    expect(await send(rig, MOVE_SLOWLY)).toBeNull();
    const slowlyTo1200 = (servo: number) => `55 55 08 03 01 DC 05 0${servo} B0 04`;
    expect(sent).toEqual([slowlyTo1200(3), MOVE_SLOWLY, slowlyTo1200(2)]);
    expect(rig.session.motions()(1).target).toBe(2_000);
  });

  test('asks the battery as the page does', async () => {
    const rig = await createRig();
    expect(await send(rig, '55 55 02 0F')).toBeNull();
    expect(rig.session.state.battery).toMatchObject({ kind: 'read', batteryMv: 7_500 });
  });

  test('runs a group as the page does', async () => {
    const rig = await createRig();
    expect(await send(rig, '55 55 05 06 08 00 00')).toBeNull();
    expect(rig.session.state.activity).toMatchObject({ kind: 'running', slot: 8, truth: 'acknowledged' });
    expect(await send(rig, '55 55 02 07')).toBeNull();
    expect(rig.session.state.activity).toEqual({ kind: 'idle' });
  });

  test('stands in the log also where the board only ignores it', async () => {
    const rig = await createRig();
    const sent = sentBy(rig);
    expect(await send(rig, '55 55 03 63 01')).toBeNull();
    expect(sent).toEqual(['55 55 03 63 01']);
  });

  test.each([
    '55 55 02 06',
    '55 55 03 08 00',
    '55 55 02',
    '55 55 02 07 00',
    MOVE_SLOWLY.replace('D0 07', 'D0 0F'),
  ])('%s never leaves', async (hex) => {
    const rig = await createRig();
    const sent = sentBy(rig);
    expect(await send(rig, hex)).toBe('outOfRange');
    expect(sent).toEqual([]);
  });

  test('moves nothing while stopped, but asks', async () => {
    const rig = await createRig();
    void rig.session.halt();
    await rig.clock.advance(1_000);
    for (const hex of [MOVE_SLOWLY, '55 55 05 06 08 01 00', '55 55 02 63'])
      expect(await send(rig, hex)).toBe('latched');
    expect(await send(rig, '55 55 02 0F')).toBeNull();
    expect(rig.ofKind('move')).toEqual([]);
    expect(rig.ofKind('run')).toEqual([]);
  });

  test('releases servos as the page does', async () => {
    const rig = await createRig({ profile: 'xarm', family: family('xarm') });
    expect(await send(rig, '55 55 08 03 01 B8 0B 01 90 01')).toBeNull();
    expect(await send(rig, '55 55 04 14 01 01')).toBe('busy');
    await rig.clock.advance(3_000);
    expect(await send(rig, '55 55 04 14 01 01')).toBeNull();
    expect(rig.ofKind('release')).toEqual([{ kind: 'release', servos: [1] }]);
  });

  test('moves no board whose family is unknown', async () => {
    const rig = await createRig({ profile: 'xarm', family: family('unknown') });
    expect(await send(rig, '55 55 08 03 01 DC 05 01 90 01')).toBe('outOfRange');
    expect(await send(rig, '55 55 05 06 08 01 00')).toBe('outOfRange');
    expect(await send(rig, '55 55 02 63')).toBe('outOfRange');
    expect(rig.heard).toEqual([]);
  });

  test('waits for no answer and no link that is not there', async () => {
    const rig = await createRig();
    await rig.session.close();
    expect(await send(rig, MOVE_SLOWLY)).toBe('closed');
    expect(await send(rig, '55 55 02 0F')).toBe('closed');
  });

  test('asks a LeArm nothing while a group runs there (L8)', async () => {
    const rig = await createRig({ profile: 'learm-esp32', family: family('learm-esp32') });
    void rig.session.run(1, 5);
    await rig.clock.advance(200);
    expect(await send(rig, '55 55 02 01')).toBe('busy');
    expect(rig.ofKind('readVersion')).toEqual([]);
  });
});
