// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/recording/objects/object_writer.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>

#include "orca/idl/object_type.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"
#include "orca/ros/cdr.hpp"
#include "orca/ros/message_type.hpp"

namespace orca::recording {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestAttachment = std::uintmax_t{16} << 20;  // [bytes]
constexpr std::array kEncapsulationHead{std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}};

Stamp stamp_of(TimePoint time) {
  return static_cast<Stamp>(std::max<std::int64_t>(time.time_since_epoch().count(), 0));
}

std::string hex(std::uint64_t number) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(number));
  return text;
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

// Returns the files that values of attributes in a graph name.
std::set<std::string> files_in(const std::string& graph) {
  std::set<std::string> files;
  for (std::size_t at = graph.find("\"/"); at != std::string::npos; at = graph.find("\"/", at + 1)) {
    const std::size_t end = graph.find('"', at + 1);
    if (end == std::string::npos) break;
    const std::string path = graph.substr(at + 1, end - at - 1);
    std::error_code error;
    if (path.ends_with(".mcap")) continue;  // what a replay plays
    if (fs::is_regular_file(path, error) && fs::file_size(path, error) <= kLargestAttachment)
      files.insert(path);
  }
  return files;
}

std::string media_type_of(const std::string& path) {
  const std::string extension = fs::path(path).extension();
  if (extension == ".xml" || extension == ".urdf") return "application/xml";
  if (extension == ".png") return "image/png";
  return extension == ".csv" ? "text/csv" : "application/octet-stream";
}

}  // namespace

std::string topic_of(std::string_view row) {
  std::string topic = "/" + std::string(row);
  std::ranges::replace(topic, '.', '/');
  return topic;
}

ObjectWriter::ObjectWriter(std::unique_ptr<Output> output) : writer_(std::move(output), "ros2", "orca") {}

Status ObjectWriter::begin(const Origin& origin) {
  Metadata metadata{"orca.recording", origin.more};
  metadata.values["format"] = "1";
  metadata.values["graph"] = origin.graph;
  metadata.values["clock"] = origin.is_virtual ? "virtual" : "steady";
  metadata.values["log_time"] = origin.is_virtual
                                    ? "when an object passed its port [ns of the run's virtual clock]"
                                    : "when an object passed its port [ns since 1970, by the run's clock]";
  metadata.values["publish_time"] =
      "when its data were sensed, or else when it was made [ns of the same clock]";
  metadata.values["ports"] = joined(origin.ports);
  if (!origin.is_virtual) metadata.values["begun"] = utc_now();  // a virtual run depends on nothing outside
  return writer_.note(metadata);
}

Status ObjectWriter::attach_graph(const std::string& graph) {
  const auto bytes = std::as_bytes(std::span(graph));
  Status attached = writer_.attach({0, 0, "graph.xml", "application/xml", {bytes.begin(), bytes.end()}});
  for (const std::string& path : files_in(graph)) {
    std::ifstream file(path, std::ios::binary);
    const std::string content{std::istreambuf_iterator<char>(file), {}};
    const auto data = std::as_bytes(std::span(content));
    if (attached.ok())
      attached = writer_.attach({0, 0, path, media_type_of(path), {data.begin(), data.end()}});
  }
  return attached;
}

Status ObjectWriter::attach_json(const std::string& name, const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return writer_.attach({0, 0, name, "application/json", {bytes.begin(), bytes.end()}});
}

ObjectWriter::Row& ObjectWriter::row_of(std::string_view row, const ObjectType& type) {
  auto types = rows_.find(row);
  if (types == rows_.end()) types = rows_.emplace(std::string(row), TypeRows{}).first;
  const auto known = std::ranges::find(types->second, &type, &TypeRows::value_type::first);
  if (known != types->second.end()) return known->second;
  const ros::MessageType message = ros::message_type_of(type);
  const std::uint16_t schema = writer_.add_schema(message.name, "ros2msg", message.definition);
  const std::uint16_t channel = writer_.add_channel(schema, topic_of(row), "cdr",
                                                    {{"orca.port", std::string(row)},
                                                     {"orca.type", std::string(type.name)},
                                                     {"orca.layout", hex(type.layout_hash)}});
  return types->second.emplace_back(&type, Row{channel, 0}).second;
}

std::uint16_t ObjectWriter::channel_of(std::string_view message_type, const std::string& topic) {
  const std::optional<ros::MessageType> type = ros::standard_message_type(message_type);
  return writer_.add_channel(
      type ? writer_.add_schema(type->name, "ros2msg", type->definition) : std::uint16_t{0}, topic, "cdr",
      {});
}

Status ObjectWriter::add(std::string_view row, const ObjectRef& object, TimePoint passed) {
  Row& places = row_of(row, object.type());
  payload_.assign(kEncapsulationHead.begin(), kEncapsulationHead.end());
  // Alignment counts from the byte after the encapsulation header, so the object is written apart.
  const std::size_t size = object.type().write(object.get(), {});
  payload_.resize(kEncapsulationHead.size() + size);
  (void)object.type().write(object.get(), std::span(payload_).subspan(kEncapsulationHead.size()));
  const Message message{places.channel, static_cast<std::uint32_t>(object.header().seq()), stamp_of(passed),
                        stamp_of(object.stamp()), payload_};
  if (Status written = writer_.write(message); !written.ok()) return written;
  return add_twins(row, places, object, message);
}

Status ObjectWriter::add_twins(std::string_view row, Row& places, const ObjectRef& object,
                               const Message& like) {
  if (const std::optional<ros::RosMessage> twin = ros::ros_twin(object)) {
    if (places.twin == 0)
      places.twin = channel_of(twin->type, row == kLogRow ? "/rosout" : "/ros" + topic_of(row));
    if (Status written =
            writer_.write({places.twin, like.sequence, like.log_time, like.publish_time, twin->payload});
        !written.ok())
      return written;
  }
  if (const std::optional<ros::FrameNews> frames = frames_.hear(object)) {
    if (frames_channel_ == 0) frames_channel_ = channel_of(Reflection<ros::tf2_msgs::TFMessage>::name, "/tf");
    return writer_.write(
        {frames_channel_, 0, like.log_time, like.publish_time, ros::to_cdr(frames->message)});
  }
  return ok();
}

ObjectRef log_record(log::Level level, const std::string& source, const std::string& text,
                     TimePoint written) {
  Loan<idl::LogRecord> record = make_object<idl::LogRecord>();
  record->level(
      static_cast<idl::LogLevel>(std::min(static_cast<int>(level), static_cast<int>(idl::LEVEL_ERROR))));
  record->source(source);
  record->text(text);
  record->stamp(to_time_value(written));
  record->creation_time(to_time_value(written));
  return std::move(record).seal().ref();
}

Status ObjectWriter::close(const std::map<std::string, std::uint64_t>& lost, const Values& more) {
  Metadata metadata{"orca.end", more};
  std::uint64_t sum = 0;
  for (const auto& [port, count] : lost) {
    if (count > 0) metadata.values["lost." + port] = std::to_string(count);
    sum += count;
  }
  metadata.values["lost"] = std::to_string(sum);
  if (Status flushed = writer_.flush(); !flushed.ok()) return flushed;
  if (Status noted = writer_.note(metadata); !noted.ok()) return noted;
  return writer_.close();
}

}  // namespace orca::recording
