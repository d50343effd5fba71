// The page in Chinese: nothing of it is left in English, in any state that the gallery knows, and changing the language costs
// nothing that a person has done.

import { vi } from 'vitest';
import type { Page } from './harness/page.ts';
import * as gallery from '../../e2e/fixtures/gallery.ts';
import { isExhaustive } from './harness/sound.ts';
import { dashboardOf, expect, here, test } from './harness/test.ts';

const { walkGallery } = here(gallery);

/** Names, formats, units and keys that are written so in Chinese too. */
const NAMES = `
  Servodeck Chrome Edge Firefox Windows macOS Linux ChromeOS Arch Snap Flatpak Python Arduino XML CSV
  LSC OpenArm uHand xArm LeArm Tonybot TonyPi SpiderPi MasterPi ArmPi AiNex AI ESP PWM CH SER WCH USB TTL COM LPT
  GND RX TX LEN PC App Esc Ctrl Shift Alt Home End START mV English HID LOBOT Hiwonder BT24 BT Android Bluetooth chrome flags enable web bluetooth ble NAME serial hid sudo servodeck udev rule install
  http https Tailscale SSH Caddy Authorization Bearer`.split(/\s+/u);
/** What people call their own things in the gallery, and what a browser calls a pad. */
const GIVEN = [
  ...['Shelf arm', 'Desk arm', 'Greet the visitor', 'Look down', 'Look up', 'Sit', 'Dance', 'wave', 'nod'],
  ...[
    'Pick up the red cube and put it down',
    'Wave to the visitors at the door',
    'Bow',
    'Wave',
    'c0ffee',
    'greeting',
    'show',
    'work',
  ],
  ...[
    'Anna',
    'Bert',
    'Cleo',
    'A robot of somebody else',
    'dev/ttyUSB',
    'dev/ttyACM',
    'Wireless Controller',
    'detail of the failure',
    'Ben, whose name is rather long for one row',
    'On the robot',
    'The very long name of a thing that somebody liked to call it so.',
    'iPhone',
  ],
  ...[
    'http://192.168.1.5:8300/#pair=not-a-real-one',
    'http://192.168.1.5:8300/#stop=x',
    'abc123.not-a-real-one',
  ],
];

/** What opens each, and what closes it. */
const DIALOGS = [
  ['电池设置', '关闭'],
  ['全部擦除', '保留'],
  ['连接', '关闭'],
  ['机器人：机械臂', '关闭'],
] as const;

/** Every text that is seen or spoken, apart from what says of itself that it is English. */
async function textsOf(page: Page): Promise<readonly string[]> {
  return page.evaluate(() => {
    const isChinese = (element: Element | null): boolean =>
      element?.closest('[lang]')?.getAttribute('lang') === 'zh-CN';
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    const texts = new Set<string>();
    for (let node = walker.nextNode(); node !== null; node = walker.nextNode()) {
      if (
        isChinese(node.parentElement) &&
        node.parentElement?.closest('code, script, style, noscript') === null
      )
        texts.add(node.textContent ?? '');
    }
    for (const name of ['aria-label', 'aria-valuetext', 'aria-description', 'title', 'placeholder', 'alt']) {
      for (const element of document.querySelectorAll(`[${name}]:not(article)`))
        if (isChinese(element)) texts.add(element.getAttribute(name) ?? '');
    }
    return [...texts];
  });
}

/** Runs of letters that are no name; commands to type and bytes in hex are as they are. */
function englishIn(text: string): readonly string[] {
  const rest = GIVEN.reduce((left, given) => left.replaceAll(given, ''), text)
    .replace(/“[\x20-\x7e]+”/gu, '')
    .replace(/(No\.10 )?\w*\.(xml|rob|d6a|csv|json)\b/gu, '')
    .replace(/\b[0-9A-F]{2}( [0-9A-F]{2})+\b/gu, '');
  return (rest.match(/[A-Za-z]{2,}/gu) ?? []).filter((run) => !NAMES.includes(run));
}

async function expectChinese(page: Page, state: string): Promise<void> {
  const left = (await textsOf(page)).filter((text) => englishIn(text).length > 0);
  expect.soft(left, state).toEqual([]);
}

if (isExhaustive)
  test('no state of the gallery has an English sentence left', async ({ page, url }) => {
    await walkGallery({ page, url, language: 'zh' }, (state) => expectChinese(page, state));
  });

test.describe('in a Chinese browser', () => {
  test.beforeEach(() => void vi.spyOn(navigator, 'languages', 'get').mockReturnValue(['zh-CN']));

  test('the page is Chinese from the start, whatever is opened', async ({ page, url }) => {
    const button = (name: string) => page.getByRole('button', { name, exact: true });
    const dialog = page.getByRole('dialog').or(page.getByRole('alertdialog'));
    const ends = (name: string) => dialog.getByRole('button', { name, exact: true });
    await page.goto(url);
    await expect(button('停止')).toBeVisible();
    await expect(page.locator('html')).toHaveAttribute('lang', 'zh-CN');
    await button('显示日志').click();
    await expectChinese(page, 'ready');
    for (const [open, close] of DIALOGS) {
      await button(open).click();
      await expect(ends(close)).toBeVisible();
      await expectChinese(page, open);
      await ends(close).click();
    }
    for (const part of ['姿态', '键盘和手柄', '按钮']) {
      await page.getByRole('radio', { name: part }).check();
      await expectChinese(page, part);
    }
    await page.getByRole('switch', { name: '编辑按钮' }).check();
    await button('添加按钮').click();
    await expectChinese(page, 'editing a button');
    await button('展示模式').click();
    await expectChinese(page, 'kiosk');
    await page.keyboard.press('Escape');
    await expect(button('恢复')).toBeVisible();
    await expectChinese(page, 'stopped');
  });
});

test('another language changes every word at once, loses nothing and is remembered', async ({
  page,
  url,
}) => {
  const dashboard = dashboardOf(page);
  await page.goto(url);
  await expect(dashboard.link).toContainText('Ready');
  await dashboard.capture.click();
  await dashboard.button('Show the log').click();
  const typed = page.getByRole('textbox', { name: 'Packet in hex' });
  await typed.fill('55 55 02');

  const language = page.getByRole('combobox', { name: 'Language' });
  await language.focus();
  await language.selectOption('中文');
  await expect(page.getByRole('button', { name: '停止', exact: true })).toBeVisible();
  await expect(page.getByRole('button', { name: '撤销：记录一帧' })).toBeEnabled();
  await expect(page.getByRole('textbox', { name: '十六进制数据包' })).toHaveValue('55 55 02');
  await expect(page.getByRole('log', { name: '数据包' })).toContainText('连接就绪');
  await expect(page.getByRole('combobox', { name: '语言' })).toBeFocused();
  await expect(page.locator('html')).toHaveAttribute('lang', 'zh-CN');

  await page.reload();
  await expect(page.getByRole('button', { name: '停止', exact: true })).toBeVisible();
  await page.getByRole('combobox', { name: '语言' }).selectOption('English');
  await expect(dashboard.stop).toBeVisible();
  await expect(page.locator('html')).toHaveAttribute('lang', 'en');
});
