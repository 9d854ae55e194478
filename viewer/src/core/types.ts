// SPDX-License-Identifier: MIT
// What the core answers: see wasm/answers.cpp and docs/design/viewer.md. Texts of files are text,
// never markup.

/** A number; nan and infinities come as text. */
export type Num = number | 'nan' | 'inf' | '-inf';

export interface Diagnostic {
  file: string;
  /** From 1; 0: the file as a whole. */
  line: number;
  column: number;
  severity: 'note' | 'warning' | 'error';
  code: string;
  message: string;
  excerpt: string;
  /** Byte offset in the excerpt that the place points at. */
  caret: number;
}

/** A primitive shape that is fixed to a joint, in the file's unit of length. */
export interface VisualShape {
  kind: 'box' | 'cylinder' | 'sphere' | 'capsule' | 'cone';
  size: [number, number, number];
  position: [number, number, number];
  /** w x y z */
  rotation: [number, number, number, number];
  colour: [number, number, number] | null;
}

/** A column of the file that belongs to a joint. */
export interface Channel {
  name: string;
  column: number;
  /** Empty: a part of a quaternion, a scale, a column that moves nothing. */
  measure?: 'length' | 'angle' | '';
  /** Its limits in its own unit; absent: none. */
  lower?: number;
  upper?: number;
}

/** A way in which a joint of a robot moves; its numbers are in `unit`, absent ones are null. */
export interface Dof {
  kind: 'rotation' | 'translation';
  axis: [Num, Num, Num];
  unit: string;
  lower: number | null;
  upper: number | null;
  /** Per second. */
  max_speed: number | null;
  /** The id by which files of joint values move it. */
  id: number | null;
}

export interface Joint {
  name: string;
  joint_name: string;
  /** The index of the parent; -1 for a root. */
  parent: number;
  tips: string[];
  visuals: VisualShape[];
  channels?: Channel[];
  /** Of a robot's links. */
  dofs?: Dof[];
}

export type Certainty = 'known' | 'clear' | 'doubtful';

export interface Time {
  num_frames: number;
  /** A skeleton alone, which shows its rest pose. */
  is_still: boolean;
  first_frame_number: number;
  duration: number;
  frame_time: number;
  own_times: number[] | null;
}

/** An open document, as the core describes it. */
export interface Description {
  path: string;
  format: string;
  kind: 'motion' | 'skeleton' | 'body_motion' | 'pose_flow';
  skeleton: string;
  servo_map: string;
  project: string;
  /** The files that it was read with, whoever named them. */
  companions: string[];
  options: Record<string, unknown>;
  /** Whether it is known where the figure is: joint values of a robot alone do not say it. */
  has_place: boolean;
  /** Of a flow that shows its sliders alone: what a figure needs; empty: nothing, or no flow. */
  lacks: string;
  /** Whether it can be warped: a flow of servo poses has no frames. */
  has_frames: boolean;
  is_robot: boolean;
  angle_unit: 'degrees' | 'radians';
  metres_per_unit: number;
  facts: string[];
  joints: Joint[];
  num_coordinates: number;
  time: Time;
  extent: {min: Num[]; max: Num[]} | null;
  up: {axis: 0 | 1 | 2; certainty: Certainty; reason: string};
  facing: {direction: Num[] | null; reason: string};
  unit: {metres: number; certainty: Certainty; reason: string};
  height: Num;
  /** Which frame before the warp each frame shows; empty if the last step is no warp. */
  source_frames: number[];
  /** The time of what was read, from its first frame on, that the first frame after all steps shows. */
  source_start: number;
  /** Of a flow: its poses in the order of its run, and the frame at which each begins. */
  blocks: {frame: number; number: number; name: string}[];
}

/** One entry of a table of options. */
export interface OptionInfo {
  name: string;
  type: 'flag' | 'number' | 'count' | 'choice' | 'text' | 'file';
  value_name: string;
  help: string;
  default: string;
  is_required: boolean;
  separator: string;
  choices: string[];
  least: number | null;
  most: number | null;
}

export interface OperationForm {
  usage: string;
  parameters: OptionInfo[];
}

export interface OperationInfo {
  name: string;
  help: string;
  needs_motion: boolean;
  works_on_components: boolean;
  form: OperationForm | null;
  flow_form: OperationForm | null;
}

export interface FormatInfo {
  name: string;
  description: string;
  extensions: string[];
  is_read: boolean;
  is_written: boolean;
  writes_poses: boolean;
  takes_skeleton: boolean;
  read_options: OptionInfo[];
  write_options: OptionInfo[];
  /** Options of the conversion to it. */
  adapt_options: OptionInfo[];
}

export interface Tables {
  formats: FormatInfo[];
  operations: OperationInfo[];
  warp_options: OptionInfo[];
}

/** Words by the names of a table of options: true for a flag. */
export type OptionWords = Record<string, string | string[] | boolean>;

/** The words of a warp, by the names of the table of warp options. */
export type WarpWords = OptionWords;

/** A change of a document: an operation of the table, or a warp. */
export type Step = {operation: string} | {warp: WarpWords};

/** With what else a file is opened. */
export type OpeningWords = Pick<Description, 'skeleton' | 'servo_map' | 'project' | 'options'>;

export interface Failure {
  error: Diagnostic;
  diagnostics: Diagnostic[];
  /** Of `open`: how the file opens leniently; null or absent: it does not. */
  leniently?: OpeningWords | null;
}

export interface OpenAnswer {
  handle: number;
  document: Description;
  diagnostics: Diagnostic[];
}

export interface OpenedFile {
  path: string;
  what: 'document' | 'companion' | 'waiting' | 'fault' | 'unknown';
  format: string;
  handle: number;
  /** Whether it is of a format of robots alone. */
  is_model: boolean;
  diagnostics: Diagnostic[];
  /** How a file at fault opens leniently; null: it does not. */
  leniently: OpeningWords | null;
}

export interface OpenAllAnswer {
  opened: OpenedFile[];
  /** All that are open; described are those that are new or were read again. */
  documents: {handle: number; document: Description | null}[];
}

/** Poses of consecutive frames in the world, in the file's unit of length. */
export interface Poses {
  first: number;
  count: number;
  /** [frame][joint][3] */
  positions: Float32Array;
  /** [frame][joint][4], w x y z */
  rotations: Float32Array;
  /** [frame][tip][3], the tips of joint 0 first */
  tips: Float32Array;
}

export interface JointAnswer {
  position: Num[];
  rotation: Num[];
  channels: {name: string; value: Num}[];
  /** Of a robot's link, as its description has them, in their units. */
  dofs?: {value: Num; beyond: 'below' | 'above' | null}[];
}

/** What happens on the timeline. */
export interface Mark {
  kind: 'spike' | 'flip' | 'below' | 'above' | 'fast';
  severity: Diagnostic['severity'];
  joint: number;
  first_frame: number;
  num_frames: number;
  worst_frame: number;
  code: string;
  message: string;
}

/** A foot on the ground. */
export interface Contact {
  joint: number;
  tip: number | null;
  first_frame: number;
  num_frames: number;
}

export interface WrittenFile {
  name: string;
  bytes: Uint8Array;
}

/** What is asked of the core, and what it answers. */
export interface Questions {
  tables: {ask: object; answer: Tables};
  open: {
    ask: {
      path: string;
      skeleton?: string;
      servo_map?: string;
      project?: string;
      options?: Record<string, unknown>;
      /** The document that is opened again; absent: a new one. */
      handle?: number;
    };
    answer: OpenAnswer;
  };
  /** Opens all motions of a few, otherwise the first. */
  open_all: {ask: {paths: string[]; few?: number}; answer: OpenAllAnswer};
  close: {ask: {handle: number}; answer: object};
  edit: {
    ask: {handle: number; steps: Step[]};
    answer: {document: Description; diagnostics: Diagnostic[]};
  };
  poses: {ask: {handle: number; first: number; count: number}; answer: Poses};
  joint: {ask: {handle: number; joint: number; frame: number}; answer: JointAnswer};
  column: {ask: {handle: number; column: number}; answer: {values: Float64Array}};
  curves: {
    ask: {handle: number; joint: number};
    answer: {
      times: Float64Array;
      /** [frame][3], in the file's unit of length */
      positions: Float64Array;
      /** Units of length a second. */
      speeds: Float64Array;
      /** Degrees a second. */
      angular_speeds: Float64Array;
    };
  };
  marks: {ask: {handle: number}; answer: {marks: Mark[]}};
  contacts: {ask: {handle: number}; answer: {contacts: Contact[]; diagnostics: Diagnostic[]}};
  /** The ZMP of each frame in the world, [frame][3]; empty where the data holds none. */
  zmp: {ask: {handle: number}; answer: {points: Float64Array}};
  check: {ask: {handle: number}; answer: {diagnostics: Diagnostic[]}};
  write: {
    ask: {handle: number; name: string; format?: string; options?: OptionWords};
    answer: {files: WrittenFile[]; diagnostics: Diagnostic[]};
  };
  /** The formats that are written, and why this document cannot be written in some; else empty. */
  written_formats: {ask: {handle: number}; answer: {hindrances: Record<string, string>}};
  write_poses: {
    ask: {handle: number; name: string; tips?: boolean};
    answer: {files: WrittenFile[]};
  };
  source: {ask: {path: string}; answer: {files: WrittenFile[]}};
}
