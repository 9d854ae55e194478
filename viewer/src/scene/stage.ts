// SPDX-License-Identifier: MIT
// The stage: renderer, light, floor with a metric grid. The world is in metres, y up.
import * as THREE from 'three';

export interface Stage {
  renderer: THREE.WebGLRenderer;
  scene: THREE.Scene;
  /** Moves floor and light to where the figures are. */
  place(box: THREE.Box3, floor: number): void;
  setTheme(isDark: boolean): void;
}

interface Theme {
  background: number;
  floor: number;
  line: number;
  strongLine: number;
  light: number;
}

const kDark: Theme = {
  background: 0x15181d,
  floor: 0x1e2228,
  line: 0x333a44,
  strongLine: 0x4a5463,
  light: 2.6,
};
const kLight: Theme = {
  background: 0xeef1f5,
  floor: 0xe2e6ec,
  line: 0xc3cad4,
  strongLine: 0x98a2b0,
  light: 2.8,
};

/** How far the grid goes on beyond the figures, in metres, and its most lines. */
const kMargin = 2;
const kMostCells = 120;
const kShadowMap = 2048;

/** The width of a cell: 1 m, or 1, 2, 5 times a power of ten that keeps the lines apart. */
function cellSize(extent: number): number {
  for (let size = extent < 0.5 ? 0.1 : 1; ; size *= 10) {
    for (const factor of [1, 2, 5]) {
      if (extent / (size * factor) <= kMostCells) return size * factor;
    }
  }
}

/** Lines of a square grid around the origin, as many cells to each side. */
function gridLines(cells: number, size: number): THREE.BufferGeometry {
  const points: number[] = [];
  const end = cells * size;
  for (let i = -cells; i <= cells; i++) {
    points.push(i * size, 0, -end, i * size, 0, end, -end, 0, i * size, end, 0, i * size);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(points, 3));
  return geometry;
}

export function makeStage(canvas: HTMLCanvasElement): Stage {
  const renderer = new THREE.WebGLRenderer({canvas, antialias: true, preserveDrawingBuffer: false});
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = THREE.PCFSoftShadowMap;
  renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));

  const scene = new THREE.Scene();
  const sky = new THREE.HemisphereLight(0xffffff, 0x8a8f98, 1.2);
  const sun = new THREE.DirectionalLight(0xffffff, kLight.light);
  sun.castShadow = true;
  sun.shadow.mapSize.set(kShadowMap, kShadowMap);
  sun.shadow.bias = -0.0005;
  sun.shadow.normalBias = 0.01;
  const floor = new THREE.Mesh(
    new THREE.PlaneGeometry(1, 1).rotateX(-Math.PI / 2),
    new THREE.MeshLambertMaterial({polygonOffset: true, polygonOffsetFactor: 1}),
  );
  floor.receiveShadow = true;
  const grid = new THREE.LineSegments(
    new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({transparent: true}),
  );
  scene.add(sky, sun, sun.target, floor, grid);

  return {
    renderer,
    scene,
    place(box, height) {
      const centre = box.getCenter(new THREE.Vector3());
      const size = box.getSize(new THREE.Vector3());
      const reach = Math.max(size.x, size.z) / 2 + Math.max(kMargin, size.y);
      const cell = cellSize(2 * reach);
      grid.geometry.dispose();
      grid.geometry = gridLines(Math.ceil(reach / cell), cell);
      const origin = new THREE.Vector3(
        Math.round(centre.x / cell) * cell,
        height,
        Math.round(centre.z / cell) * cell,
      );
      grid.position.copy(origin);
      floor.position.copy(origin);
      floor.scale.set(reach * 40, 1, reach * 40);
      const radius = Math.max(0.5, size.length() / 2 + 0.5);
      sun.target.position.copy(centre);
      sun.position.copy(centre).add(new THREE.Vector3(0.5, 1.2, 0.7).multiplyScalar(2 * radius));
      const {camera} = sun.shadow;
      camera.left = camera.bottom = -radius;
      camera.right = camera.top = radius;
      camera.near = 0.1 * radius;
      camera.far = 6 * radius;
      camera.updateProjectionMatrix();
    },
    setTheme(isDark) {
      const theme = isDark ? kDark : kLight;
      scene.background = new THREE.Color(theme.background);
      scene.fog = null;
      floor.material.color.set(theme.floor);
      grid.material.color.set(theme.line);
      sun.intensity = theme.light;
    },
  };
}
