// The WebSocket of one robot that is driven from the fleet page, to the gateway that serves the page. Passes messages on; knows none of
// their meanings.

import { PROTOCOL } from '#shared/client/messages.generated.ts';
import type { DriveNews, DriveWish } from './drive.generated.ts';

export interface DriveListener {
  heard(news: DriveNews): void;
  /** The connection has ended, or there was none; `reason` may be empty. */
  ended(reason: string): void;
}

export interface DriveChannel {
  /** Dropped while there is no connection: nothing waits for a later one. */
  send(wish: DriveWish): void;
}

export function openDriveChannel(robot: string, listener: DriveListener): DriveChannel {
  const url = new URL(`./api/fleet/robots/${encodeURIComponent(robot)}/drive`, location.href);
  url.protocol = url.protocol.replace('http', 'ws');
  url.searchParams.set('protocol', String(PROTOCOL));
  const socket = new WebSocket(url);
  socket.onmessage = ({ data }) => listener.heard(JSON.parse(String(data)) as DriveNews);
  socket.onclose = ({ reason }) => listener.ended(reason);
  return {
    send: (wish) => {
      if (socket.readyState === WebSocket.OPEN) socket.send(JSON.stringify(wish));
    },
  };
}
