import { compileSource } from './board/compile/compileSource.ts';
import { expect, test } from 'vitest';
import { insertFrame } from '#shared/group/groupEdits.ts';
import { FAMILIES, UNKNOWN_BOARD } from '#shared/codec/families.ts';
import { freshRobot } from './profiles/robots.ts';
import { createTestPage } from './pageUnderTest.ts';

const POSE = Array.from({ length: 16 }, (_, index) => ({ servo: index + 1, position: 1200 + index }));

test('without a known board a group is judged by the one that the robot is described for', async () => {
  const { compiled, document, device, robots } = await createTestPage(new Map(), { family: UNKNOWN_BOARD });
  expect(device.store.getState().family.id).toBe('unknown');
  robots.add(() => 'add', freshRobot('plain16', 'lsc-16'));
  document.edit(
    () => 'fill',
    (group) => insertFrame(group, 0, { durationMs: 500, targets: POSE }),
  );
  const { source, report } = compiled.now(compileSource);
  expect([source.family, report.problems]).toEqual([FAMILIES['lsc-16'], []]);
});
