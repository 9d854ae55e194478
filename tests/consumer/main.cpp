// SPDX-License-Identifier: MIT
// A program outside the project: prints the sizes of public structs, reads a BVH file and prints where
// its second joint is. The library and the program may be compiled with different flags.

#include <cstdio>
#include <kinefile/kinefile.hpp>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  using namespace kinefile;
  std::printf("Joint %zu Skeleton %zu Motion %zu Clip %zu Document %zu DegreeOfFreedom %zu\n",
              sizeof(Joint), sizeof(Skeleton), sizeof(Motion), sizeof(Clip), sizeof(Document),
              sizeof(DegreeOfFreedom));
  Diagnostics diagnostics;
  const auto document = read_file(argv[1], nullptr, {}, diagnostics);
  if (!document) {
    std::fprintf(stderr, "%s\n", to_string(document.error()).c_str());
    return 1;
  }
  const auto& motion = std::get<Motion>(document->content);
  const auto poses = forward_kinematics(motion.skeleton, motion.clip);
  std::printf("%s %.7f %.7f %.7f\n", motion.skeleton.joints[1].name.c_str(), poses.positions[3],
              poses.positions[4], poses.positions[5]);
}
