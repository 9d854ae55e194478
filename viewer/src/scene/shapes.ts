// SPDX-License-Identifier: MIT
// What the links of a robot look like: the primitive shapes of its file, one instanced mesh for each
// kind of shape.
import * as THREE from 'three';
import type {Description, VisualShape} from '../core/types.ts';
import type {FramePoses} from '../poses.ts';

type Solid = 'box' | 'cylinder' | 'sphere' | 'cone';

/** Each fills a box of size 1 around its origin; the round ones are along z. */
const kSolids: Record<Solid, THREE.BufferGeometry> = {
  box: new THREE.BoxGeometry(1, 1, 1),
  cylinder: new THREE.CylinderGeometry(0.5, 0.5, 1, 28).rotateX(Math.PI / 2),
  sphere: new THREE.SphereGeometry(0.5, 24, 16),
  cone: new THREE.ConeGeometry(0.5, 1, 28).rotateX(Math.PI / 2),
};

/** A part that is drawn: a solid in the frame of a joint. */
interface Part {
  solid: Solid;
  joint: number;
  jointFromSolid: THREE.Matrix4;
  colour: VisualShape['colour'];
}

/** The solids of a shape: a capsule is a cylinder and two spheres. */
export function solidsOf(shape: VisualShape): {
  solid: Solid;
  size: [number, number, number];
  z: number;
}[] {
  const {kind, size} = shape;
  if (kind !== 'capsule') return [{solid: kind, size, z: 0}];
  const [x, y, length] = size;
  const cap = Math.min(length, (x + y) / 2);
  const straight = length - cap;
  const end: [number, number, number] = [x, y, cap];
  return [
    {solid: 'cylinder', size: [x, y, straight], z: 0},
    {solid: 'sphere', size: end, z: straight / 2},
    {solid: 'sphere', size: end, z: -straight / 2},
  ];
}

function partsOf(document: Description): Part[] {
  const parts: Part[] = [];
  const turn = new THREE.Quaternion();
  document.joints.forEach(({visuals}, joint) => {
    for (const shape of visuals) {
      const [w, x, y, z] = shape.rotation;
      turn.set(x, y, z, w);
      for (const {solid, size, z: along} of solidsOf(shape)) {
        const middle = new THREE.Vector3(0, 0, along)
          .applyQuaternion(turn)
          .add(new THREE.Vector3(...shape.position));
        const jointFromSolid = new THREE.Matrix4().compose(
          middle,
          turn,
          new THREE.Vector3(...size),
        );
        parts.push({solid, joint, jointFromSolid, colour: shape.colour});
      }
    }
  });
  return parts;
}

/** How far a part reaches from its joint, about. */
function reachOf({jointFromSolid}: Part): number {
  const middle = new THREE.Vector3().setFromMatrixPosition(jointFromSolid);
  const size = new THREE.Vector3().setFromMatrixScale(jointFromSolid);
  return middle.length() + Math.max(size.x, size.y, size.z) / 2;
}

export interface Shapes {
  meshes: THREE.InstancedMesh[];
  /** How far shapes reach beyond their joints, in the file's unit. */
  reach: number;
  show(poses: FramePoses): void;
  /** Colours each part: its own colour, or none, becomes the one that is drawn. */
  paint(colourOf: (joint: number, own: VisualShape['colour'], out: THREE.Color) => void): void;
  /** The joint of an instance of one of the meshes. */
  jointOf(mesh: THREE.Object3D, instance: number): number;
}

/** Whether a robot has any shape. */
export const hasShapes = (document: Description): boolean =>
  document.joints.some((joint) => joint.visuals.length > 0);

/** The largest extent of the shapes of each joint, in the file's unit; 0 without any. */
export const extentsOfShapes = (document: Description): number[] =>
  document.joints.map(({visuals}) => Math.max(0, ...visuals.flatMap(({size}) => size)));

/** Makes the shapes of a robot from one material. */
export function makeShapes(document: Description, material: THREE.Material): Shapes {
  const all = partsOf(document);
  const groups = (Object.keys(kSolids) as Solid[])
    .map((solid) => ({solid, parts: all.filter((part) => part.solid === solid)}))
    .filter(({parts}) => parts.length > 0)
    .map(({solid, parts}) => ({
      parts,
      mesh: new THREE.InstancedMesh(kSolids[solid], material, parts.length),
    }));
  const place = new THREE.Vector3();
  const turn = new THREE.Quaternion();
  const one = new THREE.Vector3(1, 1, 1);
  const matrix = new THREE.Matrix4();
  const colour = new THREE.Color();
  return {
    meshes: groups.map(({mesh}) => mesh),
    reach: Math.max(...all.map(reachOf)),
    show({positions, rotations}) {
      for (const {parts, mesh} of groups) {
        for (let k = 0; k < parts.length; k++) {
          const {joint, jointFromSolid} = parts[k];
          const at = joint * 4;
          place.fromArray(positions, joint * 3);
          turn.set(rotations[at + 1], rotations[at + 2], rotations[at + 3], rotations[at]);
          mesh.setMatrixAt(k, matrix.compose(place, turn, one).multiply(jointFromSolid));
        }
        mesh.instanceMatrix.needsUpdate = true;
      }
    },
    paint(colourOf) {
      for (const {parts, mesh} of groups) {
        parts.forEach((part, k) => {
          colourOf(part.joint, part.colour, colour);
          mesh.setColorAt(k, colour);
        });
        mesh.instanceColor!.needsUpdate = true;
      }
    },
    jointOf: (mesh, instance) => groups.find((group) => group.mesh === mesh)!.parts[instance].joint,
  };
}
