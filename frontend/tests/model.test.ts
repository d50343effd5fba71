// A model of one's own in three dimensions: imported, its joints given to servos, drawn, and dragged by its end.

import { strToU8, zipSync } from 'fflate';
import { Vector3 } from 'three';
import URDFLoader, { type URDFRobot } from 'urdf-loader';
import { readyRobot } from '#shared/profile/readyRobots.ts';
import type { Robot, RobotJoint } from '#shared/profile/robot.ts';
import { changeServo } from '#shared/profile/robotEdits.ts';
import { lastTarget, ofKind } from '../../e2e/fixtures/bus.ts';
import * as robotDialog from '../../e2e/fixtures/robotDialog.ts';
import { importedUrdf, linkName } from '../src/features/picture/three/urdf.ts';
import { parseUrdf } from '../src/features/picture/three/figure.ts';
import { linksIn } from '../src/features/picture/three/hulls.ts';
import { describe } from '../src/features/picture/three/useModel.ts';
import { collisionsOf } from '#shared/kinematics/collision.ts';
import { ModelFileError, readModelFile } from '../src/features/picture/three/modelFile.ts';
import { expect, here, test, type Dashboard } from './harness/test.ts';
import { advance } from './harness/time.ts';

const { robotDialogOf } = here(robotDialog);

const corner = (x: number, y: number, z: number): string => `vertex ${x} ${y} ${z}`;
const facet = (...corners: readonly string[]): string =>
  `facet normal 0 0 1\nouter loop\n${corners.join('\n')}\nendloop\nendfacet`;
/** A pyramid, 100 mm high. */
const MESH = `solid bar\n${[
  facet(corner(-0.01, -0.01, 0), corner(0.01, -0.01, 0), corner(0, 0, 0.1)),
  facet(corner(0.01, -0.01, 0), corner(0.01, 0.01, 0), corner(0, 0, 0.1)),
  facet(corner(0.01, 0.01, 0), corner(-0.01, 0.01, 0), corner(0, 0, 0.1)),
  facet(corner(-0.01, 0.01, 0), corner(-0.01, -0.01, 0), corner(0, 0, 0.1)),
].join('\n')}\nendsolid bar\n`;

/** Where the directory of a ZIP has the unpacked size of a file. */
const SIZE_AT = 24;

const link = (name: string, mesh = 'package://crane_description/meshes/bar.stl'): string =>
  `<link name="${name}"><visual><geometry><mesh filename="${mesh}"/></geometry></visual></link>`;
const joint = (name: string, parent: string, child: string, axis: string): string =>
  `<joint name="${name}" type="revolute"><origin xyz="0 0 0.1" rpy="0 0 0"/><parent link="${parent}"/><child link="${child}"/>` +
  `<axis xyz="${axis}"/><limit lower="-1.5" upper="1.5" effort="1" velocity="1"/></joint>`;
const CRANE = `<?xml version="1.0"?><robot name="crane">
${link('base')}${link('tower')}${link('boom')}${link('hook')}${link('lamp', 'meshes/lamp.stl')}
${joint('slew', 'base', 'tower', '0 0 1')}${joint('luff', 'tower', 'boom', '0 1 0')}${joint('tilt', 'boom', 'hook', '0 1 0')}
<joint name="lamp_mount" type="fixed"><parent link="boom"/><child link="lamp"/></joint>
</robot>`;

const zipOf = (files: Readonly<Record<string, string>>): Uint8Array<ArrayBuffer> =>
  new Uint8Array(
    zipSync(Object.fromEntries(Object.entries(files).map(([name, text]) => [name, strToU8(text)]))),
  );
const CRANE_ZIP = zipOf({
  'crane/urdf/crane.urdf': CRANE,
  'crane/meshes/Bar.stl': MESH,
  'crane/readme.md': 'x',
});

function modelIn(dashboard: Dashboard) {
  const { page } = dashboard;
  const robots = robotDialogOf(dashboard);
  const line = (name: string) => robots.dialog.getByRole('listitem', { name, exact: true });
  return {
    ...robots,
    line,
    servoOf: (name: string) => line(name).getByRole('combobox', { name: `Servo of ${name}` }),
    async choose(name: string, buffer: Uint8Array): Promise<void> {
      const choosing = page.waitForEvent('filechooser');
      await robots.dialog.getByRole('button', { name: /^(Import|Replace) model/ }).click();
      await (await choosing).setFiles({ name, mimeType: 'application/zip', buffer });
    },
  };
}

async function editing(dashboard: Dashboard) {
  const model = modelIn(dashboard);
  await model.opener.click();
  await model.button('Edit').click();
  return model;
}

test('a ZIP of URDF and meshes becomes the picture, and its end is dragged', async ({
  dashboard,
  page,
  robot,
}) => {
  const model = await editing(dashboard);
  await model.choose('crane.zip', CRANE_ZIP);
  await expect(model.dialog.getByText('crane.zip, 3 joints, 16 triangles')).toBeVisible();
  await expect(model.dialog.getByText('Not in the file, so not drawn: meshes/lamp.stl')).toBeVisible();
  await expect(model.servoOf('slew')).toHaveValue('6');
  await expect(model.servoOf('tilt')).toHaveValue('4');
  await model.servoOf('tilt').selectOption('3');
  await expect(model.line('tilt').getByRole('textbox', { name: 'Degrees at home of tilt' })).toHaveValue('0');
  await model.button('Undo: Servo of tilt').click();
  await expect(model.servoOf('tilt')).toHaveValue('4');
  await model.button('Close').click();
  expect(ofKind(await robot.bus(), 'move')).toEqual([]);

  await page.getByRole('radio', { name: '3D' }).check();
  await dashboard.button('Position of the gripper').click();
  await dashboard.button('Centre all').click();
  await advance(5000);
  // Three pyramids above the base.
  await expect(page.getByRole('textbox', { name: 'Up', exact: true })).toHaveValue('400');
  await dashboard.type(page.getByRole('textbox', { name: 'Up', exact: true }), 350);
  await expect(page.getByRole('textbox', { name: 'Up', exact: true })).toHaveValue('350');
  expect(await lastTarget(robot.bus, 5)).not.toBe(1500);

  await page.reload();
  await page.getByRole('radio', { name: '3D' }).check();
  await expect(page.getByRole('button', { name: 'Position of the gripper' })).toBeVisible();
  await expect(page.getByText(/is not on this computer/)).toBeHidden();
});

test('a profile whose model was imported elsewhere draws a common body, and says so', async ({
  dashboard,
  page,
}) => {
  const model = await editing(dashboard);
  await model.choose('crane.zip', CRANE_ZIP);
  await expect(model.line('slew')).toBeVisible();
  await model.button('Close').click();
  await new Promise<void>((resolve) => {
    indexedDB.deleteDatabase('servodeck-files').addEventListener('success', () => resolve());
  });
  await page.reload();
  await page.getByRole('radio', { name: '3D' }).check();
  await expect(page.getByText(/crane.zip is not on this computer/)).toBeVisible();
});

test('what cannot be read says why, and changes nothing', async ({ dashboard }) => {
  const model = await editing(dashboard);
  const problem = model.dialog.getByRole('alert').filter({ hasText: /./ });
  for (const [content, why] of [
    [zipOf({ 'readme.md': 'no robot' }), /no URDF in this file/],
    [CRANE_ZIP.slice(0, 200), /cannot be read/],
    [strToU8('<robot><link'), /cannot be read/],
    [strToU8(CRANE.replaceAll('"revolute"', '"fixed"')), /No joint in this URDF turns/],
    [strToU8(CRANE.replaceAll('parent link="tower"', 'parent link="nowhere"')), /do not form a robot/],
    [
      strToU8('<robot xmlns:xacro="http://ros.org/wiki/xacro"><xacro:macro name="arm"/></robot>'),
      /This is xacro/,
    ],
  ] as const) {
    await model.choose('file.zip', content);
    await expect(problem).toHaveText(why);
  }
  await expect(model.dialog.getByRole('list', { name: 'Joints of the model' })).toBeHidden();
});

test('a ZIP that unpacks to more than fits is refused before it is unpacked', () => {
  const bomb = zipSync({ 'a.stl': new Uint8Array(1000) });
  const directory = bomb.findLastIndex((_, at) =>
    [0x50, 0x4b, 1, 2].every((byte, by) => bomb[at + by] === byte),
  );
  new DataView(bomb.buffer, bomb.byteOffset).setUint32(directory + SIZE_AT, 200e6, true);
  expect(() => readModelFile(bomb)).toThrow(new ModelFileError('tooLarge'));
});

test('a joint turns with its servo as it does in the file, from where it is at home', () => {
  for (let seed = 1; seed <= 200; seed += 1) {
    const draw = drawing(seed);
    const angles = [draw(), draw(), draw()].map((share) => (share - 0.5) * 3);
    const bindings = ['slew', 'luff', 'tilt'].map((name): RobotJoint => ({
      ...{ name, isReversed: draw() < 0.5 },
      homeDegrees: Math.round((draw() - 0.5) * 200),
    }));
    const random = (): string => `${draw() - 0.5} ${draw() - 0.5} ${draw() + 0.1}`;
    const text = CRANE.replaceAll('rpy="0 0 0"', () => `rpy="${random()}"`).replaceAll(
      /axis xyz="[^"]*"/gu,
      () => `axis xyz="${random()}"`,
    );
    const { urdf } = readModelFile(strToU8(text));
    const wanted = posed(text, (robot) =>
      bindings.forEach(({ name, isReversed, homeDegrees }, index) =>
        robot.joints[name]?.setJointValue(
          (homeDegrees * Math.PI) / 180 + (isReversed ? -1 : 1) * angles[index]!,
        ),
      ),
    ).links.hook!;
    const made = posed(importedUrdf(urdf, turnedBy(bindings), null), (robot) =>
      angles.forEach((angle, index) => robot.joints[`servo_${index + 1}`]?.setJointValue(angle)),
    ).links[linkName('hook')]!;
    for (const point of [new Vector3(), new Vector3(0.1, 0, 0), new Vector3(0, 0.1, 0)])
      expect(made.localToWorld(point.clone()).distanceTo(wanted.localToWorld(point.clone()))).toBeLessThan(
        1e-6,
      );
  }
});

function posed(text: string, pose: (robot: URDFRobot) => void): URDFRobot {
  const loader = new URDFLoader();
  loader.packages = '';
  loader.loadMeshCb = (_name, _manager, _material, done) => done(undefined as never);
  const robot = loader.parse(text.replaceAll('type="revolute"', 'type="continuous"'));
  pose(robot);
  robot.updateMatrixWorld(true);
  return robot;
}

function turnedBy(joints: readonly RobotJoint[]): Robot {
  const names = {
    robot: 'arm',
    role: (role: string, servo: number) => `${role} ${servo}`,
    limb: (limb: string) => limb,
  };
  const arm = readyRobot('arm', 'doc', names);
  return joints.reduce((robot, one, index) => changeServo(robot, index + 1, { joint: one }), arm);
}

test('an imported model is judged by the hulls of its meshes', () => {
  const turned = ['slew', 'luff', 'tilt'].map((name) => ({ name, isReversed: false, homeDegrees: 0 }));
  const robot = turnedBy(turned);
  const description = describe(readModelFile(CRANE_ZIP), robot);
  const model = linksIn(parseUrdf(description!), robot);
  expect(model.links.map(({ name, mount }) => [name, mount?.servo])).toEqual([
    ['own_base', undefined],
    ['own_tower', 1],
    ['own_boom', 2],
    ['own_hook', 3],
    ['own_lamp', null],
  ]);
  const [x, y, z] = [0, 1, 2].map((axis) => {
    const along = model.links[1]!.shapes[0]!.size.filter((_, index) => index % 3 === axis);
    return Math.max(...along) - Math.min(...along);
  });
  expect([x, y, z].map((length) => length!.toFixed(3))).toEqual(['0.020', '0.020', '0.100']);
  // The boom folds down beside the tower, and the hook with it onto the base.
  const bent = (luff: number, tilt: number) =>
    new Map([
      [2, luff],
      [3, tilt],
    ]);
  const at = (atMs: number, angles: ReadonlyMap<number, number>) => ({ atMs, angles });
  const over = collisionsOf(model, [at(0, bent(0, 0)), at(1000, bent(3.1, 0))]);
  expect(over.map(({ kind, links }) => [kind, ...links])).toContainEqual(['self', 'own_base', 'own_hook']);
  expect(collisionsOf(model, [at(0, bent(0, 0)), at(1000, bent(0.5, 0.5))])).toEqual([]);
});

/** Numbers from 0 to 1, the same for the same seed. */
function drawing(seed: number): () => number {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}
