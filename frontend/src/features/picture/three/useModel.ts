// What a robot is drawn from in three dimensions: the model that its owner imported, else one made of primitive shapes after its body.

import { useEffect, useMemo, useState } from 'react';
import { Box3, Mesh, type Object3D, Vector3 } from 'three';
import type { Robot } from '#shared/profile/robot.ts';
import { storedFile } from '../../../state/fileStore.ts';
import { type Description, parseUrdf } from './figure.ts';
import { type ModelFile, readModelFile } from './modelFile.ts';
import { importedUrdf, type LimbEnd, linkName, meshName, urdfOf } from './urdf.ts';

interface ShownModel {
  /** null: there is nothing to draw, or not yet. */
  readonly description: Description | null;
  /** `missing`: the imported file is not on this computer, and the body is drawn in its place. */
  readonly state: 'loading' | 'missing' | 'ready';
}

export async function modelFileOf(id: string): Promise<ModelFile | null> {
  try {
    const bytes = await storedFile(id);
    return bytes === null ? null : readModelFile(bytes);
  } catch {
    return null;
  }
}

/** undefined: none, or still being read. null: not on this computer. */
export function useModelFile(id: string | null): ModelFile | null | undefined {
  const [read, setRead] = useState<{ readonly id: string; readonly file: ModelFile | null } | null>(null);
  useEffect(() => {
    let isWanted = true;
    if (id !== null) void modelFileOf(id).then((file) => isWanted && setRead({ id, file }));
    return () => void (isWanted = false);
  }, [id]);
  return read?.id === id ? read.file : undefined;
}

export function useModel(robot: Robot): ShownModel {
  const id = robot.model?.id ?? null;
  const file = useModelFile(id);
  return useMemo(() => {
    if (id !== null && file === undefined) return { description: null, state: 'loading' };
    const imported = file ? describe(file, robot) : null;
    if (imported !== null) return { description: imported, state: 'ready' };
    const urdf = urdfOf(robot);
    return {
      description: urdf === null ? null : { urdf, meshes: NO_MESHES },
      state: id === null ? 'ready' : 'missing',
    };
  }, [id, file, robot]);
}

const NO_MESHES: Description['meshes'] = new Map();

/** null: its links do not hang together. */
export function describe({ urdf, meshes }: ModelFile, robot: Robot): Description | null {
  const named = new Map([...meshes].map(([name, mesh]) => [meshName(name), mesh]));
  const described = (end: LimbEnd | null): Description => ({
    urdf: importedUrdf(urdf, robot, end),
    meshes: named,
  });
  try {
    const plain = described(null);
    const parsed = parseUrdf(plain);
    const link = robot.model?.end ?? null;
    const frame = link === null ? undefined : parsed.links[linkName(link)];
    return link === null || frame === undefined ? plain : described({ link, at: farEndOf(frame) });
  } catch {
    return null;
  }
}

/** Where what is drawn of a link ends, seen from its origin, in its own frame; its origin where nothing is drawn. */
function farEndOf(link: Object3D): readonly [number, number, number] {
  link.updateMatrixWorld(true);
  const toLink = link.matrixWorld.clone().invert();
  const box = new Box3();
  for (const part of link.children) {
    if (!('isURDFVisual' in part)) continue;
    part.traverse((node) => {
      if (!(node instanceof Mesh)) return;
      const { geometry, matrixWorld } = node as Mesh;
      geometry.computeBoundingBox();
      if (geometry.boundingBox !== null)
        box.union(geometry.boundingBox.clone().applyMatrix4(matrixWorld).applyMatrix4(toLink));
    });
  }
  if (box.isEmpty()) return [0, 0, 0];
  const { x, y, z } = box.getCenter(new Vector3());
  const middle = [x, y, z] as const;
  const ahead = middle.reduce(
    (most, at, axis) => (Math.abs(at) > Math.abs(middle[most] ?? 0) ? axis : most),
    0,
  );
  const [low, high] = [box.min.toArray(), box.max.toArray()];
  const end = middle.map((at, axis) => (axis === ahead ? ((at < 0 ? low : high)[axis] ?? 0) : at));
  return [end[0] ?? 0, end[1] ?? 0, end[2] ?? 0];
}
