// The page's stores around a simulated board in virtual time, as connect/page.ts puts them together, for tests.

import { FAMILIES } from '#shared/protocol/families.ts';
import { createRig } from '#shared/session/rig.ts';
import { createDevice } from './device.ts';
import { createMacroRun } from './macroRun.ts';
import { createMacros } from './macros.ts';
import { createNotices } from './notices.ts';
import { createPoses } from './poses.ts';
import { createRobots } from './robots.ts';

/** `texts` is what the browser kept; two desks with the same texts are two visits. */
export async function createDesk(texts = new Map<string, string>()) {
  const rig = await createRig();
  const { clock } = rig;
  const storage = {
    getItem: (key: string) => texts.get(key) ?? null,
    setItem: (key: string, text: string) => void texts.set(key, text),
  };
  const notices = createNotices(clock);
  const robots = createRobots(storage, notices);
  const device = createDevice({ family: FAMILIES.doc, clock, notices, robots });
  device.attach(rig.session, { kind: 'simulated', label: 'Simulated board', isSimulated: true });
  const poses = createPoses({ storage, notices, robots, device });
  const macros = createMacros(storage, notices, robots);
  const macroRun = createMacroRun({ device, poses, robots, notices, clock });
  return {
    ...{ ...rig, texts, notices, robots, device, poses, macros, macroRun },
    book: () => poses.book.store.getState().present,
    told: () => notices.store.getState().map(({ text }) => text),
    moves: () => rig.ofKind('move'),
  };
}
