import { expect, test } from 'vitest';
import { copyFrames, copyKeys } from '#shared/group/clip.ts';
import { setColour, setNote } from '#shared/group/frameEdits.ts';
import { setEasing } from '#shared/group/keyEdits.ts';
import { clipFromText, clipToText } from './clipText.ts';
import { smallGroup } from './timelineUnderTest.ts';

/** As another window gets it. */
const fromElsewhere = (text: string) => clipFromText(`${text}\n`);

test('copied keys come back from the text that stands for them', () => {
  const refs = [
    { frameId: 2, servo: 1 },
    { frameId: 3, servo: 1 },
    { frameId: 3, servo: 3 },
  ];
  const clip = copyKeys(
    setEasing(
      smallGroup(),
      refs.filter(({ frameId }) => frameId === 3),
      'hold',
    ),
    refs,
  );
  expect(fromElsewhere(clipToText(clip))).toEqual(clip);
});

test('so do frames, with what is said of them', () => {
  const clip = copyFrames(setColour(setNote(smallGroup(), 1, 'Up'), [3], 'plum'), [1, 3]);
  expect(clip.moments.map(({ note, colour }) => [note, colour])).toEqual([
    ['Up', null],
    ['', 'plum'],
  ]);
  expect(fromElsewhere(clipToText(clip))).toEqual(clip);
});

test('what was copied here is not read again', () => {
  const clip = copyFrames(smallGroup(), [1, 3]);
  expect(clipFromText(clipToText(clip))).toBe(clip);
});

test('any other text is no clip', () => {
  expect(clipFromText('55 55 02 0F')).toBeNull();
});
