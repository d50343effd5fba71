// One measured figure and what it stands beside. Knows neither how it was measured nor how it is shown.

/** What a user would use instead, or the limit that nothing can pass; measured or computed in the same run. */
export interface Rival {
  readonly what: string;
  /** In the figure's unit. */
  readonly value: number;
}

export interface Figure {
  /** The key of the JSON object, e.g. `codec.decodeMBs`; its part before the first dot is the group. */
  readonly key: string;
  readonly value: number;
  /** Empty for a plain ratio. */
  readonly unit: string;
  readonly against?: Rival;
  /** What was promised, where something was; `npm run bench` says which are missed. */
  readonly limit?: { readonly atMost: number } | { readonly atLeast: number };
  /** One line for people: what was measured and on how many samples. */
  readonly note: string;
}

/** `value / against`: below 1 is better for times and sizes, above 1 for throughput. */
export function ratioOf({ value, against }: Figure): number | null {
  return against === undefined ? null : value / against.value;
}

/** The flat object for machines: `key`, and beside it `keyAgainst` and `keyRatio` where there is something to compare. */
export function toRecord(figures: readonly Figure[]): Record<string, number> {
  const record: Record<string, number> = {};
  for (const figure of figures) {
    record[figure.key] = rounded(figure.value);
    const ratio = ratioOf(figure);
    if (figure.against === undefined || ratio === null) continue;
    record[`${figure.key}Against`] = rounded(figure.against.value);
    record[`${figure.key}Ratio`] = rounded(ratio);
  }
  return record;
}

/** No measurement here is good for more than five digits. */
function rounded(value: number): number {
  return Number(value.toPrecision(5));
}
