// A model of a robot in a file: URDF alone, or a ZIP of it with the meshes that it names. Reads it, checks it, and makes the meshes
// into objects of three.js. Knows no robot profile and no place where files are stored.

import { unzipSync } from 'fflate';
import { Mesh, MeshBasicMaterial, type Object3D } from 'three';
import { ColladaLoader } from 'three/examples/jsm/loaders/ColladaLoader.js';
import { OBJLoader } from 'three/examples/jsm/loaders/OBJLoader.js';
import { STLLoader } from 'three/examples/jsm/loaders/STLLoader.js';

export interface ModelFile {
  readonly urdf: Document;
  /** By the file names of the URDF; null: not in the file, or of a kind that cannot be read. */
  readonly meshes: ReadonlyMap<string, Object3D | null>;
}

/** `xacro`: it must be expanded first. `noJoint`: nothing in it turns. */
export type ModelFlaw = 'tooLarge' | 'noUrdf' | 'broken' | 'xacro' | 'noJoint';

export class ModelFileError extends Error {
  override readonly name = 'ModelFileError';

  constructor(readonly flaw: ModelFlaw) {
    super(flaw);
  }
}

const MOST_BYTES = 30e6;
/** Of all that is unpacked: a ZIP may be a thousand times as large as it looks. */
const MOST_UNPACKED_BYTES = 150e6;
const ZIP_MARK = [0x50, 0x4b];
const MESH = /\.(?:stl|dae|obj)$/iu;
const URDF = /\.(?:urdf|xml)$/iu;

/** Throws ModelFileError. */
export function readModelFile(bytes: Uint8Array): ModelFile {
  if (bytes.length > MOST_BYTES) throw new ModelFileError('tooLarge');
  const isZip = ZIP_MARK.every((byte, at) => bytes[at] === byte);
  const files = isZip ? unpacked(bytes) : new Map([['model.urdf', bytes]]);
  const urdf = robotIn(files);
  const names = new Set(meshNamesIn(urdf));
  return { urdf, meshes: new Map([...names].map((name) => [name, meshNamed(name, files)])) };
}

const meshNamesIn = (urdf: Document): readonly string[] =>
  [...urdf.querySelectorAll('visual > geometry > mesh')].map((mesh) => mesh.getAttribute('filename') ?? '');

type Files = ReadonlyMap<string, Uint8Array>;

function unpacked(bytes: Uint8Array): Files {
  let total = 0;
  try {
    const entries = unzipSync(bytes, {
      filter({ name, originalSize }) {
        if (!MESH.test(name) && !URDF.test(name)) return false;
        total += originalSize;
        if (total > MOST_UNPACKED_BYTES) throw new ModelFileError('tooLarge');
        return true;
      },
    });
    return new Map(Object.entries(entries));
  } catch (error) {
    throw error instanceof ModelFileError ? error : new ModelFileError('broken');
  }
}

/** The URDF nearest to the top: packages carry others along for simulators. */
function robotIn(files: Files): Document {
  const depth = (name: string): number => name.split('/').length;
  const names = [...files.keys()].filter((name) => URDF.test(name));
  const found = names
    .sort((one, other) => depth(one) - depth(other) || one.length - other.length)
    .map((name) => parsed(files.get(name) ?? new Uint8Array()))
    .filter((document) => document !== null);
  const robot = found.find(({ documentElement }) => documentElement.localName === 'robot');
  if (robot === undefined)
    throw new ModelFileError(found.length < names.length && found.length === 0 ? 'broken' : 'noUrdf');
  if ([...robot.querySelectorAll('*')].some(({ prefix }) => prefix === 'xacro'))
    throw new ModelFileError('xacro');
  if (jointsOf(robot).length === 0) throw new ModelFileError('noJoint');
  return robot;
}

function parsed(bytes: Uint8Array): Document | null {
  const document = new DOMParser().parseFromString(new TextDecoder().decode(bytes), 'application/xml');
  return document.querySelector('parsererror') === null ? document : null;
}

/** URDF names a mesh by a package, an address or a path from somewhere: the file whose path ends alike in the most steps. */
function meshNamed(name: string, files: Files): Object3D | null {
  const steps = name.replace(/^[a-z]+:\/\//iu, '').split(/[/\\]/u);
  for (let from = 0; from < steps.length; from += 1) {
    const end = steps.slice(from).join('/').toLowerCase();
    for (const [path, bytes] of files) {
      const at = path.toLowerCase();
      if (at === end || at.endsWith(`/${end}`)) return meshIn(path, bytes);
    }
  }
  return null;
}

function meshIn(path: string, bytes: Uint8Array): Object3D | null {
  try {
    if (/\.stl$/iu.test(path))
      return new Mesh(new STLLoader().parse(bytes.slice().buffer), new MeshBasicMaterial());
    const text = new TextDecoder().decode(bytes);
    if (/\.obj$/iu.test(path)) return new OBJLoader().parse(text);
    return /\.dae$/iu.test(path) ? (new ColladaLoader().parse(text, '')?.scene ?? null) : null;
  } catch {
    return null;
  }
}

/** What a servo can turn. `lower`, `upper`: radians, as in the file. */
export interface ModelJoint {
  readonly name: string;
  readonly lower: number;
  readonly upper: number;
}

/** In the order from the base to the ends. Those that follow another one are not among them. */
export function jointsOf(urdf: Document): readonly ModelJoint[] {
  const all = [...urdf.querySelectorAll('robot > joint')];
  const childrenOf = (link: string): readonly Element[] =>
    all.filter((joint) => attribute(joint, 'parent', 'link') === link);
  const children = new Set(all.map((joint) => attribute(joint, 'child', 'link')));
  const roots = [...urdf.querySelectorAll('robot > link')]
    .map((link) => link.getAttribute('name') ?? '')
    .filter((name) => !children.has(name));
  const ordered: Element[] = [];
  function visit(link: string): void {
    for (const joint of childrenOf(link)) {
      if (ordered.includes(joint)) continue;
      ordered.push(joint);
      visit(attribute(joint, 'child', 'link'));
    }
  }
  for (const root of roots) visit(root);
  return ordered.filter(isTurned).map((joint) => ({
    name: joint.getAttribute('name') ?? '',
    lower: Number(attribute(joint, 'limit', 'lower') || -Math.PI),
    upper: Number(attribute(joint, 'limit', 'upper') || Math.PI),
  }));
}

const isTurned = (joint: Element): boolean =>
  ['revolute', 'continuous'].includes(joint.getAttribute('type') ?? '') &&
  joint.querySelector(':scope > mimic') === null;

export const linksOf = (urdf: Document): readonly string[] =>
  [...urdf.querySelectorAll('robot > link')].map((link) => link.getAttribute('name') ?? '');

const attribute = (joint: Element, child: string, name: string): string =>
  joint.querySelector(`:scope > ${child}`)?.getAttribute(name) ?? '';

/** Of all that is drawn of its meshes. */
export function trianglesOf({ urdf, meshes }: ModelFile): number {
  let count = 0;
  for (const name of meshNamesIn(urdf))
    meshes.get(name)?.traverse((node) => {
      if (!(node instanceof Mesh)) return;
      const { index, attributes } = (node as Mesh).geometry;
      count += (index?.count ?? attributes.position?.count ?? 0) / 3;
    });
  return Math.round(count);
}
