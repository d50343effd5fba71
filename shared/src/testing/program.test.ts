import { expect, test } from 'vitest';
import { replayText } from './replay.ts';

const LOG = 'servodeck-log: 1\nboard: doc\nexpect: session battery 7500 mV\n1.0 > 55 55 02 0F\n';

test('a log whose expectations come true is good', async () => {
  const { output, isGood } = await replayText(`${LOG}1.03 < 55 55 04 0F 4C 1D`);
  expect(isGood).toBe(true);
  expect(output).toContain('ok      session battery 7500 mV');
});

test('a log whose expectations fail is not', async () => {
  const { output, isGood } = await replayText(LOG);
  expect(isGood).toBe(false);
  expect(output).toContain('FAILED  session battery 7500 mV');
});

test('what cannot be read is reported line by line', async () => {
  expect(await replayText(`${LOG}2.0 > 5Z`)).toEqual({
    output: 'This log cannot be read.\nline 5: "5Z" is no byte like 0F; words stand behind a #',
    isGood: false,
  });
});

test('an unknown board is answered with those there are', async () => {
  expect((await replayText(LOG, 'toaster')).output).toMatch(
    /^No simulated board is called "toaster"; there are doc, /u,
  );
});
