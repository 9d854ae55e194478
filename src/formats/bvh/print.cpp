// SPDX-License-Identifier: MIT
#include "formats/bvh/print.hpp"

#include <fmt/format.h>

#include "kinefile/skeleton.hpp"

namespace kinefile::bvh {
namespace {

struct Writer {
  text::Printer& printer;
  std::string_view line_end;

  /// Starts a line, indented by the depth of braces.
  void indent(std::size_t depth) {
    for (std::size_t i = 0; i < depth; ++i) printer.print('\t');
  }
  void line(std::size_t depth, std::string_view text) {
    indent(depth);
    printer.print(text);
    printer.print(line_end);
  }
  void offset(std::size_t depth, const std::array<double, 3>& numbers) {
    indent(depth);
    printer.print("OFFSET");
    printer.continue_row(numbers, " ");
    printer.print(line_end);
  }
};

void print_end_site(Writer& writer, const EndSite& site, std::size_t depth) {
  writer.line(depth, site.name.empty() ? "End Site" : fmt::format("End Site {}", site.name));
  writer.line(depth, "{");
  writer.offset(depth + 1, site.offset);
  writer.line(depth, "}");
}

void print_node(Writer& writer, const Node& node, std::size_t depth) {
  const bool is_root = node.parent == kNoParent;
  writer.line(depth, fmt::format("{} {}", is_root ? "ROOT" : "JOINT", node.name));
  writer.line(depth, "{");
  writer.offset(depth + 1, node.offset);
  std::string channels = fmt::format("CHANNELS {}", node.channels.size());
  for (const Channel& channel : node.channels) channels += " " + spelling(channel);
  writer.line(depth + 1, channels);
  for (const EndSite& site : node.end_sites) print_end_site(writer, site, depth + 1);
}

}  // namespace

void print_hierarchy(text::Printer& printer, const File& file, std::string_view line_end) {
  Writer writer{printer, line_end};
  writer.line(0, "HIERARCHY");
  std::vector<std::size_t> open;  // the nodes whose braces are open, the innermost last
  const auto close_to = [&](std::size_t depth) {
    while (open.size() > depth) {
      open.pop_back();
      writer.line(open.size(), "}");
    }
  };
  for (std::size_t n = 0; n < file.nodes.size(); ++n) {
    const std::size_t parent = file.nodes[n].parent;
    std::size_t depth = open.size();
    while (depth > 0 && open[depth - 1] != parent) --depth;
    close_to(depth);
    print_node(writer, file.nodes[n], depth);
    open.push_back(n);
  }
  close_to(0);
}

void print_counts(text::Printer& printer, std::size_t num_frames, const Timeline& timeline,
                  std::string_view line_end) {
  Writer writer{printer, line_end};
  writer.line(0, "MOTION");
  writer.line(0, fmt::format("Frames: {}", num_frames));
  writer.line(0, fmt::format("Frame Time: {}", frame_time(timeline)));
}

void print_frames(text::Printer& printer, const Unbound& unbound, std::span<const double> rows,
                  std::size_t begin, std::size_t end, std::string_view line_end) {
  const std::size_t num_columns = unbound.file.num_columns;
  std::vector<double> in_order(unbound.column_of.size());
  for (std::size_t f = begin; f < end; ++f) {
    const auto row = rows.subspan(f * num_columns, num_columns);
    for (std::size_t c = 0; c < in_order.size(); ++c) in_order[c] = row[unbound.column_of[c]];
    printer.print_row(in_order.empty() ? row : in_order, " ");
    printer.print(line_end);
  }
}

}  // namespace kinefile::bvh
