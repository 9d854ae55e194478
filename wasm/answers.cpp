// SPDX-License-Identifier: MIT
#include "answers.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "describe.hpp"
#include "kinefile/check.hpp"
#include "kinefile/io.hpp"
#include "kinefile/joint_curves.hpp"
#include "kinefile/limits.hpp"
#include "kinefile/marks.hpp"
#include "kinefile/process.hpp"
#include "kinefile/retime.hpp"
#include "kinefile/robot.hpp"
#include "opening.hpp"
#include "writing.hpp"

namespace kinefile::page {
namespace {

/// The place of numbers or bytes in the module's memory.
template <class T>
Json place_of(const T* data, std::size_t size) {
  return {{"at", reinterpret_cast<std::uintptr_t>(data)}, {"size", size}};
}

Json as_floats(Held& held, const Array<double>& values) {
  Array<float> floats(values.size());
  const std::span<float> out = floats.mutate();
  std::transform(values.begin(), values.end(), out.begin(),
                 [](double value) { return static_cast<float>(value); });
  held.floats.push_back(std::move(floats));
  return place_of(held.floats.back().data(), values.size());
}

Json as_doubles(Held& held, Array<double> values) {
  held.doubles.push_back(std::move(values));
  return place_of(held.doubles.back().data(), held.doubles.back().size());
}

Json failure(const Error& error, const Diagnostics& diagnostics) {
  return {{"error", json_of(static_cast<const Diagnostic&>(error))},
          {"diagnostics", json_of(diagnostics)}};
}

/// The failure of a question that does not fit.
Json refusal(const char* message) {
  return failure(make_error(ErrorKind::Usage, "CLI001", message), {});
}

Slot* slot_of(Session& session, const Json& question) {
  const auto found = session.slots.find(question.value("handle", 0));
  return found == session.slots.end() ? nullptr : &found->second;
}

std::size_t count_of(const Json& question, const char* key, std::size_t most) {
  const double given = question.value(key, 0.0);
  return given > 0 ? static_cast<std::size_t>(std::min(given, static_cast<double>(most))) : 0;
}

Opening opening_of(const Json& question) {
  const Json options = question.value("options", Json::object());
  return {.path = text_of(question, "path"),
          .from = text_of(options, "from"),
          .skeleton = text_of(question, "skeleton"),
          .servo_map = text_of(question, "servo_map"),
          .project = text_of(question, "project"),
          .options = options};
}

/// How a file opens leniently: the words to ask `open` with; null: it does not.
Json words_of(const std::optional<Opening>& opening) {
  if (!opening) return nullptr;
  return {{"skeleton", opening->skeleton},
          {"servo_map", opening->servo_map},
          {"project", opening->project},
          {"options", opening->options}};
}

/// Opens one file, or opens it again in place of a document: {"path", "skeleton", "servo_map",
/// "project", "options", "handle"}.
Json open_file(Session& session, const Json& question) {
  Diagnostics diagnostics;
  const int given = question.value("handle", 0);
  const Opening opening = opening_of(question);
  auto slot = open(session, opening, diagnostics);
  if (!slot) {
    Json failed = failure(slot.error(), diagnostics);
    if (given == 0) failed["leniently"] = words_of(lenient_opening(session, opening, slot.error()));
    return failed;
  }
  const int handle = given != 0 ? given : session.next_handle++;
  session.slots.insert_or_assign(handle, std::move(*slot));
  return {{"handle", handle},
          {"document", describe(session.slots.at(handle))},
          {"diagnostics", json_of(diagnostics)}};
}

/// Opens several files: {"paths", "few"}. The answer has all open documents, and describes those
/// that are new or were read again.
Json open_files(Session& session, const Json& question) {
  const auto paths = question.value("paths", std::vector<std::string>());
  std::vector<std::string> known;
  for (const std::string& path : paths) {
    if (session.files.contains(path)) known.push_back(path);
  }
  constexpr const char* kWhats[] = {"document", "companion", "waiting", "fault", "unknown"};
  const std::size_t few = count_of(question, "few", known.size());
  const OpenedFiles all = open_all(session, known, few > 0 ? std::optional(few) : std::nullopt);
  Json opened = Json::array();
  for (const Opened& one : all.files) {
    const Format* format = find_format(one.format);
    opened.push_back({{"path", one.path},
                      {"what", kWhats[static_cast<std::size_t>(one.what)]},
                      {"format", one.format},
                      {"handle", one.handle},
                      {"is_model", format != nullptr && !is_written(*format)},
                      {"diagnostics", json_of(one.diagnostics)},
                      {"leniently", words_of(one.leniently)}});
  }
  Json documents = Json::array();
  for (const auto& [handle, slot] : session.slots) {
    const bool is_changed = all.changed.contains(handle);
    documents.push_back({{"handle", handle}, {"document", is_changed ? describe(slot) : Json()}});
  }
  return {{"opened", std::move(opened)}, {"documents", std::move(documents)}};
}

Json close(Session& session, const Json& question) {
  session.slots.erase(question.value("handle", 0));
  return Json::object();
}

/// {"handle", "steps"}: see `apply_steps`.
Json edit(Session& session, Slot& slot, const Json& question) {
  Diagnostics diagnostics;
  const auto applied =
      apply_steps(session, slot, question.value("steps", Json::array()), diagnostics);
  if (!applied) return failure(applied.error(), diagnostics);
  return {{"document", describe(slot)}, {"diagnostics", json_of(diagnostics)}};
}

/// {"handle", "first", "count"}: positions [frame][joint][3], rotations [frame][joint][4] as
/// w x y z, tips [frame][tip][3], as floats in the file's unit of length.
Json poses(Held& held, const Slot& slot, const Json& question) {
  const std::size_t num_frames = slot.table.frames.num_frames();
  const std::size_t first = count_of(question, "first", num_frames);
  const std::size_t count = count_of(question, "count", num_frames - first);
  if (count == 0) return {{"count", 0}};
  const PoseArrays poses = poses_of(slot.table, {first, first + count, 1});
  return {{"first", first},
          {"count", count},
          {"positions", as_floats(held, poses.positions)},
          {"rotations", as_floats(held, poses.rotations)},
          {"tips", as_floats(held, poses.tips)}};
}

/// The values of a robot's joint, in the units that its description has, and which limit each of
/// them is beyond.
Json dof_values(const Motion& motion, const Joint& joint, std::span<const double> row) {
  Json json = Json::array();
  for (const DegreeOfFreedom& dof : joint.dofs) {
    if (num_coordinates(dof) != 1) continue;
    const double value = value_of(dof, row[dof.coordinate]);
    const auto breach = breach_of(dof, value);
    const bool is_below = breach == LimitBreach::Kind::Below;
    json.push_back({{"value", number(value * told_unit(dof, motion.skeleton).factor)},
                    {"beyond", breach ? Json(is_below ? "below" : "above") : Json()}});
  }
  return json;
}

/// {"handle", "frame", "joint"}: the joint's pose and its values.
Json joint(const Slot& slot, const Json& question) {
  const Motion& motion = motion_of(slot);
  const std::size_t num_frames = slot.table.frames.num_frames();
  const std::size_t j = count_of(question, "joint", motion.skeleton.joints.size());
  const std::size_t frame = count_of(question, "frame", num_frames);
  if (j >= motion.skeleton.joints.size() || frame >= num_frames) return {{"channels", Json()}};
  const PoseArrays poses = poses_of(slot.table, {frame, frame + 1, 1});
  Json json;
  for (std::size_t k = 0; k < 3; ++k)
    json["position"].push_back(number(poses.positions[j * 3 + k]));
  for (std::size_t k = 0; k < 4; ++k)
    json["rotation"].push_back(number(poses.rotations[j * 4 + k]));
  json["channels"] = Json::array();
  const auto row = motion.clip.row(frame);
  for (std::size_t c = 0; c < row.size(); ++c) {
    const Coordinate& coordinate = motion.skeleton.coordinates[c];
    if (coordinate.joint == j)
      json["channels"].push_back({{"name", coordinate.channel}, {"value", number(row[c])}});
  }
  if (j > 0 && is_of_robot(slot)) json["dofs"] = dof_values(motion, motion.skeleton.joints[j], row);
  return json;
}

/// {"handle", "column"}: a column of the clip, as doubles.
Json column(Held& held, const Slot& slot, const Json& question) {
  const Clip& clip = motion_of(slot).clip;
  const std::size_t c = count_of(question, "column", clip.num_coordinates);
  if (c >= clip.num_coordinates) return refusal("there is no such column");
  Array<double> values(clip.num_frames);
  const std::span<double> out = values.mutate();
  for (std::size_t f = 0; f < clip.num_frames; ++f) out[f] = clip.row(f)[c];
  return {{"values", as_doubles(held, std::move(values))}};
}

/// {"handle", "joint"}: how a joint moves in the world, as doubles.
Json curves(Held& held, const Slot& slot, const Json& question) {
  const Motion& motion = motion_of(slot);
  const std::size_t joints[] = {count_of(question, "joint", motion.skeleton.joints.size())};
  if (joints[0] >= motion.skeleton.joints.size()) return refusal("there is no such joint");
  JointCurves curves = std::move(joint_curves(motion, joints).front());
  Array<double> times(motion.clip.num_frames);
  const std::span<double> out = times.mutate();
  for (std::size_t f = 0; f < out.size(); ++f) out[f] = time_of_frame(motion.clip.timeline, f);
  return {{"times", as_doubles(held, std::move(times))},
          {"positions", as_doubles(held, std::move(curves.positions))},
          {"speeds", as_doubles(held, std::move(curves.speeds))},
          {"angular_speeds", as_doubles(held, std::move(curves.angular_speeds))}};
}

/// {"handle"}: what happens on the timeline.
Json marks(const Slot& slot) {
  constexpr const char* kKinds[] = {"spike", "flip", "below", "above", "fast"};
  Json marks = Json::array();
  for (const Mark& mark : find_marks(motion_of(slot))) {
    marks.push_back({{"kind", kKinds[static_cast<std::size_t>(mark.kind)]},
                     {"severity", severity_name(mark.severity)},
                     {"joint", mark.joint},
                     {"first_frame", mark.first_frame},
                     {"num_frames", mark.num_frames},
                     {"worst_frame", mark.worst_frame},
                     {"code", mark.code},
                     {"message", mark.message}});
  }
  return {{"marks", std::move(marks)}};
}

/// {"handle"}: where feet are on the ground.
Json contacts(const Slot& slot) {
  if (!slot.lacks.empty()) return {{"contacts", Json::array()}, {"diagnostics", Json::array()}};
  Diagnostics diagnostics;
  const auto found = retime::ground_contacts(motion_of(slot), diagnostics);
  if (!found) return failure(found.error(), diagnostics);
  Json contacts = Json::array();
  for (const retime::GroundContact& contact : *found) {
    contacts.push_back({{"joint", contact.joint},
                        {"tip", contact.is_tip ? Json(contact.tip) : Json()},
                        {"first_frame", contact.first_frame},
                        {"num_frames", contact.num_frames}});
  }
  return {{"contacts", std::move(contacts)}, {"diagnostics", json_of(diagnostics)}};
}

/// {"handle"}: the ZMP of each frame in the world, [frame][3], in the file's unit of length; empty
/// where the data holds none.
Json zmp(Held& held, const Slot& slot) {
  const Motion& motion = motion_of(slot);
  const BodyMotion* body = std::get_if<BodyMotion>(&slot.current.content);
  if (body == nullptr) return {{"points", as_doubles(held, {})}};
  Diagnostics ignored;
  const auto in_world = robot::zmp(*body, false, ignored);
  const Component* found =
      in_world ? find_component(*in_world, ComponentKind::Vectors, kZmp) : nullptr;
  if (found == nullptr || !have_same_times(found->timeline, motion.clip.timeline)) {
    return {{"points", as_doubles(held, {})}};
  }
  Array<double> points = found->values;
  for (double& value : points.mutate()) value /= motion.skeleton.metres_per_unit;
  return {{"points", as_doubles(held, std::move(points))}};
}

/// {"handle"}: the diagnostics of reading the file and of checking it.
Json check_document(const Slot& slot) {
  Diagnostics diagnostics = slot.noticed;
  CheckOptions options;
  options.name = slot.opening.path;
  // A flow is checked as a program; what its motion does on the robot, the marks tell.
  if (std::holds_alternative<BodyMotion>(slot.source.content)) {
    options.robot = source_of_model(slot);
  }
  check(slot.source, options, diagnostics);
  return {{"diagnostics", json_of(diagnostics)}};
}

/// The files that were written, for the page to offer.
Json files_of(Held& held, std::vector<MemoryFile>&& files) {
  Json json = Json::array();
  for (MemoryFile& file : files) {
    held.texts.push_back(std::move(file.bytes));
    Json place = place_of(held.texts.back().data(), held.texts.back().size());
    place["name"] = file.name;
    json.push_back(std::move(place));
  }
  return json;
}

/// {"handle", "name", "format", "options"}: the document after its steps, converted.
Json write_document(const Session& session, Held& held, Slot& slot, const Json& question) {
  const std::string name = text_of(question, "name"), wanted = text_of(question, "format");
  const Format* format = wanted.empty() ? format_of_name(name) : find_format(wanted);
  Diagnostics diagnostics;
  if (format == nullptr) {
    return failure(make_error(ErrorKind::Usage, "CLI001", "the name shows no format", name),
                   diagnostics);
  }
  const Json words = question.value("options", Json::object());
  auto files = written_files(session, slot, {name, *format, words}, diagnostics);
  if (!files) return failure(files.error(), diagnostics);
  return {{"files", files_of(held, std::move(*files))}, {"diagnostics", json_of(diagnostics)}};
}

/// {"handle"}: the formats that are written, by name, and why the document cannot be written in
/// some; empty: it can.
Json written_formats(const Session& session, const Slot& slot) {
  Json hindrances;
  for (const Format& format : formats()) {
    if (!is_written(format)) continue;
    hindrances[std::string(format.name)] = hindrance_of_writing(session, slot, format);
  }
  return {{"hindrances", std::move(hindrances)}};
}

/// {"handle", "name", "tips"}: a table of world positions.
Json write_poses(Held& held, const Slot& slot, const Json& question) {
  const std::string name = text_of(question, "name");
  const Format* format = format_of_name(name);
  if (format == nullptr || format->write_poses == nullptr) {
    return failure(
        make_error(ErrorKind::Usage, "CLI001", "no table of poses has such a name", name), {});
  }
  FkTable table = slot.table;
  table.options.rotations = false;
  table.options.tips = question.value("tips", false);
  std::string text;
  const auto written = write_table(table, *format, {}, [&text](std::string_view piece) {
    text += piece;
    return true;
  });
  if (!written) return failure(written.error(), {});
  std::vector<MemoryFile> files = {{name, std::move(text)}};
  return {{"files", files_of(held, std::move(files))}};
}

/// {"path"}: a file, exactly as it was given.
Json source(const Session& session, const Json& question) {
  const auto found = session.files.find(text_of(question, "path"));
  if (found == session.files.end()) return {{"files", Json::array()}};
  Json place = place_of(found->second->data(), found->second->size());
  place["name"] = found->first;
  return {{"files", {std::move(place)}}};
}

}  // namespace

Json answer(Session& session, Held& held, const Json& question) {
  held = {};
  held.floats.reserve(8);  // so that no array moves
  held.doubles.reserve(8);
  held.texts.reserve(64);
  const std::string ask = text_of(question, "ask");
  if (ask == "tables") return tables();
  if (ask == "open") return open_file(session, question);
  if (ask == "open_all") return open_files(session, question);
  if (ask == "close") return close(session, question);
  if (ask == "source") return source(session, question);
  Slot* const slot = slot_of(session, question);
  if (slot == nullptr) return refusal("no such document is open");
  if (ask == "edit") return edit(session, *slot, question);
  if (ask == "poses") return poses(held, *slot, question);
  if (ask == "joint") return joint(*slot, question);
  if (ask == "column") return column(held, *slot, question);
  if (ask == "curves") return curves(held, *slot, question);
  if (ask == "marks") return marks(*slot);
  if (ask == "contacts") return contacts(*slot);
  if (ask == "zmp") return zmp(held, *slot);
  if (ask == "check") return check_document(*slot);
  if (ask == "write") return write_document(session, held, *slot, question);
  if (ask == "written_formats") return written_formats(session, *slot);
  if (ask == "write_poses") return write_poses(held, *slot, question);
  return failure(make_error(ErrorKind::Usage, "CLI001", "there is no question '" + ask + "'"), {});
}

}  // namespace kinefile::page
