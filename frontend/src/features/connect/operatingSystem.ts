// Which operating system the browser runs on, to show the right guide first. A guess for words only: nothing else depends on
// it, and the person can choose another.

export const SYSTEMS = ['windows', 'macos', 'linux', 'chromeos'] as const;
export type OperatingSystem = (typeof SYSTEMS)[number];

const SIGNS: readonly (readonly [RegExp, OperatingSystem])[] = [
  [/cros|chrome ?os/i, 'chromeos'],
  [/win/i, 'windows'],
  [/mac|iphone|ipad/i, 'macos'],
];

export function operatingSystemIn(platform: string): OperatingSystem {
  return SIGNS.find(([sign]) => sign.test(platform))?.[1] ?? 'linux';
}

export function operatingSystem(): OperatingSystem {
  const { userAgentData } = navigator as { userAgentData?: { readonly platform?: string } };
  return operatingSystemIn(userAgentData?.platform ?? navigator.userAgent);
}
