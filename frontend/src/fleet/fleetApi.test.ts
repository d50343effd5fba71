import { afterEach, expect, test, vi } from 'vitest';
import { GatewayProblem } from '#shared/client/request.ts';
import { gatewayFleet } from './fleetApi.ts';

afterEach(() => vi.unstubAllGlobals());

test('an answer that is cut off is a problem of the gateway, which the page shows and asks again after', async () => {
  vi.stubGlobal('fetch', () => Promise.resolve(new Response('{"revision": 4, "robo')));
  await expect(gatewayFleet.changes(0)).rejects.toBeInstanceOf(GatewayProblem);
  await expect(gatewayFleet.stop(null)).rejects.toBeInstanceOf(GatewayProblem);
});
