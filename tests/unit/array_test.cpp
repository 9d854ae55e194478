// SPDX-License-Identifier: MIT
#include "kinefile/array.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <numeric>
#include <vector>

namespace kinefile {
namespace {

TEST(Array, CopiesShareMemoryUntilOneIsWritten) {
  Array<double> a = {1, 2, 3};
  const Array<double> b = a;
  EXPECT_EQ(a.data(), b.data());
  a.mutate()[1] = 20;
  EXPECT_NE(a.data(), b.data());
  EXPECT_EQ(a, (Array<double>{1, 20, 3}));
  EXPECT_EQ(b, (Array<double>{1, 2, 3}));
}

TEST(Array, AnArrayThatIsAloneIsWrittenInPlace) {
  Array<double> a(1000, 1.0);
  const double* const before = a.data();
  { const Array<double> copy = a; }
  a.mutate()[0] = 2;
  EXPECT_EQ(a.data(), before);
}

TEST(Array, MemoryIsAligned) {
  for (const std::size_t size : {1u, 3u, 1000u, 600'000u}) {
    const Array<double> a(size);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(a.data()) % 64, 0u) << size;
  }
}

TEST(Array, GrowsAndKeepsWhatItHas) {
  Array<double> a;
  std::vector<double> expected;
  for (int i = 0; i < 10'000; ++i) {
    a.append({i * 1.0, i * 2.0});
    expected.insert(expected.end(), {i * 1.0, i * 2.0});
  }
  EXPECT_EQ(a, expected);
  a.append(a);
  EXPECT_EQ(a.size(), 40'000u);
  EXPECT_EQ(a[20'001], 0.0);
  EXPECT_EQ(a[39'999], expected.back());
}

TEST(Array, AdoptedMemoryIsReadInPlaceAndCopiedForAWrite) {
  auto owner = std::make_shared<std::vector<double>>(std::vector<double>{1, 2, 3});
  const std::weak_ptr<std::vector<double>> watched = owner;
  Array<double> a = Array<double>::adopt(*owner, owner);
  EXPECT_EQ(a.data(), owner->data());
  const Array<double> b = a;
  EXPECT_EQ(b.data(), owner->data());
  a.mutate()[0] = 10;
  EXPECT_EQ((*owner)[0], 1);
  EXPECT_EQ(a[0], 10);
  owner.reset();
  EXPECT_FALSE(watched.expired());
  EXPECT_EQ(b[2], 3);
}

TEST(Array, WritableAdoptedMemoryIsWrittenInPlaceAndCopiedDeeply) {
  auto owner = std::make_shared<std::vector<double>>(std::vector<double>{1, 2, 3});
  Array<double> a = Array<double>::adopt_writable(*owner, owner);
  const Array<double> copy = a;
  EXPECT_NE(copy.data(), owner->data());
  a.mutate()[0] = 10;
  EXPECT_EQ((*owner)[0], 10);
  EXPECT_EQ(copy[0], 1);
}

TEST(Array, CopiesOfExposedMemoryAreDeep) {
  Array<double> a = {1, 2, 3};
  const Array<double> before = a;
  const std::span<double> view = a.expose();
  EXPECT_NE(a.data(), before.data());
  const Array<double> after = a;
  view[0] = 100;
  EXPECT_EQ(a[0], 100);
  EXPECT_EQ(before[0], 1);
  EXPECT_EQ(after[0], 1);
}

TEST(Array, AnEmptyOneHasNoMemory) {
  Array<double> a;
  EXPECT_TRUE(a.mutate().empty());
  EXPECT_EQ(a.data(), nullptr);
  a.append(std::vector<double>{});
  const Array<double> b = a;
  EXPECT_EQ(a, b);
}

}  // namespace
}  // namespace kinefile
