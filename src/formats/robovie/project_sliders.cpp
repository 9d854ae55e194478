// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "formats/robovie/codes.hpp"
#include "formats/robovie/project.hpp"

namespace kinefile::robovie {
namespace {

/// The allowed words per degree of a servo, as in a servo map.
constexpr double kLeastUnits = 0.001, kMostUnits = 1e6;

/// Variables, of which the first are sliders.
constexpr int kMostSliders = 64;
constexpr int kStyleDegrees = 2;
constexpr int kDisabledBit = 1;

/// Sliders that jump to a new value at once by default: the voice, LEDs, digital outputs.
bool jumps_usually(std::size_t slider) { return slider == 30 || (slider >= 37 && slider <= 40); }

void read_pair(const ProjectLine& line, Slider& slider) {
  if (!line.has(2)) return;
  const auto kind = line.integer(0, 0, 3);
  const auto partner = line.integer(1, 0, kMostSliders - 1);
  if (!kind || !partner) return;
  slider.pair = static_cast<PairKind>(*kind);
  const bool has_partner = slider.pair == PairKind::Left || slider.pair == PairKind::Right;
  slider.partner = has_partner ? *partner : -1;
}

void read_style(const ProjectLine& line, Slider& slider) {
  if (!line.has(3)) return;
  slider.style = line.integer(0, 0, 99).value_or(0);
  const auto units = line.decimal(2);
  if (slider.style != kStyleDegrees || !units) return;
  if (*units >= kLeastUnits && *units <= kMostUnits) {
    slider.units_per_degree = *units;
    return;
  }
  line.reader().warn(code::kBadNumber,
                     fmt::format("expected {} to {} words a degree, found {}; the slider has no "
                                 "degrees then",
                                 kLeastUnits, kMostUnits, *units),
                     line.at());
}

void read_division(const ProjectLine& line, Slider& slider) {
  if (!line.has(3)) return;
  const auto minimum = line.integer(0, -32768, 32767);
  const auto maximum = line.integer(1, -32768, 32767);
  const auto step = line.integer(2, 1, 65535);
  if (!minimum || !maximum || !step) return;
  if (*minimum > *maximum) {
    line.reader().warn(code::kBadNumber,
                       fmt::format("expected a smaller number before a larger one, found {} and {}",
                                   *minimum, *maximum),
                       line.at());
    return;
  }
  slider.minimum = *minimum;
  slider.maximum = *maximum;
  slider.step = *step;
}

void read_slider_line(const ProjectLine& line, Slider& slider) {
  if (line.key() == "_AXISNAME" && line.has(1)) {
    slider.name = line.text(0);
  } else if (line.key() == "_PAIR") {
    read_pair(line, slider);
  } else if (line.key() == "_PUTSTYLE") {
    read_style(line, slider);
  } else if (line.key() == "_DIVISION") {
    read_division(line, slider);
  } else if (line.key() == "_FLAG" && line.has(2)) {
    const auto bits = line.integer(1, 0, kLargestNumber);
    slider.is_disabled = bits && (*bits & kDisabledBit) != 0;
  }
}

/// Reports partners that do not name each other.
void check_pairs(const Reader& reader, RobotProject& project) {
  for (std::size_t s = 0; s < project.sliders.size(); ++s) {
    Slider& slider = project.sliders[s];
    if (slider.partner < 0) continue;
    const auto partner = static_cast<std::size_t>(slider.partner);
    const bool is_slider = partner < project.sliders.size() && partner != s;
    if (is_slider && project.sliders[partner].partner == static_cast<int>(s)) continue;
    reader.tell(
        Severity::Warning, code::kBadPair,
        fmt::format("expected slider {} and its partner to name each other, found {}", s, partner),
        reader.source.text().data());
    slider.pair = PairKind::None;
    slider.partner = -1;
  }
}

}  // namespace

void read_sliders(const Reader& reader, RobotProject& project) {
  Slider* slider = nullptr;
  for_each_line(reader, [&](const ProjectLine& line) {
    if (line.key() != "_NUMBER") {
      if (slider != nullptr) read_slider_line(line, *slider);
      return;
    }
    slider = nullptr;
    const auto number = line.has(1) ? line.integer(0, 0, kMostSliders - 1) : std::nullopt;
    if (!number) return;
    const auto index = static_cast<std::size_t>(*number);
    while (project.sliders.size() <= index) {
      project.sliders.emplace_back();
      project.sliders.back().jumps = jumps_usually(project.sliders.size() - 1);
    }
    slider = &project.sliders[index];
  });
  if (project.sliders.empty()) {
    reader.error(code::kNoSliders, "expected sliders (_NUMBER:), found none",
                 reader.source.text().data());
  }
  check_pairs(reader, project);
}

}  // namespace kinefile::robovie
