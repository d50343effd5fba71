import { expect, test } from 'vitest';
import { createVirtualClock } from '#shared/testing/virtualClock.ts';
import { createMemoryStore } from '../../library/memoryStore.ts';
import { lookAfresh } from './selectionBack.ts';
import { createVisit } from '../../library/libraryUnderTest.ts';
import { keySet, createTimeline } from './timeline.ts';

test('what was selected and looked at in one group is not in another, whose frames have the same ids', async () => {
  const timeline = createTimeline();
  const visit = createVisit(createMemoryStore(), createVirtualClock());
  lookAfresh({ ...visit, timeline });
  await visit.later();
  visit.capture(1000);
  const [frame] = visit.document.store.getState().present.frames;
  visit.view.setState({ selectedFrame: frame!.id });
  timeline.setState({
    ...{ selected: keySet([{ frameId: frame!.id, servo: 1 }]), playheadMs: 800, followsGroup: false },
    range: { fromMs: 0, toMs: 500 },
  });
  await visit.later();
  expect(timeline.getState()).toMatchObject({ playheadMs: 800, followsGroup: false });
  visit.library.create();
  visit.capture(1200);
  expect(visit.document.store.getState().present.frames[0]!.id).toBe(frame!.id);
  expect(visit.view.getState().selectedFrame).not.toBe(frame!.id);
  expect(timeline.getState()).toMatchObject({ playheadMs: 0, followsGroup: true, range: null });
  expect(timeline.getState().selected.size).toBe(0);
});
