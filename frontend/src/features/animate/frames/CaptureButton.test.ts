import { expect, test } from 'vitest';
import { insertFrame } from '#shared/group/groupEdits.ts';
import { createTestPage } from '../../pageUnderTest.ts';
import { captureFrame } from './CaptureButton.tsx';

test.each([
  ['before', [100, 1000, 200, 300]],
  ['after', [100, 200, 1000, 300]],
  ['end', [100, 200, 300, 1000]],
] as const)('a frame comes %s, whichever one is selected', async (side, expected) => {
  const context = await createTestPage();
  const { document, view, device } = context;
  for (const [index, position] of [100, 200, 300].entries())
    document.edit(
      () => 'write',
      (group) => insertFrame(group, index, { durationMs: position, targets: [{ servo: 1, position }] }, 'us'),
    );
  device.move([{ servo: 1, position: 1000 }], 1500);
  await context.draw(200);
  view.setState({ selectedFrame: document.store.getState().present.frames[1]!.id });
  captureFrame({ document, view, device }, side);
  const { frames } = document.store.getState().present;
  expect(frames.map(({ targets }) => targets[0]?.position)).toEqual(expected);
  expect(view.getState().selectedFrame).toBe(frames[expected.indexOf(1000)]!.id);
});
