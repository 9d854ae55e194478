// SPDX-License-Identifier: MIT
#include "run_output.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "flow_words.hpp"

namespace kinefile::cli {
namespace {

constexpr std::size_t kPieceSize = 1 << 16;

/// A field of a table, in quotes where it must be.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

/// How a column shows a slider: (word - base) / units.
struct SliderColumn {
  std::string name;
  double units = 0;  ///< 0: the word itself
  int base = 0;
};

std::vector<SliderColumn> columns_of(const RunTable& table) {
  std::vector<SliderColumn> columns(table.run.num_sliders);
  const auto base =
      table.project != nullptr ? base_values(*table.project) : std::vector<std::int16_t>();
  for (std::size_t s = 0; s < columns.size(); ++s) {
    columns[s].name = fmt::format("s{}", s);
    if (table.project == nullptr || s >= table.project->sliders.size()) continue;
    const Slider& slider = table.project->sliders[s];
    if (!slider.name.empty()) columns[s].name = slider.name;
    columns[s].units = slider.units_per_degree;
    if (table.is_relative && s < base.size()) columns[s].base = base[s];
  }
  return columns;
}

/// Prints the rows of a run one by one, in large pieces.
struct Writer {
  const RunTable& table;
  const Sink& sink;
  std::vector<SliderColumn> columns;
  bool has_sounds = false;
  bool has_masks = false;
  std::size_t next_event = 0;
  std::string buffer = {};

  void print_header() {
    buffer = "tick,time";
    for (const SliderColumn& column : columns) buffer += "," + field(column.name);
    if (has_sounds) buffer += ",sound";
    if (has_masks) buffer += ",servo_off";
    buffer += '\n';
  }

  void print_events(std::uint64_t tick) {
    const auto& events = table.run.events;
    std::string sound, mask;
    for (; next_event < events.size() && events[next_event].tick == tick; ++next_event) {
      const flow::Event& event = events[next_event];
      if (!event.sound.empty()) sound = event.sound;
      if (event.changes_servos) mask = mask_text(event.servo_off);
    }
    if (has_sounds) buffer += "," + field(sound);
    if (has_masks) buffer += "," + mask;
  }

  void print_row(std::size_t tick) {
    const auto out = std::back_inserter(buffer);
    fmt::format_to(out, "{},{}", tick, seconds_of(tick, table.tick_seconds));
    const std::int16_t* row = table.run.sliders.data() + tick * columns.size();
    for (const SliderColumn& column : columns) {
      const std::int16_t word = *row++;
      if (column.units > 0) {
        fmt::format_to(out, ",{}", (word - column.base) / column.units);
      } else {
        fmt::format_to(out, ",{}", word);
      }
    }
    print_events(tick);
    buffer += '\n';
  }

  bool hand_on() {
    const bool is_good = sink(buffer);
    buffer.clear();
    return is_good;
  }
};

/// What a step did, beyond its block's kind and name.
std::string deed_of(const PoseFlow& flow, const flow::Step& step, const flow::RunOptions& options) {
  const Block& block = flow.blocks[step.block];
  if (const auto* pose = std::get_if<PoseBlock>(&block.body)) {
    std::string text = fmt::format(", {} tick{}", pose->ticks, pose->ticks == 1 ? "" : "s");
    if (step.takes_branch) text += ", then break";
    return text;
  }
  if (const auto* sum = std::get_if<ArithmeticBlock>(&block.body)) {
    return fmt::format(", v{} is {}", sum->variable, step.value);
  }
  if (std::holds_alternative<LoopBlock>(block.body)) {
    return step.takes_branch ? ", leaves" : ", goes on";
  }
  const auto* branch = std::get_if<BranchBlock>(&block.body);
  if (branch == nullptr) return {};
  const bool is_true = step.takes_branch == options.true_takes_branch;
  return fmt::format(", v{} is {}: {}", branch->variable, step.value, is_true);
}

std::string_view end_text(flow::End end) {
  switch (end) {
    case flow::End::EndBlock:
      return "ends";
    case flow::End::NoArrow:
      return "stops where an arrow leads nowhere";
    case flow::End::MaxTicks:
      return "is cut off by the limit of time";
  }
  return "";
}

}  // namespace

double seconds_of(std::uint64_t tick, double tick_seconds) {
  const auto ticks = static_cast<double>(tick);
  const double rate = std::round(1 / tick_seconds);
  return std::abs(rate * tick_seconds - 1) < 1e-12 ? ticks / rate : ticks * tick_seconds;
}

bool write_run_csv(const RunTable& table, const Sink& sink) {
  Writer writer{table, sink, columns_of(table)};
  for (const flow::Event& event : table.run.events) {
    writer.has_sounds = writer.has_sounds || !event.sound.empty();
    writer.has_masks = writer.has_masks || event.changes_servos;
  }
  writer.print_header();
  for (std::size_t tick = 0; tick <= table.run.num_ticks; ++tick) {
    writer.print_row(tick);
    if (writer.buffer.size() > kPieceSize && !writer.hand_on()) return false;
  }
  return writer.hand_on();
}

std::string trace_of(const PoseFlow& flow, const flow::Run& run, const flow::RunOptions& options,
                     double tick_seconds) {
  std::string text;
  const auto out = std::back_inserter(text);
  for (const flow::Step& step : run.path) {
    const Block& block = flow.blocks[step.block];
    fmt::format_to(out, "{:6} {:9.3f}  {} {}", step.tick, seconds_of(step.tick, tick_seconds),
                   step.block, body_name(block));
    if (!block.name.empty()) fmt::format_to(out, " \"{}\"", block.name);
    text += deed_of(flow, step, options) + "\n";
  }
  for (const flow::Event& event : run.events) {
    const double seconds = seconds_of(event.tick, tick_seconds);
    if (event.changes_servos) {
      fmt::format_to(out, "{:6} {:9.3f}  servos off {}\n", event.tick, seconds,
                     mask_text(event.servo_off));
    }
    if (!event.sound.empty()) {
      fmt::format_to(out, "{:6} {:9.3f}  sound {}\n", event.tick, seconds, event.sound);
    }
  }
  fmt::format_to(out, "{:6} {:9.3f}  {}\n", run.num_ticks, seconds_of(run.num_ticks, tick_seconds),
                 end_text(run.end));
  for (std::size_t v = 64; v < kNumVariables; ++v) {
    if (run.variables[v] != 0) fmt::format_to(out, "v{} = {}\n", v, run.variables[v]);
  }
  return text;
}

}  // namespace kinefile::cli
