// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "browser.hpp"
#include "command.hpp"
#include "embedded_page.hpp"
#include "numbers.hpp"
#include "options.hpp"
#include "page.hpp"
#include "report.hpp"
#include "signals.hpp"
#include "skeleton_source.hpp"

namespace kinefile::cli {
namespace {

struct View {
  std::vector<std::string> files;
  std::string out;
  std::string png;
  Picture picture;
  std::string servo_map;
  bool may_replace = false;
  Reading reading;
};

/// What was read for a page. The bytes of all files are in `Reading::options.opened`.
struct ViewInput {
  std::optional<ServoMap> servo_map;
  DocumentSource robot;
  std::vector<std::string> files;  ///< the file that was read for each argument
  bool has_flow = false;
};

/// Reads "1280x720" into a picture's size; false if it is not two numbers of pixels.
bool set_size(Picture& picture, const std::string& text) {
  constexpr int kLeast = 16;
  constexpr int kMost = 8192;
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) return false;
  const auto width = parse_number<int>(std::string_view(text).substr(0, cross));
  const auto height = parse_number<int>(std::string_view(text).substr(cross + 1));
  if (!width || !height) return false;
  if (std::min(*width, *height) < kLeast || std::max(*width, *height) > kMost) return false;
  picture.width = *width;
  picture.height = *height;
  return true;
}

/// Why the options do not fit together; empty if they do.
std::string view_misuse(const View& view) {
  if (view.out.empty() && view.png.empty()) {
    return "nothing to write: -o OUT.html names the page, --png OUT.png a picture of it";
  }
  if (view.out == view.png) return fmt::format("-o and --png both name '{}'", view.out);
  return {};
}

Result<std::optional<ServoMap>> load_servo_map(const View& view, Diagnostics& diagnostics) {
  if (view.servo_map.empty()) return std::optional<ServoMap>();
  const auto bytes = FileBytes::open(view.servo_map);
  if (!bytes) return fail(bytes.error());
  view.reading.options.opened->push_back({view.servo_map, bytes->view(), bytes->owner()});
  auto map = parse_servo_map(bytes->view(), view.servo_map, diagnostics);
  if (!map) return fail(std::move(map.error()));
  return std::optional<ServoMap>(std::move(*map));
}

/// The motion of a robot that runs a flow.
Result<Document> motion_of_flow(const PoseFlow& flow, const View& view, const ViewInput& input,
                                Diagnostics& diagnostics) {
  if (!input.servo_map || view.reading.skeleton.empty()) {
    return fail(ErrorKind::Usage, "CLI001",
                "a flow of poses needs --servo-map, which says what words mean to joints, and "
                "--skeleton, the robot that is shown");
  }
  RunSettings settings;
  settings.project = view.reading.loaded_project;
  settings.servo_map = input.servo_map;
  const auto run = kinefile::run(flow, settings, diagnostics);
  if (!run) return fail(run.error());
  return document_of_run(*run, *input.servo_map, input.robot, diagnostics);
}

/// Checks that a document can be shown, and that it has the frames that are asked for.
Result<void> expect_shown(Document document, const std::string& file, const View& view,
                          ViewInput& input, Diagnostics& diagnostics) {
  if (const PoseFlow* flow = std::get_if<PoseFlow>(&document.content)) {
    input.has_flow = true;
    auto played = motion_of_flow(*flow, view, input, diagnostics);
    if (!played) return fail(std::move(played.error()));
    document = std::move(*played);
  }
  const auto placed = place(document, input.robot, view.reading.is_lenient, diagnostics);
  if (!placed) return fail(placed.error());
  if (diagnostics.has_errors()) return fail(diagnostics.first_error());
  const std::size_t num_frames = placed->motion.clip.num_frames;
  const std::string& frames = view.picture.frames;
  if (placed->is_still || parse_range(frames, num_frames)) return {};
  return fail(make_error(ErrorKind::Usage, "CLI001",
                         fmt::format("expected --frames N, A:B or A:B:STEP within 0:{}, found '{}'",
                                     num_frames, frames),
                         file));
}

int read_for_page(const std::string& file, const View& view, ViewInput& input,
                  const Globals& globals) {
  int exit_code = kDone;
  const std::size_t num_opened = view.reading.options.opened->size();
  auto document = load(file, view.reading, globals, exit_code);
  if (!document) return exit_code;
  input.files.push_back(view.reading.options.opened->at(num_opened).name);
  Diagnostics noticed;
  const auto shown = expect_shown(std::move(*document), file, view, input, noticed);
  const Diagnostics diagnostics = named(noticed, file, view.reading.is_strict);
  print_diagnostics(STDERR_FILENO, diagnostics, globals);
  if (!shown) return print_failure(shown.error(), diagnostics, file, globals);
  return diagnostics.has_errors() ? kInvalid : kDone;
}

/// Reads what all files share: the project and the servo map.
int read_shared(const View& view, ViewInput& input, const Globals& globals) {
  Diagnostics diagnostics;
  diagnostics.warnings_are_errors = view.reading.is_strict;
  Result<void> read;
  if (const auto project = load_project(view.reading, diagnostics); !project) {
    read = fail(project.error());
  } else if (auto map = load_servo_map(view, diagnostics); map) {
    input.servo_map = std::move(*map);
  } else {
    read = fail(map.error());
  }
  print_diagnostics(STDERR_FILENO, diagnostics, globals);
  return read ? kDone : print_failure(read.error(), diagnostics, {}, globals);
}

/// Reads everything that the page shows.
/// \returns the worst of the exit codes
int read_all(const View& view, ViewInput& input, const Globals& globals) {
  int exit_code = read_shared(view, input, globals);
  if (exit_code != kDone) return exit_code;
  input.robot = read_once(source_of_skeleton(view.reading));
  for (const std::string& file : view.files) {
    exit_code = worse(exit_code, read_for_page(file, view, input, globals));
  }
  if (exit_code != kDone) return exit_code;
  if (input.servo_map && !input.has_flow) {
    print_error(make_error(ErrorKind::Usage, "CLI003",
                           fmt::format("--servo-map {} has no effect: no file is a flow of poses",
                                       view.servo_map)),
                globals);
    return kUsage;
  }
  return finish_reading(view.reading, globals, exit_code);
}

/// The option of reading with this name, of the first format that has it, or null.
const ReadOption* find_read_option(std::string_view name) {
  for (const Format& format : formats()) {
    if (const ReadOption* option = find_option(format.read_options, name)) return option;
  }
  return nullptr;
}

/// The options of reading that were given, as the page takes them.
/// \param folder  the page's folder, which contains all of its files
std::vector<std::pair<std::string, std::string>> given_options(const Reading& reading,
                                                               const std::string& folder) {
  std::vector<std::pair<std::string, std::string>> options;
  if (!reading.from.empty()) options.emplace_back("from", reading.from);
  for (const CLI::Option* given : reading.command->get_options()) {
    if (given->count() == 0) continue;
    const std::string name = given->get_single_name();
    const ReadOption* const option = find_read_option(name);
    if (option == nullptr || option->set == nullptr) continue;  // not of reading, or a file
    std::string word = option->info.type == OptionType::Flag ? "" : given->results().back();
    if (option->info.type == OptionType::File) word = path_within(folder, word);
    options.emplace_back(name, std::move(word));
  }
  if (reading.is_lenient) options.emplace_back("lenient", "");
  return options;
}

PageContent content_of(const View& view, const ViewInput& input) {
  const std::vector<CompanionFile>& opened = *view.reading.options.opened;
  std::vector<std::string> names;
  for (const CompanionFile& file : opened) names.push_back(file.name);
  const std::string folder = common_folder(names);
  const auto path_of = [&folder](const std::string& file) {
    return file.empty() ? std::string() : path_within(folder, file);
  };
  PageContent content;
  std::set<std::string> known;
  for (const CompanionFile& file : opened) {
    std::string path = path_of(file.name);
    if (known.insert(path).second) content.files.push_back({std::move(path), file.bytes});
  }
  const Reading& reading = view.reading;
  for (const std::string& file : input.files) {
    content.open.push_back({path_of(file), path_of(reading.skeleton), path_of(reading.project),
                            path_of(view.servo_map), given_options(reading, folder)});
  }
  return content;
}

/// Writes the page and its picture, both or none.
Result<void> write_page_and_picture(const View& view, const std::string& page) {
  const OutputFiles files = files_on_disk(output_options(view.may_replace));
  // A name that cannot be written is told before the browser starts.
  Sink page_sink;
  Sink picture_sink;
  for (auto [name, sink] :
       {std::pair(&view.out, &page_sink), std::pair(&view.png, &picture_sink)}) {
    if (name->empty()) continue;
    auto opened = files.open(*name);
    if (!opened) return fail(std::move(opened.error()));
    *sink = std::move(*opened);
  }
  if (picture_sink) {
    const auto png = picture_of(page, view.picture);
    if (!png) return fail(png.error());
    picture_sink(*png);
  }
  if (page_sink) page_sink(page);
  return files.commit();
}

int run(const View& view, const Globals& globals) {
  if (const std::string fault = view_misuse(view); !fault.empty()) {
    return usage_error(globals, fault);
  }
  ViewInput input;
  if (const int exit_code = read_all(view, input, globals); exit_code != kDone) return exit_code;
  const auto page = page_with(embedded_page(), content_of(view, input));
  const auto written = page ? write_page_and_picture(view, *page) : fail(page.error());
  if (written) return kDone;
  print_error(written.error(), globals);
  return exit_code_of(written.error());
}

void add_picture_options(CLI::App& command, View& view) {
  CLI::Option* png =
      command
          .add_option("--png", view.png, "Write a picture of the page (needs a Chromium browser)")
          ->type_name("OUT.png");
  command
      .add_option("--frames", view.picture.frames,
                  "The picture is a sheet of these frames; B is not included")
      ->needs(png)
      ->type_name("A:B[:STEP]");
  const auto set = [&view](const std::string& text) { return set_size(view.picture, text); };
  command
      .add_option_function<std::string>(
          "--size", [set](const std::string& text) { set(text); }, "Size of the picture, in pixels")
      ->needs(png)
      ->check([set](const std::string& text) {
        return set(text) ? std::string() : "expected WIDTHxHEIGHT, each from 16 to 8192";
      })
      ->default_str("1280x720")
      ->type_name("WxH");
}

}  // namespace

void add_view(CLI::App& app, Globals& globals) {
  auto view = std::make_shared<View>();
  view->reading.options.opened = std::make_shared<std::vector<CompanionFile>>();
  CLI::App* command = app.add_subcommand(
      "view", "Make a page that plays motions in a browser: one file, which needs no network");
  command->add_option("FILE", view->files, "Files to show one over the other; - is standard input")
      ->required();
  command->add_option("-o,--out", view->out, "Page to write (.html); - is standard output")
      ->type_name("OUT");
  add_picture_options(*command, *view);
  command
      ->add_option("--servo-map", view->servo_map,
                   "For a flow of servo poses: a YAML file that says what words mean to joints")
      ->type_name("FILE");
  command->add_flag("--force", view->may_replace, "Replace an existing file");
  add_reading_options(*command, view->reading);
  command->callback(
      [view, &globals] { globals.run = [view, &globals] { return run(*view, globals); }; });
}

}  // namespace kinefile::cli
