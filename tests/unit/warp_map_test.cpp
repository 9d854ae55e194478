// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "kinefile/retime.hpp"
#include "retime/curves.hpp"

namespace kinefile {
namespace {

constexpr std::size_t kFrames = 450;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<double> warped(const retime::WarpOptions& options, std::size_t num_frames = kFrames) {
  const auto map = retime::warp_map(num_frames, options);
  EXPECT_TRUE(map) << to_string(map.error());
  if (!map) return {};
  EXPECT_FALSE(map->timeline);
  for (const double frame : map->old_frames) {
    EXPECT_TRUE(frame >= 0 && frame <= static_cast<double>(num_frames) - 1) << frame;
  }
  return map->old_frames;
}

std::string warp_fault(const retime::WarpOptions& options, std::size_t num_frames = kFrames) {
  const auto map = retime::warp_map(num_frames, options);
  EXPECT_FALSE(map);
  if (map) return "";
  EXPECT_EQ(map.error().kind, ErrorKind::Usage);
  EXPECT_EQ(map.error().code, "RTM001");
  return map.error().message;
}

retime::WarpOptions with_curve(retime::WarpCurve curve) {
  retime::WarpOptions options;
  options.keys = {{150, 160}};
  options.curve = curve;
  return options;
}

TEST(WarpMap, WithoutKeysNothingChanges) {
  for (const retime::Tail tail :
       {retime::Tail::Keep, retime::Tail::Extend, retime::Tail::Uniform}) {
    for (const retime::WarpCurve curve : {retime::WarpCurve::Linear, retime::WarpCurve::Pchip,
                                          retime::WarpCurve::Steffen, retime::WarpCurve::Hermite}) {
      retime::WarpOptions options;
      options.tail = tail;
      options.curve = curve;
      const auto frames = warped(options);
      ASSERT_EQ(frames.size(), kFrames);
      for (std::size_t n = 0; n < kFrames; ++n) EXPECT_NEAR(frames[n], double(n), 1e-12);
      EXPECT_EQ(warped(options, 1), std::vector<double>{0});
    }
  }
  EXPECT_TRUE(warped({}, 0).empty());
}

TEST(WarpMap, KeepsTheLength) {
  const auto frames = warped({.keys = {{150, 160}}});
  ASSERT_EQ(frames.size(), 450u);
  EXPECT_EQ(frames[0], 0);
  EXPECT_EQ(frames[1], 0.9375);
  EXPECT_EQ(frames[2], 1.875);
  EXPECT_EQ(frames[16], 15);
  EXPECT_EQ(frames[160], 150);
  EXPECT_NEAR(frames[161], 151.034602, 1e-6);
  EXPECT_NEAR(frames[300], 294.844291, 1e-6);
  EXPECT_NEAR(frames[448], 447.965398, 1e-6);
  EXPECT_EQ(frames[449], 449);
}

TEST(WarpMap, BringsAKeyForward) {
  const auto frames = warped({.keys = {{150, 140}}});
  ASSERT_EQ(frames.size(), 450u);
  EXPECT_NEAR(frames[1], 1.071429, 1e-6);
  EXPECT_EQ(frames[14], 15);
  EXPECT_EQ(frames[140], 150);
  EXPECT_NEAR(frames[141], 150 + 299.0 / 309, 1e-12);
  EXPECT_EQ(frames[449], 449);
}

TEST(WarpMap, ExtendPlaysTheRestAsItWas) {
  const auto longer = warped({.keys = {{150, 160}}, .tail = retime::Tail::Extend});
  ASSERT_EQ(longer.size(), 460u);
  for (std::size_t n = 160; n < 460; ++n) EXPECT_EQ(longer[n], double(n) - 10);
  const auto shorter = warped({.keys = {{150, 140}}, .tail = retime::Tail::Extend});
  ASSERT_EQ(shorter.size(), 440u);
  for (std::size_t n = 140; n < 440; ++n) EXPECT_EQ(shorter[n], double(n) + 10);
}

TEST(WarpMap, UniformPlaysTheRestAtTheRateOfTheLastInterval) {
  const auto frames = warped({.keys = {{150, 160}}, .tail = retime::Tail::Uniform});
  ASSERT_EQ(frames.size(), 479u);
  EXPECT_EQ(frames[478], 448.125);
  for (std::size_t n = 0; n < 479; ++n) EXPECT_EQ(frames[n], double(n) * 0.9375);
}

TEST(WarpMap, ExtendEndsAtTheLastWholeFrame) {
  const auto frames = warped({.keys = {{150, 160.5}}, .tail = retime::Tail::Extend});
  ASSERT_EQ(frames.size(), 460u);
  EXPECT_EQ(frames.back(), 448.5);
}

TEST(WarpMap, RoundingDoesNotLoseTheEnd) {
  const auto frames = warped({.keys = {{0.1, 0.3}, {0.3, 0.5}}, .tail = retime::Tail::Extend}, 11);
  EXPECT_EQ(frames.size(), 11u);
  const auto exact = warped({.keys = {{0.7, 1.7}}, .tail = retime::Tail::Extend}, 11);
  ASSERT_EQ(exact.size(), 12u);
  EXPECT_EQ(exact.back(), 10);
}

TEST(WarpMap, SlopesAreThoseOfTheFacts) {
  const std::vector<retime::Knot> knots = {{0, 0}, {160, 150}, {449, 449}};
  const auto pchip = retime::pchip_slopes(knots);
  EXPECT_NEAR(pchip[0], 0.9028979238754324, 1e-15);
  EXPECT_NEAR(pchip[1], 0.9790438768827766, 1e-15);
  EXPECT_NEAR(pchip[2], 1.0971020761245676, 1e-15);
  const auto steffen = retime::steffen_slopes(knots);
  EXPECT_NEAR(steffen[0], 0.9028979, 1e-7);
  EXPECT_NEAR(steffen[1], 0.9721021, 1e-7);
  EXPECT_NEAR(steffen[2], 1.0971021, 1e-7);
}

TEST(WarpMap, CurvesHaveTheirWorkedNumbers) {
  const auto pchip = warped(with_curve(retime::WarpCurve::Pchip));
  EXPECT_NEAR(pchip[1], 0.903071, 1e-6);
  EXPECT_NEAR(pchip[80], 73.477081, 1e-6);
  EXPECT_EQ(pchip[160], 150);
  EXPECT_NEAR(pchip[161], 150.979212, 1e-6);
  EXPECT_NEAR(pchip[300], 290.591376, 1e-6);
  const auto steffen = warped(with_curve(retime::WarpCurve::Steffen));
  EXPECT_NEAR(steffen[80], 73.615917, 1e-6);
  EXPECT_NEAR(steffen[300], 290.333045, 1e-6);
  const auto hermite = warped(with_curve(retime::WarpCurve::Hermite));
  EXPECT_NEAR(hermite[1], 0.998963, 1e-6);
  EXPECT_NEAR(hermite[80], 75.419122, 1e-6);
  EXPECT_NEAR(hermite[300], 293.986653, 1e-6);
}

TEST(WarpMap, SmoothCurvesGoOverIntoTheTail) {
  retime::WarpOptions options = with_curve(retime::WarpCurve::Pchip);
  options.keys = {{1500, 1600}};
  options.tail = retime::Tail::Extend;
  const auto frames = warped(options, 4500);
  EXPECT_NEAR(frames[1600] - frames[1599], 1, 1e-3);
  EXPECT_EQ(frames[1600], 1500);
  EXPECT_EQ(frames[1601], 1501);
  EXPECT_EQ(frames.size(), 4600u);
}

TEST(WarpMap, KeysMayComeInAnyOrder) {
  EXPECT_EQ(warped({.keys = {{300, 310}, {100, 90}, {150, 160}}}),
            warped({.keys = {{100, 90}, {150, 160}, {300, 310}}}));
}

TEST(WarpMap, AKeyMayCutTheStartOff) {
  const auto frames = warped({.keys = {{10, 0}}, .tail = retime::Tail::Extend});
  EXPECT_EQ(frames.size(), 440u);
  EXPECT_EQ(frames.front(), 10);
}

TEST(WarpMap, HoldsWhereThatIsAllowed) {
  retime::WarpOptions options{.keys = {{100, 100}, {100, 150}}, .tail = retime::Tail::Extend};
  EXPECT_EQ(warp_fault(options),
            "expected keys that go on in the old motion, found 100:100 and 100:150, between which "
            "it stands still; --allow-hold allows it");
  options.allow_hold = true;
  for (const retime::WarpCurve curve : {retime::WarpCurve::Linear, retime::WarpCurve::Pchip,
                                        retime::WarpCurve::Steffen, retime::WarpCurve::Hermite}) {
    options.curve = curve;
    const auto frames = warped(options);
    ASSERT_EQ(frames.size(), 500u);
    for (std::size_t n = 100; n <= 150; ++n) EXPECT_EQ(frames[n], 100);
  }
}

TEST(WarpMap, RunsBackwardsWhereThatIsAllowed) {
  retime::WarpOptions options{.keys = {{449, 0}, {0, 449}}, .tail = retime::Tail::Uniform};
  EXPECT_EQ(warp_fault(options),
            "expected keys that go on in the old motion, found 449:0 and 0:449, between which it "
            "runs backwards; --allow-reverse allows it");
  options.allow_reverse = true;
  const auto frames = warped(options);
  ASSERT_EQ(frames.size(), kFrames);
  for (std::size_t n = 0; n < kFrames; ++n) EXPECT_EQ(frames[n], 449 - double(n));
}

TEST(WarpMap, UniformRunsBackToTheStart) {
  const auto frames =
      warped({.keys = {{100, 0}, {50, 25}}, .tail = retime::Tail::Uniform, .allow_reverse = true});
  EXPECT_EQ(frames.size(), 51u);
  EXPECT_EQ(frames.back(), 0);
}

TEST(WarpMap, EasesWithinEveryInterval) {
  retime::WarpOptions options{.keys = {{150, 160}}};
  options.ease = *retime::parse_ease("smooth");
  const auto frames = warped(options);
  EXPECT_EQ(frames[80], 75);
  EXPECT_DOUBLE_EQ(frames[40], 150 * 0.15625);
  EXPECT_EQ(frames[160], 150);
  EXPECT_EQ(frames[449], 449);
  options.tail = retime::Tail::Extend;
  EXPECT_EQ(warped(options)[170], 160);
}

TEST(WarpMap, AnEaseThatOvershootsStaysInTheMotion) {
  retime::WarpOptions options{.keys = {{150, 160}}};
  options.ease = *retime::parse_ease("bezier:0.3,-2,0.7,3");
  EXPECT_EQ(warp_fault(options),
            "expected an ease that does not go back, found one that overshoots; --allow-reverse "
            "allows it");
  options.allow_reverse = true;
  const auto frames = warped(options);
  EXPECT_EQ(frames[20], 0);
  EXPECT_GT(frames[140], 150);
}

TEST(WarpMap, KeysHaveToFit) {
  EXPECT_EQ(warp_fault({.keys = {{450, 460}}}),
            "expected an old frame from 0 to 449, found the key 450:460");
  EXPECT_EQ(warp_fault({.keys = {{150, -1}}}),
            "expected a new frame from 0 to 134217727, found the key 150:-1");
  EXPECT_EQ(warp_fault({.keys = {{150, 160}, {150.5, 160}}, .allow_hold = true}),
            "expected one key for the new frame 160, found 150:160 and 150.5:160");
  EXPECT_EQ(warp_fault({.keys = {{150, 449}}}),
            "expected keys before the new frame 449, at which a motion that keeps its length "
            "ends, found 150:449; --tail extend lets the length change");
  EXPECT_EQ(warp_fault({.keys = {{449, 500}}}).substr(0, 34), "expected keys before the new frame");
  for (const double bad : {kNaN, std::numeric_limits<double>::infinity(), -1.0, 1e300}) {
    EXPECT_NE(warp_fault({.keys = {{bad, 10}}, .tail = retime::Tail::Extend}), "");
    EXPECT_NE(warp_fault({.keys = {{10, bad}}, .tail = retime::Tail::Extend}), "");
  }
  EXPECT_NE(warp_fault({.keys = {{0, 0}}}, 0), "");
  EXPECT_EQ(warped({.keys = {{449, 449}}}).size(), kFrames);
}

TEST(WarpMap, DoesNotFillTheMemory) {
  EXPECT_NE(warp_fault({.keys = {{1, 2e9}}, .tail = retime::Tail::Uniform}), "");
  EXPECT_NE(warp_fault({.keys = {{1e-300, 1}}, .tail = retime::Tail::Uniform}), "");
  EXPECT_NE(warp_fault({.keys = {{1, 134217727}}, .tail = retime::Tail::Extend}), "");
  EXPECT_NE(warp_fault({}, std::numeric_limits<std::size_t>::max()), "");
  EXPECT_NE(
      warp_fault({.keys = {{1, 5}, {1, 9}}, .tail = retime::Tail::Uniform, .allow_hold = true}),
      "");
}

TEST(WarpMap, CurvesAndEasesExcludeEachOther) {
  retime::WarpOptions options = with_curve(retime::WarpCurve::Pchip);
  options.ease.kind = retime::Ease::Kind::Smooth;
  EXPECT_EQ(warp_fault(options),
            "expected an ease with the linear curve alone, found another curve");
  options = with_curve(retime::WarpCurve::Pchip);
  options.weights.assign(kFrames, 1);
  EXPECT_NE(warp_fault(options), "");
  options = {};
  options.ease = {retime::Ease::Kind::In, -1};
  EXPECT_NE(warp_fault(options), "");
}

TEST(WarpMap, EvenWeightsAreStraight) {
  retime::WarpOptions options{.keys = {{150, 160}}};
  const auto straight = warped(options);
  options.weights.assign(kFrames, 0.5);
  const auto weighted = warped(options);
  ASSERT_EQ(weighted.size(), straight.size());
  for (std::size_t n = 0; n < straight.size(); ++n) EXPECT_NEAR(weighted[n], straight[n], 1e-9);
}

TEST(WarpMap, TimeStretchesWhereTheWeightsLetIt) {
  retime::WarpOptions options{.keys = {{150, 160}}, .tail = retime::Tail::Extend};
  options.weights.assign(kFrames, 0);
  for (std::size_t f = 50; f < 100; ++f) options.weights[f] = 1;
  const auto frames = warped(options);
  for (std::size_t n = 0; n < 49; ++n) EXPECT_EQ(frames[n], double(n));
  for (std::size_t n = 111; n <= 160; ++n) EXPECT_NEAR(frames[n], double(n) - 10, 1e-12);
  EXPECT_EQ(frames[160], 150);
  // From 50 to 99 the rate is 1 / (1 + k), and k = 10 / 50.
  EXPECT_NEAR(frames[80] - frames[79], 1 / 1.2, 1e-12);
}

TEST(WarpMap, WeightsHaveToLeaveRoom) {
  retime::WarpOptions options{.keys = {{150, 100}}, .tail = retime::Tail::Extend};
  options.weights.assign(kFrames, 0);
  EXPECT_EQ(warp_fault(options),
            "expected room to change the time from 0:0 to 150:100, found no frame there that may "
            "change its rate");
  for (std::size_t f = 50; f < 90; ++f) options.weights[f] = 1;
  EXPECT_EQ(warp_fault(options),
            "expected room to change the time from 0:0 to 150:100, found too few frames there "
            "that may change their rate");
  options.weights.pop_back();
  EXPECT_EQ(warp_fault(options), "expected a weight for each of 450 frames, found 449");
  options.weights.assign(kFrames, -1);
  EXPECT_NE(warp_fault(options), "");
  options.weights.assign(kFrames, kNaN);
  EXPECT_NE(warp_fault(options), "");
  options.weights.assign(kFrames, 1e308);
  EXPECT_NE(warp_fault(options), "");
}

TEST(WarpMap, WeightsGoWithReversalsAndHolds) {
  retime::WarpOptions options{.keys = {{100, 80}, {100, 90}, {20.5, 200}},
                              .tail = retime::Tail::Extend};
  options.allow_hold = options.allow_reverse = true;
  options.weights.assign(kFrames, 0);
  for (std::size_t f = 0; f < kFrames; f += 3) options.weights[f] = 1;
  const auto frames = warped(options);
  EXPECT_EQ(frames[80], 100);
  EXPECT_EQ(frames[85], 100);
  EXPECT_EQ(frames[200], 20.5);
  for (std::size_t n = 90; n < 200; ++n) EXPECT_LT(frames[n + 1], frames[n]);
}

/// Random keys that rise, with fractions, close together and far apart.
std::vector<retime::WarpKey> random_keys(std::mt19937_64& random, double last_frame) {
  std::uniform_real_distribution<double> part(0, 1);
  std::vector<retime::WarpKey> keys;
  double old_frame = 0;
  double new_frame = 0;
  const std::size_t count = 1 + random() % 6;
  for (std::size_t k = 0; k < count; ++k) {
    old_frame += 1e-3 + part(random) * std::pow(last_frame / 12, part(random));
    new_frame += 1e-3 + part(random) * std::pow(last_frame / 12, part(random));
    keys.push_back({old_frame, new_frame});
  }
  return keys;
}

TEST(WarpMap, RisingKeysGiveRisingMaps) {
  std::mt19937_64 random(7);
  std::size_t num_maps = 0;
  for (int round = 0; round < 400; ++round) {
    retime::WarpOptions options;
    options.keys = random_keys(random, 449);
    for (const retime::Tail tail :
         {retime::Tail::Keep, retime::Tail::Extend, retime::Tail::Uniform}) {
      options.tail = tail;
      for (const retime::WarpCurve curve :
           {retime::WarpCurve::Linear, retime::WarpCurve::Pchip, retime::WarpCurve::Steffen,
            retime::WarpCurve::Hermite}) {
        options.curve = curve;
        if (tail == retime::Tail::Uniform) {  // may be very long
          const retime::WarpKey last = options.keys.back();
          if (last.new_frame > 100 * last.old_frame) continue;
        }
        const auto map = retime::warp_map(kFrames, options);
        if (!map || map->old_frames.size() > 100'000) continue;
        ++num_maps;
        for (std::size_t n = 1; n < map->old_frames.size(); ++n) {
          ASSERT_LT(map->old_frames[n - 1], map->old_frames[n]) << round << " " << n;
        }
      }
    }
  }
  EXPECT_GT(num_maps, 4000u);
}

TEST(WarpMap, WholeKeysAreMetExactly) {
  std::mt19937_64 random(8);
  for (int round = 0; round < 200; ++round) {
    retime::WarpOptions options;
    options.weights.assign(round % 2 == 0 ? 0 : kFrames, 1);
    double old_frame = 0;
    double new_frame = 0;
    for (int k = 0; k < 4; ++k) {
      old_frame += 1 + static_cast<double>(random() % 100);
      new_frame += 1 + static_cast<double>(random() % 100);
      options.keys.push_back({old_frame, new_frame});
    }
    const auto frames = warped(options);
    for (const retime::WarpKey& key : options.keys) {
      EXPECT_EQ(frames[static_cast<std::size_t>(key.new_frame)], key.old_frame);
    }
    EXPECT_EQ(frames.back(), 449);
  }
}

TEST(WarpMap, StraightPiecesFindWholeFramesExactly) {
  for (int width = 1; width <= 60; ++width) {
    for (int rise = 1; rise <= 60; ++rise) {
      const auto frames = warped({.keys = {{double(rise), double(width)}}}, 100);
      for (int n = 0; n <= width; ++n) {
        if (n * rise % width != 0) continue;
        EXPECT_EQ(frames[std::size_t(n)], n * rise / width);
      }
    }
  }
}

const Timeline kIrregular{FrameTimes{{1, 1.1, 1.3, 1.4, 1.7}}, 5};

TEST(WarpMap, OfFramesWithTimesRunsEvenlyInSeconds) {
  // Half of the way from frame 0 to the key is 0.15 s, where a motion in frames would show frame 1.
  Diagnostics diagnostics;
  const auto map = retime::warp_map(kIrregular, 5, {.keys = {{2, 6}}, .tail = retime::Tail::Extend},
                                    false, diagnostics);
  ASSERT_TRUE(map);
  const std::vector<double> expected = {0, 0.5, 1,           1.25,        1.5, 1.75,
                                        2, 3,   3 + 1 / 3.0, 3 + 2 / 3.0, 4};
  ASSERT_EQ(map->old_frames.size(), expected.size());
  for (std::size_t n = 0; n < expected.size(); ++n) {
    EXPECT_NEAR(map->old_frames[n], expected[n], 1e-12) << n;
  }
  EXPECT_EQ(map->timeline, (Timeline{FrameRate{10}, 5}));
  ASSERT_EQ(diagnostics.items().size(), 1u);
  EXPECT_EQ(diagnostics.items()[0].code, "RTM009");
  EXPECT_NE(diagnostics.items()[0].message.find("10 frames a second"), std::string::npos);
}

TEST(WarpMap, OfFramesWithTimesWithoutKeysShowsEveryFrameAtItsTime) {
  Diagnostics diagnostics;
  const auto map = retime::warp_map(kIrregular, 5, {}, false, diagnostics);
  ASSERT_TRUE(map);
  ASSERT_EQ(map->old_frames.size(), 8u);
  EXPECT_EQ(map->old_frames[1], 1);
  EXPECT_EQ(map->old_frames[2], 1.5);
  EXPECT_EQ(map->old_frames[3], 2);
  EXPECT_EQ(map->old_frames[4], 3);
  EXPECT_EQ(map->old_frames[7], 4);
}

TEST(WarpMap, OfFramesWithTimesTakesKeysInSeconds) {
  Diagnostics diagnostics;
  const auto map = retime::warp_map(kIrregular, 5, {.keys = {{1.3, 0.2}}}, true, diagnostics);
  ASSERT_TRUE(map);
  EXPECT_EQ(map->old_frames[2], 2) << "what happened at 1.3 s is shown 0.2 s behind the start";
  EXPECT_EQ(map->old_frames.size(), 8u);
  const auto steady =
      retime::warp_map({FrameRate{10}, 0}, 5, {.keys = {{0.1, 0.2}}}, true, diagnostics);
  ASSERT_TRUE(steady);
  EXPECT_EQ(steady->old_frames[2], 1);
}

TEST(WarpMap, OfFramesWithTimesStretchesWhereWeightsAllowIt) {
  Diagnostics diagnostics;
  retime::WarpOptions options;
  options.keys = {{4, 9}};
  options.tail = retime::Tail::Extend;
  options.weights = {0, 0, 0, 1, 1};  // from frame 2 on, 0.3 s behind the start
  const auto map = retime::warp_map(kIrregular, 5, options, false, diagnostics);
  ASSERT_TRUE(map);
  EXPECT_NEAR(map->old_frames[1], 1, 1e-12);
  EXPECT_NEAR(map->old_frames[3], 2, 1e-12);
  EXPECT_EQ(map->old_frames.back(), 4);
}

TEST(WarpMap, OfFramesWithTimesRefusesWhatItCannotDo) {
  Diagnostics diagnostics;
  const auto beyond = retime::warp_map(kIrregular, 5, {.keys = {{5, 6}}}, false, diagnostics);
  ASSERT_FALSE(beyond);
  EXPECT_EQ(beyond.error().code, "RTM001");
  EXPECT_NE(beyond.error().message.find("from 0 to 4"), std::string::npos);
  const Timeline falling{FrameTimes{{0, 2, 1}}, 0};
  const auto refused = retime::warp_map(falling, 3, {}, false, diagnostics);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "RTM002");
  const auto weights = retime::warp_map(kIrregular, 5, {.weights = {1, 1}}, false, diagnostics);
  ASSERT_FALSE(weights);
  EXPECT_EQ(weights.error().code, "RTM001");
}

}  // namespace
}  // namespace kinefile
