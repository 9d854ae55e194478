# SPDX-License-Identifier: MIT
"""Inputs of any size: for each parser, what a file can have many of."""

def bvh_skeleton(num_joints):
    channels = "CHANNELS 3 Zrotation Xrotation Yrotation\n"
    lines = ["HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\n"
             "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"]
    for i in range(num_joints):
        lines.append(f"JOINT j{i}\n{{\nOFFSET {1 + i % 3} 0 0\n{channels}"
                     "End Site\n{\nOFFSET 0 1 0\n}\n}\n")
    return "".join(lines) + "}\n"


def bvh(num_joints=3, num_frames=3):
    rows = []
    for frame in range(num_frames):
        row = [frame % 7, 90.5, frame % 11, 1, frame % 13, 3]
        row += [(frame + k) % 90 for k in range(3 * num_joints)]
        rows.append(" ".join(map(str, row)) + "\n")
    motion = f"MOTION\nFrames: {num_frames}\nFrame Time: 0.01\n" + "".join(rows)
    return bvh_skeleton(num_joints) + motion


def asf(num_bones=3):
    head = (":version 1.10\n:name a\n:units\nmass 1\nlength 1\nangle deg\n:documentation\nx\n:root\n"
            "order TX TY TZ RX RY RZ\naxis XYZ\nposition 0 0 0\norientation 0 0 0\n:bonedata\n")
    bones = "".join(f"begin\nid {i + 1}\nname b{i}\ndirection 1 0 0\nlength {1 + i % 3}\naxis 0 0 0 XYZ\n"
                    f"dof rx ry rz\nlimits (-180 180)\n(-180 180)\n(-180 180)\nend\n"
                    for i in range(num_bones))
    links = "root " + " ".join(f"b{i}" for i in range(num_bones))
    return f"{head}{bones}:hierarchy\nbegin\n{links}\nend\n"


def amc(num_bones=3, num_frames=3):
    frames = []
    for frame in range(num_frames):
        bones = "".join(f"b{i} {frame % 9} {i % 7} 1\n" for i in range(num_bones))
        frames.append(f"{frame + 1}\nroot 0 {frame % 5} 0 0 0 0\n{bones}")
    return ":FULLY-SPECIFIED\n:DEGREES\n" + "".join(frames)


def seq(num_joints=3, num_frames=3):
    frames = "".join("      - [ " + ", ".join(str((k + frame) % 3) for k in range(num_joints)) + " ]\n"
                     for frame in range(num_frames))
    return ("type: CompositeSeq\ncontent: BodyMotion\nformatVersion: 2\nframeRate: 100\n"
            f"numFrames: {num_frames}\ncomponents:\n  -\n    type: MultiValueSeq\n"
            f"    content: JointDisplacement\n    frameRate: 100\n    numFrames: {num_frames}\n"
            f"    numParts: {num_joints}\n    frames:\n{frames}")


def seq_of_components(count):
    parts = "".join(f" - type: MultiValueSeq\n   content: J{i}\n   numParts: 1\n   frameRate: 100\n"
                    "   numFrames: 1\n   frames:\n    - [ 0 ]\n" for i in range(count))
    return f"type: CompositeSeq\nformatVersion: 2\ncomponents:\n{parts}"


def seq_of_lists(count):
    """A key that nobody reads holds lists of lists."""
    return seq() + "extra:\n" + "  - [ [ 0, [ 1 ] ], [ ], { a: [ 2 ] } ]\n" * count


def csv_of_points(count):
    names = ",".join(f"l{i}.x,l{i}.y,l{i}.z" for i in range(count))
    rows = "".join(f"{0.01 * frame:.2f}" + ",1,2,3" * count + "\n" for frame in range(3))
    return f"time,{names}\n{rows}"


def csv_of_links(count):
    channels = ("x", "y", "z", "qw", "qx", "qy", "qz")
    names = ",".join(f"l{i}.{channel}" for i in range(count) for channel in channels)
    rows = "".join(f"{0.01 * frame:.2f}" + ",1,2,3,1,0,0,0" * count + "\n" for frame in range(3))
    return f"time,{names}\n{rows}"


def csv_of_joints(count, num_rows=3):
    rows = "".join(f"{0.01 * frame:.2f}" + ",0.1" * count + "\n" for frame in range(num_rows))
    return "time," + ",".join(f"j{i}" for i in range(count)) + f"\n{rows}"


def hrpsys(num_joints=3, num_frames=3):
    return "".join(f"{0.005 * frame:.3f}" + " 0.5" * num_joints + "\n" for frame in range(num_frames))


def body(count):
    links = "".join(f"  - {{ name: L{i}, parent: ROOT, joint_type: revolute, joint_id: {i}, "
                    f"joint_axis: Y, translation: [ 0, 0, 1 ] }}\n" for i in range(count))
    return ("format: ChoreonoidBody\nformat_version: 2.0\nname: r\nroot_link: ROOT\nlinks:\n"
            f"  - {{ name: ROOT, joint_type: free }}\n{links}")


def body_of_missing_parts(count):
    parts = "".join(f"  - {{ type: SubBody, uri: zz{i}.body, prefix: s{i}_, parent: ROOT }}\n"
                    for i in range(count))
    return ("format: ChoreonoidBody\nformat_version: 2.0\nname: r\nroot_link: ROOT\nlinks:\n"
            f"  - {{ name: ROOT, joint_type: free }}\n{parts}")


def urdf(count):
    links = "".join(f'<link name="l{i}"/>' for i in range(count + 1))
    joints = "".join(f'<joint name="j{i}" type="revolute"><parent link="l0"/><child link="l{i + 1}"/>'
                     f'<axis xyz="0 0 1"/><limit lower="-1" upper="1"/></joint>' for i in range(count))
    return f'<robot name="r">{links}{joints}</robot>'


def urdf_of_mimics(count):
    """Each joint follows the one before it."""
    links = "".join(f'<link name="l{i}"/>' for i in range(count + 1))
    joints = "".join(
        f'<joint name="j{i}" type="revolute"><parent link="l0"/><child link="l{i + 1}"/>'
        f'<axis xyz="0 0 1"/><limit lower="-1" upper="1"/>'
        + (f'<mimic joint="j{i - 1}"/>' if i > 0 else "") + "</joint>" for i in range(count))
    return f'<robot name="r">{links}{joints}</robot>'


def urdf_of_attributes(count):
    attributes = " ".join(f'a{i}="1"' for i in range(count))
    return f'<robot name="r"><link name="l0" {attributes}/></robot>'


def wrl(count):
    joints = "".join(f"DEF J{i} Joint {{ jointType \"rotate\" jointId {i} jointAxis \"Y\" "
                     f"children [ DEF S{i} Segment {{ mass 1 }} ] }}\n" for i in range(count))
    return ("#VRML V2.0 utf8\nPROTO Joint [ exposedField SFString jointType \"\" field SFInt32 jointId -1 "
            "field SFString jointAxis \"X\" exposedField MFNode children [] ] { Transform { } }\n"
            "PROTO Segment [ field SFFloat mass 0 ] { Transform { } }\n"
            "PROTO Humanoid [ exposedField MFNode humanoidBody [] exposedField MFNode joints [] ] "
            "{ Transform { } }\n"
            f"DEF r Humanoid {{ humanoidBody [ DEF W Joint {{ jointType \"free\" children [ {joints} ] }} ] }}\n")


def robovie(num_blocks):
    words = ",".join(["0x0000"] * 62)
    blocks = "".join(
        f"_MOTION_INFO:[[B{i}]]-[50]-[{10 + i}]-[6]-[6]-[{i + 2}]-[-1]\n"
        f"_POSE:[40]-[{words}]-[[]]-[{'0' * 30}]\n\n" for i in range(num_blocks))
    return ("_MOTION_FORMAT:[ POSEDEF_V1R4 ]\n_ENABLE_AXIS:[62]\n\n"
            f"_MOTION_INFO:[[]]-[50]-[10]-[6]-[0]-[1]-[-1]\n_STARTMOT:\n\n{blocks}"
            "_MOTION_INFO:[[END]]-[50]-[316]-[16]-[46]-[-1]-[-1]\n_ENDMOT:\n")


def servo_map(count):
    """Of the joints of `seq`; sliders beyond the flow's 62 are refused one by one."""
    servos = "".join(f"  - {{slider: {i}, joint: j{i}, sign: 1, units_per_degree: 100}}\n" for i in range(count))
    return f"sliders: 62\ntick: 16667\nservos:\n{servos}"


def joint_map(count):
    return "".join(f"L{i}: j{i}\n" for i in range(count))


def project():
    return "MODELNAME:[[a]]\nROMINI:[[rom.ini]]\nMAPINI:[[map.ini]]\nDEFPOSINI:[[pos.ini]]\nSLDINI:[[sld.ini]]\n"


def project_sliders(count):
    return "_CENTER_BAR:[0.5]-[0]\n" + "".join(
        f"_NUMBER:[{i}]\n_AXISNAME:[[arm{i}]]\n_PAIR:[0]-[0]\n_PUTSTYLE:[2]-[2]-[100.0]\n"
        "_DIVISION:[-1000]-[1000]-[10]\n_FLAG:[0]-[4]\n\n" for i in range(count))


def project_motors(count):
    return "MASTER_CLOCK:[16667]\n" + "".join(
        f"MOTORNAME:[[m{i}]]\nMOTOR_VARINDEX:[{i}]-[31]-[132]\nMOTOR_LIMIT:[-500]-[600]\n\n" for i in range(count))


def project_poses(count):
    return "MAINDEFPOS_NUM:[0]\n" + "".join(
        f"DEFPOS:[[p{i}]]\nAXISENABLE:[0]\nDEFPOS_VALUE:[0x0000]\n" for i in range(count))


def project_sounds(count):
    return "".join(f"VOICE:[{i}]-[[drum{i}.wav]]\n" for i in range(count))
