// SPDX-License-Identifier: MIT
// Parts of the scene without a browser: where figures, shapes and cameras are put.
import assert from 'node:assert/strict';
import {dirname, join} from 'node:path';
import {before, test} from 'node:test';
import {fileURLToPath} from 'node:url';
import {build} from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
let parts;

before(async () => {
  const names = ['sheet', 'floor', 'framing', 'ghosts', 'paths', 'shapes', 'placement', 'figure'];
  const made = await build({
    stdin: {
      contents: [
        ...names.map((name) => `export * from './src/scene/${name}.ts';`),
        `export * as THREE from 'three';`,
      ].join('\n'),
      resolveDir: join(here, '..'),
    },
    bundle: true,
    write: false,
    format: 'esm',
    logLevel: 'warning',
  });
  const text = Buffer.from(made.outputFiles[0].text).toString('base64');
  parts = await import(`data:text/javascript;base64,${text}`);
});

const near = (actual, expected, message) =>
  expected.forEach((value, k) => {
    assert.ok(Math.abs(actual[k] - value) < 1e-5, `${message}: ${actual} for ${expected}`);
  });

/** A description with what placement reads of it. */
const described = (given = {}) => ({
  joints: [{name: 'Hips', parent: -1, tips: [], visuals: []}],
  unit: {metres: 0.01},
  up: {axis: 1},
  facing: {direction: [0, 0, 1]},
  extent: {min: [-50, 0, 0], max: [50, 180, 300]},
  height: 180,
  ...given,
});

test('the frames of a contact sheet end before B, as elsewhere', () => {
  const {framesOf} = parts;
  assert.deepEqual(framesOf('0:60:20', 90), [0, 20, 40]);
  assert.deepEqual(framesOf('80::5', 90), [80, 85]);
  assert.deepEqual(framesOf('7', 90), [7]);
  assert.deepEqual(framesOf(':4', 90), [0, 1, 2, 3]);
  assert.equal(framesOf('', 90).length, 12);
  assert.ok(framesOf('::1', 100_000).length <= 120);
  for (const wrong of ['5:5', '9:3', '0:91', '0:9:0', 'a', '1:2:3:4', '-1:3']) {
    assert.equal(framesOf(wrong, 90), null, wrong);
  }
});

test('pictures of a sheet are as large as they can be', () => {
  const {gridFor} = parts;
  const {columns, rows} = gridFor(12, 1200, 600, 0.5);
  assert.ok(columns * rows >= 12 && columns > rows, `${columns} ${rows}`);
  assert.equal(gridFor(1, 500, 500, 1).columns, 1);
});

test('cells of the grid fit the figure, and lines never run together', () => {
  const {cellSize, lengthText} = parts;
  for (const [figure, cell] of [
    [1.75, 1],
    [1.2, 1],
    [2.1, 1],
    [0.45, 0.1],
    [0.1, 0.1],
    [60, 50],
  ]) {
    assert.ok(Math.abs(cellSize(figure, 1000 / figure) - cell) < 1e-9, `${figure}`);
  }
  assert.equal(cellSize(1.75, 5), 10);
  assert.deepEqual([0.005, 0.1, 1, 50, 1000].map(lengthText), [
    '5 mm',
    '10 cm',
    '1 m',
    '50 m',
    '1 km',
  ]);
});

test('a figure in centimetres with z up stands in metres with y up', () => {
  const {sceneFromFile, facingOf, boxOf, THREE} = parts;
  const document = described({up: {axis: 2}, facing: {direction: [0, -1, 0]}});
  const top = new THREE.Vector3(0, 0, 180).applyMatrix4(sceneFromFile(document));
  near(top.toArray(), [0, 1.8, 0], 'up');
  near(facingOf({document, front: null}).toArray(), [0, 0, 1], 'facing');
  const sideways = described({up: {axis: 0}});
  near(
    new THREE.Vector3(180, 0, 0).applyMatrix4(sceneFromFile(sideways)).toArray(),
    [0, 1.8, 0],
    'x',
  );
  assert.ok(boxOf(described({extent: {min: ['nan', 0, 0], max: [1, 1, 1]}})).isEmpty());
});

test('motions stand as recorded, aligned, or side by side', () => {
  const {offsetsOf, THREE} = parts;
  const motion = (handle, placement) => ({handle, placement, document: described()});
  const places = {1: [1, 0.9, 2], 2: [5, 0.8, -3], 3: [0, 1, 0]};
  const starts = {of: ({handle}) => new THREE.Vector3(...places[handle])};
  const motions = [motion(1, 'aligned'), motion(2, 'aligned'), motion(3, 'recorded')];
  const [first, second, third] = offsetsOf(motions, starts);
  near(first.toArray(), [0, 0, 0], 'the first stays');
  near(second.toArray(), [-4, 0, 5], 'the ground position of the first, not its height');
  near(third.toArray(), [0, 0, 0], 'as recorded');
  const beside = offsetsOf(
    [motion(1, 'recorded'), motion(2, 'beside'), motion(3, 'beside')],
    starts,
  );
  // Widths are 1 m: from -0.5 to 0.5; gaps are 0.35 of 1.8 m.
  near(beside[1].toArray(), [1 + 0.63, 0, 5], 'to the right, in line');
  near(beside[2].toArray(), [2 * (1 + 0.63), 0, 2], 'further right');
});

test('shapes are placed in the frames of their joints', () => {
  const {makeShapes, solidsOf, THREE} = parts;
  const half = Math.SQRT1_2;
  const shape = {
    kind: 'box',
    size: [2, 4, 6],
    position: [0, 0, 1],
    rotation: [half, half, 0, 0],
    colour: [1, 0, 0],
  };
  const document = described({joints: [{name: 'a', parent: -1, tips: [], visuals: [shape]}]});
  const shapes = makeShapes(document, new THREE.MeshBasicMaterial());
  // The joint is at (10, 0, 0), turned by 90 degrees around y.
  shapes.show({
    positions: new Float32Array([10, 0, 0]),
    rotations: new Float32Array([half, 0, half, 0]),
    tips: new Float32Array(),
  });
  const matrix = new THREE.Matrix4();
  shapes.meshes[0].getMatrixAt(0, matrix);
  near(new THREE.Vector3().applyMatrix4(matrix).toArray(), [11, 0, 0], 'its middle');
  // The end of its z axis is turned to -y by the shape.
  const end = new THREE.Vector3(0, 0, 0.5).applyMatrix4(matrix);
  near(end.toArray(), [11, -3, 0], 'its end');
  const solids = solidsOf({...shape, kind: 'capsule', size: [2, 2, 6]});
  assert.deepEqual(
    solids.map(({solid, size, z}) => [solid, size[2], z]),
    [
      ['cylinder', 4, 0],
      ['sphere', 2, 2],
      ['sphere', 2, -2],
    ],
  );
});

test('a cone has its apex at +z, and solids fill a box of size 1', () => {
  const {makeShapes, THREE} = parts;
  const kinds = ['box', 'cylinder', 'sphere', 'cone'];
  for (const kind of kinds) {
    const visuals = [
      {kind, size: [1, 1, 1], position: [0, 0, 0], rotation: [1, 0, 0, 0], colour: null},
    ];
    const document = described({joints: [{name: 'a', parent: -1, tips: [], visuals}]});
    const [{geometry}] = makeShapes(document, new THREE.MeshBasicMaterial()).meshes;
    geometry.computeBoundingBox();
    near(geometry.boundingBox.max.toArray(), [0.5, 0.5, 0.5], kind);
    near(geometry.boundingBox.min.toArray(), [-0.5, -0.5, -0.5], kind);
    if (kind !== 'cone') continue;
    const places = geometry.getAttribute('position');
    for (let k = 0; k < places.count; k++) {
      if (places.getZ(k) < 0.49) continue;
      near([places.getX(k), places.getY(k)], [0, 0], 'the apex');
    }
  }
});

test('ghosts are around the present, or all over a short clip', () => {
  const {ghostTimes} = parts;
  assert.deepEqual(ghostTimes(5, 10), [4, 4.25, 4.5, 4.75, 5.25, 5.5, 5.75, 6]);
  assert.deepEqual(ghostTimes(0, 10), [0.25, 0.5, 0.75, 1]);
  assert.deepEqual(ghostTimes(0.3, 0.8).length, 9);
  assert.equal(ghostTimes(0.3, 0.8).at(-1), 0.8);
});

test('paths have few points, none of them without a place', () => {
  const {thinned, jointOfPath} = parts;
  const long = new Float64Array(30_000).map((_, k) => k);
  assert.ok(thinned(long, 100).points.length <= 300);
  const broken = new Float64Array([Number.NaN, 0, 0, 1, 2, 3, Number.NaN, 0, 0, 4, 5, 6]);
  assert.deepEqual([...thinned(broken).points], [1, 2, 3, 1, 2, 3, 1, 2, 3, 4, 5, 6]);
  assert.equal(thinned(new Float64Array(6).fill(Number.NaN)), null);
  const names = (list) => ({joints: list.map((name) => ({name}))});
  const active = {handle: 1, document: names(['Hips', 'Hand'])};
  const other = {handle: 2, document: names(['Root', 'Hand', 'Foot'])};
  assert.deepEqual(
    [jointOfPath(active, active, 1), jointOfPath(other, active, 1), jointOfPath(other, active, 0)],
    [1, 1, 0],
  );
});

test('the camera follows along the ground, and upwards only when it must', () => {
  const {follow, THREE} = parts;
  const target = new THREE.Vector3(0, 1, 0);
  assert.equal(follow(target, new THREE.Vector3(1, 1.3, 2), 1.8, null), false);
  near(target.toArray(), [1, 1, 2], 'at once while time stands, and not up with a step');
  assert.equal(follow(target, new THREE.Vector3(2, 1, 2), 1.8, 0.03), true);
  assert.ok(target.x > 1.05 && target.x < 1.5, `${target.x}`);
  follow(target, new THREE.Vector3(2, 5, 2), 1.8, 0.03);
  near([target.y], [5 - 0.4 * 1.8], 'up the stairs');
});

test('long walks are framed around the figure, the floor is where feet are', () => {
  const {framedBox, floorHeight, THREE} = parts;
  const box = (...at) =>
    new THREE.Box3(new THREE.Vector3(...at.slice(0, 3)), new THREE.Vector3(...at.slice(3)));
  const walk = framedBox(box(-50, 0, -50, 50, 2, 50), box(9, 0, 9, 10, 1.8, 10), 1.8, 0.1);
  assert.ok(walk.max.x - walk.min.x < 6 && walk.containsPoint(new THREE.Vector3(9.5, 1, 9.5)));
  const dance = framedBox(box(-1, 0, -1, 1, 1.8, 1), box(0, 0, 0, 0.5, 1.8, 0.5), 1.8, 0.1);
  assert.ok(dance.min.x < -1 && dance.max.x > 1, 'as a whole');
  assert.ok(!framedBox(new THREE.Box3(), new THREE.Box3(), 1.7, 0.1).isEmpty());
  assert.equal(floorHeight(box(0, -0.05, 0, 1, 1.8, 1), 1.8), 0);
  assert.equal(floorHeight(box(0, -0.9, 0, 1, 0.9, 1), 1.8), -0.9);
  assert.equal(floorHeight(box(0, 40, 0, 1, 42, 1), 1.8), 40);
});

test('a figure without a height has the size of its pose', () => {
  const {sizeOf, boxOfPoses, THREE} = parts;
  const poses = {
    positions: new Float32Array([0, 0, 0, 3, 4, 0, Number.NaN, 1, 1]),
    rotations: new Float32Array(),
    tips: new Float32Array(),
  };
  const box = boxOfPoses(poses, new THREE.Box3());
  near(box.max.toArray(), [3, 4, 0], 'points that are nowhere do not count');
  assert.ok(Math.abs(sizeOf(described({height: 'nan'}), box) - 3.5) < 1e-9);
  assert.equal(sizeOf(described({height: 4}), box), 4);
  assert.equal(sizeOf(described({height: 500}), box), 5);
  assert.equal(sizeOf(described({height: 0}), new THREE.Box3()), 100);
});
