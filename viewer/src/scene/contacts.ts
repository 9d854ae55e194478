// SPDX-License-Identifier: MIT
// Contacts: discs on the ground where feet are on it.
import * as THREE from 'three';
import {type Core, isFailure} from '../core/core.ts';
import type {Contact} from '../core/types.ts';
import type {OpenMotion} from '../state.ts';
import {numFrames} from '../times.ts';
import type {Figure} from './figure.ts';

const kMostDiscs = 64;
/** Relative to the figure's size; or to how far its shapes reach, which would hide it. */
const kRadius = 0.05;
const kBeyondShapes = 0.8;
/** How far discs are above the floor. */
const kLift = 0.0015;

/** What a contact disc is under: a motion at a frame, with its figure. */
export interface Standing {
  motion: OpenMotion;
  frame: number;
  figure: Figure;
}

interface Kept {
  version: number;
  contacts: Contact[];
}

export interface Contacts {
  /** Whether a motion has any, as far as that is known; asks once. */
  has(motion: OpenMotion): boolean;
  /** Puts discs on a floor; none of them: no discs. */
  show(standing: Standing[], floor: number): void;
}

export function makeContacts(core: Core, group: THREE.Group, onArrival: () => void): Contacts {
  const kept = new Map<number, Kept>();
  const material = new THREE.MeshBasicMaterial({
    transparent: true,
    opacity: 0.85,
    depthWrite: false,
    polygonOffset: true,
    polygonOffsetFactor: -2,
    polygonOffsetUnits: -2,
  });
  const ring = new THREE.RingGeometry(0.62, 1, 40).rotateX(-Math.PI / 2);
  const discs = new THREE.InstancedMesh(ring, material, kMostDiscs);
  discs.frustumCulled = false;
  discs.renderOrder = 1;
  discs.count = 0;
  group.add(discs);
  const place = new THREE.Vector3();
  const matrix = new THREE.Matrix4();
  const colour = new THREE.Color();

  const contactsOf = (motion: OpenMotion): Contact[] => {
    const known = kept.get(motion.handle);
    if (known?.version === motion.version) return known.contacts;
    // Those of before the change are shown until the new ones are there.
    const entry: Kept = {version: motion.version, contacts: known?.contacts ?? []};
    kept.set(motion.handle, entry);
    if (numFrames(motion.document.time) < 2) return [];
    core.ask('contacts', {handle: motion.handle}).then((answer) => {
      if (kept.get(motion.handle) !== entry) return;
      entry.contacts = isFailure(answer) ? [] : answer.contacts;
      onArrival();
    });
    return entry.contacts;
  };

  const add = ({joint, tip}: Contact, {motion, figure}: Standing, floor: number) => {
    const {positions, tips} = figure.shown!;
    if (tip === null) place.fromArray(positions, joint * 3);
    else place.fromArray(tips, tip * 3);
    place.applyMatrix4(figure.root.matrix);
    if (!Number.isFinite(place.x + place.z) || discs.count >= kMostDiscs) return;
    const {metres} = motion.document.unit;
    const size = figure.size * metres;
    const radius = Math.max(kRadius * size, kBeyondShapes * figure.skin() * metres);
    matrix.makeScale(radius, 1, radius);
    matrix.setPosition(place.x, floor + kLift * size, place.z);
    discs.setMatrixAt(discs.count, matrix);
    discs.setColorAt(discs.count, colour.set(motion.colour));
    discs.count++;
  };

  return {
    has: (motion) => (kept.get(motion.handle)?.contacts ?? contactsOf(motion)).length > 0,
    show(standing, floor) {
      discs.count = 0;
      for (const one of standing) {
        if (one.figure.shown === null) continue;
        for (const contact of contactsOf(one.motion)) {
          const since = one.frame - contact.first_frame;
          if (since >= 0 && since < contact.num_frames) add(contact, one, floor);
        }
      }
      discs.instanceMatrix.needsUpdate = true;
      if (discs.instanceColor) discs.instanceColor.needsUpdate = true;
    },
  };
}
