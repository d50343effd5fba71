// The gateway's errors for a program: its codes, and two of this side of the line, as backend/servodeck/client/errors.py has them.
// Knows no route.

import type { GatewayProblem } from './request.ts';
import type { Problem } from './http.generated.ts';

/** Every failure. `code` is the gateway's word for programs, `message` its sentence for people; `unknown` codes are of a newer gateway. */
export class GatewayError extends Error {
  override readonly name: string = 'GatewayError';

  constructor(
    readonly code: Problem['code'] | (string & {}),
    detail: string,
    /** With `portBusy`: the programs that have the port, where the gateway's system reports them. */
    readonly heldBy: readonly string[] = [],
    options?: ErrorOptions,
  ) {
    super(detail, options);
  }
}

/** No gateway answers there, or its answer was lost: the outcome is unknown. */
export class UnreachableError extends GatewayError {
  override readonly name = 'UnreachableError';

  constructor(detail: string, options?: ErrorOptions) {
    super('noAnswer', detail, [], options);
  }
}

/** The end did not come in the time that was allowed; what this program had begun is stopped. */
export class TimedOutError extends GatewayError {
  override readonly name = 'TimedOutError';

  constructor(detail: string) {
    super('noAnswer', detail);
  }
}

export function errorOf(problem: GatewayProblem): GatewayError {
  const { code, message, heldBy } = problem;
  if (code === null) return new UnreachableError(sentence(message), { cause: problem.cause });
  return new GatewayError(code, message, heldBy, { cause: problem });
}

const sentence = (words: string): string => `${words.slice(0, 1).toUpperCase()}${words.slice(1)}.`;
