// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "bag.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "asking.hpp"
#include "bag_carmen.hpp"
#include "bag_ring.hpp"
#include "orca/base/text.hpp"
#include "orca/recording/objects/object_reader.hpp"
#include "orca/text/object_table.hpp"
#include "orca/xml/names.hpp"
#include "table.hpp"
#include "tapping/object_learning.hpp"

namespace orca::orcactl {
namespace {

using recording::ObjectReader;
using recording::RecordedObject;
using supervisor::Record;

using Words = std::vector<std::string>;  // the file, and what follows it

double seconds(recording::Stamp from, recording::Stamp to) { return static_cast<double>(to - from) * 1e-9; }

std::string offset_text(const recording::Finding& finding) {
  return finding.offset == 0 ? finding.text : "byte " + std::to_string(finding.offset) + ": " + finding.text;
}

std::vector<Record> topics_of(const recording::Reader& file, const recording::Values& facts) {
  const recording::Statistics& numbers = file.statistics();
  const double span = seconds(numbers.start, numbers.end);
  std::vector<Record> table;
  for (const auto& [id, channel] : file.channels()) {
    const auto count = numbers.by_channel.find(id);
    const std::uint64_t messages = count == numbers.by_channel.end() ? 0 : count->second;
    const auto schema = file.schemas().find(channel.schema);
    const std::string port = recording::fact(channel.metadata, "orca.port");
    const std::string lost = recording::fact(facts, "lost." + port);
    table.push_back({{"topic", channel.topic},
                     {"type", schema == file.schemas().end() ? "" : schema->second.name},
                     {"messages", messages},
                     {"per_s", span > 0.0 ? static_cast<double>(messages) / span : 0.0, 2},
                     {"port", port},
                     {"lost", lost.empty() ? "0" : lost}});
  }
  std::ranges::sort(table, {}, [](const Record& record) { return record[0].value; });
  return table;
}

Record summary_of(const recording::Reader& file, const recording::Values& facts) {
  const recording::Statistics& numbers = file.statistics();
  // A bag says nothing of its clock; as a rule it counts from 1970.
  const bool has_dates = facts.empty() || recording::fact(facts, "clock") == "steady";
  return {{"messages", numbers.messages},
          {"begin_s", seconds(0, numbers.start), 6},
          {"begin", has_dates ? local_time(numbers.start) : ""},
          {"end", has_dates ? local_time(numbers.end) : ""},
          {"duration_s", seconds(numbers.start, numbers.end), 3},
          {"megabytes", static_cast<double>(file.size()) * 1e-6, 3},
          {"chunks", numbers.chunks},
          {"attachments", file.attachments().size()},
          {"whole", file.has_index()},
          {"graph", recording::fact(facts, "graph")},
          {"clock", recording::fact(facts, "clock")},
          {"begun", recording::fact(facts, "begun")},
          {"trace_hash", recording::fact(facts, "trace-hash")},
          {"unreached", recording::fact(facts, "unreached")},
          {"library", file.library()}};
}

Status info(const Words& words, bool as_json) {
  if (const std::string folder = ring_folder(words[0]); !folder.empty()) return show_ring(folder, as_json);
  const Result<recording::Reader> file = recording::Reader::open(words[0]);
  if (!file) return file.error();
  const recording::Values facts = recording::facts_of(*file);
  const Record summary = summary_of(*file, facts);
  const std::vector<Record> topics = topics_of(*file, facts);
  if (as_json) {
    std::vector<Record> all{summary};
    all.insert(all.end(), topics.begin(), topics.end());
    print(table_json(all));
    return ok();
  }
  for (const supervisor::Cell& cell : summary)
    if (!cell.value.empty()) print(cell.name + ": " + cell.value + "\n");
  for (const recording::IndexEntry& entry : file->attachments()) print("attachment: " + entry.name + "\n");
  print("\n" + table_text(topics, terminal_columns()));
  const auto& findings = file->findings();
  const bool is_mcap = std::ranges::all_of(findings, [](const auto& one) { return one.offset != 0; });
  if (!is_mcap)
    for (const recording::Finding& finding : findings)
      std::fprintf(stderr, "orcactl: %s\n", finding.text.c_str());
  if (const std::string damage = recording::damage_of(*file); !damage.empty())
    std::fprintf(stderr, "orcactl: %s\n", damage.c_str());
  else if (is_mcap && !file->has_index())
    std::fprintf(stderr, "orcactl: the file has no index; orcactl bag recover gives it one\n");
  return ok();
}

void print_findings(const recording::Examination& examined) {
  for (const recording::Finding& finding : examined.findings) print(offset_text(finding) + "\n");
  for (const std::string& remark : examined.remarks) print("remark: " + remark + "\n");
}

Status check(const Words& words, bool /*as_json*/) {
  const Result<recording::Examination> examined = recording::check(words[0]);
  if (!examined) return examined.error();
  print_findings(*examined);
  const std::uint64_t messages = examined->statistics.messages;
  if (examined->findings.empty()) {
    print("in order: " + std::to_string(messages) + " messages in " +
          std::to_string(examined->statistics.chunks) + " chunks\n");
    return ok();
  }
  const bool is_mcap =
      std::ranges::all_of(examined->findings, [](const auto& finding) { return finding.offset != 0; });
  return fail(
      Code::data_loss,
      "the file is not in order; " + std::to_string(messages) + " messages are whole" +
          (is_mcap ? "; orcactl bag recover " + words[0] + " NEW.mcap writes these into a new file" : ""),
      words[0]);
}

Status recover(const Words& words, bool /*as_json*/) {
  if (words.size() != 2) return fail(Code::invalid_argument, "bag recover needs FILE.mcap and NEW.mcap");
  auto output = recording::open_file(words[1]);
  if (!output) return output.error();
  const Result<recording::Examination> examined = recording::recover(words[0], *std::move(output));
  if (!examined) return (void)std::remove(words[1].c_str()), examined.error();
  print_findings(*examined);
  print(words[1] + ": " + std::to_string(examined->statistics.messages) + " messages in " +
        std::to_string(examined->statistics.chunks) + " chunks\n");
  return ok();
}

// Returns the ports that the words after the file name; all of the recording if there are none.
Result<std::set<std::string>> ports_of(const ObjectReader& reader, const Words& words) {
  std::vector<std::string> known;
  for (const auto& [name, row] : reader.rows()) known.push_back(name);
  std::set<std::string> ports;
  for (auto word = words.begin() + 1; word < words.end(); ++word) {
    const Result<std::string> row = recording::find_row(reader.rows(), reader.others(), *word);
    if (!row)
      return fail(row.error().code, row.error().message + xml::did_you_mean(xml::nearest_name(*word, known)));
    ports.insert(*row);
  }
  if (ports.empty()) ports.insert(known.begin(), known.end());
  return ports;
}

Status csv(const Words& words, bool /*as_json*/) {
  const Result<ObjectReader> reader = ObjectReader::open(words[0]);
  if (!reader) return reader.error();
  const Result<std::set<std::string>> ports = ports_of(*reader, words);
  if (!ports) return ports.error();
  ObjectTable table{reader->is_virtual()
                        ? TimePoint{}
                        : TimePoint(Duration(static_cast<Duration::rep>(reader->file().statistics().start)))};
  for (const std::string& port : *ports)
    for (const auto& [type, count] : reader->rows().at(port).types) table.add_type(*find_object_type(type));
  const auto make_room = [&](const RecordedObject& one) { return table.make_room(one.object), true; };
  std::vector<std::string> flaws;  // the second time they go to the log
  if (const Status read = reader->objects(*ports, make_room, &flaws); !read.ok()) return read;
  print(table.header());
  return reader->objects(
      *ports, [&](const RecordedObject& one) { return print(table.row(one.row, one.object)), true; });
}

Status carmen(const Words& words, bool /*as_json*/) {
  const Result<ObjectReader> reader = ObjectReader::open(words[0]);
  if (!reader) return reader.error();
  const Result<std::set<std::string>> ports = ports_of(*reader, words);
  if (!ports) return ports.error();
  return print_carmen_log(*reader, *ports);
}

// ---- Comparison

struct Kept {
  std::string row;
  ObjectRef object;
  TimePoint passed;
};

Result<std::vector<Kept>> objects_of(const ObjectReader& reader, const std::set<std::string>& ports) {
  std::vector<Kept> all;
  const Status read = reader.objects(ports, [&](const RecordedObject& one) {
    all.push_back({std::string(one.row), one.object, one.passed});
    return true;
  });
  return read.ok() ? Result<std::vector<Kept>>(std::move(all)) : Result<std::vector<Kept>>(read.error());
}

std::string place_of(const Kept& one) {
  char text[64];
  std::snprintf(text, sizeof text, "%.6f s", to_seconds(one.passed.time_since_epoch()));
  return one.row + " number " + std::to_string(one.object.header().seq()) + " at " + text;
}

// Returns whether two objects of one type have the same fields. Not a number is the same as itself here, which == denies.
bool are_same(const ObjectRef& a, const ObjectRef& b) {
  if (a.type().equal(a.get(), b.get())) return true;
  std::vector<std::byte> bytes, others;
  a.type().serialize(a.get(), bytes);
  b.type().serialize(b.get(), others);
  return bytes == others;
}

// Returns what differs between two objects; empty: nothing.
std::string difference(const Kept& a, const Kept& b) {
  if (a.row != b.row) return "the other has one of " + place_of(b) + " in its place";
  if (&a.object.type() != &b.object.type())
    return "it is of type " + std::string(a.object.type().name) + ", the other of " +
           std::string(b.object.type().name);
  if (a.passed != b.passed) return "the other passed as " + place_of(b);
  if (are_same(a.object, b.object)) return {};
  for (const std::string& field : field_names(a.object.type(), a.object.get())) {
    const auto left = field_texts(a.object.type(), a.object.get(), field);
    const auto right = field_texts(b.object.type(), b.object.get(), field);
    if (!left || left->size() != 1) continue;
    const std::string here = left->front().text;
    const std::string there = right && right->size() == 1 ? right->front().text : "nothing";
    if (here != there) return field + " is " + here + ", and " + there + " in the other";
  }
  return "a list is longer in one of them";
}

Status compare(const Words& words, bool /*as_json*/) {
  if (words.size() < 2) return fail(Code::invalid_argument, "bag diff needs two files");
  std::vector<std::vector<Kept>> both;
  const Words ports(words.begin() + 1, words.end());  // after the second file
  for (const std::string& path : {words[0], words[1]}) {
    const Result<ObjectReader> reader = ObjectReader::open(path);
    if (!reader) return reader.error();
    Result<std::set<std::string>> wanted = ports_of(*reader, ports);
    if (!wanted) return fail(wanted.error().code, wanted.error().message, path);
    Result<std::vector<Kept>> objects = objects_of(*reader, *wanted);
    if (!objects) return fail(objects.error().code, objects.error().message, path);
    both.push_back(*std::move(objects));
  }
  const std::size_t common = std::min(both[0].size(), both[1].size());
  for (std::size_t i = 0; i < common; ++i)
    if (const std::string what = difference(both[0][i], both[1][i]); !what.empty())
      return fail(Code::failed_precondition, "the first difference, after " + std::to_string(i) +
                                                 " equal objects: " + place_of(both[0][i]) + ": " + what);
  if (both[0].size() != both[1].size())
    return fail(Code::failed_precondition,
                "all " + std::to_string(common) + " objects of one are in the other, which has " +
                    std::to_string(std::max(both[0].size(), both[1].size()) - common) + " more");
  print("equal: " + std::to_string(common) + " objects\n");
  return ok();
}

Status cut_out(const Words& words, bool /*as_json*/) { return cut(words); }

}  // namespace

ExitCode handle_bag(const apps::Call& call) {
  using Way = Status (*)(const Words&, bool);
  static const std::map<std::string, Way> ways{{"info", info},  {"check", check},   {"recover", recover},
                                               {"csv", csv},    {"carmen", carmen}, {"diff", compare},
                                               {"cut", cut_out}};
  const auto way = ways.find(call.words.front());
  if (way == ways.end()) {
    std::vector<std::string> names;
    for (const auto& [name, function] : ways) names.push_back(name);
    return report({fail(Code::invalid_argument,
                        "bag expects " + listed(names) + ", not " + in_quotes(call.words.front()) +
                            xml::did_you_mean(xml::nearest_name(call.words.front(), names))),
                   ExitCode::usage});
  }
  if (call.has("--json") && way->first != "info")
    return report({fail(Code::invalid_argument,
                        "bag " + way->first + " writes no JSON, leave out --json; bag info does"),
                   ExitCode::usage});
  learn_objects_in_folders(call);
  const Status done = way->second({call.words.begin() + 1, call.words.end()}, call.has("--json"));
  if (done.ok()) return ExitCode::done;
  return report(
      {done.error(), done.error().code == Code::invalid_argument ? ExitCode::usage : ExitCode::refused});
}

}  // namespace orca::orcactl
