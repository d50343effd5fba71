// A browser's Bluetooth for tests, below the channel: one module with its service, and at each step an exception that a test requested
// for, once, or a promise that never settles. Time is the test's.

/** Where the browser may reject. */
export const STEPS = [
  'connect',
  'getPrimaryServices',
  'getCharacteristics',
  'startNotifications',
  'write',
] as const;
export type Step = (typeof STEPS)[number];

export const FFE0: readonly Kind[] = [['ffe1', ['notify', 'write', 'writeWithoutResponse']]];
/** One characteristic for each direction, and the browser is to wait for an answer to each write. */
export const FFF0: readonly Kind[] = [
  ['ffe2', ['write']],
  ['ffe1', ['notify']],
];
type Kind = readonly [short: string, properties: readonly string[]];

export interface FakeModule {
  readonly module: BluetoothDevice;
  /** In the pieces in which they were written, with the method's name. */
  readonly written: { readonly method: string; readonly bytes: Uint8Array }[];
  failNext(step: Step, error: DOMException | 'never settles'): void;
  isConnected(): boolean;
  deliver(...bytes: readonly number[]): void;
  /** The radio loses it. */
  drop(): void;
  /** The adapter is switched off or on. */
  power(isOn: boolean): void;
  /** For `navigator`. */
  readonly bluetooth: object;
}

export function createModule(characteristics = FFE0, id = 'wQ8x+2Lk==', name = 'Hiwonder'): FakeModule {
  const failures = new Map<Step, DOMException | 'never settles'>();
  const written: FakeModule['written'] = [];
  let isOn = true;
  let isConnected = false;

  async function step(name: Step): Promise<void> {
    const failure = failures.get(name);
    failures.delete(name);
    await Promise.resolve();
    if (failure === 'never settles') await new Promise(() => undefined);
    if (failure instanceof DOMException) throw failure;
    if (name !== 'connect' && !isConnected)
      throw new DOMException('GATT Server is disconnected.', 'NetworkError');
  }

  const write = (method: string) => async (bytes: Uint8Array) => {
    await step('write');
    written.push({ method, bytes });
  };
  const made = characteristics.map(([short, properties]) =>
    Object.assign(new EventTarget(), {
      uuid: `0000${short}-0000-1000-8000-00805f9b34fb`,
      properties: Object.fromEntries(properties.map((property) => [property, true])),
      value: undefined as DataView | undefined,
      startNotifications: () => step('startNotifications'),
      writeValueWithResponse: write('writeValueWithResponse'),
      writeValueWithoutResponse: write('writeValueWithoutResponse'),
    }),
  );
  const service = { getCharacteristics: () => step('getCharacteristics').then(() => made) };
  const module = Object.assign(new EventTarget(), {
    ...{ id, name },
    gatt: {
      get connected() {
        return isConnected;
      },
      async connect() {
        await step('connect');
        if (!isOn) throw new DOMException('Bluetooth adapter not available.', 'NotFoundError');
        isConnected = true;
      },
      getPrimaryServices: () => step('getPrimaryServices').then(() => [service]),
      disconnect,
    },
  });

  function disconnect(): void {
    if (!isConnected) return;
    isConnected = false;
    module.dispatchEvent(new Event('gattserverdisconnected'));
  }

  const bluetooth = Object.assign(new EventTarget(), { getAvailability: () => Promise.resolve(isOn) });
  return {
    module: module as unknown as BluetoothDevice,
    written,
    failNext: (name, error) => failures.set(name, error),
    isConnected: () => isConnected,
    deliver(...bytes) {
      const notifies = made.find(({ properties }) => properties.notify);
      if (notifies === undefined) return;
      // As browsers do it: a view of a larger buffer.
      notifies.value = new DataView(Uint8Array.from([0, ...bytes, 0]).buffer, 1, bytes.length);
      notifies.dispatchEvent(new Event('characteristicvaluechanged'));
    },
    drop: disconnect,
    power(next) {
      isOn = next;
      if (!isOn) disconnect();
      bluetooth.dispatchEvent(new Event('availabilitychanged'));
    },
    bluetooth,
  };
}
