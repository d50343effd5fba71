// What component tests are judged by: an expectation that does not hold fails.

import { expect, test } from './harness/test.ts';

test('what is said to be otherwise fails where it is just so, and a press on what never comes', async ({
  page,
}) => {
  const element = document.createElement('input');
  Object.assign(element, { value: 'one', className: 'one', ariaLabel: 'one' });
  element.style.setProperty('display', 'block');
  const line = document.createElement('p');
  line.textContent = 'one';
  document.body.append(element, line);
  const [field, said] = [page.locator('input.one'), page.locator('p')];
  const soon = { timeout: 0 };
  const failing = [
    page.getByRole('button', { name: 'Nowhere' }).click(),
    expect(said).not.toHaveText('one', soon),
    expect(said).not.toHaveText(['one'], soon),
    expect(said).not.toHaveText(/o/, soon),
    expect(said).not.toContainText('on', soon),
    expect(said).not.toHaveCount(1, soon),
    expect(said).not.toBeVisible(soon),
    expect(field).not.toHaveValue('one', soon),
    expect(field).not.toHaveAttribute('class', 'one', soon),
    expect(field).not.toHaveAttribute('class', undefined, soon),
    expect(field).not.toHaveCSS('display', 'block', soon),
    expect(field).not.toHaveAccessibleName('one', soon),
    expect(field).not.toBeEnabled(soon),
  ];
  const outcomes = await Promise.allSettled(failing);
  expect(outcomes.map(({ status }) => status)).toEqual(failing.map(() => 'rejected'));
  expect(outcomes[0]).toMatchObject({ reason: { message: expect.stringContaining('nothing is there') } });

  await expect(said).not.toHaveText('two');
  await expect(said).not.toHaveText(['one', 'two']);
  await expect(field).not.toHaveValue('two');
  await expect(field).not.toHaveAttribute('class', 'two');
});
