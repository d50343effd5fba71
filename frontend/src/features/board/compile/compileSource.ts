// What a group becomes on its board, worked out from all that it depends on: in the page, or beside it. Keeps nothing.

import { compile, type Compiled } from '#shared/group/compile.ts';
import type { ActionGroup } from '#shared/group/group.ts';
import type { Robot } from '#shared/profile/robot.ts';
import { boardFingerprint } from '#shared/group/fingerprint.ts';
import type { Family } from '#shared/codec/families.ts';

export interface Source {
  readonly group: ActionGroup;
  readonly family: Family;
  readonly robot: Robot;
  readonly maxErrorUnits: number;
}

export interface CompileResult extends Compiled {
  /** Of the frames as the board gets them, with trims. */
  readonly fingerprint: string;
}

export function compileSource({ group, ...options }: Source): CompileResult {
  const { frames, report } = compile(group, options);
  return { frames, report, fingerprint: boardFingerprint(options.robot, frames) };
}
