// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "replay/recorded_system.hpp"

#include <algorithm>
#include <deque>
#include <nlohmann/json.hpp>
#include <utility>

#include "answers.hpp"
#include "orca/idl/system.hpp"
#include "orca/recording/objects/object_writer.hpp"
#include "orca/text/object_table.hpp"

namespace orca::view {
namespace {

using nlohmann::json;
using recording::Message;
using supervisor::Record;
using supervisor::Tapped;

constexpr std::size_t kEncapsulation = 4;  // [bytes] in front of each object
constexpr std::size_t kMostOpened = 200;   // chunks that are opened for one object or for the log

bool is_port(const std::string& row) { return row.find('.') != std::string::npos; }

// Returns the text of an attachment; empty: it is not there.
std::string attached(const recording::Reader& file, const std::string& name) {
  for (const recording::IndexEntry& entry : file.attachments()) {
    if (entry.name != name) continue;
    const Result<recording::Attachment> found = file.attachment(entry);
    if (found) return {reinterpret_cast<const char*>(found->data.data()), found->data.size()};
  }
  return {};
}

std::string field(const ObjectRef& object, const std::string& name) {
  const auto texts = field_texts(object.type(), object.get(), name);
  return texts && texts->size() == 1 ? texts->front().text : "";
}

// Without an index nobody knows.
bool may_have(const recording::ChunkIndex& chunk, const std::set<std::uint16_t>& channels) {
  const auto& in_it = chunk.message_index_offsets;
  return in_it.empty() || std::ranges::any_of(channels, [&](auto id) { return in_it.contains(id); });
}

std::string text_in(const json& row, const char* name) {
  return row.contains(name) && row[name].is_string() ? row[name].get<std::string>() : "";
}

}  // namespace

Result<RecordedSystem> RecordedSystem::open(const std::string& path) {
  Result<recording::ObjectReader> reader = recording::ObjectReader::open(path);
  if (!reader) return reader.error();
  if (reader->rows().empty())
    return fail(Code::failed_precondition, "nothing of a system is in this recording", path);
  RecordedSystem system(*std::move(reader));
  system.name_ = recording::fact(system.reader_.facts(), "graph");
  system.find_sources();
  system.read_structure();
  system.read_alarms();
  return system;
}

void RecordedSystem::find_sources() {
  for (const auto& [id, channel] : reader_.file().channels()) {
    const std::string row = recording::fact(channel.metadata, "orca.port");
    const std::string type = recording::fact(channel.metadata, "orca.type");
    if (!row.empty() && !type.empty()) sources_[id] = {row, type};
  }
}

void RecordedSystem::read_structure() {
  graph_ = attached(reader_.file(), "graph.json");
  ports_ = attached(reader_.file(), "ports.json");
  const json ports = read_json(ports_);
  if (!read_json(graph_).is_object() || !ports.is_array()) return make_up_structure();
  for (const json& port : ports) {
    if (!port.is_object() || !port.contains("connected_to") || !port["connected_to"].is_array()) continue;
    for (const json& other : port["connected_to"])
      if (other.is_string()) connected_[text_in(port, "port")].push_back(other.get<std::string>());
  }
}

void RecordedSystem::make_up_structure() {
  json components = json::array();
  json ports = json::array();
  std::set<std::string> names;
  for (const auto& [name, row] : reader_.rows()) {
    if (!is_port(name)) continue;
    const std::string component = name.substr(0, name.rfind('.'));
    if (names.insert(component).second)
      components.push_back({{"name", component}, {"type", ""}, {"process", "recorded"}});
    ports.push_back({{"port", name},
                     {"declared_as", name.substr(name.rfind('.') + 1)},
                     {"process", "recorded"},
                     {"pattern", "Push"},
                     {"role", "Server"},
                     {"type", row.types.begin()->first},
                     {"required", false},
                     {"many", true},
                     {"disabled", false},
                     {"connected_to", json::array()},
                     {"text", ""}});
  }
  graph_ = json{{"name", name_}, {"components", components}, {"connections", json::array()}}.dump();
  ports_ = ports.dump();
}

std::vector<Record> RecordedSystem::components() const {
  std::vector<Record> rows;
  const json graph = read_json(graph_);
  if (!graph.is_object() || !graph.contains("components") || !graph["components"].is_array()) return rows;
  for (const json& one : graph["components"]) {
    if (!one.is_object()) continue;
    rows.push_back({{"name", text_in(one, "name")},
                    {"type", text_in(one, "type")},
                    {"process", text_in(one, "process")},
                    {"pid", 0},
                    {"state", "recorded"},
                    {"plugin", ""},
                    {"build_id", ""},
                    {"restarts", 0},
                    {"alarms", ""},
                    {"memory_mb", 0.0, 1},
                    {"log_per_s", 0.0, 1}});
  }
  return rows;
}

void RecordedSystem::read_alarms() {
  std::uint64_t number = 0;
  (void)reader_.objects({std::string(recording::kAlarmRow)}, [&](const recording::RecordedObject& one) {
    const std::string own = field(one.object, "own_kind");
    const std::string kind = own.empty() ? field(one.object, "kind") : own;
    const std::string source = field(one.object, "source");
    AlarmChange& change = alarm_changes_.emplace_back();
    change.time = static_cast<Stamp>(one.passed.time_since_epoch().count());
    change.key = kind + "\n" + source;
    if (field(one.object, "active") != "true") return true;
    change.row = {
        {"number", ++number},
        {"time", to_seconds(one.passed.time_since_epoch() - Duration(static_cast<std::int64_t>(begin()))), 3},
        {"severity", field(one.object, "severity")},
        {"kind", kind},
        {"source", source},
        {"process", ""},
        {"times", 1},
        {"active", true},
        {"mission", 0},
        {"text", field(one.object, "text")}};
    return true;
  });
}

std::vector<Record> RecordedSystem::alarms(Stamp now) const {
  std::map<std::string, Record> active;
  for (const AlarmChange& change : alarm_changes_) {
    if (change.time > now) break;
    if (change.row)
      active[change.key] = *change.row;
    else
      active.erase(change.key);
  }
  std::vector<Record> rows;
  for (auto& [key, row] : active) rows.push_back(std::move(row));
  return rows;
}

std::vector<Record> RecordedSystem::log(Stamp from, Stamp to, const std::set<std::string>& who) const {
  static const std::map<std::string, std::string> levels{{"LEVEL_DEBUG", "debug"},
                                                         {"LEVEL_INFO", "info"},
                                                         {"LEVEL_WARNING", "warning"},
                                                         {"LEVEL_ERROR", "error"}};
  std::deque<Record> rows;
  (void)pass({std::string(recording::kLogRow)}, from, to, [&](const std::string&, const Tapped& passed) {
    ObjectLoan object = make_object(*find_object_type(passed.type));
    if (!object.type().deserialize(passed.object, object.get()).ok()) return true;
    const ObjectRef line = std::move(object).seal();
    const std::string source = field(line, "source");
    if (!who.empty() && !who.contains(source)) return true;
    const auto level = levels.find(field(line, "level"));
    if (rows.size() == kMostLines) rows.pop_front();
    rows.push_back({{"time", static_cast<double>(passed.passed - begin()) * 1e-9, 3},
                    {"level", level == levels.end() ? "info" : level->second},
                    {"who", source},
                    {"text", field(line, "text")}});
    return true;
  });
  return {rows.begin(), rows.end()};
}

std::vector<Record> RecordedSystem::newest_log(Stamp now, const std::set<std::string>& who) const {
  const Stamp from = log_begin(now);
  std::vector<Record> rows = log(from, now, who);
  if (from == begin()) return rows;
  rows.insert(rows.begin(), {{"time", static_cast<double>(from - begin()) * 1e-9, 3},
                             {"level", "info"},
                             {"who", "recording"},
                             {"text",
                              "what was logged before this is left out, since the recording is long; "
                              "set the time back to see it"}});
  return rows;
}

RecordedSystem::Stamp RecordedSystem::log_begin(Stamp now) const {
  const std::set<std::uint16_t> channels = channels_of({std::string(recording::kLogRow)});
  std::vector<Stamp> starts;
  for (const recording::ChunkIndex& chunk : reader_.file().chunks())
    if (chunk.start <= now && may_have(chunk, channels)) starts.push_back(chunk.start);
  if (starts.size() <= kMostOpened) return begin();
  std::ranges::nth_element(starts, starts.begin() + kMostOpened - 1, std::greater());
  return starts[kMostOpened - 1];
}

std::string RecordedSystem::row_of(const std::string& port) const {
  if (reader_.rows().contains(port)) return port;
  const auto connected = connected_.find(port);
  if (connected == connected_.end()) return {};
  const auto& others = connected->second;
  const auto recorded =
      std::ranges::find_if(others, [&](const std::string& other) { return reader_.rows().contains(other); });
  return recorded == others.end() ? "" : *recorded;
}

std::string RecordedSystem::type_of(const std::string& row) const {
  const auto found = reader_.rows().find(row);
  return found == reader_.rows().end() || found->second.types.empty() ? ""
                                                                      : found->second.types.begin()->first;
}

std::set<std::uint16_t> RecordedSystem::channels_of(const std::set<std::string>& rows) const {
  std::set<std::uint16_t> channels;
  for (const auto& [id, source] : sources_)
    if (rows.contains(source.row)) channels.insert(id);
  return channels;
}

Tapped RecordedSystem::tapped(const Message& message) const {
  Tapped passed;
  passed.type = sources_.at(message.channel).type;
  const auto object = message.payload.subspan(std::min(kEncapsulation, message.payload.size()));
  passed.object.assign(object.begin(), object.end());
  passed.passed = message.log_time;
  passed.created = message.publish_time;
  passed.size = object.size();
  return passed;
}

std::optional<Tapped> RecordedSystem::last(const std::string& row, Stamp now) const {
  const std::set<std::uint16_t> channels = channels_of({row});
  std::vector<recording::ChunkIndex> chunks = reader_.file().chunks();
  std::ranges::stable_sort(chunks, std::greater(), &recording::ChunkIndex::start);
  std::size_t opened = 0;
  for (const recording::ChunkIndex& chunk : chunks) {
    if (chunk.start > now || !may_have(chunk, channels)) continue;
    if (++opened > kMostOpened) break;
    std::optional<Tapped> found;
    (void)reader_.file().messages(
        channels,
        [&](const Message& message) {
          if (message.log_time > std::min(now, chunk.end)) return false;
          found = tapped(message);
          return true;
        },
        chunk.start);
    if (found) return found;
  }
  return std::nullopt;
}

Status RecordedSystem::pass(
    const std::set<std::string>& rows, Stamp from, Stamp to,
    const std::function<bool(const std::string& row, const Tapped& passed)>& take) const {
  const std::set<std::uint16_t> channels = channels_of(rows);
  if (channels.empty()) return ok();  // no channels would be all of them
  return reader_.file().messages(
      channels,
      [&](const Message& message) {
        return message.log_time <= to && take(sources_.at(message.channel).row, tapped(message));
      },
      from);
}

}  // namespace orca::view
