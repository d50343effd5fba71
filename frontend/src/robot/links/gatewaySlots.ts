// The gateway's downloads as this page sees them: begins one, hears how far the latest is, calls it off. The gateway stores by
// itself and continues when the page is closed. Knows jobs and their route; no socket.

import { fingerprintOf } from '#shared/group/fingerprint.ts';
import { LinkError } from '#shared/robot/linkError.ts';
import { DOWNLOAD_PORTION_BYTES } from '#shared/robot/timings.ts';
import type { DownloadProgress, SlotGroup, SlotVersions } from '#shared/robot/state.ts';
import type { GroupBody } from '#shared/client/http.generated.ts';
import { isRecord } from '#shared/client/request.ts';
import { askGateway, frameBody, refusal } from './gatewayValues.ts';
import type { JobState, StateMessage } from '#shared/client/messages.generated.ts';

/** As large as half a megabyte, which a slow network takes a while for. */
const TAKEN_WITHIN_MS = 8_000;

export interface GatewaySlots {
  /** Slots that hold half a group. */
  readonly broken: readonly number[];
  readonly versions: SlotVersions;
  /** The latest download, whichever client began it; null where there was none. */
  readonly download: (DownloadProgress & { readonly isOver: boolean }) | null;
  /** In their order; resolves when the board has all of them; rejects with what ended it. */
  store(groups: readonly SlotGroup[]): Promise<void>;
  /** Calls off the one under way. */
  cancel(): Promise<void>;
  jobChanged(job: JobState | null): void;
  slotsChanged(broken: readonly number[], versions: StateMessage['slotVersions']): void;
  /** The gateway is gone: the waiting for a download ends, though the download may go on. */
  gone(error: LinkError): void;
}

interface Waiter {
  readonly id: string;
  readonly resolve: () => void;
  readonly reject: (error: LinkError) => void;
}

/** `begin` gives the nonce of this page's lease; `changed` hears that something of it is another now. */
export function createGatewaySlots(begin: () => Promise<string>, changed: () => void): GatewaySlots {
  let job: JobState | null = null;
  let broken: readonly number[] = [];
  let versions: SlotVersions = {};
  let waiter: Waiter | null = null;

  function settle(): void {
    if (waiter === null || job?.id !== waiter.id || job.status === 'running') return;
    const { resolve, reject } = waiter;
    waiter = null;
    if (job.status === 'done') resolve();
    else reject(refusal(job.code ?? 'internal', job.detail ?? ''));
  }

  async function handOver(portion: readonly SlotGroup[], behind?: string): Promise<string> {
    const nonce = await begin();
    const body = { groups: portion.map(toBody), nonce, ...(behind !== undefined && { behind }) };
    const taken = await askGateway('post', '/api/download', { body, withinMs: TAKEN_WITHIN_MS });
    if (!isRecord(taken) || typeof taken.id !== 'string')
      throw new LinkError('internal', 'the gateway’s answer is no job');
    return taken.id;
  }

  /** While the first ones are stored, which takes longer: from then on the gateway needs this page no more. */
  async function handOverRest(rest: readonly (readonly SlotGroup[])[], id: string): Promise<void> {
    for (const portion of rest) await handOver(portion, id);
  }

  return {
    get broken() {
      return broken;
    },
    get versions() {
      return versions;
    },
    get download() {
      if (job === null) return null;
      const { slots, groupsStored, framesStored, frameCount, bytesSent, bytesTotal, remainingMs } = job;
      const progress = { slots, groupsStored, framesStored, frameCount, bytesSent, bytesTotal, remainingMs };
      return { ...progress, isOver: job.status !== 'running' };
    },
    async store(groups) {
      const [first = [], ...rest] = portions(groups);
      const id = await handOver(first);
      const ended = new Promise<void>((resolve, reject) => {
        waiter = { id, resolve, reject };
        // Its end may have come before its beginning was answered.
        settle();
      });
      await Promise.all([ended, handOverRest(rest, id)]);
    },
    async cancel() {
      if (job?.status !== 'running') return;
      await askGateway('delete', '/api/jobs/{job}', { values: { job: job.id }, withinMs: TAKEN_WITHIN_MS });
    },
    jobChanged(next) {
      job = next;
      settle();
      changed();
    },
    slotsChanged(nextBroken, next) {
      const nextVersions = versionsOf(next);
      const isSame = nextBroken.join() === broken.join() && isAlike(nextVersions, versions);
      if (isSame) return;
      broken = nextBroken;
      versions = nextVersions;
      changed();
    },
    gone(error) {
      job = null;
      waiter?.reject(error);
      waiter = null;
    },
  };
}

function portions(groups: readonly SlotGroup[]): readonly (readonly SlotGroup[])[] {
  const all: SlotGroup[][] = [];
  let roomBytes = 0;
  for (const group of groups) {
    const bytes = JSON.stringify(toBody(group)).length + 1; // figures and letters of one byte each, and a comma
    if (bytes > roomBytes) {
      all.push([]);
      roomBytes = DOWNLOAD_PORTION_BYTES;
    }
    all.at(-1)?.push(group);
    roomBytes -= bytes;
  }
  return all;
}

function toBody({ slot, frames, replaces, name = '', documentId = null }: SlotGroup): GroupBody {
  const version = fingerprintOf(frames);
  const about = { slot, version, name, document: documentId };
  return { ...about, ...(replaces !== undefined && { replaces }), frames: frames.map(frameBody) };
}

function versionsOf(slots: StateMessage['slotVersions']): SlotVersions {
  return Object.fromEntries(
    Object.entries(slots).map(([slot, { document, ...stored }]) => [
      slot,
      { ...stored, documentId: document },
    ]),
  );
}

function isAlike(one: SlotVersions, other: SlotVersions): boolean {
  const slots = Object.keys(one).map(Number);
  return (
    slots.length === Object.keys(other).length &&
    slots.every(
      (slot) => one[slot]?.version === other[slot]?.version && one[slot]?.atMs === other[slot]?.atMs,
    )
  );
}
