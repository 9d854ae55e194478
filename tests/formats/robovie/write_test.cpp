// SPDX-License-Identifier: MIT
// Encodings, layouts and what cannot be written.

#include "formats/robovie/robovie.hpp"
#include "kinefile/flow.hpp"
#include "kinefile/robovie.hpp"

namespace kinefile::test {
namespace {

std::string valid(const std::string& name) { return fixture("robovie/valid/" + name); }

Document robovie_document(std::string_view bytes, const ReadOptions& options = {}) {
  const ReadText read = read_robovie(bytes, options);
  EXPECT_TRUE(read.document) << text_of(read.diagnostics);
  return read.document.value_or(Document{});
}

std::string crlf(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return out;
}

/// The first error of writing, or nothing.
std::string write_fault(const Document& document, const WriteOptions& options = {}) {
  Diagnostics diagnostics;
  const auto written = find_format("robovie")->write(
      document, options, [](std::string_view) { return true; }, diagnostics);
  return written ? "" : to_string(written.error());
}

PoseFlow small_flow() {
  PoseFlow flow;
  flow.num_sliders = 2;
  flow.blocks.resize(3);
  flow.blocks[0].body = StartBlock{};
  flow.blocks[0].normal = 1;
  PoseBlock pose;
  pose.words = {{256, true}, {-1, false}};
  flow.blocks[1] = {.name = "A", .normal = 2, .body = pose};
  flow.blocks[2].body = EndBlock{};
  return flow;
}

TEST(RobovieWrite, FilesOfEveryEncodingComeBackByteForByte) {
  for (const std::string name : {"drum.txt", "all_blocks.txt"}) {
    const Document document = robovie_document(valid(name));
    for (const std::string encoding : {"utf-16le", "utf-8", "cp932", "utf-16be"}) {
      const std::string bytes =
          write_to_string(document, "robovie", {.of_formats = robovie::WriteOptions{encoding}});
      const Document again = robovie_document(bytes);
      EXPECT_EQ(std::get<PoseFlow>(again.content), std::get<PoseFlow>(document.content));
      EXPECT_EQ(fact_of(again, "encoding").substr(0, encoding.size()), encoding);
      EXPECT_EQ(write_to_string(again, "robovie"), bytes) << name << " " << encoding;
    }
    EXPECT_EQ(write_to_string(document, "robovie"), valid(name));
    EXPECT_EQ(write_to_string(robovie_document(crlf(valid(name))), "robovie"), crlf(valid(name)));
  }
}

TEST(RobovieWrite, UtfWithAMarkKeepsIt) {
  const std::string text = "\xEF\xBB\xBF" + valid("drum.txt");
  EXPECT_EQ(write_to_string(robovie_document(text), "robovie"), text);
}

TEST(RobovieWrite, TrailBytesThatAreBracketsInCp932AreNoBrackets) {
  // ゼ ソ ゾ ー: their second bytes are [ \ ] and [.
  const std::string text =
      "_MOTION_FORMAT:[ POSEDEF_WORD_N ]\n_ENABLE_AXIS:[1]\n"
      "_POSE:[1]-[0x0000]-[-1]-[-1]-[[\x83\x5B\x83\x5C\x83\x5D\x81\x5B.wav]]\n";
  const Document document = robovie_document(text);
  const PoseFlow& flow = std::get<PoseFlow>(document.content);
  EXPECT_EQ(std::get<PoseBlock>(flow.blocks.at(0).body).sound, "ゼソゾー.wav");
  EXPECT_EQ(write_to_string(document, "robovie"), text);
}

TEST(RobovieWrite, OldFilesOfTheEditorAreReadWithoutAWord) {
  const std::string ascii =
      "_MOTION_FORMAT:[ POSEDEF_WORD_N ]\r\n_ENABLE_AXIS:[1]\r\n"
      "_POSE:[1]-[0x0000]-[-1]-[-1]-[[]]\r\n";
  EXPECT_EQ(text_of(read_robovie(ascii).diagnostics), "");
  const std::string cp932 = replaced(ascii, "[[]]", "[[\x83\x5C.wav]]");
  EXPECT_EQ(text_of(read_robovie(cp932).diagnostics), "");
  const std::string lf = replaced(replaced(ascii, "\r\n", "\n"), "]]\r\n", "]]\n");
  EXPECT_EQ(codes_of(read_robovie(lf).diagnostics), std::vector<std::string>{"RBV048"});
}

TEST(RobovieWrite, AFlowWithoutAFileIsWrittenAsTheEditorDoes) {
  Document document;
  document.content = small_flow();
  const std::string mask(30, '0');
  EXPECT_EQ(write_to_string(document, "robovie"),
            as_editor("_MOTION_FORMAT:[ POSEDEF_V1R4 ]\n_ENABLE_AXIS:[2]\n\n"
                      "_MOTION_INFO:[[]]-[0]-[0]-[6]-[6]-[1]-[-1]\n_STARTMOT:\n\n"
                      "_MOTION_INFO:[[A]]-[0]-[0]-[6]-[6]-[2]-[-1]\n"
                      "_POSE:[1]-[0x0100,0Xffff]-[[]]-[" +
                      mask +
                      "]\n\n"
                      "_MOTION_INFO:[[]]-[0]-[0]-[6]-[6]-[-1]-[-1]\n_ENDMOT:\n"));
  PoseFlow& flow = std::get<PoseFlow>(document.content);
  flow.format = FlowFormat::WordN;
  flow.blocks = {flow.blocks[1]};
  flow.blocks[0].normal = kNoBlock;
  EXPECT_EQ(write_to_string(document, "robovie"),
            as_editor("_MOTION_FORMAT:[ POSEDEF_WORD_N ]\n_ENABLE_AXIS:[2]\n"
                      "_POSE:[1]-[0x0100,0Xffff]-[-1]-[-1]-[[]]\n"));
}

TEST(RobovieWrite, TheLastLineMayLackItsEnd) {
  std::string text = valid("all_blocks.txt");
  text.pop_back();
  EXPECT_EQ(write_to_string(robovie_document(text), "robovie"), text);
}

TEST(RobovieWrite, NamesWithBracketsComeBack) {
  for (const std::string name :
       {"[", "]", "]]", "a]]", "[[a]]", "]-[", "]] -[", "  ", "[[[", "x]-"}) {
    Document document;
    PoseFlow flow = small_flow();
    flow.blocks[1].name = name;
    std::get<PoseBlock>(flow.blocks[1].body).sound = name;
    document.content = flow;
    const Document again = robovie_document(write_to_string(document, "robovie"));
    EXPECT_EQ(std::get<PoseFlow>(again.content), flow) << name;
  }
}

TEST(RobovieWrite, WhatCannotBeWrittenIsRefused) {
  Document document;
  document.content = small_flow();
  PoseFlow& flow = std::get<PoseFlow>(document.content);
  PoseBlock& pose = std::get<PoseBlock>(flow.blocks[1].body);

  flow.blocks[1].name = "é";
  EXPECT_EQ(
      write_fault(document, {.of_formats = robovie::WriteOptions{"cp932"}}),
      "error[RBV052]: the texts of block 1 have the character 'é', which cp932 does not have");
  for (const std::string name : {"a]]-[b", "a\nb"}) {
    flow.blocks[1].name = name;
    EXPECT_EQ(write_fault(document),
              "error[RBV053]: the flow cannot be written: block 1: its name holds ']]-[' or the "
              "end of a line");
  }
  flow.blocks[1].name = "";
  pose.ticks = 240;
  EXPECT_EQ(write_fault(document),
            "error[RBV053]: the flow cannot be written: block 1: its time is 240 ticks, not 1 to "
            "239");
  pose.ticks = 1;
  pose.words.pop_back();
  EXPECT_EQ(write_fault(document),
            "error[RBV053]: the flow cannot be written: block 1: it has 1 words, not 2");
  pose.words.emplace_back();
  flow.format = FlowFormat::WordN;
  EXPECT_EQ(write_fault(document),
            "error[RBV053]: the flow cannot be written: block 0: POSEDEF_WORD_N has poses alone");
  flow.format = FlowFormat::V1R4;
  flow.num_sliders = 63;
  EXPECT_EQ(write_fault(document),
            "error[RBV053]: the flow cannot be written: it has 63 sliders, not 1 to 62");
  document.content = Motion{};
  EXPECT_EQ(write_fault(document), "error[RBV053]: expected a flow of servo poses to write");
}

TEST(RobovieWrite, AFlowThatBecomesV1R4HasItsEncoding) {
  // ソ is 83 5C in CP932. The older editor's file has no byte order mark.
  const std::string word_n =
      "_MOTION_FORMAT:[ POSEDEF_WORD_N ]\r\n_ENABLE_AXIS:[2]\r\n"
      "_POSE:[10]-[0x0001,0X0000]-[-1]-[-1]-[[\x83\x5C.wav]]\r\n";
  for (const std::string& bytes : {word_n, replaced(word_n, "\x83\x5C", "ソ"),
                                   replaced(word_n, "-[[\x83\x5C.wav]]\r\n", "-[[]]\r\n")}) {
    Document document = robovie_document(bytes);
    EXPECT_EQ(write_to_string(document, "robovie"), bytes) << "as it is, nothing changes";
    Diagnostics diagnostics;
    document.content =
        flow::in_format(std::get<PoseFlow>(document.content), FlowFormat::V1R4, diagnostics)
            .value();
    const std::string written = write_to_string(document, "robovie");
    EXPECT_TRUE(written.starts_with("\xFF\xFE_\0M")) << bytes;
    const ReadText again = read_robovie(written);
    EXPECT_EQ(text_of(again.diagnostics), "") << "just as the editor writes";
    EXPECT_EQ(flow_of(again), std::get<PoseFlow>(document.content));
    // Who asks for an encoding gets it.
    const std::string asked =
        write_to_string(document, "robovie", {.of_formats = robovie::WriteOptions{"cp932"}});
    EXPECT_TRUE(asked.starts_with("_MOTION_FORMAT:[ POSEDEF_V1R4 ]\r\n"));
  }
}

TEST(RobovieWrite, MissingWordsAreWrittenAsDisabled) {
  const Document document = robovie_document(fixture("robovie/invalid/thirty_words.motion"));
  const PoseFlow& flow = std::get<PoseFlow>(document.content);
  const PoseBlock& pose = std::get<PoseBlock>(flow.blocks.at(1).body);
  ASSERT_EQ(pose.words.size(), 62u);
  EXPECT_EQ(pose.words[29], (SliderWord{0, true}));
  EXPECT_EQ(pose.words[30], (SliderWord{0, false}));
  const ReadText again = read_robovie(write_to_string(document, "robovie"));
  EXPECT_EQ(codes_of(again.diagnostics), std::vector<std::string>{"RBV048"});
}

TEST(RobovieProbe, TheContentShowsTheFormatInEveryEncoding) {
  const Document document = robovie_document(valid("all_blocks.txt"));
  for (const std::string encoding : {"utf-16le", "utf-8", "cp932", "utf-16be"}) {
    const std::string bytes =
        write_to_string(document, "robovie", {.of_formats = robovie::WriteOptions{encoding}});
    const Format* format = detect_format(bytes, "no.extension");
    ASSERT_NE(format, nullptr) << encoding;
    EXPECT_EQ(format->name, "robovie");
  }
  const std::string without_mark =
      write_to_string(document, "robovie", {.of_formats = robovie::WriteOptions{"utf-16le"}})
          .substr(2);
  EXPECT_NE(detect_format(without_mark, "no.extension"), nullptr);
  EXPECT_EQ(detect_format("a text\n", "no.extension"), nullptr);
}

}  // namespace
}  // namespace kinefile::test
