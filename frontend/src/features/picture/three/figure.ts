// One drawn robot: a URDF in three.js, posed by servo angles. As a body, or as a ghost of which only the outline is drawn. Knows no
// motion, no camera and no pointer.

import {
  EdgesGeometry,
  Group,
  type BufferGeometry,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshStandardMaterial,
  type Object3D,
  type Raycaster,
} from 'three';
import URDFLoader, { type URDFJoint, type URDFRobot } from 'urdf-loader';
import { jointName } from './urdf.ts';

export interface FigureColours {
  readonly body: string;
  readonly servo: string;
  readonly edge: string;
  readonly reported: string;
  readonly selected: string;
  readonly unknown: string;
  readonly touching: string;
}

/** What its outline says of a servo, beside where it is. */
export interface Marks {
  isReported(servo: number): boolean;
  isSelected(servo: number): boolean;
  /** Of what the servo turns; null: of the base. It is filled, not only outlined. */
  isTouching(servo: number | null): boolean;
}

export const NO_MARKS: Marks = {
  isReported: () => false,
  isSelected: () => false,
  isTouching: () => false,
};

/** Radians by servo; null: not known. */
export type Angles = (servo: number) => number | null;

export interface Figure {
  readonly robot: URDFRobot;
  pose(angles: Angles, marks?: Marks): void;
  /** The servo that turns what the ray meets first; null: none. */
  servoAt(ray: Raycaster): number | null;
  paint(colours: FigureColours): void;
  dispose(): void;
}

/** Edges flatter than this are not drawn, so that cylinders have rims and no staves. */
const EDGE_DEGREES = 35;
const OPACITY = {
  body: { fill: 1, edge: 1 },
  ghost: { fill: 0.1, edge: 0.95 },
  skin: { fill: 0.04, edge: 0.45 },
} as const;

/** `ghost`: an outline. `skin`: a weak one, of a pose before or after. */
export type FigureLook = keyof typeof OPACITY;
const TOUCHING_OPACITY = 0.75;
/** Stripes of the screen, so that they look the same on each face. */
const HATCH = { eachPx: 9, widthPx: 2.5 };

/** `meshes`: by the names that the URDF has for them. */
export interface Description {
  readonly urdf: string;
  readonly meshes: ReadonlyMap<string, Object3D | null>;
}

/** Throws where a joint hangs between links that do not exist. */
export function parseUrdf({ urdf, meshes }: Description): URDFRobot {
  const loader = new URDFLoader();
  loader.loadMeshCb = (name, _manager, _material, done) => done(meshes.get(name)?.clone() ?? new Group());
  return loader.parse(urdf);
}

export function createFigure(description: Description, servos: readonly number[], look: FigureLook): Figure {
  const robot = parseUrdf(description);
  const isGhost = look !== 'body';
  const opacity = OPACITY[look];
  const fill = (): MeshStandardMaterial =>
    new MeshStandardMaterial({
      roughness: 0.75,
      metalness: 0.05,
      transparent: isGhost,
      opacity: opacity.fill,
      depthWrite: !isGhost,
      // The outline lies on the faces, and must win against them.
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
  const materials = {
    body: fill(),
    servo: fill(),
    unknown: hatched(fill()),
    edge: new LineBasicMaterial({ transparent: isGhost, opacity: opacity.edge }),
    reportedEdge: new LineBasicMaterial(),
    selectedEdge: new LineBasicMaterial(),
    touching: fill(),
    touchingEdge: new LineBasicMaterial(),
    unknownEdge: new LineBasicMaterial(),
  };
  materials.touching.opacity = TOUCHING_OPACITY;
  const parts = dressed(robot, servos, materials);
  return {
    robot,
    pose(angles, marks = NO_MARKS) {
      for (const servo of servos) robot.joints[jointName(servo)]?.setJointValue(angles(servo) ?? 0);
      for (const { mesh, edges, isServo, carriedBy } of parts) {
        const isKnown = carriedBy.every((servo) => angles(servo) !== null);
        const turnedBy = carriedBy.at(-1);
        const isTouching = marks.isTouching(turnedBy ?? null);
        if (isTouching) mesh.material = materials.touching;
        else mesh.material = isKnown ? materials[isServo ? 'servo' : 'body'] : materials.unknown;
        if (isTouching) edges.material = materials.touchingEdge;
        else if (turnedBy !== undefined && marks.isSelected(turnedBy))
          edges.material = materials.selectedEdge;
        else if (!isKnown) edges.material = materials.unknownEdge;
        else if (turnedBy !== undefined && marks.isReported(turnedBy))
          edges.material = materials.reportedEdge;
        else edges.material = materials.edge;
      }
    },
    servoAt(ray) {
      const [hit] = ray.intersectObjects(
        parts.map(({ mesh }) => mesh),
        false,
      );
      return parts.find(({ mesh }) => mesh === hit?.object)?.carriedBy.at(-1) ?? null;
    },
    paint({ body, servo, edge, reported, selected, unknown, touching }) {
      materials.body.color.set(isGhost ? edge : body);
      materials.servo.color.set(isGhost ? edge : servo);
      materials.unknown.color.set(unknown);
      materials.edge.color.set(edge);
      materials.reportedEdge.color.set(reported);
      materials.selectedEdge.color.set(selected);
      materials.unknownEdge.color.set(unknown);
      materials.touching.color.set(touching);
      materials.touchingEdge.color.set(touching);
    },
    dispose() {
      for (const { mesh, edges } of parts) for (const { geometry } of [mesh, edges]) geometry.dispose();
      for (const material of Object.values(materials)) material.dispose();
    },
  };
}

function hatched(material: MeshStandardMaterial): MeshStandardMaterial {
  material.onBeforeCompile = (shader) => {
    const stripes = `if (mod(gl_FragCoord.x + gl_FragCoord.y, ${HATCH.eachPx.toFixed(1)}) > ${HATCH.widthPx.toFixed(1)}) discard;`;
    shader.fragmentShader = shader.fragmentShader.replace('void main() {', `void main() {\n${stripes}`);
  };
  return material;
}

interface Part {
  readonly mesh: Mesh<BufferGeometry, MeshStandardMaterial>;
  readonly edges: LineSegments<BufferGeometry, LineBasicMaterial>;
  readonly isServo: boolean;
  /** The servos between it and the ground. */
  readonly carriedBy: readonly number[];
}

interface Materials {
  readonly body: MeshStandardMaterial;
  readonly edge: LineBasicMaterial;
}

function dressed(robot: URDFRobot, servos: readonly number[], { body, edge }: Materials): readonly Part[] {
  const meshes: Mesh[] = [];
  robot.traverse((node) => {
    if (node instanceof Mesh) meshes.push(node as Mesh);
  });
  return meshes.map((mesh): Part => {
    const isServo = nameOf(mesh.material) === 'servo';
    const edges = new LineSegments<BufferGeometry, LineBasicMaterial>(
      new EdgesGeometry(mesh.geometry, EDGE_DEGREES),
      edge,
    );
    mesh.add(edges);
    mesh.material = body;
    return { mesh: mesh as Part['mesh'], edges, isServo, carriedBy: carriersOf(mesh, servos) };
  });
}

const nameOf = (material: Mesh['material']): string => (Array.isArray(material) ? '' : material.name);

export function carriersOf(part: Object3D, servos: readonly number[]): readonly number[] {
  const found: number[] = [];
  for (let node: Object3D | null = part; node !== null; node = node.parent) {
    const name = isJoint(node) ? (mimickedBy(node) ?? node.urdfName) : '';
    const servo = servos.find((number) => jointName(number) === name);
    if (servo !== undefined) found.unshift(servo);
  }
  return found;
}

export const isJoint = (node: Object3D): node is URDFJoint => 'isURDFJoint' in node;

const mimickedBy = (joint: URDFJoint): string | null =>
  'mimicJoint' in joint && typeof joint.mimicJoint === 'string' ? joint.mimicJoint : null;
