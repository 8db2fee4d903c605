// SPDX-License-Identifier: LGPL-3.0-or-later
// The folder of a bag: what rosbag2 has split into several files is one recording. Their names say which belong together, so
// metadata.yaml, which is missing when the recorder was killed, is not needed.
#include <algorithm>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <optional>
#include <utility>

#include "orca/base/text.hpp"
#include "storage.hpp"

namespace orca::recording {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostWaiting = std::size_t{512}
                                     << 20;  // [bytes] that wait for messages of the next file

// A name of rosbag2: NAME_12.mcap.
struct Numbered {
  std::string name;
  std::uint64_t number;
  std::string path;
};

std::optional<Numbered> numbered(const std::string& path) {
  const std::string stem = fs::path(path).stem().string();
  const std::size_t line = stem.rfind('_');
  if (line == std::string::npos || line + 1 == stem.size() || stem.size() - line > 10 ||
      stem.find_first_not_of("0123456789", line + 1) != std::string::npos)
    return std::nullopt;
  return Numbered{stem.substr(0, line), std::strtoull(stem.c_str() + line + 1, nullptr, 10), path};
}

std::vector<std::string> files_with(const std::string& folder, std::initializer_list<const char*> endings) {
  std::vector<std::string> files;
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error))
    if (std::ranges::count(endings, entry->path().extension().string()) > 0)
      files.push_back(entry->path().string());
  std::ranges::sort(files);
  return files;
}

Error no_single_bag(const std::vector<std::string>& files, const std::string& folder) {
  return fail(Code::not_found, "the folder has several recordings; name one of them: " + listed(files),
              folder);
}

// Messages of several files, each of which is later than the one before as a whole, or nearly.
class Joined final : public Storage {
 public:
  explicit Joined(std::vector<std::unique_ptr<Storage>> parts) : parts_(std::move(parts)) {
    std::ranges::stable_sort(parts_, {}, [](const auto& part) { return part->summary.statistics.start; });
    has_index = true;
    for (const std::unique_ptr<Storage>& part : parts_) add(*part);
  }

  Status messages(const std::set<std::uint16_t>& channels, const std::function<bool(const Message&)>& take,
                  Stamp from) const override;

 private:
  struct Waiting {
    Message message;
    std::vector<std::byte> payload;
  };

  void add(const Storage& part);
  std::uint16_t channel_of(const Storage& part, const Channel& channel);
  // Passes on what waits and is not later than a time. Returns false if no more is wanted.
  static bool pass_on(std::deque<Waiting>& waiting, Stamp time,
                      const std::function<bool(const Message&)>& take);

  std::vector<std::unique_ptr<Storage>> parts_;
  std::vector<std::map<std::uint16_t, std::uint16_t>> channels_;  // by part: its numbers, and those of all
};

void Joined::add(const Storage& part) {
  library = part.library;
  size += part.size;
  has_index = has_index && part.has_index;
  findings.insert(findings.end(), part.findings.begin(), part.findings.end());
  std::map<std::uint16_t, std::uint16_t>& numbers = channels_.emplace_back();
  for (const auto& [id, channel] : part.summary.channels) numbers[id] = channel_of(part, channel);
  const Statistics& said = part.summary.statistics;
  Statistics& all = summary.statistics;
  if (said.messages > 0) {
    all.start = all.messages == 0 ? said.start : std::min(all.start, said.start);
    all.end = std::max(all.end, said.end);
  }
  all.messages += said.messages;
  all.chunks += said.chunks;
  for (const auto& [id, count] : said.by_channel)
    if (const auto number = numbers.find(id); number != numbers.end())
      all.by_channel[number->second] += count;
}

// A topic is one channel, in however many files it is.
std::uint16_t Joined::channel_of(const Storage& part, const Channel& channel) {
  Schema schema;
  if (const auto found = part.summary.schemas.find(channel.schema); found != part.summary.schemas.end())
    schema = found->second;
  for (const auto& [id, known] : summary.channels)
    if (known.topic == channel.topic && known.message_encoding == channel.message_encoding &&
        summary.schemas.at(known.schema).name == schema.name)
      return id;
  const auto number = static_cast<std::uint16_t>(summary.channels.size() + 1);
  schema.id = number;
  summary.schemas[number] = schema;
  summary.channels[number] = channel;
  summary.channels[number].id = number;
  summary.channels[number].schema = number;
  return number;
}

bool Joined::pass_on(std::deque<Waiting>& waiting, Stamp time,
                     const std::function<bool(const Message&)>& take) {
  for (; !waiting.empty() && waiting.front().message.log_time <= time; waiting.pop_front()) {
    waiting.front().message.payload = waiting.front().payload;
    if (!take(waiting.front().message)) return false;
  }
  return true;
}

Status Joined::messages(const std::set<std::uint16_t>& channels,
                        const std::function<bool(const Message&)>& take, Stamp from) const {
  std::deque<Waiting> waiting;  // in the order of time
  std::size_t kept = 0;         // [bytes] that have waited in all; few do
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    std::set<std::uint16_t> wanted;
    for (const auto& [id, number] : channels_[i])
      if (channels.empty() || channels.contains(number)) wanted.insert(id);
    if (wanted.empty() || parts_[i]->summary.statistics.end < from) continue;
    const Stamp next = i + 1 < parts_.size() ? parts_[i + 1]->summary.statistics.start : UINT64_MAX;
    bool goes_on = true;
    const auto sort_in = [&](const Message& message) {
      Message renamed = message;
      renamed.channel = channels_[i].at(message.channel);
      if (next > 0 && !pass_on(waiting, std::min(message.log_time, next - 1), take)) return goes_on = false;
      if (message.log_time < next) return goes_on = take(renamed);
      kept += message.payload.size();
      const auto place = std::ranges::upper_bound(waiting, message.log_time, {},
                                                  [](const Waiting& one) { return one.message.log_time; });
      waiting.insert(place, {renamed, {message.payload.begin(), message.payload.end()}});
      return kept <= kMostWaiting;
    };
    if (Status read = parts_[i]->messages(wanted, sort_in, from); !read.ok()) {
      (void)pass_on(waiting, UINT64_MAX, take);
      return read;
    }
    if (!goes_on) return ok();
    if (kept > kMostWaiting)
      return fail(Code::data_loss, "the files of the bag are of the same time, which is too much to sort");
  }
  (void)pass_on(waiting, UINT64_MAX, take);
  return ok();
}

}  // namespace

Result<std::vector<std::string>> files_of(const std::string& path) {
  std::error_code unused;
  if (!fs::is_directory(path, unused)) return std::vector<std::string>{path};
  std::vector<std::string> files = files_with(path, {".mcap", ".db3"});
  if (files.size() == 1) return files;
  if (files.empty()) {
    const std::vector<std::string> packed = files_with(path, {".zstd"});
    if (packed.empty()) return fail(Code::not_found, "the folder has no file of a bag, .mcap or .db3", path);
    return fail(Code::unimplemented,
                "its files are compressed as a whole; unpack them first: zstd -d " + packed.front() + " -o " +
                    fs::path(packed.front()).replace_extension().string(),
                path);
  }
  std::vector<Numbered> parts;
  for (const std::string& file : files) {
    const std::optional<Numbered> part = numbered(file);
    if (!part || part->name != numbered(files.front())->name ||
        fs::path(file).extension() != fs::path(files.front()).extension())
      return no_single_bag(files, path);
    parts.push_back(*part);
  }
  std::ranges::sort(parts, {}, &Numbered::number);
  files.clear();
  for (const Numbered& part : parts) {
    if (part.number != files.size())
      return fail(Code::not_found,
                  "of the bag's files the one with number " + std::to_string(files.size()) +
                      " is missing; to read the others, name one of them",
                  path);
    files.push_back(part.path);
  }
  return files;
}

bool is_bag_folder(const std::string& path) {
  std::error_code unused;
  return fs::is_directory(path, unused) && !files_with(path, {".mcap", ".db3", ".zstd"}).empty();
}

std::unique_ptr<Storage> join(std::vector<std::unique_ptr<Storage>> parts) {
  return std::make_unique<Joined>(std::move(parts));
}

}  // namespace orca::recording
