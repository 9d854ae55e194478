// SPDX-License-Identifier: MIT
// Small motions for the tests of the page.
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {gzipSync} from 'node:zlib';
import {out, page} from './browser.mjs';

/** A figure that walks off and bends: Hips, Chest, Head. `names` replaces the names. */
export function smallBvh(frames = 120, names = ['Hips', 'Chest', 'Head'], frameTime = 0.02) {
  const rows = Array.from({length: frames}, (_, frame) => {
    const angle = (Math.sin(frame / 10) * 20).toFixed(4);
    return `${frame / 2} 90 0 0 0 0 ${angle} 0 0 0 ${angle} 0`;
  });
  const rotations = 'Zrotation Xrotation Yrotation';
  return `HIERARCHY
ROOT ${names[0]}
{
  OFFSET 0 90 0
  CHANNELS 6 Xposition Yposition Zposition ${rotations}
  JOINT ${names[1]}
  {
    OFFSET 0 30 0
    CHANNELS 3 ${rotations}
    JOINT ${names[2]}
    {
      OFFSET 0 30 0
      CHANNELS 3 ${rotations}
      End Site
      {
        OFFSET 0 20 0
      }
    }
  }
}
MOTION
Frames: ${frames}
Frame Time: ${frameTime}
${rows.join('\n')}
`;
}

/** A skeleton of one bone, which turns up to 15 degrees about z. */
export const smallAsf = `:version 1.10
:name test
:units
  mass 1.0
  length 0.45
  angle deg
:root
  order TX TY TZ RX RY RZ
  axis XYZ
  position 0 0 0
  orientation 0 0 0
:bonedata
  begin
    id 1
    name arm
    direction 1 0 0
    length 5
    axis 0 0 0 XYZ
    dof rx ry rz
    limits (-90 90)
           (-90 90)
           (-15 15)
  end
:hierarchy
  begin
    root arm
  end
`;

/** Its motion, from frame 1 on, with an angle for each frame. */
export const smallAmc = (angles) =>
  [
    ':FULLY-SPECIFIED',
    ':DEGREES',
    ...angles.flatMap((angle, index) => [
      String(index + 1),
      `root 0 ${index} 0 0 0 0`,
      `arm 0 0 ${angle}`,
    ]),
    '',
  ].join('\n');

/** A robot's project for the flow of the examples: its first slider has a name and degrees. */
export const smallProject = {
  'robot.rpj': 'MODELNAME:[[small]]\nSLDINI:[[sliders.ini]]\n',
  'sliders.ini': `_CENTER_BAR:[0.5]-[0]
_NUMBER:[12]
_AXISNAME:[[shoulder]]
_PAIR:[0]-[0]
_PUTSTYLE:[2]-[2]-[182.0]
_DIVISION:[-32768]-[32767]-[128]
_FLAG:[0]-[4]
`,
};

/** Writes a file for a test; gives back its path. */
export function fileOf(name, text) {
  const path = join(out, name);
  writeFileSync(path, text);
  return path;
}

/** A page that carries files, as the command makes it. `open` is what it opens. */
export function carryingPage(name, files, open) {
  const list = files.map(({path, text}) => ({path, size: Buffer.byteLength(text)}));
  const head = Buffer.from(JSON.stringify({files: list, open}));
  const size = Buffer.alloc(4);
  size.writeUInt32LE(head.length);
  const packed = gzipSync(Buffer.concat([size, head, ...files.map(({text}) => Buffer.from(text))]));
  const place = '<script id="motion" type="text/plain"></script>';
  const html = readFileSync(page, 'utf8');
  return fileOf(name, html.replace(place, place.replace('><', `>${packed.toString('base64')}<`)));
}
