import { expect, test } from 'vitest';
import { operatingSystemIn } from './PortGuide.tsx';

test.each([
  ['Windows', 'windows'],
  ['macOS', 'macos'],
  ['Linux', 'linux'],
  ['Chrome OS', 'chromeos'],
  ['Mozilla/5.0 (Windows NT 10.0; Win64; x64)', 'windows'],
  ['Mozilla/5.0 (Macintosh; Intel Mac OS X 10_15_7)', 'macos'],
  ['Mozilla/5.0 (X11; CrOS x86_64 14541.0.0)', 'chromeos'],
  ['Mozilla/5.0 (X11; Linux x86_64)', 'linux'],
])('%s gets the guide for %s', (platform, system) => {
  expect(operatingSystemIn(platform)).toBe(system);
});
