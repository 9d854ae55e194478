// SPDX-License-Identifier: MIT
// Cameras: a free one that orbits or follows, and straight views from front, side and top.
import * as THREE from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';
import type {Camera} from '../state.ts';

export interface Cameras {
  readonly current: THREE.PerspectiveCamera | THREE.OrthographicCamera;
  controls: OrbitControls;
  resize(width: number, height: number): void;
  /** Shows a box from the direction of a view. */
  frame(box: THREE.Box3, view: Camera, facing: THREE.Vector3): void;
  /** Moves the camera along with a point, when it follows. */
  moveTo(target: THREE.Vector3): void;
}

const kFieldOfView = 35;
const kMargin = 1.15;

/** Where a view looks from, seen from the figure. */
function directionOf(view: Camera, facing: THREE.Vector3): THREE.Vector3 {
  const left = new THREE.Vector3(0, 1, 0).cross(facing);
  switch (view) {
    case 'front':
      return facing.clone();
    case 'side':
      return left;
    case 'top':
      return new THREE.Vector3(0, 1, 0).addScaledVector(facing, 1e-4);
    default:
      return facing.clone().multiplyScalar(1).addScaledVector(left, 0.55).setY(0.32).normalize();
  }
}

export function makeCameras(canvas: HTMLCanvasElement, onChange: () => void): Cameras {
  const perspective = new THREE.PerspectiveCamera(kFieldOfView, 1, 0.01, 1000);
  const straight = new THREE.OrthographicCamera(-1, 1, 1, -1, -1000, 1000);
  const controls: OrbitControls = new OrbitControls(perspective, canvas);
  controls.addEventListener('change', onChange);
  let aspect = 1;
  let current: THREE.PerspectiveCamera | THREE.OrthographicCamera = perspective;

  /** How far away a sphere of a radius fits into the picture. */
  const distanceFor = (radius: number): number => {
    const half = THREE.MathUtils.degToRad(kFieldOfView / 2);
    const narrow = Math.min(half, Math.atan(Math.tan(half) * aspect));
    return (radius / Math.sin(narrow)) * kMargin;
  };

  const sizeStraight = (radius: number) => {
    const half = (radius * kMargin) / Math.min(1, aspect);
    straight.top = half;
    straight.bottom = -half;
    straight.right = half * aspect;
    straight.left = -half * aspect;
    straight.zoom = 1;
    straight.updateProjectionMatrix();
  };

  return {
    get current() {
      return current;
    },
    controls,
    resize(width, height) {
      aspect = width / Math.max(1, height);
      perspective.aspect = aspect;
      perspective.updateProjectionMatrix();
      straight.right = straight.top * aspect;
      straight.left = -straight.right;
      straight.updateProjectionMatrix();
    },
    frame(box, view, facing) {
      const isStraight = view === 'front' || view === 'side' || view === 'top';
      current = isStraight ? straight : perspective;
      const centre = box.getCenter(new THREE.Vector3());
      const radius = Math.max(0.05, box.getSize(new THREE.Vector3()).length() / 2);
      const distance = distanceFor(radius);
      perspective.near = distance / 500;
      perspective.far = distance * 50;
      perspective.updateProjectionMatrix();
      sizeStraight(radius);
      current.position.copy(centre).addScaledVector(directionOf(view, facing), distance);
      (controls as {object: THREE.Camera}).object = current;
      controls.target.copy(centre);
      controls.enableRotate = !isStraight;
      controls.update();
    },
    moveTo(target) {
      current.position.add(target.clone().sub(controls.target));
      controls.target.copy(target);
      controls.update();
    },
  };
}
