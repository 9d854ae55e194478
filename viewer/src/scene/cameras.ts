// SPDX-License-Identifier: MIT
// Cameras: a free one that orbits or follows, and straight views from front, side and top. All of
// them look at the same target.
import * as THREE from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';
import type {Camera} from '../state.ts';

export type AnyCamera = THREE.PerspectiveCamera | THREE.OrthographicCamera;

/** A camera, what it looks at, and half the height of what it sees there. */
export interface View {
  camera: AnyCamera;
  target: THREE.Vector3;
  halfHeight: number;
}

/** How much of the picture is covered, in parts of its height or width, from each of its edges. */
export interface Cover {
  top: number;
  bottom: number;
  left: number;
  right: number;
}

export const kNoCover: Readonly<Cover> = {top: 0, bottom: 0, left: 0, right: 0};

export interface Cameras {
  readonly current: AnyCamera;
  readonly target: THREE.Vector3;
  /** Whether a person has moved it since it framed something. */
  readonly isMoved: boolean;
  /** Half the height of what is seen at the target, in metres. */
  halfHeight(): number;
  resize(width: number, height: number): void;
  /**
   * Looks from the direction of a view, at the target, at the same scale. The free camera returns to
   * where it was, or, anew, to where it looks at first.
   */
  setView(view: Camera, facing: THREE.Vector3, anew?: boolean): void;
  /** Half the height of the picture in which a box fills what is not covered. */
  halfHeightFor(box: THREE.Box3, cover: Readonly<Cover>): number;
  /** Moves so that a box fills the picture, or what is not covered of it, without turning. */
  frame(box: THREE.Box3, cover?: Readonly<Cover>): void;
  /** Moves the camera along with a point, when it follows. */
  moveTo(target: THREE.Vector3): void;
  /** Fits near and far to a scene that reaches so far from the target. */
  setRange(reach: number): void;
  /** Turns by angles around the target; straight views are moved instead. */
  turn(right: number, up: number): void;
  /** Moves by parts of half the picture's height. */
  pan(right: number, up: number): void;
  zoom(factor: number): void;
  /** Another camera that looks the same way, for a picture of other proportions; it shows a box. */
  framed(box: THREE.Box3 | null, aspect: number, halfHeight?: number): View;
  /** Whether some of a box is in view. */
  sees(box: THREE.Box3): boolean;
  /** How wide a box looks, relative to its height. */
  aspectOf(box: THREE.Box3): number;
}

const kFieldOfView = 32;
const kSlope = Math.tan(THREE.MathUtils.degToRad(kFieldOfView / 2));
const kMargin = 1.2;
const kUp = new THREE.Vector3(0, 1, 0);

export const isStraight = (view: Camera): boolean =>
  view === 'front' || view === 'side' || view === 'top';

/** A facing that is this close to an axis is along it, in radians: grids then look straight. */
const kAlmostStraight = 0.14;

function straightened(facing: THREE.Vector3): THREE.Vector3 {
  const quarter = Math.PI / 2;
  const angle = Math.atan2(facing.x, facing.z);
  const nearest = Math.round(angle / quarter) * quarter;
  if (Math.abs(angle - nearest) > kAlmostStraight) return facing;
  return new THREE.Vector3(Math.round(Math.sin(nearest)), 0, Math.round(Math.cos(nearest)));
}

/**
 * Where a view looks from, seen from the figure. From the side, it walks to the right; from the top,
 * it walks upwards.
 */
function directionOf(view: Camera, given: THREE.Vector3): THREE.Vector3 {
  const facing = straightened(given);
  const left = new THREE.Vector3().crossVectors(kUp, facing);
  switch (view) {
    case 'front':
      return facing.clone();
    case 'side':
      return left.negate();
    case 'top':
      return kUp.clone().addScaledVector(facing, -1e-4).normalize();
    default:
      return facing.clone().addScaledVector(left, 0.6).setY(0.34).normalize();
  }
}

/** The corners of a box, from its middle, along a camera's axes. */
function cornersOf(box: THREE.Box3, camera: AnyCamera): THREE.Vector3[] {
  const inverse = camera.quaternion.clone().invert();
  const half = box.getSize(new THREE.Vector3()).multiplyScalar(0.5);
  const corners: THREE.Vector3[] = [];
  for (let k = 0; k < 8; k++) {
    const side = new THREE.Vector3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    corners.push(side.multiply(half).applyQuaternion(inverse));
  }
  return corners;
}

/** How high half of a picture must be, at the middle of a box, to hold all of the box. */
function halfHeightFor(box: THREE.Box3, camera: AnyCamera, aspect: number): number {
  let half = 1e-4;
  for (const {x, y, z} of cornersOf(box, camera)) {
    const near = camera instanceof THREE.PerspectiveCamera ? z * kSlope : 0;
    half = Math.max(half, Math.abs(x) / aspect + near, Math.abs(y) + near);
  }
  return half * kMargin;
}

function sizeStraight(camera: THREE.OrthographicCamera, half: number, aspect: number): void {
  camera.top = half;
  camera.bottom = -half;
  camera.right = half * aspect;
  camera.left = -half * aspect;
  camera.zoom = 1;
  camera.updateProjectionMatrix();
}

export function makeCameras(canvas: HTMLCanvasElement, onChange: () => void): Cameras {
  const perspective = new THREE.PerspectiveCamera(kFieldOfView, 1, 0.01, 1000);
  const straight = new THREE.OrthographicCamera(-1, 1, 1, -1, -1000, 1000);
  const controls = new OrbitControls<AnyCamera>(perspective, canvas);
  perspective.position.set(0, 1, 4);
  let aspect = 1;
  let current: AnyCamera = perspective;
  let reach = 1;
  let isMoved = false;
  let isHeld = false;
  /** Where the free camera looked from. */
  const freely = new THREE.Vector3();
  controls.addEventListener('change', () => {
    isMoved ||= isHeld;
    onChange();
  });
  controls.addEventListener('start', () => {
    isHeld = true;
  });
  controls.addEventListener('end', () => {
    isHeld = false;
  });

  const {target} = controls;
  const halfHeight = () =>
    current === straight
      ? straight.top / straight.zoom
      : kSlope * perspective.position.distanceTo(target);

  /** Puts the current camera in a direction from the target. */
  const place = (direction: THREE.Vector3, half: number) => {
    current.position.copy(target).addScaledVector(direction, half / kSlope);
    sizeStraight(straight, half, aspect);
    current.lookAt(target);
    controls.object = current;
    controls.update();
  };
  const direction = () => current.position.clone().sub(target).normalize();

  return {
    target,
    get current() {
      return current;
    },
    get isMoved() {
      return isMoved;
    },
    halfHeight,
    resize(width, height) {
      aspect = width / Math.max(1, height);
      perspective.aspect = aspect;
      perspective.updateProjectionMatrix();
      straight.right = straight.top * aspect;
      straight.left = -straight.right;
      straight.updateProjectionMatrix();
    },
    setView(view, facing, anew = false) {
      const half = halfHeight();
      if (anew) freely.set(0, 0, 0);
      else if (current === perspective && freely.lengthSq() > 0) freely.copy(direction());
      current = isStraight(view) ? straight : perspective;
      controls.enableRotate = current === perspective;
      controls.mouseButtons.LEFT = controls.enableRotate ? THREE.MOUSE.ROTATE : THREE.MOUSE.PAN;
      controls.touches.ONE = controls.enableRotate ? THREE.TOUCH.ROTATE : THREE.TOUCH.PAN;
      if (current === perspective && freely.lengthSq() === 0) {
        freely.copy(directionOf(view, facing));
      }
      place(current === perspective ? freely : directionOf(view, facing), half);
    },
    halfHeightFor(box, {top, bottom, left, right}) {
      const high = 1 - top - bottom;
      return halfHeightFor(box, current, (aspect * (1 - left - right)) / high) / high;
    },
    frame(box, cover = kNoCover) {
      const {top, bottom, left, right} = cover;
      const from = direction();
      const half = this.halfHeightFor(box, cover);
      box.getCenter(target);
      place(from, half);
      const aside = new THREE.Vector3(half * aspect * (right - left), half * (top - bottom), 0);
      this.moveTo(aside.applyQuaternion(current.quaternion).add(target));
      isMoved = false;
    },
    moveTo(point) {
      current.position.add(point).sub(target);
      target.copy(point);
      controls.update();
    },
    setRange(given) {
      reach = given;
      const distance = current.position.distanceTo(target);
      current.near = current === perspective ? distance / 60 : -2 * reach;
      current.far = distance + 2 * reach;
      current.updateProjectionMatrix();
    },
    turn(right, up) {
      isMoved = true;
      if (current === straight) return this.pan(right, up);
      const place = new THREE.Spherical().setFromVector3(current.position.clone().sub(target));
      place.theta += right;
      place.phi -= up;
      place.makeSafe();
      current.position.setFromSpherical(place).add(target);
      controls.update();
    },
    pan(right, up) {
      isMoved = true;
      const half = halfHeight();
      const move = new THREE.Vector3(right * half, up * half, 0).applyQuaternion(
        current.quaternion,
      );
      this.moveTo(move.add(target));
      onChange();
    },
    zoom(factor) {
      isMoved = true;
      place(direction(), halfHeight() / factor);
      onChange();
    },
    framed(box, wanted, given) {
      const camera: AnyCamera = current.clone();
      const middle = box === null ? target.clone() : box.getCenter(new THREE.Vector3());
      const own = box === null ? halfHeight() : halfHeightFor(box, camera, wanted);
      const half = given ?? own;
      camera.position.copy(middle).addScaledVector(direction(), half / kSlope);
      if (camera instanceof THREE.PerspectiveCamera) {
        camera.aspect = wanted;
        camera.near = half / kSlope / 60;
        camera.far = half / kSlope + 2 * reach;
        camera.updateProjectionMatrix();
      } else {
        camera.far = half / kSlope + 2 * reach;
        sizeStraight(camera, half, wanted);
      }
      camera.updateMatrixWorld();
      return {camera, target: middle, halfHeight: half};
    },
    sees(box) {
      current.updateMatrixWorld();
      const all = new THREE.Matrix4().multiplyMatrices(
        current.projectionMatrix,
        current.matrixWorldInverse,
      );
      return new THREE.Frustum().setFromProjectionMatrix(all).intersectsBox(box);
    },
    aspectOf(box) {
      const corners = cornersOf(box, current);
      const width = Math.max(...corners.map(({x}) => Math.abs(x)));
      const height = Math.max(...corners.map(({y}) => Math.abs(y)));
      return height > 0 ? Math.max(0.2, Math.min(5, width / height)) : 1;
    },
  };
}
