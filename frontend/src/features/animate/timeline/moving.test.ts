import { describe, expect, test } from 'vitest';
import { addMarker } from '#shared/group/frameEdits.ts';
import { createTestTimeline } from './timelineUnderTest.ts';
import { TIMELINE_ACTIONS } from './timelineActions.ts';

async function withMarkers() {
  const context = await createTestTimeline();
  context.stores.document.edit(
    () => 'mark',
    (group) => addMarker(addMarker(group, 900, 'Bow'), 200, 'Wave'),
  );
  const { stores, group } = context;
  const marks = () =>
    group()
      .markers.toSorted((one, other) => one.atMs - other.atMs)
      .map(({ atMs, text }) => [atMs, text]);
  const chosen = () => group().markers.find(({ id }) => id === stores.timeline.getState().marker)?.text;
  return { ...context, marks, chosen };
}

describe('markers by keyboard', () => {
  test('come one after the other, and the playhead goes along', async () => {
    const { key, chosen, stores } = await withMarkers();
    stores.timeline.setState({ playheadMs: 500 });
    const walked = [0, 1, 2].map(() => {
      key('M', { shiftKey: true });
      return [chosen(), stores.timeline.getState().playheadMs, stores.notices.said.getState()];
    });
    expect(walked).toEqual([
      ['Bow', 900, 'Bow, 0.90 s'],
      ['Wave', 200, 'Wave, 0.20 s'],
      ['Bow', 900, 'Bow, 0.90 s'],
    ]);
  });

  test('are moved by ticks, with Shift by ten, no key with them, and stay selected', async () => {
    const { key, marks, chosen, select, keys, steps } = await withMarkers();
    const before = keys(1);
    const stepsBefore = steps();
    select([2, 1]);
    key('M', { shiftKey: true });
    key('ArrowRight');
    key('ArrowLeft', { shiftKey: true });
    expect(marks()[0]).toEqual([20, 'Wave']);
    key('ArrowLeft', { shiftKey: true });
    expect(marks()[0]).toEqual([0, 'Wave']);
    expect([chosen(), keys(1), steps() - stepsBefore]).toEqual(['Wave', before, 3]);
  });

  test('are renamed and deleted by the actions of keys, which then say so', async () => {
    const { key, marks, stores } = await withMarkers();
    const named = () =>
      (['marker', 'remove'] as const).map((name) =>
        TIMELINE_ACTIONS[name].label({ state: stores.timeline.getState() }),
      );
    expect(named()).toEqual(['Set marker', 'Delete keys']);
    key('M', { shiftKey: true });
    expect(named()).toEqual(['Rename marker', 'Delete marker']);
    key('m');
    expect(stores.timeline.getState().question).toBe('marker');
    key('Delete');
    expect(marks()).toEqual([[900, 'Bow']]);
  });

  test('where there is none, that is said', async () => {
    const { key, noticeTexts } = await createTestTimeline();
    key('M', { shiftKey: true });
    expect(noticeTexts()).toEqual(['There is no marker yet.']);
  });
});
