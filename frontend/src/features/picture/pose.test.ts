import { describe, expect, test } from 'vitest';
import { FAMILIES } from '#shared/codec/families.ts';
import { armPicture, dialDegrees, fraction, JOINT, shaftDegrees } from './pose.ts';

const doc = FAMILIES.doc;
const known = (entries: Record<number, number>) => (servo: number) => entries[servo] ?? null;
const centred = known({ 1: 1500, 2: 1500, 3: 1500, 4: 1500, 5: 1500, 6: 1500 });

describe('the arm as a picture', () => {
  test('an arm at its centre stands straight', () => {
    const picture = armPicture(centred, doc);
    expect(picture.shoulder).toEqual({ degrees: 0, known: true });
    expect(picture.elbow.degrees).toBe(0);
    expect(picture.wrist.degrees).toBe(0);
  });

  test('the ends of the range are a quarter turn to either side', () => {
    expect(shaftDegrees(500, doc)).toBe(-90);
    expect(shaftDegrees(2500, doc)).toBe(90);
    expect(shaftDegrees(1000, FAMILIES['bus-ctrl'])).toBe(120);
  });

  test('what an unknown joint carries is unknown too, what carries it is not', () => {
    const picture = armPicture(known({ [JOINT.shoulder]: 1500, [JOINT.wrist]: 1500 }), doc);
    expect(picture.shoulder.known).toBe(true);
    expect(picture.elbow.known).toBe(false);
    expect(picture.wrist.known).toBe(false);
  });

  test('the base is known without the arm above it', () => {
    expect(armPicture(known({ [JOINT.base]: 900 }), doc).base.known).toBe(true);
  });

  test('jaws close as the position grows, and seen edge-on they look closed', () => {
    const open = armPicture(known({ 1: 500, 2: 1500 }), doc);
    const shut = armPicture(known({ 1: 2500, 2: 1500 }), doc);
    expect(open.jawFront.degrees).toBeGreaterThan(shut.jawFront.degrees);
    const edgeOn = armPicture(known({ 1: 500, 2: 2500 }), doc);
    expect(edgeOn.jaw.degrees).toBeLessThan(open.jaw.degrees);
    expect(edgeOn.jawFront.degrees).toBe(open.jawFront.degrees);
  });
});

test('a dial spans two thirds of a turn around straight up', () => {
  expect([500, 1500, 2500].map((position) => dialDegrees(position, doc))).toEqual([-120, 0, 120]);
  expect(fraction(2000, doc.position)).toBe(0.75);
});
