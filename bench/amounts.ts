// How much is measured: enough for figures to stand on, or with `--quick` enough to see that all of them can be taken.
// Knows no measurement.

export const isQuick = process.argv.includes('--quick');

export function amount(usual: number, quick: number): number {
  return isQuick ? quick : usual;
}
