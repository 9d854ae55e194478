// SPDX-License-Identifier: MIT
// The floor: a metric grid that fades out around the middle of the view, and the shadows on it.
// In straight views from front and side, where the floor is a line, the same grid stands behind the
// figures.
import * as THREE from 'three';
import type {Theme} from './theme.ts';

const kVertex = `
varying vec2 vLocal;
uniform float reach;
void main() {
  vLocal = position.xy * reach;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

/** Lines are as wide as pixels, and go where they would lie closer than a few pixels. */
const kFragment = `
varying vec2 vLocal;
uniform float reach;
uniform float cell;
uniform vec2 offset;
uniform vec3 floorColour;
uniform vec3 lineColour;
uniform vec3 strongColour;
uniform float fill;
float lines(vec2 at, float size, float width) {
  vec2 place = at / size;
  vec2 step = max(fwidth(place), vec2(1e-7));
  vec2 away = abs(fract(place - 0.5) - 0.5) / step;
  vec2 line = clamp(0.5 * width + 0.5 - away, 0.0, 1.0) * (1.0 - smoothstep(0.06, 0.3, step));
  return max(line.x, line.y);
}
void main() {
  float away = length(vLocal) / reach;
  float fade = pow(1.0 - smoothstep(0.0, 1.0, away), 1.5);
  vec2 at = vLocal + offset;
  float fine = lines(at, cell, 1.2);
  float strong = lines(at, cell * 10.0, 1.6);
  vec3 colour = mix(mix(floorColour, lineColour, fine), strongColour, strong);
  float ground = gl_FrontFacing ? fill : 0.0;
  // Half a step of noise, against bands in the fading.
  float noise = fract(sin(dot(gl_FragCoord.xy, vec2(12.9898, 78.233))) * 43758.5453) - 0.5;
  gl_FragColor = vec4(colour, max(ground, max(fine, strong)) * fade + noise / 96.0 * fade);
  #include <colorspace_fragment>
}`;

export interface Floor {
  objects: THREE.Object3D[];
  setTheme(theme: Theme): void;
  /** Lays the grid around a point. */
  lay(middle: THREE.Vector3, height: number, reach: number, cell: number): void;
  /** Stands a grid behind the figures, upright, turned to a camera; null: none. */
  stand(camera: THREE.Camera | null, behind: THREE.Vector3): void;
}

const kPlane = new THREE.PlaneGeometry(2, 2);

function makeGrid(fill: number): THREE.Mesh<THREE.PlaneGeometry, THREE.ShaderMaterial> {
  const material = new THREE.ShaderMaterial({
    vertexShader: kVertex,
    fragmentShader: kFragment,
    uniforms: {
      reach: {value: 1},
      cell: {value: 1},
      offset: {value: new THREE.Vector2()},
      floorColour: {value: new THREE.Color()},
      lineColour: {value: new THREE.Color()},
      strongColour: {value: new THREE.Color()},
      fill: {value: fill},
    },
    transparent: true,
    depthWrite: false,
    side: THREE.DoubleSide,
  });
  const grid = new THREE.Mesh(kPlane, material);
  grid.renderOrder = -2;
  grid.frustumCulled = false;
  return grid;
}

/** Both grids repeat after ten cells, so that far from the origin the shader has small numbers. */
const within = (value: number, cell: number): number => value % (cell * 10);

export function makeFloor(): Floor {
  const ground = makeGrid(1);
  ground.rotation.x = -Math.PI / 2;
  const backdrop = makeGrid(0);
  const shadows = new THREE.Mesh(kPlane, new THREE.ShadowMaterial({depthWrite: false}));
  shadows.rotation.x = -Math.PI / 2;
  shadows.receiveShadow = true;
  shadows.renderOrder = -1;
  const right = new THREE.Vector3();
  const grids = [ground, backdrop];
  return {
    objects: [...grids, shadows],
    setTheme(theme) {
      for (const {material} of grids) {
        material.uniforms.floorColour.value.set(theme.floor);
        material.uniforms.lineColour.value.set(theme.line);
        material.uniforms.strongColour.value.set(theme.strongLine);
      }
      shadows.material.opacity = theme.shadow;
    },
    lay(middle, height, reach, cell) {
      for (const grid of grids) {
        grid.scale.setScalar(reach);
        grid.material.uniforms.reach.value = reach;
        grid.material.uniforms.cell.value = cell;
      }
      ground.position.set(middle.x, height, middle.z);
      ground.material.uniforms.offset.value.set(within(middle.x, cell), within(-middle.z, cell));
      shadows.position.copy(ground.position);
      shadows.scale.setScalar(reach);
    },
    stand(camera, behind) {
      backdrop.visible = camera !== null;
      if (camera === null) return;
      backdrop.quaternion.copy(camera.quaternion);
      backdrop.position.copy(behind);
      const cell = backdrop.material.uniforms.cell.value;
      right.set(1, 0, 0).applyQuaternion(camera.quaternion);
      const height = behind.y - ground.position.y;
      backdrop.material.uniforms.offset.value.set(
        within(behind.dot(right), cell),
        within(height, cell),
      );
    },
  };
}

/** Cells are no larger than a figure, and no line is closer to the next than so many pixels. */
const kLeastPixels = 14;

/** The width of a cell in metres: 1 or 5 times a power of ten. */
export function cellSize(figure: number, pixelsPerMetre: number): number {
  const power = 10 ** Math.floor(Math.log10(Math.max(figure, 1e-6) * 1.05));
  let cell = figure * 1.05 >= 5 * power ? 5 * power : power;
  while (cell * pixelsPerMetre < kLeastPixels) cell *= 10;
  return cell;
}

/** A length as people say it: 5 mm, 10 cm, 1 m, 1 km. */
export function lengthText(metres: number): string {
  const units: [number, string][] = [
    [1000, 'km'],
    [1, 'm'],
    [0.01, 'cm'],
    [0.001, 'mm'],
  ];
  const [size, name] = units.find(([one]) => metres >= one * 0.999) ?? [0.001, 'mm'];
  return `${Number((metres / size).toPrecision(3))} ${name}`;
}
