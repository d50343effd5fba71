// The gateway's ports: listing them, opening one; and listening at other speeds on the port in use, at the gateway or here. Trusts no
// answer's shape; every failure is a LinkError.

import timings from '../../../shared/protocol/timings.json' with { type: 'json' };
import { LinkError } from '#shared/robot/linkError.ts';
import { ANSWER_WITHIN_MS } from './gatewayApi.ts';
import { askGateway } from './links/gatewayValues.ts';
import { isRecord } from '#shared/client/request.ts';
import { findRate, type HeardAtRate } from './links/otherRates.ts';
import type { Opening } from './ways.ts';

export interface GatewayPort {
  readonly device: string;
  readonly description: string;
  /** The gateway's present one, by whichever of its names. */
  readonly inUse: boolean;
}

export interface FoundRate {
  readonly baud: number;
  readonly kind: 'packets' | 'text';
}

/** Ports of the gateway's machine, the likely ones first. */
export async function readPorts(): Promise<readonly GatewayPort[]> {
  const list: unknown = await askGateway('get', '/api/ports', { withinMs: ANSWER_WITHIN_MS });
  if (!Array.isArray(list)) throw new LinkError('internal', 'the gateway’s list of ports is no list');
  return list.filter(isPort).map(({ device, description, inUse }) => ({ device, description, inUse }));
}

/** Whatever board is there: the gateway knows it from before, or queries it. */
export async function openGatewayPort(device: string): Promise<void> {
  const body = { device, board: 'unknown' };
  await askGateway('put', '/api/port', { body, withinMs: ANSWER_WITHIN_MS });
}

/** On its port, which it gives up for that and opens again; null where nothing that can be read arrives. */
async function findGatewayRate(): Promise<FoundRate | null> {
  const found = await askGateway('post', '/api/port/listen', { withinMs: timings.line.listenedWithinMs });
  if (!isRecord(found) || typeof found.baud !== 'number') return null;
  return { baud: found.baud, kind: found.kind === 'packets' ? 'packets' : 'text' };
}

function isPort(value: unknown): value is GatewayPort {
  return (
    isRecord(value) &&
    typeof value.device === 'string' &&
    typeof value.description === 'string' &&
    typeof value.inUse === 'boolean'
  );
}

interface FindRateOptions {
  readonly isReadable: (heard: HeardAtRate) => boolean;
  detach(): Promise<void>;
  reopen(port: SerialPort): Promise<void>;
}

/** null where nothing that can be read arrives by itself. Rejects with a LinkError. */
export async function findRateOf(opening: Opening, options: FindRateOptions): Promise<FoundRate | null> {
  return opening.way().kind === 'gateway' ? findGatewayRate() : findHere(opening.port as SerialPort, options);
}

async function findHere(
  port: SerialPort,
  { isReadable, detach, reopen }: FindRateOptions,
): Promise<FoundRate | null> {
  await detach();
  try {
    const heard = await findRate(port, isReadable);
    return heard && { baud: heard.baud, kind: heard.packets > 0 ? 'packets' : 'text' };
  } finally {
    await reopen(port);
  }
}
