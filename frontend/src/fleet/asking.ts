// What a person asks of the gateway, and why it was refused, in a sentence.

import { useState } from 'react';
import { GatewayProblem } from '#shared/client/request.ts';
import { words } from '../i18n/whole.ts';

/** In the gateway's own words; where it has not answered, what was asked may have been done all the same. */
export const refusalText = ({ code, message }: GatewayProblem): string =>
  code === null ? words.fleet.unanswered : message;

/** `problem`: why the latest one was refused, empty where it was not. */
export function useAsking() {
  const [problem, setProblem] = useState('');
  const ask = (work: () => Promise<unknown>): void => {
    setProblem('');
    void work().catch((error: unknown) => {
      if (!(error instanceof GatewayProblem)) throw error;
      setProblem(refusalText(error));
    });
  };
  return { problem, ask };
}
