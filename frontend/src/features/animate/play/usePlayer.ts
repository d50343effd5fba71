// What plays the group at hand; it is there from the first panel on that has buttons for it.

import type { Player } from './playback.ts';
import { playerOf } from './player.ts';
import { useStores } from '../../stores.ts';

export const usePlayer = (): Player => playerOf(useStores().playback);
