// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/recording/objects/object_reader.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "orca/base/log.hpp"
#include "orca/base/text.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/ros/cdr.hpp"

namespace orca::recording {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kEncapsulation = 4;  // [bytes] in front of each object

TimePoint time_of(std::uint64_t ns) { return TimePoint(Duration(static_cast<Duration::rep>(ns))); }

// Returns the file of a recording: of a bag's folder the one that is in it.
Result<std::string> file_of(const std::string& path) {
  std::error_code unused;
  if (!fs::is_directory(path, unused)) return path;
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, unused))
    if (entry.path().extension() == ".mcap") files.push_back(entry.path().string());
  std::ranges::sort(files);
  if (files.size() == 1) return files.front();
  return fail(Code::not_found,
              files.empty() ? "the folder has no MCAP file; of a bag in SQLite, ros2 bag convert makes one"
                            : "the folder has several files; name one of them: " + listed(files),
              path);
}

}  // namespace

Result<ObjectReader> ObjectReader::open(const std::string& path) {
  const Result<std::string> name = file_of(path);
  if (!name) return name.error();
  Result<Reader> file = Reader::open(*name);
  if (!file) return file.error();
  ObjectReader reader(*std::move(file));
  if (const Status found = reader.find_rows(); !found.ok())
    return fail(found.error().code, found.error().message, path);
  if (reader.rows_.empty()) reader.find_topics();
  reader.facts_ = facts_of(reader.file_);
  return reader;
}

Status ObjectReader::find_rows() {
  for (const auto& [id, channel] : file_.channels()) {
    const std::string row = fact(channel.metadata, "orca.port");
    const std::string name = fact(channel.metadata, "orca.type");
    if (row.empty() || name.empty()) continue;
    const ObjectType* const type = find_object_type(name);
    if (type == nullptr)
      return fail(Code::failed_precondition,
                  "objects of the type " + name + " of " + row + " are not known here" +
                      (name.find('.') == std::string::npos
                           ? ""
                           : "; the folder of their library must be among the plugin folders (--plugins)"));
    if (std::strtoull(fact(channel.metadata, "orca.layout").c_str(), nullptr, 16) != type->layout_hash)
      return fail(Code::failed_precondition,
                  "objects of the type " + name + " of " + row +
                      " had other fields when they were recorded; read the file with the build of that time");
    add_row(id, {row, type, nullptr});
  }
  return ok();
}

// Finds the topics of a bag that have something to say to Orca.
void ObjectReader::find_topics() {
  for (const auto& [id, channel] : file_.channels()) {
    const auto schema = file_.schemas().find(channel.schema);
    if (channel.message_encoding != "cdr" || schema == file_.schemas().end()) continue;
    const std::string& message = schema->second.name;
    if (channel.topic == "/tf_static" && message == Reflection<ros::tf2_msgs::TFMessage>::name)
      learn_frames(id);
    const auto twin = std::ranges::find_if(ros::twins(), [&](const ros::Twin& known) {
      return known.from_ros != nullptr && known.message == message;
    });
    if (twin != ros::twins().end()) add_row(id, {channel.topic, &twin->object, &*twin});
  }
}

void ObjectReader::add_row(std::uint16_t channel, Source source) {
  const auto& counts = file_.statistics().by_channel;
  const auto count = counts.find(channel);
  RecordedRow& found = rows_[source.row];
  found.name = source.row;
  found.types[std::string(source.type->name)] += count == counts.end() ? 0 : count->second;
  sources_[channel] = std::move(source);
}

void ObjectReader::learn_frames(std::uint16_t channel) {
  // Damage is reported when the objects are read.
  (void)file_.messages({channel}, [this](const Message& message) {
    ros::tf2_msgs::TFMessage frames;
    if (ros::from_cdr(message.payload, frames).ok()) frames_.learn(frames);
    return true;
  });
}

std::string fact(const Values& facts, const std::string& name) {
  const auto found = facts.find(name);
  return found == facts.end() ? "" : found->second;
}

Values facts_of(const Reader& file) {
  Values facts;
  for (const IndexEntry& entry : file.metadata()) {
    if (entry.name != "orca.recording" && entry.name != "orca.end") continue;
    if (const Result<Metadata> metadata = file.metadata(entry))
      facts.insert(metadata->values.begin(), metadata->values.end());
  }
  return facts;
}

Result<ObjectRef> ObjectReader::object_of(const Source& source, const Message& message) const {
  if (source.twin != nullptr) {
    const auto mount_of = [this](const std::string& frame) { return frames_.mount_of(frame); };
    return source.twin->from_ros(message.payload, mount_of, time_of(message.log_time));
  }
  if (message.payload.size() < kEncapsulation) return fail(Code::data_loss, "an object is cut short");
  ObjectLoan object = make_object(*source.type);
  const Status read = source.type->deserialize(message.payload.subspan(kEncapsulation), object.get());
  if (!read.ok()) return read.error();
  return std::move(object).seal();
}

bool ObjectReader::is_virtual() const { return fact(facts_, "clock") == "virtual"; }

Status ObjectReader::objects(const std::set<std::string>& rows,
                             const std::function<bool(const RecordedObject&)>& take) const {
  std::set<std::uint16_t> channels;
  for (const auto& [id, source] : sources_)
    if (rows.empty() || rows.contains(source.row)) channels.insert(id);
  if (channels.empty()) return ok();  // no channels would be all of them
  Status status = ok();
  std::map<std::string, std::uint64_t> silent;  // messages that are left out, by row
  const Status read = file_.messages(channels, [&](const Message& message) {
    const Source& source = sources_.at(message.channel);
    const Result<ObjectRef> object = object_of(source, message);
    if (!object && source.twin != nullptr) return ++silent[source.row], true;  // as on a live topic
    if (!object) return status = fail(object.error().code, source.row + ": " + object.error().message), false;
    return take({source.row, *object, time_of(message.log_time)});
  });
  for (const auto& [row, count] : silent)
    log::warning(row, std::to_string(count) +
                          " messages of the bag say nothing that Orca understands, and are left out");
  return status.ok() ? read : status;
}

}  // namespace orca::recording
