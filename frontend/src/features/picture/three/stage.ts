// The scene around the robot: floor, light, camera, and the ways to look around. Draws a frame only on request. Knows no robot.

import {
  Box3,
  DirectionalLight,
  GridHelper,
  HemisphereLight,
  LineBasicMaterial,
  type Object3D,
  PerspectiveCamera,
  Raycaster,
  Scene,
  Sphere,
  Vector2,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

export interface Stage {
  readonly scene: Scene;
  readonly camera: PerspectiveCamera;
  /** While a limb is led the pointer does not turn the view. */
  setTurning(isTurning: boolean): void;
  /** Draws once, in the next frame. */
  draw(): void;
  /** Looks at all of a robot that reaches so far. */
  frame(reachM: number, heightM: number): void;
  /** The view as it was at first. */
  home(): void;
  turn(byRadians: number, upRadians: number): void;
  zoom(by: number): void;
  /** The ray under a pointer, in the room. */
  rayAt(clientX: number, clientY: number): Raycaster;
  /** Where a point of the room is on the page. */
  onPage(point: Vector3): { readonly x: number; readonly y: number };
  paint(colours: { readonly line: string }): void;
  dispose(): void;
}

const FIELD_OF_VIEW = 32;
/** From its front and right, a little from above. */
const FROM = new Vector3(0.62, -0.78, 0.36).normalize();
const MOST_PIXELS_RATIO = 2;
const GRID = { size: 1.2, cells: 24 };

export function createStage(canvas: HTMLCanvasElement, beforeDraw: () => void): Stage {
  const renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
  renderer.setPixelRatio(Math.min(MOST_PIXELS_RATIO, devicePixelRatio));
  const scene = new Scene();
  const camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 20);
  camera.up.set(0, 0, 1);
  const controls = new OrbitControls(camera, canvas);
  controls.maxPolarAngle = Math.PI * 0.55;
  controls.minDistance = 0.15;
  controls.maxDistance = 4;
  const sun = new DirectionalLight('#ffffff', 2.2);
  sun.position.set(0.6, -0.9, 1.4);
  const grid = new GridHelper(GRID.size, GRID.cells);
  grid.rotation.x = Math.PI / 2;
  const gridLine = new LineBasicMaterial({ transparent: true, opacity: 0.55 });
  grid.material = gridLine;
  scene.add(sun, new HemisphereLight('#ffffff', '#8a8a8a', 1.6), grid);

  let requested = 0;
  function draw(): void {
    if (requested !== 0) return;
    requested = requestAnimationFrame(() => {
      requested = 0;
      beforeDraw();
      renderer.render(scene, camera);
    });
  }
  controls.addEventListener('change', draw);

  let framed = { target: new Vector3(0, 0, 0.15), distance: 1 };
  function home(): void {
    controls.target.copy(framed.target);
    camera.position.copy(framed.target).addScaledVector(FROM, framed.distance);
    controls.update();
    draw();
  }

  const sizes = new ResizeObserver(() => {
    const { clientWidth: width, clientHeight: height } = canvas;
    if (width === 0 || height === 0) return;
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    // An empty canvas would flash.
    beforeDraw();
    renderer.render(scene, camera);
  });
  sizes.observe(canvas);

  const inView = ({ left, top, width, height }: DOMRect, x: number, y: number): Vector2 =>
    new Vector2(((x - left) / width) * 2 - 1, 1 - ((y - top) / height) * 2);

  return {
    scene,
    camera,
    setTurning: (isTurning) => (controls.enabled = isTurning),
    draw,
    frame(reachM, heightM) {
      const half = (FIELD_OF_VIEW / 360) * Math.PI;
      framed = { target: new Vector3(0, 0, heightM / 2), distance: reachM / Math.sin(half) };
      home();
    },
    home,
    turn(byRadians, upRadians) {
      const arm = camera.position.clone().sub(controls.target);
      const spun = arm.applyAxisAngle(camera.up, byRadians);
      const side = new Vector3().crossVectors(camera.up, spun).normalize();
      camera.position.copy(controls.target).add(spun.applyAxisAngle(side, -upRadians));
      controls.update();
      draw();
    },
    zoom(by) {
      camera.position.sub(controls.target).multiplyScalar(by).add(controls.target);
      controls.update();
      draw();
    },
    rayAt(clientX, clientY) {
      const caster = new Raycaster();
      caster.setFromCamera(inView(canvas.getBoundingClientRect(), clientX, clientY), camera);
      return caster;
    },
    onPage(point) {
      const { left, top, width, height } = canvas.getBoundingClientRect();
      const { x, y } = point.clone().project(camera);
      return { x: left + ((x + 1) / 2) * width, y: top + ((1 - y) / 2) * height };
    },
    paint: ({ line }) => void gridLine.color.set(line),
    dispose() {
      cancelAnimationFrame(requested);
      sizes.disconnect();
      controls.dispose();
      grid.geometry.dispose();
      gridLine.dispose();
      renderer.dispose();
    },
  };
}

/** How far a model goes from the middle of its base, and how high. */
export function sizeOf(model: Object3D): { readonly reachM: number; readonly heightM: number } {
  const box = new Box3().setFromObject(model);
  const { radius } = box.getBoundingSphere(new Sphere());
  return { reachM: radius, heightM: box.max.z };
}
