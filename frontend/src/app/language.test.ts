import { afterEach, expect, test } from 'vitest';
import { eventually } from '#shared/testing/eventually.ts';
import { createVirtualClock } from '#shared/testing/virtualClock.ts';
import { undoLabel } from '#shared/document/history.ts';
import { speak, words } from '../i18n/words.ts';
import { createTestPage } from '../features/pageUnderTest.ts';
import { followLanguage, createView } from '../features/view.ts';
import { createNotices } from '../state/notices.ts';

afterEach(() => speak('en'));

async function visit(tags: readonly string[], texts = new Map<string, string>()) {
  const storage = {
    getItem: (key: string) => texts.get(key) ?? null,
    setItem: (key: string, text: string) => void texts.set(key, text),
  };
  const view = createView({ browser: storage, tab: storage });
  await followLanguage({ view, notices: createNotices(createVirtualClock()), tags });
  return view;
}

const spoken = (locale: string) => eventually(() => expect(words.locale).toBe(locale));

test('the page begins in the language of the browser', async () => {
  await visit(['zh-CN', 'en']);
  expect(words.stop.button).toBe('停止');
});

test('a choice is spoken at once, and again at the next visit', async () => {
  const texts = new Map<string, string>();
  const view = await visit(['en'], texts);
  view.setState({ language: 'zh' });
  await spoken('zh-CN');
  await speak('en');
  await visit(['en'], texts);
  expect(words.locale).toBe('zh-CN');
});

test('left to the system again, it is the language of the browser again', async () => {
  const view = await visit(['zh']);
  view.setState({ language: 'en' });
  await spoken('en');
  view.setState({ language: 'system' });
  await spoken('zh-CN');
});

test('robots are named in the language they are made in, and steps named in the one they are read in', async () => {
  await visit(['zh']);
  const { robots } = await createTestPage();
  const { robot } = robots.current();
  expect([robot.name, robot.servos[0]?.name]).toEqual(['机械臂', '夹爪']);
  robots.duplicate();
  expect(undoLabel(robots.store.getState())).toBe('复制机器人');
  await speak('en');
  expect(undoLabel(robots.store.getState())).toBe('duplicate robot');
});
