// What only the browser's driver can do for a test, in Node: real input, and what the system asks for. Coordinates are of the
// whole window.

import type { BrowserCommand } from 'vitest/node';

export type Act =
  | readonly ['move', number, number, number?]
  | readonly ['down' | 'up', number?, MouseButton?]
  | readonly ['wheel', number, number]
  | readonly ['keyDown' | 'keyUp' | 'press' | 'type' | 'insertText', string]
  | readonly ['leaveClipboard']
  | readonly ['touch', Touch, readonly { x: number; y: number; id: number }[]];

export type MouseButton = 'left' | 'middle' | 'right';
export type Touch = 'touchStart' | 'touchMove' | 'touchEnd';

export interface Media {
  readonly media?: 'screen' | 'print' | null;
  readonly colorScheme?: 'light' | 'dark' | null;
  readonly reducedMotion?: 'reduce' | 'no-preference' | null;
  readonly forcedColors?: 'active' | 'none' | null;
  readonly contrast?: 'more' | 'no-preference' | null;
}

export interface Screen {
  readonly hasTouch: boolean;
  readonly deviceScaleFactor: number;
}

type Context = Parameters<BrowserCommand>[0];
type Page = Context['page'];
type Devtools = Awaited<ReturnType<ReturnType<Page['context']>['newCDPSession']>>;

const opened = new WeakMap<Page, Promise<Devtools>>();

/** One for each window: a finger is known only to the session in which it came down. */
function devtoolsOf(page: Page): Promise<Devtools> {
  const devtools = opened.get(page) ?? page.context().newCDPSession(page);
  opened.set(page, devtools);
  return devtools;
}

/** Several at once: each call costs as much as ten acts. */
const act: BrowserCommand<[acts: readonly Act[]]> = async (context, acts) => {
  for (const one of acts) await perform(context, one);
};

/** All windows of the browser have one: the window that copied has it to itself until its page ends. */
const clipboard = { owner: '', waiting: [] as (() => void)[] };

async function takeClipboard(owner: string): Promise<void> {
  while (clipboard.owner !== '' && clipboard.owner !== owner)
    await new Promise<void>((resolve) => clipboard.waiting.push(resolve));
  clipboard.owner = owner;
}

function leaveClipboard(owner: string): void {
  if (clipboard.owner !== owner) return;
  clipboard.owner = '';
  for (const resolve of clipboard.waiting.splice(0)) resolve();
}

async function perform({ page, sessionId }: Context, one: Act): Promise<void> {
  const { mouse, keyboard } = page;
  switch (one[0]) {
    case 'move':
      return mouse.move(one[1], one[2], { steps: one[3] ?? 1 });
    case 'down':
      return mouse.down({ clickCount: one[1] ?? 1, button: one[2] ?? 'left' });
    case 'up':
      return mouse.up({ clickCount: one[1] ?? 1, button: one[2] ?? 'left' });
    case 'wheel':
      return mouse.wheel(one[1], one[2]);
    case 'keyDown':
      return keyboard.down(one[1]);
    case 'keyUp':
      return keyboard.up(one[1]);
    case 'press':
      if (/\+[cx]$/i.test(one[1])) await takeClipboard(sessionId);
      return keyboard.press(one[1]);
    case 'type':
      return keyboard.type(one[1]);
    case 'insertText':
      return keyboard.insertText(one[1]);
    case 'touch': {
      const devtools = await devtoolsOf(page);
      await devtools.send('Input.dispatchTouchEvent', { type: one[1], touchPoints: [...one[2]] });
      return;
    }
    case 'leaveClipboard':
      leaveClipboard(sessionId);
  }
}

const emulateMedia: BrowserCommand<[media: Media]> = ({ page }, media) => page.emulateMedia(media);

/** Room for the largest window of a test. */
export const BROWSER_WINDOW = { width: 1920, height: 1200 };

/** After fingers a headless browser has no pointer at all, neither coarse nor fine: what is laid out must not ask for a fine one. */
const emulateScreen: BrowserCommand<[screen: Screen]> = async ({ page }, { hasTouch, deviceScaleFactor }) => {
  const devtools = await devtoolsOf(page);
  await devtools.send('Emulation.setTouchEmulationEnabled', { enabled: hasTouch, maxTouchPoints: 2 });
  // Never cleared: that would take back the window's size too, and presses far below would meet what they were not meant for.
  await devtools.send('Emulation.setDeviceMetricsOverride', {
    ...BROWSER_WINDOW,
    ...{ deviceScaleFactor, mobile: false },
  });
};

/** The picture of a part of the window, as base64. */
const picture: BrowserCommand<[clip: { x: number; y: number; width: number; height: number }]> = async (
  { page },
  clip,
) => (await page.screenshot({ clip })).toString('base64');

export const commands = { act, emulateMedia, emulateScreen, picture };

declare module 'vitest/browser' {
  interface BrowserCommands {
    act(acts: readonly Act[]): Promise<void>;
    emulateMedia(media: Media): Promise<void>;
    emulateScreen(screen: Screen): Promise<void>;
    picture(clip: { x: number; y: number; width: number; height: number }): Promise<string>;
  }
}
