// SPDX-License-Identifier: MIT
#include "kinefile/io.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "kinefile/process.hpp"
#include "kinefile/retime_documents.hpp"
#include "support/support.hpp"
#include "walk.hpp"

namespace kinefile {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test, gone afterwards.
class Disk : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = fs::temp_directory_path() / "kinefile-test.XXXXXX";
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ / name; }
  void put(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
  }
  std::size_t num_files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

TEST_F(Disk, ReadsBytes) {
  put("a", "hello");
  EXPECT_EQ(FileBytes::open(path("a"))->view(), "hello");
  put("empty", "");
  EXPECT_EQ(FileBytes::open(path("empty"))->view(), "");
}

TEST_F(Disk, ReadsANamedPipeThatIsOpenedOnce) {
  const std::string pipe = path("a.bvh");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::string text = test::bvh_with_rows({"1 2 3 4 5 6 7 8 9"});
  // If the reader opened and closed the pipe before, these bytes could be lost.
  std::thread writer([&] { std::ofstream(pipe, std::ios::binary) << text; });
  Diagnostics diagnostics;
  const auto document = read_file(pipe, nullptr, {}, diagnostics);
  writer.join();
  ASSERT_TRUE(document);
  EXPECT_EQ(std::get<Motion>(document->content).clip.num_frames, 1u);
}

TEST_F(Disk, SaysWhyAFileCannotBeRead) {
  const auto missing = FileBytes::open(path("none"));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, "IO001");
  EXPECT_EQ(missing.error().kind, ErrorKind::Io);
  EXPECT_EQ(missing.error().message, "cannot read: No such file or directory");
}

TEST_F(Disk, AFileAppearsWholeOrNotAtAll) {
  {
    auto file = OutputFile::create(path("a"));
    ASSERT_TRUE(file);
    EXPECT_TRUE(file->write("half"));
    EXPECT_FALSE(fs::exists(path("a")));
  }
  EXPECT_EQ(num_files(), 0u) << "an uncommitted file leaves nothing behind";
  auto file = OutputFile::create(path("a"));
  ASSERT_TRUE(file->write("whole"));
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(test::bytes_of(path("a")), "whole");
}

TEST_F(Disk, AnExistingFileIsReplacedOnlyOnRequest) {
  put("a", "old");
  const auto refused = OutputFile::create(path("a"));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "IO002");
  auto file = OutputFile::create(path("a"), {.may_replace = true});
  ASSERT_TRUE(file->write("new"));
  EXPECT_EQ(test::bytes_of(path("a")), "old");
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(test::bytes_of(path("a")), "new");
}

TEST_F(Disk, AFileThatAppearsMeanwhileIsNotReplaced) {
  {
    auto file = OutputFile::create(path("a"));
    ASSERT_TRUE(file->write("ours"));
    put("a", "theirs");
    EXPECT_FALSE(file->commit());
  }
  EXPECT_EQ(test::bytes_of(path("a")), "theirs");
  EXPECT_EQ(num_files(), 1u);
}

TEST_F(Disk, ALinkStaysALink) {
  put("target", "old");
  fs::create_symlink(path("target"), path("link"));
  auto file = OutputFile::create(path("link"), {.may_replace = true});
  ASSERT_TRUE(file->write("new"));
  ASSERT_TRUE(file->commit());
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(test::bytes_of(path("target")), "new");
}

TEST_F(Disk, AReplacedFileKeepsItsRights) {
  put("a", "old");
  chmod(path("a").c_str(), 0640);
  auto file = OutputFile::create(path("a"), {.may_replace = true});
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(fs::status(path("a")).permissions(), fs::perms(0640));
}

TEST_F(Disk, SaysWhyAFileCannotBeWritten) {
  const auto file = OutputFile::create(path("none/a"));
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, "IO003");
}

TEST_F(Disk, AFullDiskIsAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  auto file = OutputFile::create("/dev/full");
  ASSERT_TRUE(file);
  EXPECT_FALSE(file->write(std::string(100'000, 'x')));
  EXPECT_FALSE(file->commit());
}

TEST_F(Disk, FindsTheFormatByContentThenByName) {
  const std::string bvh = test::bvh_with_rows({"0 0 0 0 0 0 0 0 0"});
  put("walk.txt", bvh);
  Diagnostics diagnostics;
  EXPECT_TRUE(read_file(path("walk.txt"), nullptr, {}, diagnostics));
  put("odd.BVH", "not a motion");
  EXPECT_FALSE(read_file(path("odd.BVH"), nullptr, {}, diagnostics));
  EXPECT_EQ(test::codes_of(diagnostics), std::vector<std::string>{"BVH001"});
  put("odd.xyz", "not a motion");
  Diagnostics none;
  const auto unknown = read_file(path("odd.xyz"), nullptr, {}, none);
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, "FMT001");
  const auto json = read_file(path("odd.xyz"), find_format("json"), {}, none);
  ASSERT_FALSE(json);
  EXPECT_TRUE(json.error().message.starts_with(
      "json is only written, not read; what is read: bvh, asf, amc"));
}

TEST_F(Disk, FilesOutsideOfAFolderAreFoundBelowTheRootAlone) {
  for (const char* name : {"top/arm", "top/hand", "other"}) fs::create_directories(folder_ / name);
  put("top/hand/Hand.body", "hand");
  put("top/arm/own.body", "own");
  put("other/tip.body", "tip");
  fs::create_directory_symlink(path("other"), path("top/link"));
  const std::string arm = path("top/arm/arm.body");
  const auto opens = [](const Resolver& files, const std::string& name) {
    return files.open(name).has_value();
  };
  const Resolver own = files_beside(arm);
  EXPECT_TRUE(opens(own, "own.body"));
  EXPECT_FALSE(opens(own, "../hand/Hand.body"));
  for (const char* root : {"top", "top/", "top/hand/..", "."}) {
    const Resolver files = files_beside(arm, path(root));
    EXPECT_TRUE(opens(files, "own.body")) << root;
    EXPECT_TRUE(opens(files, "../hand/Hand.body")) << root;
    EXPECT_TRUE(opens(files, "../hand/hand.BODY")) << root;
    EXPECT_TRUE(opens(files, path("top/hand/Hand.body"))) << root;
    EXPECT_FALSE(opens(files, "../hand/none.body")) << root;
    EXPECT_FALSE(opens(files, std::string("../hand/Hand.body\0", 18))) << root;
    EXPECT_FALSE(opens(files, "")) << root;
    EXPECT_FALSE(opens(files, "../hand")) << root;
  }
  const Resolver top = files_beside(arm, path("top"));
  for (const std::string& name : {std::string("../../other/tip.body"), path("other/tip.body"),
                                  std::string("../link/tip.body")}) {
    EXPECT_FALSE(opens(top, name)) << name;
    EXPECT_TRUE(opens(files_beside(arm, folder_), name)) << name;
  }
  EXPECT_FALSE(opens(files_beside(arm, path("top/han")), "../hand/Hand.body"));
}

TEST_F(Disk, LinksOutOfTheFolderAreNotOpenedAndTold) {
  for (const char* name : {"models", "other", "models/own"}) fs::create_directories(folder_ / name);
  put("other/secret.txt", "secret");
  put("models/own/inner.body", "inner");
  fs::create_symlink(path("other/secret.txt"), path("models/link.body"));
  fs::create_symlink("own/inner.body", path("models/inside.body"));
  Diagnostics refusals;
  const Resolver files = files_beside(path("models/arm.body"), {}, &refusals);
  EXPECT_FALSE(files.open("link.body"));
  EXPECT_FALSE(files.open("LINK.body"));
  EXPECT_TRUE(files.open("inside.body"));
  EXPECT_FALSE(files.open("none.body"));
  EXPECT_EQ(test::text_of(refusals),
            path("models/link.body") +
                ": warning[IO005]: not opened: this link leads out of the folder; --skeleton names "
                "a skeleton, --model-root a folder that a model's parts may lie in\n");
  EXPECT_TRUE(files_beside(path("models/arm.body"), folder_).open("link.body"));
}

TEST_F(Disk, FilesThatAreOpenedAreRecorded) {
  fs::create_directories(folder_ / "parts");
  const std::string arm =
      "format: ChoreonoidBody\nformat_version: 2.0\nlinks:\n  - { name: A }\n  - { "
      "type: SubBody, uri: parts/hand.body, parent: A, prefix: L_ }\n";
  const std::string hand = "format: ChoreonoidBody\nformat_version: 2.0\nlinks: [ { name: H } ]\n";
  put("arm.body", arm);
  put("parts/hand.body", hand);
  put("unused.body", hand);
  ReadOptions options;
  options.opened = std::make_shared<std::vector<CompanionFile>>();
  Diagnostics diagnostics;
  EXPECT_TRUE(read_file(path("arm.body"), nullptr, options, diagnostics));
  ASSERT_EQ(options.opened->size(), 2u) << test::text_of(diagnostics);
  EXPECT_EQ(options.opened->at(0).name, path("arm.body"));
  EXPECT_EQ(options.opened->at(0).bytes, arm);
  EXPECT_EQ(options.opened->at(1).name, path("parts/hand.body"));
  EXPECT_EQ(options.opened->at(1).bytes, hand);
}

TEST_F(Disk, TheSkeletonThatIsNamedIsRecordedAfterTheMotion) {
  put("figure.asf", test::fixture("acclaim/invalid/arm.asf"));
  put("move.amc", ":FULLY-SPECIFIED\n:DEGREES\n1\n");
  ReadOptions options;
  options.skeleton_name = path("figure.asf");
  options.opened = std::make_shared<std::vector<CompanionFile>>();
  Diagnostics diagnostics;
  EXPECT_FALSE(read_file(path("move.amc"), nullptr, options, diagnostics));
  ASSERT_EQ(options.opened->size(), 2u) << test::text_of(diagnostics);
  EXPECT_EQ(options.opened->at(0).name, path("move.amc"));
  EXPECT_EQ(options.opened->at(1).name, path("figure.asf"));
}

TEST_F(Disk, ALargeFileIsProcessedBlockByBlockAsWhole) {
  const Document walk{examples::make_walk({.num_frames = 3000}), "bvh", {}};
  put("a.bvh", test::write_to_string(walk, "bvh"));
  Job job;
  job.source = path("a.bvh");
  job.reading.holds_opened = false;
  job.change_in_blocks = [](LongMotion motion, Diagnostics& diagnostics) {
    return retime::resample(std::move(motion), 50, {}, diagnostics);
  };
  std::size_t num_whole = 0;
  job.change = [&num_whole](Document& document, Diagnostics& diagnostics) {
    ++num_whole;
    return retime::resample(document, 50, {}, diagnostics);
  };
  const auto made = [&job] {
    auto files = std::make_shared<std::vector<MemoryFile>>();
    job.reading.opened = std::make_shared<std::vector<CompanionFile>>();
    const Report report = process(job, files_in_memory(files));
    EXPECT_FALSE(report.error);
    std::string all =
        fmt::format("{} {}\n{}", report.kind, report.num_frames, test::text_of(report.diagnostics));
    for (const MemoryFile& file : *files) all += file.name + "\n" + file.bytes;
    return all;
  };
  for (const char* target : {"b.amc", "b.bvh", "b.csv", "b.seq"}) {
    job.target = target;
    job.most_bytes_in_memory.reset();
    const std::string whole = made();
    job.most_bytes_in_memory = 0;
    num_whole = 0;
    EXPECT_TRUE(made() == whole) << target;
    EXPECT_EQ(num_whole, std::string_view(target) == "b.seq" ? 1u : 0u);
    ASSERT_EQ(job.reading.opened->size(), 1u) << target;
    const CompanionFile& opened = job.reading.opened->front();
    EXPECT_EQ(opened.name, job.source);
    ASSERT_TRUE(opened.pieces);
    std::string head(9, ' ');
    EXPECT_TRUE(opened.pieces->read(0, head));
    EXPECT_EQ(head, "HIERARCHY");
  }
  put("a.bvh", "shorter");
  std::string head(7, ' ');
  EXPECT_FALSE(job.reading.opened->front().pieces->read(0, head));
}

TEST_F(Disk, TheModelRootIsAFolder) {
  put("a.body", "format: ChoreonoidBody\nformat_version: 2.0\nlinks: [ { name: A } ]\n");
  Diagnostics diagnostics;
  ReadOptions options;
  for (const std::string& root : {path("a.body"), path("none")}) {
    options.model_root = root;
    const auto read = read_file(path("a.body"), nullptr, options, diagnostics);
    ASSERT_FALSE(read) << root;
    EXPECT_EQ(read.error().code, "IO004");
    EXPECT_EQ(read.error().kind, ErrorKind::Usage);
  }
  options.model_root = folder_;
  EXPECT_TRUE(read_file(path("a.body"), nullptr, options, diagnostics));
}

TEST_F(Disk, RefusedDocumentsLeaveNoFile) {
  Document document;
  document.content = Skeleton{};
  Diagnostics diagnostics;
  EXPECT_FALSE(write_file(path("a.csv"), document, *find_format("csv"), {}, {}, diagnostics));
  EXPECT_EQ(num_files(), 0u);
}

}  // namespace
}  // namespace kinefile
