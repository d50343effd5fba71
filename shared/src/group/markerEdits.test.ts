import { describe, expect, test } from 'vitest';
import { emptyGroup } from './group.ts';
import { setKey } from './keyEdits.ts';
import { addMarker, deleteMarker, moveMarker, renameMarker } from './frameEdits.ts';
import { deleteTime, insertTime, setDuration } from './timeEdits.ts';

const RIPPLE = { ripple: true };

describe('a marker', () => {
  test('is added with its own id, moved, renamed and deleted', () => {
    const group = addMarker(setKey(emptyGroup('Wave', 'us'), 1, 100, 1500), 50.4, 'Here');
    expect(group.markers).toEqual([{ id: 2, atMs: 50, text: 'Here' }]);
    expect(renameMarker(moveMarker(group, 2, 70), 2, 'There').markers).toEqual([
      { id: 2, atMs: 70, text: 'There' },
    ]);
    expect(deleteMarker(group, 2).markers).toEqual([]);
  });

  test('goes along when time is inserted before it', () => {
    const group = addMarker(setKey(emptyGroup('Wave', 'us'), 1, 100, 1500), 50, 'Here');
    expect(insertTime(group, 20, 1000).markers[0]!.atMs).toBe(1050);
    expect(setDuration(group, 1, 30, RIPPLE).markers[0]!.atMs).toBe(30);
    expect(deleteTime(group, { fromMs: 20, toMs: 60 }).markers).toEqual([]);
  });
});
