// SPDX-License-Identifier: MIT
// A program outside the project: prints the sizes of public structs, which must not depend on the
// compiler's flags, reads a BVH file and prints where its second joint is.

#include <cstdio>
#include <kinefile/kinefile.hpp>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  std::printf("Joint %zu Skeleton %zu Motion %zu Clip %zu Document %zu DegreeOfFreedom %zu\n",
              sizeof(kinefile::Joint), sizeof(kinefile::Skeleton), sizeof(kinefile::Motion),
              sizeof(kinefile::Clip), sizeof(kinefile::Document),
              sizeof(kinefile::DegreeOfFreedom));
  kinefile::Diagnostics diagnostics;
  const auto motion = kinefile::read_motion(argv[1], diagnostics);
  if (!motion) {
    std::fprintf(stderr, "%s\n", kinefile::to_string(motion.error()).c_str());
    return 1;
  }
  const auto poses = kinefile::forward_kinematics(motion->skeleton, motion->clip);
  std::printf("%s %.7f %.7f %.7f\n", motion->skeleton.joints[1].name.c_str(), poses.positions[3],
              poses.positions[4], poses.positions[5]);
}
