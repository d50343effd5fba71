// Servos in portions that fit one packet each. Pure.

export function portions(servos: readonly number[], size: number): readonly (readonly number[])[] {
  const count = Math.max(1, Math.ceil(servos.length / size));
  return Array.from({ length: count }, (_, index) => servos.slice(index * size, (index + 1) * size));
}
