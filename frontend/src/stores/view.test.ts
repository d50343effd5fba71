import { expect, test } from 'vitest';
import { createView } from './view.ts';

function storageWith(text: string | null) {
  const stored = new Map(text === null ? [] : [['servodeck.view', text]]);
  return {
    stored,
    getItem: (key: string) => stored.get(key) ?? null,
    setItem: (key: string, value: string) => void stored.set(key, value),
  };
}

test('the theme is remembered, other words in its place are not taken', () => {
  const storage = storageWith(null);
  createView(storage).setState({ theme: 'dark' });
  expect(createView(storage).getState().theme).toBe('dark');
  expect(createView(storageWith('<script>')).getState().theme).toBe('system');
});

test('so are the unit of positions and how servos are laid out', () => {
  const storage = storageWith(null);
  createView(storage).setState({ positionsIn: 'degrees', servoLayout: 'body' });
  expect(createView(storage).getState()).toMatchObject({ positionsIn: 'degrees', servoLayout: 'body' });
});

test('what else is open or selected begins anew', () => {
  const storage = storageWith(null);
  createView(storage).setState({ tab: 'log', slot: 7 });
  expect(createView(storage).getState()).toMatchObject({ tab: 'live', slot: 0 });
});

test('the kiosk outlives a reload, until somebody leaves it', () => {
  const storage = storageWith(null);
  createView(storage).setState({ kiosk: 'on' });
  expect(createView(storage).getState().kiosk).toBe('on');
  createView(storage).setState({ kiosk: 'off' });
  expect(createView(storage).getState().kiosk).toBe('off');
});
