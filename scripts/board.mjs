// `npm run board`: the simulated board alone on a serial device, for other programs. Arguments go to the simulator,
// for example `npm run board -- --seed 7 --fault lostAck`.

import { simulatedBoard } from './cable.mjs';
import { endChildren, onEnd } from './children.mjs';
import { setUp } from './setup.mjs';
import { main, say } from './steps.mjs';

await main(async () => {
  onEnd(() => void endChildren().then(() => process.exit(0)));
  await setUp();
  const cable = await simulatedBoard({
    link: 'build/simulated-board',
    simulatorArgs: process.argv.slice(2),
    onLine: say,
    onLost: () => say('The simulated board has ended.'),
  });
  await cable.plug();
  if (!cable.isPlugged()) return 1;
  say(`The simulated board is on ${cable.device}. Ctrl-C ends it.`);
  return 0;
});
