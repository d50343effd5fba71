// The operating systems whose ways with ports the guides tell of. Knows no sentence.

export const SYSTEMS = ['windows', 'macos', 'linux', 'chromeos'] as const;
export type OperatingSystem = (typeof SYSTEMS)[number];
