// SPDX-License-Identifier: MIT
#include "page.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>

#include "base64.hpp"

namespace kinefile::cli {
namespace {

constexpr std::string_view kPage =
    R"(<html><script id="motion" type="text/plain"></script><script>1</script></html>)";

std::string gunzip(std::string_view bytes) {
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, 16 + MAX_WBITS), Z_OK);
  std::string input(bytes);
  std::string output(std::size_t{1} << 20, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(output.data());
  stream.avail_out = static_cast<uInt>(output.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  output.resize(stream.total_out);
  inflateEnd(&stream);
  return output;
}

TEST(Base64, IsThatOfTheStandard) {
  constexpr std::array<std::array<const char*, 2>, 7> kCases = {{{"", ""},
                                                                 {"f", "Zg=="},
                                                                 {"fo", "Zm8="},
                                                                 {"foo", "Zm9v"},
                                                                 {"foob", "Zm9vYg=="},
                                                                 {"fooba", "Zm9vYmE="},
                                                                 {"foobar", "Zm9vYmFy"}}};
  for (const auto& [bytes, text] : kCases) {
    EXPECT_EQ(base64_of(bytes), text);
    EXPECT_EQ(bytes_of_base64(text), bytes);
  }
  EXPECT_EQ(base64_of("\xfb\xff\xfe"), "+//+");
  EXPECT_EQ(bytes_of_base64("+//+"), "\xfb\xff\xfe");
}

TEST(Base64, RefusesOtherText) {
  for (const char* text : {"Zg", "Zg=", "Z===", "====", "Zm9v\n", "Zm 9", "Zg==Zg=="}) {
    EXPECT_FALSE(bytes_of_base64(text)) << text;
  }
}

TEST(Gzip, OfTheSameBytesIsTheSameAndHasNoTime) {
  const std::string bytes(300'000, 'x');
  const std::string packed = gzip_of(bytes);
  EXPECT_EQ(packed, gzip_of(bytes));
  EXPECT_EQ(packed.substr(4, 4), std::string(4, '\0'));
  EXPECT_LT(packed.size(), 1000u);
  EXPECT_EQ(gunzip(packed), bytes);
  EXPECT_EQ(gunzip(gzip_of("")), "");
}

TEST(Page, PayloadIsALengthAJsonTextAndTheFiles) {
  const PageContent content = {
      {{"walk.amc", "AMC"}, {"walk.asf", std::string_view("A\0F", 3)}},
      {{"walk.amc", "walk.asf", "", "", {{"fps", "30"}, {"keep-times", ""}}},
       {"b.txt", "", "p.rpj", "m.yaml", {}}}};
  const std::string json =
      R"({"files":[{"path":"walk.amc","size":3},{"path":"walk.asf","size":3}],)"
      R"("open":[{"path":"walk.amc","skeleton":"walk.asf","options":{"fps":"30","keep-times":true}},)"
      R"({"path":"b.txt","project":"p.rpj","servo_map":"m.yaml","options":{}}]})";
  ASSERT_EQ(json.size(), 0xe6u);
  EXPECT_EQ(payload_of(content),
            std::string("\xe6\0\0\0", 4) + json + "AMC" + std::string("A\0F", 3));
}

TEST(Page, NamesThatAreNotUtf8StayWithinJson) {
  const std::string payload = payload_of({{{"a\xff.bvh", ""}}, {}});
  EXPECT_NE(payload.find("a\xef\xbf\xbd.bvh"), std::string::npos);
}

TEST(Page, ContentIsInItsElementAndTheRestUnchanged) {
  const PageContent content = {{{"a.bvh", "</script>"}}, {{"a.bvh", "", "", "", {}}}};
  const auto page = page_with(kPage, content);
  ASSERT_TRUE(page);
  constexpr std::string_view kBefore = R"(<html><script id="motion" type="text/plain">)";
  constexpr std::string_view kAfter = "</script><script>1</script></html>";
  ASSERT_TRUE(page->starts_with(kBefore));
  ASSERT_TRUE(page->ends_with(kAfter));
  const std::size_t size = page->size() - kBefore.size() - kAfter.size();
  const auto packed = bytes_of_base64(page->substr(kBefore.size(), size));
  ASSERT_TRUE(packed);
  EXPECT_EQ(gunzip(*packed), payload_of(content));
}

TEST(Page, WithoutAPlaceForContentIsRefused) {
  const auto none = page_with("", {});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, "PAG001");
  EXPECT_EQ(none.error().kind, ErrorKind::Usage);
  EXPECT_EQ(none.error().message,
            "this kinefile was built without its page; 'make web' builds it, then build again");
  for (const std::string& page : {std::string("<html></html>"), std::string(kPage) += kPage}) {
    const auto other = page_with(page, {});
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().code, "PAG001");
    EXPECT_TRUE(
        other.error().message.starts_with("expected a page that has <script id=\"motion\""));
  }
}

TEST(Page, PathsAreRelativeToTheDeepestFolderOfAllFiles) {
  EXPECT_EQ(common_folder({"/a/b/walk.bvh"}), "/a/b");
  EXPECT_EQ(common_folder({"/a/b/walk.bvh", "/a/bc/run.bvh"}), "/a");
  EXPECT_EQ(common_folder({"/a/b/arm/arm.body", "/a/b/arm/../hand/hand.body"}), "/a/b");
  EXPECT_EQ(common_folder({"/a/walk.bvh", "/b/walk.bvh", "<stdin>"}), "/");
  EXPECT_EQ(path_within("/a", "/a/b/walk.bvh"), "b/walk.bvh");
  EXPECT_EQ(path_within("/a/b", "/a/b/arm/../hand/hand.body"), "hand/hand.body");
  EXPECT_EQ(path_within("/", "/b/walk.bvh"), "b/walk.bvh");
  EXPECT_EQ(path_within("/a", "<stdin>"), "<stdin>");
  EXPECT_EQ(path_within(common_folder({"walk.bvh", "sub/walk.bvh"}), "sub/walk.bvh"),
            "sub/walk.bvh");
}

TEST(Page, FoldersAtOrAboveItsOwnAreDots) {
  EXPECT_EQ(path_within("/a/b", "/a/b/models/"), "models");
  EXPECT_EQ(path_within("/a/b", "/a/b/"), ".");
  EXPECT_EQ(path_within("/a/b", "/a"), ".");
  EXPECT_EQ(path_within("/a/b", "/c/d"), ".");
}

}  // namespace
}  // namespace kinefile::cli
