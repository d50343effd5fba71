// What holds for every action of the page, by the lists alone.

import { afterEach, expect, test } from 'vitest';
import { createMappings } from '../features/inputs/pad.ts';
import { createTestPage } from '../features/pageUnderTest.ts';
import type { Stores } from '../features/stores.ts';
import { LANGUAGE_CODES, speak } from '../i18n/words.ts';
import { ACTION_PLACES } from './ActionList.tsx';

afterEach(() => speak('en'));

async function allActions() {
  const page = await createTestPage();
  const storage = { getItem: () => null, setItem: () => undefined };
  const mappings = createMappings(storage, page.notices, page.robots);
  // Those that no action asks for are missing.
  const stores = { ...page, mappings } as unknown as Stores;
  return {
    stores,
    places: () => ACTION_PLACES.map((place) => ({ ...place, actions: place.actions(stores) })),
  };
}

test.each(LANGUAGE_CODES)('each has a label of its own in its place, in %s', async (language) => {
  const { places } = await allActions();
  await speak(language);
  for (const { id, actions, keys } of places()) {
    const labels = [...actions, ...keys.map((use) => ({ ...use, label: use.label() }))].map(
      ({ label }) => label,
    );
    expect(labels.filter((label) => label.trim() === '')).toEqual([]);
    expect(new Set(labels).size, id).toBe(labels.length);
    if (language === 'zh') for (const label of labels) expect(label).toMatch(/\p{Script=Han}/u);
  }
});

test('no two have the same key where both could be meant', async () => {
  const { places } = await allActions();
  const [page, ...others] = places();
  const keysOf = (place: typeof page): readonly string[] =>
    [...(place?.actions ?? []), ...(place?.keys ?? [])].flatMap(({ keys }) => keys);
  for (const place of others) {
    const keys = [...keysOf(page), ...keysOf(place)];
    expect(
      keys.filter((key, index) => keys.indexOf(key) !== index),
      place.id,
    ).toEqual([]);
  }
});

test('one that cannot be done says why, in each language', async () => {
  const { places, stores } = await allActions();
  const reasons = () => places().flatMap(({ actions }) => actions.map(({ enabled }) => enabled));
  stores.view.setState({ authoring: 'group' });
  const english = reasons();
  expect(english).toContain('Select keys first.');
  expect(english).toContain('Select a frame to change it.');
  expect(english).toContain('Open “Poses” first.');
  await speak('zh');
  const chinese = reasons();
  expect(chinese.map((one) => one === true)).toEqual(english.map((one) => one === true));
  for (const one of chinese) expect(one === true || /\p{Script=Han}/u.test(one)).toBe(true);
});
