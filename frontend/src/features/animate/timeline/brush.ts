// What everything that is painted is painted with, and of.

import type { Look } from '../../picture/look.ts';
import type { Scene } from './scene.ts';

export interface Brush {
  readonly ctx: CanvasRenderingContext2D;
  readonly look: Look;
  readonly scene: Scene;
}
