import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { FAMILIES } from '../codec/families.ts';
import { HAPPENINGS, type Entry, type Recording } from './recording.ts';
import { isBoardId, readRecording, writeRecording } from './recordingText.ts';

const HEAD = 'servodeck-log: 1\nboard: doc\n';
const read = (body: string) => readRecording(HEAD + body);
const entriesOf = (body: string): readonly Entry[] => read(body).recording?.entries ?? [];
function problemsOf(text: string): readonly (readonly [number, string])[] {
  const result = readRecording(text);
  return result.recording === null ? result.problems.map(({ line, reason }) => [line, reason]) : [];
}

const boards = [...Object.keys(FAMILIES), 'unknown'].filter(isBoardId);
const moment = fc.oneof(
  fc.record({
    mark: fc.constantFrom('sent' as const, 'received' as const, 'garbage' as const, 'truncated' as const),
    bytes: fc.uint8Array({ minLength: 1, maxLength: 300 }),
  }),
  fc.record({ mark: fc.constant('link' as const), happening: fc.constantFrom(...HAPPENINGS) }),
  fc.record({ mark: fc.constant('board' as const), board: fc.constantFrom(...boards) }),
);
/** Any text that stands in one line. */
const words = fc.string({ unit: 'grapheme' }).map((text) => text.replace(/[\s\p{Cc}]+/gu, ' ').trim());
const recordings: fc.Arbitrary<Recording> = fc.record({
  header: fc.record({
    board: fc.constantFrom(...boards),
    ...{ port: words, date: words, app: words },
    expectations: fc.array(words, { maxLength: 3 }),
  }),
  entries: fc.array(fc.tuple(fc.nat({ max: 5_000 }), moment), { maxLength: 30 }).map((steps) => {
    let atMs = 0;
    return steps.map(([afterMs, what]): Entry => ({ atMs: (atMs += afterMs), ...what }));
  }),
});

describe('a log as text', () => {
  test('whatever is written is read back the same, whatever the notes say', () => {
    fc.assert(
      fc.property(recordings, fc.string({ unit: 'binary' }), (recording, note) => {
        expect(readRecording(writeRecording(recording, () => note))).toEqual({ recording });
      }),
    );
  });

  test('line ends, indents and a byte order mark of any system make no difference', () => {
    fc.assert(
      fc.property(recordings, fc.constantFrom('\n', '\r\n'), fc.boolean(), (recording, end, mark) => {
        const text = writeRecording(recording, () => '').replaceAll('\n', end);
        expect(readRecording(`${mark ? '\uFEFF' : ''}${text}`)).toEqual({ recording });
      }),
    );
  });

  test('a damaged text is read or refused, never an exception', () => {
    fc.assert(
      fc.property(recordings, fc.nat(), fc.string(), (recording, at, insert) => {
        const text = writeRecording(recording, () => 'note');
        const cut = at % text.length;
        const result = readRecording(text.slice(0, cut) + insert + text.slice(cut));
        expect(result.recording === null ? result.problems.length : 1).toBeGreaterThan(0);
      }),
    );
  });

  test('a line says time, way, bytes and words', () => {
    const entries: Entry[] = [{ atMs: 12_345, mark: 'sent', bytes: Uint8Array.of(0x55, 0x55, 2, 15) }];
    const header = {
      board: 'xarm',
      port: 'COM3',
      date: '2026-11-21',
      app: '0.1.0',
      expectations: [],
    } as const;
    expect(writeRecording({ header, entries }, () => 'Ask for\nthe battery').split('\n')).toEqual([
      'servodeck-log: 1',
      'board: xarm',
      'port: COM3',
      'date: 2026-11-21',
      'app: 0.1.0',
      '',
      expect.stringMatching(/^# /u),
      '12.345  >  55 55 02 0F  # Ask for the battery',
      '',
    ]);
  });

  test('people write as they like: comments, empty lines, tabs, small letters, whole seconds', () => {
    expect(entriesOf('\n# what I did\n   1\t>\t55 55 02 0f\n1.5 <? 41 # "OK"?\n2 = lost')).toEqual([
      { atMs: 1_000, mark: 'sent', bytes: Uint8Array.of(0x55, 0x55, 2, 15) },
      { atMs: 1_500, mark: 'garbage', bytes: Uint8Array.of(0x41) },
      { atMs: 2_000, mark: 'link', happening: 'lost' },
    ]);
  });

  test.each([
    ['1.0 > 55 5', '"5" is no byte like 0F; words stand behind a #'],
    ['1.0 > 55 55 02 07 Stop', '"Stop" is no byte like 0F; words stand behind a #'],
    ['1.0 >', 'there are no bytes'],
    ['1.0 ? 55', '"?" is no sign; there are > < <? <| ='],
    ['> 55 55 02 07', 'a line begins with its seconds, like 12.345, then a sign'],
    ['1.0 = away', '"away" is none of opened, lost, closed, stopped, latched, resumed, board NAME'],
    ['1.0 = board toaster', 'no board is called "toaster"'],
    [`1.0 > ${'00 '.repeat(513)}`, 'more than 512 bytes in one line'],
    ['colour: red', '"colour:" is none of servodeck-log, board, port, date, app, expect'],
    ['board: doc', '"board:" comes twice'],
    ['2.0 = lost\n1.0 = opened', 'time runs backwards here'],
    ['2.0 = lost\nport: COM3', '"port:" stands behind packets; it belongs to the header'],
  ])('%j is refused with its line and the reason', (body, reason) => {
    expect(problemsOf(HEAD + body)).toEqual([[2 + body.split('\n').length, reason]]);
  });

  test('a text that is no log of ours is refused as a whole', () => {
    expect(problemsOf('')).toEqual([
      [0, 'the header has no "servodeck-log:"'],
      [0, 'the header has no "board:"'],
    ]);
    expect(problemsOf('servodeck-log: 2\nboard: doc')).toEqual([
      [1, 'this log has format 2; format 1 can be read'],
    ]);
    expect(problemsOf('no log\n'.repeat(1_000)).length).toBe(20);
  });
});
