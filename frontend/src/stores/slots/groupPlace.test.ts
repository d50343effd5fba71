import { expect, test } from 'vitest';
import { setMeta } from '#shared/actions/group/groupEdits.ts';
import { createMemoryKeeper } from '../../keepers/memoryKeeper.ts';
import { createVirtualClock } from '#shared/simulator/virtualClock.ts';
import { chosenPlace, followPlace } from './groupPlace.ts';
import { createVisit } from '../library/libraryUnderTest.ts';

async function openVisit() {
  const clock = createVirtualClock();
  const visit = createVisit(createMemoryKeeper(), clock);
  followPlace(visit);
  await visit.later();
  const keep = (change: Parameters<typeof setMeta>[1]) =>
    visit.document.edit(
      () => 'keep',
      (group) => setMeta(group, change),
    );
  return { ...visit, keep, chosen: () => chosenPlace(visit.view.getState()) };
}

test('a group’s own slot and times are what is chosen, also when they are undone', async () => {
  const { keep, chosen, document } = await openVisit();
  keep({ slot: 5, times: 2 });
  expect(chosen()).toEqual({ slot: 5, times: 2 });
  keep({ times: 0 });
  expect(chosen()).toEqual({ slot: 5, times: 0 });
  document.undo();
  expect(chosen()).toEqual({ slot: 5, times: 2 });
});

test('what is chosen otherwise holds until another group is opened, or this one says so', async () => {
  const { keep, chosen, view, library, openId, later, capture } = await openVisit();
  keep({ slot: 5 });
  view.setState({ slot: 9, times: 4 });
  capture(1000);
  expect(chosen()).toEqual({ slot: 9, times: 4 });
  const wave = openId();
  await later();
  library.create();
  expect(chosen()).toEqual({ slot: 9, times: 1 });
  await library.open(wave);
  expect(chosen()).toEqual({ slot: 5, times: 1 });
});
