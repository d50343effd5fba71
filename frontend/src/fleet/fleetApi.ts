// The requests of the fleet page to the gateway that serves it. Each rejects with a GatewayProblem.

import type {
  FleetChanges,
  FleetCue,
  FleetDownloadWish,
  FleetRunWish,
  FleetStopped,
  FleetTask,
} from '#shared/client/http.generated.ts';
import { GatewayProblem } from '#shared/client/request.ts';
import { request } from '../robot/request.ts';
import { openDriveChannel, type DriveChannel, type DriveListener } from './driveChannel.ts';

const ANSWER_WITHIN_MS = 5000;

export interface FleetApi {
  /** What has changed since that revision; 0: all of it. */
  changes(since: number): Promise<FleetChanges>;
  /** null: of every robot of the site, known or not. */
  stop(robots: readonly string[] | null): Promise<FleetStopped>;
  run(wish: FleetRunWish): Promise<FleetTask>;
  download(wish: FleetDownloadWish): Promise<FleetTask>;
  /** Asks those again at which it failed. */
  retry(task: string): Promise<FleetTask>;
  resume(robots: readonly string[]): Promise<FleetTask>;
  /** Drives that robot for as long as the channel is open. */
  drive(robot: string, listener: DriveListener): DriveChannel;
  /** The cues of a show, in place of those before. */
  setCues(cues: readonly FleetCue[]): Promise<void>;
  /** Puts these robots into that group of robots alone; empty: into none. */
  group(robots: readonly string[], group: string): Promise<void>;
}

/** An answer that was cut off, or is another program's, is none: it says nothing of the fleet. */
async function answerOf<Answer>(requested: Promise<unknown>): Promise<Answer> {
  const answer = await requested;
  if (typeof answer !== 'object' || answer === null)
    throw new GatewayProblem(null, 'the gateway’s answer is none');
  return answer as Answer;
}

export const gatewayFleet: FleetApi = {
  changes: (since) =>
    answerOf<FleetChanges>(
      request('get', '/api/fleet', {
        withinMs: ANSWER_WITHIN_MS,
        query: { since },
      }),
    ),
  stop: (robots) =>
    answerOf<FleetStopped>(
      request('post', '/api/fleet/stop', {
        withinMs: ANSWER_WITHIN_MS,
        body: { robots: robots === null ? null : [...robots] },
      }),
    ),
  run: (body) => answerOf<FleetTask>(request('post', '/api/fleet/run', { withinMs: ANSWER_WITHIN_MS, body })),
  download: (body) =>
    answerOf<FleetTask>(request('post', '/api/fleet/download', { withinMs: ANSWER_WITHIN_MS, body })),
  retry: (task) =>
    answerOf<FleetTask>(
      request('post', '/api/fleet/tasks/{task}/retry', {
        withinMs: ANSWER_WITHIN_MS,
        values: { task },
      }),
    ),
  resume: (robots) =>
    answerOf<FleetTask>(
      request('post', '/api/fleet/resume', {
        withinMs: ANSWER_WITHIN_MS,
        body: { robots: [...robots] },
      }),
    ),
  drive: openDriveChannel,
  setCues: async (cues) => {
    await request('put', '/api/fleet/cues', { withinMs: ANSWER_WITHIN_MS, body: { cues: [...cues] } });
  },
  group: async (robots, group) => {
    const body = { robots: [...robots], group };
    await request('post', '/api/fleet/groups', { withinMs: ANSWER_WITHIN_MS, body });
  },
};
