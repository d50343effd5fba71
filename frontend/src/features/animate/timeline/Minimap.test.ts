import { expect, test } from 'vitest';
import { recordingPen } from '../../picture/penUnderTest.ts';
import { paintPlayhead } from './Minimap.tsx';

test('the playhead is a line over all of the height, within both ends', () => {
  const { strokes, pen } = recordingPen({ width: 402, height: 16 });
  for (const share of [0, 0.5, 1]) paintPlayhead(pen, [share]);
  expect(strokes.map(({ colour, points }) => [colour, points])).toEqual(
    [0, 200, 400].map((x) => [
      'ink',
      [
        [x, 0],
        [x + 2, 16],
      ],
    ]),
  );
});
