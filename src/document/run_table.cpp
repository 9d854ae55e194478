// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "kinefile/run.hpp"
#include "model/slider_words.hpp"
#include "text/printer.hpp"

namespace kinefile {
namespace {

constexpr std::size_t kRunPieceSize = 1 << 16;

/// A time of a flow. With ticks of 1/60 s it is the tick divided by 60.
double seconds_of(std::uint64_t tick, double tick_seconds) {
  const auto ticks = static_cast<double>(tick);
  const double rate = std::round(1 / tick_seconds);
  return std::abs(rate * tick_seconds - 1) < 1e-12 ? ticks / rate : ticks * tick_seconds;
}

/// How a column shows a slider: (word - base) / units.
struct RunColumn {
  std::string name;
  double units = 0;  ///< 0: the word itself
  int base = 0;
};

std::vector<RunColumn> run_columns_of(const RunTable& table) {
  std::vector<RunColumn> columns(table.run.run.num_sliders);
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
struct RunWriter {
  const RunTable& table;
  const Sink& sink;
  std::vector<RunColumn> columns;
  bool has_sounds = false;
  bool has_masks = false;
  std::size_t next_event = 0;
  std::string buffer = {};

  void print_header() {
    buffer = "tick,time";
    for (const RunColumn& column : columns) buffer += "," + text::csv_field(column.name);
    if (has_sounds) buffer += ",sound";
    if (has_masks) buffer += ",servo_off";
    buffer += '\n';
  }

  void print_events(std::uint64_t tick) {
    const auto& events = table.run.run.events;
    std::string sound, mask;
    for (; next_event < events.size() && events[next_event].tick == tick; ++next_event) {
      const flow::Event& event = events[next_event];
      if (!event.sound.empty()) sound = event.sound;
      if (event.changes_servos) mask = servo_mask_text(event.servo_off);
    }
    if (has_sounds) buffer += "," + text::csv_field(sound);
    if (has_masks) buffer += "," + mask;
  }

  void print_row(std::size_t tick) {
    const auto out = std::back_inserter(buffer);
    fmt::format_to(out, "{},{}", tick, seconds_of(tick, table.run.tick_seconds));
    const std::int16_t* row = table.run.run.sliders.data() + tick * columns.size();
    for (const RunColumn& column : columns) {
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

/// The effect of a step, besides its block's kind and name.
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

bool write_run_csv(const RunTable& table, const Sink& sink) {
  RunWriter writer{table, sink, run_columns_of(table)};
  for (const flow::Event& event : table.run.run.events) {
    writer.has_sounds = writer.has_sounds || !event.sound.empty();
    writer.has_masks = writer.has_masks || event.changes_servos;
  }
  writer.print_header();
  for (std::size_t tick = 0; tick <= table.run.run.num_ticks; ++tick) {
    writer.print_row(tick);
    if (writer.buffer.size() > kRunPieceSize && !writer.hand_on()) return false;
  }
  return writer.hand_on();
}

std::string trace_of(const PoseFlow& flow, const TimedRun& timed) {
  const flow::Run& run = timed.run;
  const double tick_seconds = timed.tick_seconds;
  std::string text;
  const auto out = std::back_inserter(text);
  for (const flow::Step& step : run.path) {
    const Block& block = flow.blocks[step.block];
    fmt::format_to(out, "{:6} {:9.3f}  {} {}", step.tick, seconds_of(step.tick, tick_seconds),
                   step.block, body_name(block));
    if (!block.name.empty()) fmt::format_to(out, " \"{}\"", block.name);
    text += deed_of(flow, step, timed.options) + "\n";
  }
  for (const flow::Event& event : run.events) {
    const double seconds = seconds_of(event.tick, tick_seconds);
    if (event.changes_servos) {
      fmt::format_to(out, "{:6} {:9.3f}  servos off {}\n", event.tick, seconds,
                     servo_mask_text(event.servo_off));
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

}  // namespace kinefile
