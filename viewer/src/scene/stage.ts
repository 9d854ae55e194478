// SPDX-License-Identifier: MIT
// The stage: renderer, light, floor. The world is in metres, y up.
import * as THREE from 'three';
import {type Floor, makeFloor} from './floor.ts';
import {kDark, kLight, type Theme} from './theme.ts';

export interface Stage {
  renderer: THREE.WebGLRenderer;
  scene: THREE.Scene;
  floor: Floor;
  readonly theme: Theme;
  /** Shadows are as sharp as this box, which holds what casts them, allows. */
  lightBox(box: THREE.Box3): void;
  /** Lets a weak light shine from where a camera is, so that no view shows the dark side. */
  lightFrom(camera: THREE.Camera): void;
  /** Puts the sun beside somebody who looks from a direction. */
  turnSun(viewer: THREE.Vector3): void;
  setTheme(isDark: boolean): void;
}

const kShadowMap = 1536;
/** How far the sun is from straight above: little, so that feet and shadow meet. */
const kSunSlope = 0.65;
/** How far it is to the left of a viewer, in radians. */
const kSunTurn = -0.75;
/** The box of light grows in such steps, so that edges of shadows do not swim. */
const kGrowth = 1.25;

/** Makes the stage; throws where the browser has no WebGL. */
export function makeStage(canvas: HTMLCanvasElement): Stage {
  const renderer = new THREE.WebGLRenderer({canvas, antialias: true});
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = THREE.PCFShadowMap;
  renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));

  const scene = new THREE.Scene();
  const sky = new THREE.HemisphereLight(0xffffff, 0x6b7280);
  const sun = new THREE.DirectionalLight(0xfffaf2);
  sun.castShadow = true;
  sun.shadow.mapSize.set(kShadowMap, kShadowMap);
  sun.shadow.bias = -0.0006;
  sun.shadow.radius = 2.5;
  const fill = new THREE.DirectionalLight(0xdfe8ff);
  const floor = makeFloor();
  scene.add(sky, sun, sun.target, fill, ...floor.objects);

  const right = new THREE.Vector3();
  const up = new THREE.Vector3();
  const toSun = new THREE.Vector3();
  const centre = new THREE.Vector3();
  const size = new THREE.Vector3();
  const snap = (axis: THREE.Vector3, texel: number) => {
    const along = centre.dot(axis);
    centre.addScaledVector(axis, Math.round(along / texel) * texel - along);
  };
  let theme = kLight;
  let radius = 0;

  const turnSun = (viewer: THREE.Vector3) => {
    const angle = Math.atan2(viewer.x, viewer.z) + kSunTurn;
    toSun.set(kSunSlope * Math.sin(angle), 1, kSunSlope * Math.cos(angle)).normalize();
    right.set(0, 1, 0).cross(toSun).normalize();
    up.crossVectors(toSun, right);
  };
  turnSun(new THREE.Vector3(0, 0, 1));

  return {
    renderer,
    scene,
    floor,
    get theme() {
      return theme;
    },
    turnSun,
    lightFrom(camera) {
      fill.position.set(0.5, 0.4, 1).applyQuaternion(camera.quaternion);
    },
    lightBox(box) {
      if (box.isEmpty()) return;
      box.getCenter(centre);
      const wanted = Math.max(1e-4, box.getSize(size).length() * 0.6);
      const next = kGrowth ** Math.ceil(Math.log(wanted) / Math.log(kGrowth));
      // Whole texels: otherwise the edges crawl when the box moves.
      snap(right, (2 * next) / kShadowMap);
      snap(up, (2 * next) / kShadowMap);
      sun.target.position.copy(centre);
      sun.position.copy(centre).addScaledVector(toSun, 3 * next);
      if (next === radius) return;
      radius = next;
      const {camera} = sun.shadow;
      camera.left = camera.bottom = -radius;
      camera.right = camera.top = radius;
      camera.near = 0.5 * radius;
      camera.far = 8 * radius;
      sun.shadow.normalBias = radius * 0.004;
      camera.updateProjectionMatrix();
    },
    setTheme(isDark) {
      theme = isDark ? kDark : kLight;
      scene.background = new THREE.Color(theme.background);
      sky.intensity = theme.sky;
      sun.intensity = theme.sun;
      fill.intensity = theme.fill;
      floor.setTheme(theme);
    },
  };
}
