// One of a group of messages, of which some take values and some are plain.

export function say<Values>(message: string | ((values: Values) => string), values: Values): string {
  return typeof message === 'string' ? message : message(values);
}
