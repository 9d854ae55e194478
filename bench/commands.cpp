// SPDX-License-Identifier: MIT
#include "commands.hpp"

#include <fast_float/fast_float.h>

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "baselines.hpp"
#include "kinefile/fk.hpp"
#include "kinefile/npz.hpp"
#include "kinefile/threads.hpp"
#include "report.hpp"
#include "subject.hpp"

namespace kinefile::bench {
namespace {

using Stream = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

Stream opened(const std::string& path, const char* mode) {
  Stream stream(std::fopen(path.c_str(), mode), std::fclose);
  if (stream == nullptr) std::exit(1);
  return stream;
}

std::string path_of_output() { return subject().folder + "/positions"; }

/// The positions of all joints as an archive, without the sync that the command makes.
template <npz::Precision kPrecision, std::size_t kThreads = 1>
void positions_kinefile(benchmark::State& state) {
  set_max_threads(kThreads);
  WriteOptions options;
  options.of_formats.edit<npz::WriteOptions>().precision = kPrecision;
  for (auto _ : state) {
    Document document = read_or_exit(subject().path);
    const auto table =
        fk(kinefile::Placed{std::get<Motion>(std::move(document.content))}, FkOptions());
    const Stream out = opened(path_of_output(), "wb");
    const Sink sink = [&out](std::string_view piece) {
      return std::fwrite(piece.data(), 1, piece.size(), out.get()) == piece.size();
    };
    if (!write_table(*table, *find_format("npz"), options, sink))
      state.SkipWithError("not written");
  }
  set_max_threads(1);
}

std::string text_of_file(const std::string& path) {
  const Stream in = opened(path, "rb");
  std::fseek(in.get(), 0, SEEK_END);
  std::string text(static_cast<std::size_t>(std::ftell(in.get())), '\0');
  std::fseek(in.get(), 0, SEEK_SET);
  if (std::fread(text.data(), 1, text.size(), in.get()) != text.size()) std::exit(1);
  return text;
}

/// The numbers of a text, one by one.
Array<double> numbers_of(std::string_view text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    while (at != end && static_cast<unsigned char>(*at) <= ' ') ++at;
    if (at == end) return Array<double>(numbers);
    at = fast_float::from_chars(at, end, numbers.emplace_back()).ptr;
  }
}

/// The same from plain parts; the skeleton is there before, and what is written has no header.
template <class T>
void positions_of_parts(benchmark::State& state) {
  Motion motion = subject().motion;
  Placed<T> placed;
  for (auto _ : state) {
    const std::string text = text_of_file(subject().path);
    motion.clip.values = numbers_of(numbers_of_bvh(text));
    place_with_eigen(motion, false, placed);
    const Stream out = opened(path_of_output(), "wb");
    std::fwrite(placed.positions.data(), sizeof(T), placed.positions.size(), out.get());
  }
}

}  // namespace

void add_commands() {
  measure("positions_file/kinefile", positions_kinefile<npz::Precision::Double>);
  measure("positions_file/kinefile_float", positions_kinefile<npz::Precision::Single>);
  measure("positions_file/parts", positions_of_parts<double>);
  measure("positions_file/parts_float", positions_of_parts<float>);
  measure("positions_file/one_thread", positions_kinefile<npz::Precision::Double>, Time::Clock);
  measure("positions_file/two_threads", positions_kinefile<npz::Precision::Double, 2>, Time::Clock);
  compare("BVH to positions NPZ, against fread, fast_float, Eigen", "positions_file/kinefile",
          "positions_file/parts");
  compare("the same in single precision", "positions_file/kinefile_float",
          "positions_file/parts_float");
  compare("the same on two threads, against one", "positions_file/two_threads",
          "positions_file/one_thread");
}

}  // namespace kinefile::bench
