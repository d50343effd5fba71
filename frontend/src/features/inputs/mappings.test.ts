import { describe, expect, test } from 'vitest';
import { type Mapping, readyMapping } from '#shared/profile/mapping.ts';
import { createVirtualClock } from '#shared/testing/virtualClock.ts';
import { createMappings } from './pad.ts';
import { createNotices } from '../../state/notices.ts';
import { createRobots, freshRobot } from '../profiles/robots.ts';

function page(texts = new Map<string, string>()) {
  const storage = {
    getItem: (key: string) => texts.get(key) ?? null,
    setItem: (key: string, text: string) => void texts.set(key, text),
  };
  const notices = createNotices(createVirtualClock());
  const robots = createRobots(storage, notices);
  const mappings = createMappings(storage, notices, robots);
  const noticeTexts = () => notices.store.getState().length;
  const bindings = () => mappings.store.getState().present.bindings.length;
  return { texts, robots, mappings, noticeTexts, bindings };
}

const emptied = (mapping: Mapping): Mapping => ({ ...mapping, bindings: [] });

describe('mappings', () => {
  test('a robot has the ready one until a person changes it; then it is there at the next visit', () => {
    const { texts, mappings, robots } = page();
    expect(mappings.store.getState().present).toEqual(readyMapping(robots.current().robot));
    mappings.edit(() => 'empty', emptied);
    expect(page(texts).bindings()).toBe(0);
  });

  test('edits are undone and redone', () => {
    const { mappings, bindings } = page();
    const before = bindings();
    mappings.edit(() => 'empty', emptied);
    mappings.undo();
    expect(bindings()).toBe(before);
    mappings.redo();
    expect(bindings()).toBe(0);
  });

  test('each robot has its own, with its own undo', () => {
    const { robots, mappings, bindings } = page();
    const { id } = robots.current();
    mappings.edit(() => 'empty', emptied);
    robots.add(() => 'add', freshRobot('hand', 'doc'));
    expect(bindings()).toBeGreaterThan(0);
    mappings.undo();
    expect(bindings()).toBeGreaterThan(0);
    robots.takeUp(id);
    expect(bindings()).toBe(0);
    mappings.undo();
    expect(bindings()).toBeGreaterThan(0);
  });

  test('saved text that is none of ours is set aside', () => {
    const { texts, noticeTexts, bindings } = page(new Map([['servodeck.mapping.1', 'x']]));
    expect(texts.get('servodeck.mapping.1.unreadable')).toBe('x');
    expect(noticeTexts()).toBe(1);
    expect(bindings()).toBeGreaterThan(0);
  });
});
