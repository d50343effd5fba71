import { expect, test } from 'vitest';
import { createView, INITIAL_VIEW, type Memories } from './view.ts';

function storageWith(text: string | null) {
  const stored = new Map(text === null ? [] : [['servodeck.view', text]]);
  return {
    getItem: (key: string) => stored.get(key) ?? null,
    setItem: (key: string, value: string) => void stored.set(key, value),
  };
}

const memoriesWith = (text: string | null): Memories => ({
  browser: storageWith(text),
  tab: storageWith(null),
});

test('the theme is remembered, other words in its place are not taken', () => {
  const memories = memoriesWith(null);
  createView(memories).setState({ theme: 'dark' });
  expect(createView(memories).getState().theme).toBe('dark');
  expect(createView(memoriesWith('<script>')).getState().theme).toBe('system');
});

test('so are the unit of positions and how servos are laid out', () => {
  const memories = memoriesWith(null);
  createView(memories).setState({ positionsIn: 'degrees', servoLayout: 'body' });
  expect(createView(memories).getState()).toMatchObject({ positionsIn: 'degrees', servoLayout: 'body' });
});

test('so are the sound and the sizes of parts; a size that is no number is not taken', () => {
  const memories = memoriesWith(null);
  createView(memories).setState({ sound: 'muted', splits: { driveSide: 420 } });
  expect(createView(memories).getState()).toMatchObject({ sound: 'muted', splits: { driveSide: 420 } });
  memories.browser.setItem('servodeck.splits', '{"driveSide":"wide","boardLog":300}');
  expect(createView(memories).getState().splits).toEqual({ boardLog: 300 });
});

test('a browser that forbids storage has the usual view', () => {
  const forbidden = {
    getItem: () => {
      throw new DOMException('forbidden', 'SecurityError');
    },
    setItem: () => {
      throw new DOMException('forbidden', 'SecurityError');
    },
  };
  const view = createView({ browser: forbidden, tab: forbidden });
  expect(view.getState()).toEqual(INITIAL_VIEW);
  view.setState({ theme: 'dark' });
  expect(view.getState().theme).toBe('dark');
});

test('what is worked on outlives a reload of its tab; another tab begins anew', () => {
  const memories = memoriesWith(null);
  createView(memories).setState({ tab: 'actions', authoring: 'poses' });
  expect(createView(memories).getState()).toMatchObject({ tab: 'actions', authoring: 'poses' });
  const otherTab = createView({ ...memories, tab: storageWith(null) });
  expect(otherTab.getState()).toMatchObject({ tab: 'live', authoring: 'group' });
});

test('so does how far a calibration has come; what is none is not taken', () => {
  const memories = memoriesWith(null);
  const done = [{ servo: 1, step: 'min' }] as const;
  const found = { servo: 1, end: 'min', at: 700, home: 1500 } as const;
  const calibration = { robotId: 3, progress: { servo: 1, step: 'max', done, found } } as const;
  createView(memories).setState({ calibration });
  expect(createView(memories).getState().calibration).toEqual(calibration);
  memories.tab.setItem(
    'servodeck.calibration',
    '{"robotId":3,"progress":{"servo":1,"step":"run","done":[]}}',
  );
  expect(createView(memories).getState().calibration).toBeNull();
});

test('what else is open or selected begins anew', () => {
  const memories = memoriesWith(null);
  createView(memories).setState({ connectOpen: true, robotView: 'calibrate', slot: 7, untilStopped: true });
  expect(createView(memories).getState()).toEqual(INITIAL_VIEW);
});

test('the kiosk outlives a reload, until a person leaves it', () => {
  const memories = memoriesWith(null);
  createView(memories).setState({ kiosk: 'on' });
  expect(createView(memories).getState().kiosk).toBe('on');
  createView(memories).setState({ kiosk: 'off' });
  expect(createView(memories).getState().kiosk).toBe('off');
});
