// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "kinefile/retime_documents.hpp"

namespace kinefile::retime {
namespace {

/// Sets an option of a table by its name; false if it does not accept the word.
template <class Target>
bool set(std::span<const Option<Target>> table, Target& target, std::string_view name,
         std::string_view word) {
  const Option<Target>* option = find_option(table, name);
  if (option == nullptr) {
    ADD_FAILURE() << "there is no option " << name;
    return false;
  }
  return option->set(target, option->info, word);
}

/// Reads words of the command line into a struct of options.
template <class Target>
Target read_words(std::span<const Option<Target>> table, const std::vector<std::string>& words) {
  Target target;
  for (std::size_t w = 0; w < words.size(); ++w) {
    const std::string name = words[w].substr(2);
    const Option<Target>* option = find_option(table, name);
    const bool is_flag = option != nullptr && option->info.type == OptionType::Flag;
    EXPECT_TRUE(set(table, target, name, is_flag ? "" : words.at(w + 1))) << words[w];
    if (!is_flag) ++w;
  }
  return target;
}

void expect_keys(const DocumentWarp& warp, const std::vector<WarpKey>& keys) {
  ASSERT_EQ(warp.options.keys.size(), keys.size());
  for (std::size_t k = 0; k < keys.size(); ++k) {
    EXPECT_EQ(warp.options.keys[k].old_frame, keys[k].old_frame) << k;
    EXPECT_EQ(warp.options.keys[k].new_frame, keys[k].new_frame) << k;
  }
}

TEST(WarpOptions, KeysAddUp) {
  DocumentWarp warp;
  EXPECT_TRUE(set(warp_options(), warp, "key", "20:25,40:42.5"));
  EXPECT_TRUE(set(warp_options(), warp, "key", "50:1e2"));
  expect_keys(warp, {{20, 25}, {40, 42.5}, {50, 100}});
}

TEST(WarpOptions, AWordWithAFaultChangesNothing) {
  DocumentWarp warp;
  for (const char* word : {"", "20", "20:", ":25", "x:25", "20:25,x", "20:25,,30:40", "nan:1",
                           "1:inf", "20:25:30", "20;25"}) {
    EXPECT_FALSE(set(warp_options(), warp, "key", word)) << word;
  }
  EXPECT_FALSE(set(warp_options(), warp, "tail", "Keep"));
  EXPECT_FALSE(set(warp_options(), warp, "curve", ""));
  EXPECT_FALSE(set(warp_options(), warp, "ease", "bounce"));
  EXPECT_TRUE(words_of(warp).empty());
}

TEST(WarpOptions, ChoicesAreInTheOrderOfTheirEnums) {
  DocumentWarp warp;
  EXPECT_TRUE(set(warp_options(), warp, "tail", "extend"));
  EXPECT_EQ(warp.options.tail, Tail::Extend);
  EXPECT_TRUE(set(warp_options(), warp, "tail", "uniform"));
  EXPECT_EQ(warp.options.tail, Tail::Uniform);
  EXPECT_TRUE(set(warp_options(), warp, "tail", "keep"));
  EXPECT_EQ(warp.options.tail, Tail::Keep);
  const std::pair<const char*, WarpCurve> curves[] = {{"linear", WarpCurve::Linear},
                                                      {"pchip", WarpCurve::Pchip},
                                                      {"steffen", WarpCurve::Steffen},
                                                      {"hermite", WarpCurve::Hermite}};
  for (const auto& [word, curve] : curves) {
    EXPECT_TRUE(set(warp_options(), warp, "curve", word));
    EXPECT_EQ(warp.options.curve, curve) << word;
  }
  RetimeOptions options;
  const std::pair<const char*, RotationInterpolation> rotations[] = {
      {"slerp", RotationInterpolation::Slerp},
      {"nlerp", RotationInterpolation::Nlerp},
      {"cubic", RotationInterpolation::Cubic},
      {"euler", RotationInterpolation::Euler}};
  for (const auto& [word, rotation] : rotations) {
    EXPECT_TRUE(set(retime_options(), options, "rotation", word));
    EXPECT_EQ(options.rotation, rotation) << word;
  }
  AlignOptions align;
  EXPECT_TRUE(set(align_options(), align, "by", "points"));
  EXPECT_EQ(align.by, AlignOptions::By::Points);
  EXPECT_FALSE(set(align_options(), align, "by", "joints"));
}

TEST(WarpOptions, HaveADefaultThatIsTheStructs) {
  const auto expect_default = [](const auto& table, auto target) {
    const auto untouched = target;
    for (const auto& option : table) {
      if (option.info.type != OptionType::Choice) continue;
      EXPECT_EQ(option.info.default_word, option.info.choices[0]);
      EXPECT_TRUE(option.set(target, option.info, option.info.default_word));
    }
    EXPECT_EQ(words_of(target), words_of(untouched));
  };
  expect_default(warp_options(), DocumentWarp{});
  expect_default(retime_options(), RetimeOptions{});
  EXPECT_TRUE(words_of(DocumentWarp{}).empty());
  EXPECT_TRUE(words_of(RetimeOptions{}).empty());
}

TEST(WarpOptions, OnlyTheKeyIsRequiredAndCanRepeat) {
  for (const Option<DocumentWarp>& option : warp_options()) {
    EXPECT_EQ(option.info.is_required, option.info.name == "key") << option.info.name;
    EXPECT_EQ(option.info.can_repeat, option.info.name == "key") << option.info.name;
  }
}

TEST(WordsOfAWarp, AreThoseOfTheCommandLine) {
  DocumentWarp warp;
  warp.options.keys = {{150, 160}, {200.5, 220}};
  warp.options.tail = Tail::Extend;
  EXPECT_EQ(words_of(warp),
            (std::vector<std::string>{"--key", "150:160,200.5:220", "--tail", "extend"}));
  warp.options.tail = Tail::Keep;
  warp.options.ease = *parse_ease("in-out:3");
  warp.follows_contacts = true;
  EXPECT_EQ(words_of(warp), (std::vector<std::string>{"--key", "150:160,200.5:220", "--ease",
                                                      "in-out:3", "--contacts"}));
}

TEST(WordsOfAWarp, AreReadAsTheSameWarp) {
  DocumentWarp warp;
  warp.options.keys = {{0.1 + 0.2, 1e-7}, {1e22, 1.0 / 3}, {-0.0, 123456789.0}};
  warp.options.tail = Tail::Uniform;
  warp.options.curve = WarpCurve::Hermite;
  warp.options.ease = {Ease::Kind::Bezier, 2, 0.1 + 0.2, -1e-9, 1, 1.5};
  warp.options.allow_hold = true;
  warp.options.allow_reverse = true;
  warp.keys_in_seconds = true;
  warp.follows_contacts = true;
  const std::vector<std::string> words = words_of(warp);
  const DocumentWarp read = read_words(warp_options(), words);
  expect_keys(read, warp.options.keys);
  EXPECT_EQ(words_of(read), words);
  EXPECT_EQ(read.options.tail, Tail::Uniform);
  EXPECT_EQ(read.options.curve, WarpCurve::Hermite);
  EXPECT_EQ(read.options.ease.x1, 0.1 + 0.2);
  EXPECT_EQ(read.options.ease.y1, -1e-9);
  EXPECT_EQ(read.options.ease.y2, 1.5);
  EXPECT_TRUE(read.options.allow_hold && read.options.allow_reverse);
  EXPECT_TRUE(read.keys_in_seconds && read.follows_contacts);
}

TEST(WordsOfRetiming, AreReadAsTheSame) {
  const RetimeOptions options{RotationInterpolation::Cubic, true, true};
  const std::vector<std::string> words = words_of(options);
  EXPECT_EQ(words, (std::vector<std::string>{"--rotation", "cubic", "--antialias"}));
  const RetimeOptions read = read_words(retime_options(), words);
  EXPECT_EQ(read.rotation, RotationInterpolation::Cubic);
  EXPECT_TRUE(read.antialias);
  EXPECT_FALSE(read.lenient) << "it goes with the leniency of reading";
}

}  // namespace
}  // namespace kinefile::retime
