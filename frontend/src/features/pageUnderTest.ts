// The page's stores with a simulated board in virtual time, for tests; assembled as in app/page.ts.

import { compileSource } from './board/compile/compileSource.ts';
import { createStore } from 'zustand/vanilla';
import { FAMILIES } from '#shared/codec/families.ts';
import { createRig } from '#shared/robot/rig.ts';
import type { Robot } from '#shared/robot/robot.ts';
import { createBlend, createPoses } from './poses/poses.ts';
import { createCompiled } from './board/compile/compiled.ts';
import { createDevice, type Way } from '../robot/device.ts';
import { createDocument } from './groupDocument.ts';
import { createMacroRun, createMacros } from './buttons/macroRun.ts';
import { createMotionTape } from './animate/play/motionTape.ts';
import { createNotices } from '../state/notices.ts';
import { createPlayback, createPlayhead } from './animate/play/playback.ts';
import { playerOf } from './animate/play/player.ts';
import { createRobots } from './profiles/robots.ts';
import { createGroupPlace } from './board/slots/groupPlace.ts';
import { createReplacing } from './board/slots/replacing.ts';
import { createSlots } from './board/slots/slots.ts';
import { createTimeline } from './animate/timeline/timeline.ts';
import { createView } from './view.ts';

const SIMULATED: Way = { kind: 'simulated', label: 'Simulated board', isSimulated: true };

/** `texts` is the browser's storage; two pages with the same texts are two visits. */
export async function createTestPage(
  texts = new Map<string, string>(),
  {
    way = SIMULATED,
    share = (robot) => robot,
    ...board
  }: { readonly way?: Way; readonly share?: (robot: Robot) => Robot } & Parameters<typeof createRig>[0] = {},
) {
  const rig = await createRig(board);
  const { clock } = rig;
  const storage = {
    getItem: (key: string) => texts.get(key) ?? null,
    setItem: (key: string, text: string) => void texts.set(key, text),
  };
  const notices = createNotices(clock);
  const robots = createRobots(storage, notices);
  const device = createDevice({ family: FAMILIES.doc, clock, notices, robots });
  const document = createDocument(storage, notices, clock);
  const view = createView({ browser: storage, tab: storage });
  const compiled = createCompiled({
    ...{ document, device, robots, clock },
    compileElsewhere: (source) => Promise.resolve(compileSource(source)),
  });
  const slots = createSlots({ device, robots, notices, storage, today: () => clock.now() });
  const timeline = createTimeline();
  const playhead = createPlayhead(timeline);
  /** The id of the open group in the library. */
  const opened = createStore(() => ({ openId: 'at hand' }));
  const place = createGroupPlace({ document, opened, view, slots, device });
  const replacing = createReplacing({ device, robots, slots, place });
  const prepared = createPlayback({
    ...{ device, document, compiled, slots, place, replacing, notices, view, playhead, robots },
    documentId: () => opened.getState().openId,
  });
  const playback = { ...prepared, ...playerOf(prepared) };
  device.attach(share(rig.session), way);
  const tape = createMotionTape({ device, robots, clock });
  const poses = createPoses({ storage, notices, robots, device, view });
  const macros = createMacros(storage, notices, robots);
  const macroRun = createMacroRun({ device, poses, robots, notices, clock });
  /** Advances the clock and draws frames, as a browser does. */
  async function draw(ms: number): Promise<void> {
    for (let passed = 0; passed < ms; passed += 20) {
      await clock.advance(20);
      device.refresh();
      playback.frame();
    }
  }
  return {
    ...{
      document,
      opened,
      place,
      replacing,
      view,
      timeline,
      compiled,
      slots,
      playhead,
      playback,
      tape,
      draw,
    },
    ...{ ...rig, texts, notices, robots, device, poses, macros, macroRun },
    blend: createBlend({ device, robots, view }),
    book: () => poses.book.store.getState().present,
    noticeTexts: () => notices.store.getState().map(({ text }) => text),
    moves: () => rig.ofKind('move'),
  };
}
