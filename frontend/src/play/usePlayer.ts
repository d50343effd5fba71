// What plays the group at hand; it is there from the first panel on that has buttons for it.

import type { Player } from '../stores/playing/playback.ts';
import { playerOf } from '../stores/playing/player.ts';
import { useStores } from '../stores/stores.ts';

export const usePlayer = (): Player => playerOf(useStores().playback);
