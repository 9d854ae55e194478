// SPDX-License-Identifier: MIT
// Axes: those of the file at its origin, with their letters, and those of the selected joint.
import * as THREE from 'three';
import type {OpenMotion} from '../state.ts';
import type {Drawn} from './figures.ts';
import {uprightOf} from './placement.ts';

/** Red, green and blue, as everywhere, in tones that can be read on dark and on light. */
const kColours = ['#e5484d', '#30a46c', '#3d8bff'];
const kShaft = new THREE.CylinderGeometry(0.018, 0.018, 0.82, 10).translate(0, 0.41, 0);
const kHead = new THREE.ConeGeometry(0.05, 0.18, 14).translate(0, 0.91, 0);
const kUp = new THREE.Vector3(0, 1, 0);

function letterOf(text: string, colour: string): THREE.Sprite {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 64;
  const context = canvas.getContext('2d')!;
  context.font = '600 52px system-ui, sans-serif';
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.fillStyle = colour;
  context.fillText(text, 32, 34);
  const map = new THREE.CanvasTexture(canvas);
  map.colorSpace = THREE.SRGBColorSpace;
  return new THREE.Sprite(new THREE.SpriteMaterial({map, depthWrite: false}));
}

/** Three arrows of length 1. */
function makeArrows(letters: string): THREE.Group {
  const axes = new THREE.Group();
  axes.matrixAutoUpdate = false;
  for (let axis = 0; axis < 3; axis++) {
    const material = new THREE.MeshBasicMaterial({color: kColours[axis]});
    const along = new THREE.Vector3().setComponent(axis, 1);
    const turn = new THREE.Quaternion().setFromUnitVectors(kUp, along);
    for (const geometry of [kShaft, kHead]) {
      const part = new THREE.Mesh(geometry, material);
      part.quaternion.copy(turn);
      axes.add(part);
    }
    if (letters === '') continue;
    const letter = letterOf(letters[axis], kColours[axis]);
    letter.position.copy(along).multiplyScalar(1.16);
    letter.scale.setScalar(0.22);
    axes.add(letter);
  }
  return axes;
}

/** The length of axes, relative to the figure. */
const kOriginAxes = 0.35;
const kJointAxes = 0.14;

export interface Axes {
  /**
   * Shows the axes of a motion's file, and those of one of its joints (-1: none), for figures of a
   * size in metres; undefined: no axes.
   */
  show(motion: OpenMotion | undefined, drawn: Drawn | undefined, joint: number, size: number): void;
}

export function makeAxes(group: THREE.Group): Axes {
  const origin = makeArrows('xyz');
  const ofJoint = makeArrows('');
  group.add(origin, ofJoint);
  const place = new THREE.Vector3();
  const turn = new THREE.Quaternion();
  const scale = new THREE.Vector3();

  const showJoint = ({figure}: Drawn, joint: number) => {
    const {positions, rotations} = figure.shown!;
    const at = joint * 4;
    turn.set(rotations[at + 1], rotations[at + 2], rotations[at + 3], rotations[at]);
    place.fromArray(positions, joint * 3);
    ofJoint.matrix.compose(place, turn, scale.setScalar(kJointAxes * figure.size));
    ofJoint.matrix.premultiply(figure.root.matrix);
    ofJoint.matrixWorldNeedsUpdate = true;
  };

  return {
    show(motion, drawn, joint, size) {
      group.visible = motion !== undefined;
      if (motion === undefined) return;
      place.set(0, 0, 0);
      scale.setScalar(kOriginAxes * size);
      origin.matrix.compose(place, uprightOf(motion.document), scale);
      origin.matrixWorldNeedsUpdate = true;
      ofJoint.visible = drawn?.figure.shown != null && drawn.motion.isVisible && joint >= 0;
      if (ofJoint.visible) showJoint(drawn!, joint);
    },
  };
}
