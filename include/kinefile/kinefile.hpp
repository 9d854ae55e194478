// SPDX-License-Identifier: MIT
#pragma once

/// The whole public interface of kinefile.

#include "kinefile/anomalies.hpp"
#include "kinefile/body_bridge.hpp"
#include "kinefile/body_motion.hpp"
#include "kinefile/bridge.hpp"
#include "kinefile/channels.hpp"
#include "kinefile/clip.hpp"
#include "kinefile/compare.hpp"
#include "kinefile/convert.hpp"
#include "kinefile/diagnostics.hpp"
#include "kinefile/document.hpp"
#include "kinefile/edit.hpp"
#include "kinefile/format.hpp"
#include "kinefile/io.hpp"
#include "kinefile/joint_rotation.hpp"
#include "kinefile/kinematics.hpp"
#include "kinefile/math.hpp"
#include "kinefile/motion.hpp"
#include "kinefile/pose_table.hpp"
#include "kinefile/result.hpp"
#include "kinefile/retime.hpp"
#include "kinefile/skeleton.hpp"
#include "kinefile/timeline.hpp"
#include "kinefile/version.hpp"
#include "kinefile/world_poses.hpp"
