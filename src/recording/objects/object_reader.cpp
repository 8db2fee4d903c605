// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/recording/objects/object_reader.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

#include "orca/base/log.hpp"
#include "orca/base/text.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/ros/cdr.hpp"

namespace orca::recording {
namespace {

constexpr std::size_t kEncapsulation = 4;  // [bytes] in front of each object
constexpr std::size_t kMostFrames = 20;    // of which it is reported that nobody knows their place

TimePoint time_of(std::uint64_t ns) { return TimePoint(Duration(static_cast<Duration::rep>(ns))); }

// Returns whether a payload was compressed by rosbag2, which does so to single messages if it is told to.
bool is_compressed(std::span<const std::byte> payload) {
  constexpr std::array kFrame{std::byte{0x28}, std::byte{0xB5}, std::byte{0x2F}, std::byte{0xFD}};
  return payload.size() >= kFrame.size() && std::ranges::equal(kFrame, payload.first(kFrame.size()));
}

// Messages of a bag that no object says.
struct LeftOut {
  void add(const std::string& why) {
    if (count++ == 0) first = why;
  }
  [[nodiscard]] std::string text(const std::string& row) const {
    return row + ": " + std::to_string(count) + (count == 1 ? " message is" : " messages are") +
           " left out, the first because " + first;
  }

  std::uint64_t count = 0;
  std::string first;
};

std::vector<std::string> names_of(const std::map<std::string, RecordedRow>& rows) {
  std::vector<std::string> names;
  for (const auto& [name, row] : rows) names.push_back(name);
  if (names.empty()) names.emplace_back("nothing that Orca understands");
  return names;
}

bool is_topic(const std::string& row) { return row.starts_with('/'); }

// Returns the topics of a bag that have objects of the type that the name of a port ends with.
std::vector<std::string> topics_for(const std::map<std::string, RecordedRow>& rows, const std::string& port) {
  constexpr std::string_view kPush = "Push";
  std::vector<std::string> found;
  if (!port.ends_with(kPush)) return found;
  const std::string type = port.substr(port.rfind('.') + 1);
  for (const auto& [name, row] : rows)
    if (is_topic(name) && row.types.contains(type.substr(0, type.size() - kPush.size())))
      found.push_back(name);
  // Of topics that were recorded and silent none is meant, as long as another one spoke.
  const auto is_silent = [&](const std::string& name) { return rows.at(name).types.begin()->second == 0; };
  if (!std::ranges::all_of(found, is_silent)) std::erase_if(found, is_silent);
  return found;
}

void log_flaws(const Reader& file, const std::vector<std::string>& found) {
  if (const std::string damage = damage_of(file); !damage.empty()) log::warning("bag", damage);
  for (const std::string& flaw : found) log::warning("bag", flaw);
}

}  // namespace

Result<ObjectReader> ObjectReader::open(const std::string& path) {
  Result<Reader> file = Reader::open(path);
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
    if (schema == file_.schemas().end()) continue;
    is_bag_ = true;
    const std::string& message = schema->second.name;
    if (channel.message_encoding != "cdr") {
      others_[channel.topic] = message + " in the encoding '" + channel.message_encoding + "'";
      continue;
    }
    if (channel.topic == "/tf_static" && message == Reflection<ros::tf2_msgs::TFMessage>::name)
      learn_frames(id);
    const auto twin = std::ranges::find_if(ros::twins(), [&](const ros::Twin& known) {
      return known.from_ros != nullptr && known.message == message;
    });
    if (twin != ros::twins().end())
      add_row(id, {channel.topic, &twin->object, &*twin});
    else
      others_[channel.topic] = message;
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

std::string damage_of(const Reader& file) {
  const std::vector<Finding>& findings = file.findings();
  if (file.has_index() || findings.empty() || findings.front().offset == 0)
    return {};  // bags in SQLite say it themselves
  const std::string more =
      findings.size() > 1 ? ", and " + std::to_string(findings.size() - 1) + " more" : "";
  return "only what is whole of the recording is read; byte " + std::to_string(findings.front().offset) +
         ": " + findings.front().text + more +
         "; orcactl bag check says all, and recover writes what is whole";
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

Result<ObjectRef> ObjectReader::object_of(const Source& source, const Message& message,
                                          std::set<std::string>& unknown_frames) const {
  if (source.twin != nullptr) {
    const auto mount_of = [&](const std::string& frame) {
      auto mount = frames_.mount_of(frame);
      if (!mount && unknown_frames.size() < kMostFrames) unknown_frames.insert(frame);
      return mount;
    };
    Result<ObjectRef> object = source.twin->from_ros(message.payload, mount_of, time_of(message.log_time));
    if (!object && is_compressed(message.payload))
      return fail(Code::unimplemented,
                  "its messages are compressed one by one; ros2 bag convert writes them as they were");
    return object;
  }
  if (message.payload.size() < kEncapsulation) return fail(Code::data_loss, "an object is cut short");
  ObjectLoan object = make_object(*source.type);
  const Status read = source.type->deserialize(message.payload.subspan(kEncapsulation), object.get());
  if (!read.ok()) return read.error();
  return std::move(object).seal();
}

bool ObjectReader::is_virtual() const { return fact(facts_, "clock") == "virtual"; }

Status ObjectReader::objects(const std::set<std::string>& rows,
                             const std::function<bool(const RecordedObject&)>& take,
                             std::vector<std::string>* flaws) const {
  std::set<std::uint16_t> channels;
  for (const auto& [id, source] : sources_)
    if (rows.empty() || rows.contains(source.row)) channels.insert(id);
  if (channels.empty()) return ok();  // no channels would be all of them
  Status status = ok();
  std::map<std::string, LeftOut> left_out;  // by row
  std::set<std::string> unknown_frames;
  const Status read = file_.messages(channels, [&](const Message& message) {
    const Source& source = sources_.at(message.channel);
    const Result<ObjectRef> object = object_of(source, message, unknown_frames);
    if (!object && source.twin != nullptr && object.error().code != Code::unimplemented)
      return left_out[source.row].add(object.error().message), true;  // as on a live topic
    if (!object) return status = fail(object.error().code, source.row + ": " + object.error().message), false;
    return take({source.row, *object, time_of(message.log_time)});
  });
  std::vector<std::string> found;
  for (const auto& [row, messages] : left_out) found.push_back(messages.text(row));
  for (const std::string& frame : unknown_frames)
    found.push_back("its /tf_static does not say where '" + frame +
                    "' is; readings in that frame are taken to be from the middle of the robot");
  if (flaws == nullptr)
    log_flaws(file_, found);
  else
    flaws->insert(flaws->end(), found.begin(), found.end());
  return status.ok() ? read : status;
}

Result<std::string> find_row(const std::map<std::string, RecordedRow>& rows,
                             const std::map<std::string, std::string>& others, const std::string& name) {
  if (rows.contains(name)) return name;
  if (const auto other = others.find(name); other != others.end())
    return fail(Code::not_found, in_quotes(name) + " has messages of type " + other->second +
                                     ", which no object of Orca says; it has: " + listed(names_of(rows)));
  const std::vector<std::string> topics = topics_for(rows, name);
  if (topics.size() == 1) return topics.front();
  if (topics.size() > 1)
    return fail(Code::invalid_argument, "several topics of the bag may be meant by " + in_quotes(name) +
                                            "; name one of them in its place: " + listed(topics));
  return fail(Code::not_found,
              "the recording has nothing of " + in_quotes(name) + "; it has: " + listed(names_of(rows)));
}

}  // namespace orca::recording
