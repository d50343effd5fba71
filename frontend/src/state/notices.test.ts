import { describe, expect, test } from 'vitest';
import { RangeRefusal } from '#shared/codec/encode.ts';
import { LinkError } from '#shared/robot/linkError.ts';
import { createVirtualClock } from '#shared/testing/virtualClock.ts';
import { errorSentence } from '../i18n/sentences.ts';
import { speak } from '../i18n/words.ts';
import { createNotices } from './notices.ts';

function createTestPage() {
  const clock = createVirtualClock();
  const notices = createNotices(clock);
  return { clock, notices, noticeTexts: () => notices.store.getState().map((notice) => notice.text) };
}

describe('notices', () => {
  test('good news leaves by itself, bad news stays', async () => {
    const { clock, notices, noticeTexts } = createTestPage();
    notices.show('info', 'Slot 1 is downloaded.');
    notices.showError(new LinkError('noAnswer', 'silence'));
    await clock.advance(60_000);
    expect(noticeTexts()).toEqual([errorSentence('noAnswer')]);
  });

  test('the same thing is said once, and at most three things stand there', () => {
    const { notices, noticeTexts } = createTestPage();
    for (const text of ['a', 'b', 'a', 'c', 'd']) notices.show('warning', text);
    expect(noticeTexts()).toEqual(['a', 'c', 'd']);
  });

  test('what the person called off is no failure', () => {
    const { notices, noticeTexts } = createTestPage();
    notices.showError(new LinkError('cancelled', 'called off'));
    expect(noticeTexts()).toEqual([]);
  });

  test('a defect of ours is named as one', () => {
    const { notices } = createTestPage();
    notices.showError(new TypeError('x is undefined'));
    expect(notices.store.getState()[0]).toMatchObject({
      tone: 'danger',
      text: errorSentence('internal', 'x is undefined'),
    });
  });

  test('a value that the board cannot take is reported with its figures, in the language in use', async () => {
    const { notices, noticeTexts } = createTestPage();
    const refusal = new RangeRefusal({
      field: 'position',
      value: 2600,
      range: { min: 500, max: 2500 },
      servo: 3,
    });
    const failure = new LinkError('outOfRange', refusal.message, { cause: refusal });
    notices.showError(failure);
    await speak('zh');
    notices.showError(failure);
    await speak('en');
    expect(noticeTexts()).toEqual([
      'This value is out of range: the position of servo 3 is 2600, allowed is 500 to 2500.',
      '这个值超出范围：3号舵机的位置是2600，应在500到2500之间。',
    ]);
  });

  test('a dismissed notice is gone', () => {
    const { notices, noticeTexts } = createTestPage();
    notices.show('warning', 'a');
    notices.dismiss(notices.store.getState()[0]!.id);
    expect(noticeTexts()).toEqual([]);
  });
});
