// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "bag_ring.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "orca/base/files/own_folder.hpp"
#include "orca/base/text.hpp"
#include "orca/recording/objects/object_reader.hpp"
#include "orca/recording/objects/ring_writer.hpp"
#include "orca/recording/writer.hpp"
#include "orca/xml/quantity.hpp"
#include "table.hpp"

namespace orca::orcactl {
namespace {

namespace fs = std::filesystem;
using recording::Reader;
using recording::Stamp;
using supervisor::Record;

constexpr Stamp kStampSecond = 1'000'000'000;

struct Part {
  Reader reader;
  std::string row;  // of a ring
  recording::Values facts;
};

// Opens a file, or the files of a folder that are still there.
Result<std::vector<Part>> open_parts(const std::string& word) {
  const std::string folder = ring_folder(word);
  std::vector<Part> parts;
  for (const recording::RingFile& file : recording::ring_files(folder))
    if (Result<Reader> reader = Reader::open(file.path.string())) {
      recording::Values facts = recording::facts_of(*reader);
      parts.push_back({*std::move(reader), file.row, std::move(facts)});
    }
  if (!folder.empty())
    return parts.empty() ? Result<std::vector<Part>>(
                               fail(Code::not_found, "there is no recording in this folder", folder))
                         : Result<std::vector<Part>>(std::move(parts));
  Result<Reader> reader = Reader::open(word);
  if (!reader) return reader.error();
  recording::Values facts = recording::facts_of(*reader);
  parts.push_back({*std::move(reader), "", std::move(facts)});
  return parts;
}

// The first and the last time of all parts.
struct Span {
  Stamp begin = UINT64_MAX;
  Stamp end = 0;
};
Span span_of(const std::vector<Part>& parts) {
  Span span;
  for (const Part& part : parts) {
    const recording::Statistics& numbers = part.reader.statistics();
    if (numbers.messages == 0) continue;
    span.begin = std::min(span.begin, numbers.start);
    span.end = std::max(span.end, numbers.end);
  }
  span.begin = std::min(span.begin, span.end);
  return span;
}

std::uint64_t number_in(const recording::Values& facts, const std::string& name) {
  return std::strtoull(recording::fact(facts, name).c_str(), nullptr, 10);
}

Record ring_summary(const std::vector<Part>& parts, const std::string& folder) {
  const Span span = span_of(parts);
  std::map<std::string, std::uint64_t> dropped;  // by row: the count goes on from file to file
  std::uint64_t messages = 0;
  std::uint64_t bytes = 0;
  for (const Part& part : parts) {
    dropped[part.row] = std::max(dropped[part.row], number_in(part.facts, "dropped"));
    messages += part.reader.statistics().messages;
    bytes += part.reader.size();
  }
  return {{"folder", folder},
          {"graph", recording::fact(parts.back().facts, "graph")},
          {"begin", local_time(span.begin)},
          {"end", local_time(span.end)},
          {"begin_s", static_cast<double>(span.begin) * 1e-9, 6},
          {"duration_s", static_cast<double>(span.end - span.begin) * 1e-9, 3},
          {"files", parts.size()},
          {"megabytes", static_cast<double>(bytes) * 1e-6, 3},
          {"messages", messages},
          {"dropped_small", dropped["small"]},
          {"dropped_rest", dropped["rest"]}};
}

std::vector<Record> ring_topics(const std::vector<Part>& parts) {
  struct Topic {
    std::string type;
    std::string port;
    std::uint64_t messages = 0;
    Span span{};
  };
  std::map<std::string, Topic> topics;
  for (const Part& part : parts) {
    const recording::Statistics& numbers = part.reader.statistics();
    for (const auto& [id, channel] : part.reader.channels()) {
      const auto count = numbers.by_channel.find(id);
      const auto schema = part.reader.schemas().find(channel.schema);
      Topic& topic = topics[channel.topic];
      if (schema != part.reader.schemas().end()) topic.type = schema->second.name;
      topic.port = recording::fact(channel.metadata, "orca.port");
      if (count == numbers.by_channel.end()) continue;
      topic.messages += count->second;
      topic.span.begin = std::min(topic.span.begin, numbers.start);
    }
  }
  std::vector<Record> table;
  for (const auto& [name, topic] : topics)
    table.push_back({{"topic", name},
                     {"type", topic.type},
                     {"messages", topic.messages},
                     {"since", topic.messages == 0 ? "" : local_time(topic.span.begin)},
                     {"port", topic.port}});
  return table;
}

// Reads a time of this machine's zone; one without a day is of the last day of the recording on which it was that late.
Result<Stamp> time_of(const std::string& word, const Span& span) {
  if (const Result<Duration> since = xml::parse_duration(word))
    return span.begin + static_cast<Stamp>(since->count());
  const auto last = static_cast<std::time_t>(span.end / kStampSecond);
  for (const char* const form : {"%Y-%m-%dT%H:%M:%S", "%Y-%m-%dT%H:%M", "%H:%M:%S", "%H:%M"}) {
    std::tm parts{};
    localtime_r(&last, &parts);
    parts.tm_sec = 0;
    const char* const rest = strptime(word.c_str(), form, &parts);
    if (rest == nullptr || *rest != '\0') continue;
    parts.tm_isdst = -1;
    std::time_t time = std::mktime(&parts);
    if (form[1] == 'H' && time > last) {
      --parts.tm_mday;
      parts.tm_isdst = -1;
      time = std::mktime(&parts);
    }
    return static_cast<Stamp>(std::max<std::time_t>(time, 0)) * kStampSecond;
  }
  return fail(Code::invalid_argument,
              in_quotes(word) +
                  " is no time: write 14:03, 14:03:20, 2026-11-29T14:03:20, or 90s, which counts "
                  "from the beginning");
}

// A new file that takes over parts of others.
class Copy {
 public:
  Copy(std::unique_ptr<recording::Output> output, const Reader& like)
      : writer_(std::move(output), is_of_ros(like) ? "ros2" : "", like.library()) {}

  Status take(const Part& part, Span wanted) {
    Status status = ok();
    const Status read = part.reader.messages(
        {},
        [&](const recording::Message& message) {
          if (message.log_time >= wanted.end) return false;
          recording::Message copy = message;
          copy.channel = channel_of(part.reader, message.channel);
          status = writer_.write(copy);
          return status.ok();
        },
        wanted.begin);
    return status.ok() ? read : status;
  }

  // Takes over the graph and what else is known of a part.
  Status take_facts(const Part& part) {
    for (const recording::IndexEntry& entry : part.reader.attachments()) {
      if (!attached_.insert(entry.name).second) continue;
      const Result<recording::Attachment> attachment = part.reader.attachment(entry);
      if (!attachment) return attachment.error();
      if (Status done = writer_.attach(*attachment); !done.ok()) return done;
    }
    return ok();
  }
  Status note(recording::Metadata metadata) { return writer_.note(metadata); }
  Status close() { return writer_.close(); }
  [[nodiscard]] std::uint64_t messages() const { return writer_.statistics().messages; }

 private:
  static bool is_of_ros(const Reader& reader) {
    return std::ranges::any_of(reader.schemas(),
                               [](const auto& entry) { return entry.second.encoding == "ros2msg"; });
  }

  std::uint16_t channel_of(const Reader& reader, std::uint16_t id) {
    const recording::Channel& channel = reader.channels().at(id);
    const auto schema = reader.schemas().find(channel.schema);
    const std::uint16_t number =
        schema == reader.schemas().end()
            ? std::uint16_t{0}
            : writer_.add_schema(schema->second.name, schema->second.encoding, schema->second.data);
    const auto known = channels_.find({number, channel.topic, channel.message_encoding, channel.metadata});
    if (known != channels_.end()) return known->second;
    return channels_[{number, channel.topic, channel.message_encoding, channel.metadata}] =
               writer_.add_channel(number, channel.topic, channel.message_encoding, channel.metadata);
  }

  recording::Writer writer_;
  std::map<std::tuple<std::uint16_t, std::string, std::string, recording::Values>, std::uint16_t> channels_;
  std::set<std::string> attached_;
};

bool overlaps(const Part& part, const Span& wanted) {
  const recording::Statistics& numbers = part.reader.statistics();
  return numbers.messages > 0 && numbers.start < wanted.end && numbers.end >= wanted.begin;
}

Status copy_span(const std::vector<Part>& parts, const Span& wanted, Copy& to) {
  recording::Metadata origin{"orca.recording", {}};
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    if (!overlaps(*part, wanted)) continue;
    if (origin.values.empty()) origin.values = part->facts;
    if (Status taken = to.take_facts(*part); !taken.ok()) return taken;
  }
  for (const char* const name : {"row", "dropped"}) origin.values.erase(name);
  if (!origin.values.empty())
    if (Status noted = to.note(std::move(origin)); !noted.ok()) return noted;
  for (const Part& part : parts)
    if (overlaps(part, wanted))
      if (Status taken = to.take(part, wanted); !taken.ok()) return taken;
  return to.close();
}

// Reads FROM and TO, which may be left out.
Result<Span> wanted_span(const std::vector<std::string>& words, const Span& all) {
  Span wanted{all.begin, all.end + 1};
  for (std::size_t i = 2; i < words.size(); ++i) {
    const Result<Stamp> time = time_of(words[i], all);
    if (!time) return time.error();
    (i == 2 ? wanted.begin : wanted.end) = *time;
    // A time of day that the recording has not reached yet is not that of the day before.
    const bool is_of_day = words[i].find(':') != std::string::npos && words[i].find('T') == std::string::npos;
    if (i == 3 && is_of_day && wanted.end <= wanted.begin) wanted.end += kStampSecond * 24 * 3600;
  }
  if (words.size() == 4 && wanted.end <= wanted.begin)
    return fail(Code::invalid_argument, "TO, " + words[3] + ", is not after FROM, " + words[2]);
  return wanted;
}

}  // namespace

std::string local_time(Stamp time) {
  const auto seconds = static_cast<std::time_t>(time / kStampSecond);
  std::tm parts{};
  localtime_r(&seconds, &parts);
  char text[48];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S %z", &parts);
  return text;
}

std::string ring_folder(const std::string& word) {
  std::error_code absent;
  if (fs::is_directory(word, absent))
    return recording::ring_files(word).empty() && recording::is_bag_folder(word) ? "" : word;
  const std::string kept = OwnFolder::path_for_state() + "/recordings/" + word;
  return !fs::exists(word, absent) && fs::is_directory(kept, absent) ? kept : "";
}

Status show_ring(const std::string& folder, bool as_json) {
  const Result<std::vector<Part>> parts = open_parts(folder);
  if (!parts) return parts.error();
  const Record summary = ring_summary(*parts, folder);
  const std::vector<Record> topics = ring_topics(*parts);
  if (as_json) {
    std::vector<Record> all{summary};
    all.insert(all.end(), topics.begin(), topics.end());
    print(table_json(all));
    return ok();
  }
  for (const supervisor::Cell& cell : summary) print(cell.name + ": " + cell.value + "\n");
  print("\n" + table_text(topics, terminal_columns()));
  return ok();
}

Status cut(const std::vector<std::string>& words) {
  if (words.size() < 2 || words.size() > 4)
    return fail(Code::invalid_argument,
                "bag cut needs FILE, FOLDER or SYSTEM, and NEW.mcap, then FROM and TO");
  const Result<std::vector<Part>> parts = open_parts(words[0]);
  if (!parts) return parts.error();
  const Span all = span_of(*parts);
  const Result<Span> wanted = wanted_span(words, all);
  if (!wanted) return wanted.error();
  if (std::ranges::none_of(*parts, [&](const Part& part) { return overlaps(part, *wanted); }))
    return fail(Code::not_found, "nothing of that time is there; the recording goes from " +
                                     local_time(all.begin) + " to " + local_time(all.end));
  auto output = recording::open_file(words[1]);
  if (!output) return output.error();
  Copy to(*std::move(output), parts->back().reader);
  if (const Status copied = copy_span(*parts, *wanted, to); !copied.ok()) return copied;
  print(words[1] + ": " + std::to_string(to.messages()) + " messages\n");
  return ok();
}

}  // namespace orca::orcactl
