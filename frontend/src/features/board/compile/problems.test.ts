import { problemText } from './problems.tsx';
import { afterEach, expect, test } from 'vitest';
import { emptyGroup } from '#shared/group/group.ts';
import { readyRobot } from '#shared/profile/readyRobots.ts';
import { FAMILIES } from '#shared/codec/families.ts';
import { robotNames } from '../../../i18n/sentences.ts';
import { speak } from '../../../i18n/words.ts';

afterEach(() => speak('en'));

test('how far off the board would be is a whole number with its unit, and what helps is said', async () => {
  const problem = { kind: 'deviation', servo: 4, atMs: 2000, units: 44.556, limit: 5 } as const;
  const robot = readyRobot('arm', 'doc', robotNames('arm'));
  const source = { group: emptyGroup('Wave', 'us'), robot, family: FAMILIES.doc, maxErrorUnits: 5 };
  expect(problemText(problem, source)).toMatch(
    /^Elbow at .* off by 45\sµs; 5\sµs is allowed\. Give it more time, or allow a larger error\.$/,
  );
  await speak('zh');
  expect(problemText(problem, source)).toMatch(/^Elbow.*偏差45微秒/);
});
