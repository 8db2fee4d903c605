// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/recording/reader.hpp"

#include <array>
#include <cstring>
#include <filesystem>
#include <utility>

#include "storage.hpp"

namespace orca::recording {
namespace {

// What rosbag2 makes of whole files if it is told to compress them.
bool is_zstd(std::span<const std::byte> bytes) {
  constexpr std::array<std::uint8_t, 4> kFrame{0x28, 0xB5, 0x2F, 0xFD};
  return bytes.size() >= kFrame.size() && std::memcmp(bytes.data(), kFrame.data(), kFrame.size()) == 0;
}

Result<std::unique_ptr<Storage>> open_file_of_bag(const std::string& path) {
  Result<MappedFile> file = MappedFile::open(path);
  if (!file) return file.error();
  if (is_database(file->bytes())) return open_database(path);
  if (is_zstd(file->bytes()))
    return fail(Code::unimplemented, "the file is compressed as a whole; unpack it first: zstd -d " + path +
                                         " -o " + path.substr(0, path.rfind('.')));
  return open_mcap(*std::move(file));
}

Result<std::unique_ptr<Storage>> open_storage(const std::string& path) {
  const Result<std::vector<std::string>> files = files_of(path);
  if (!files) return files.error();
  std::vector<std::unique_ptr<Storage>> parts;
  for (const std::string& file : *files) {
    Result<std::unique_ptr<Storage>> part = open_file_of_bag(file);
    if (!part)
      return fail(part.error().code, part.error().message,
                  part.error().where.empty() ? file : part.error().where);
    parts.push_back(*std::move(part));
  }
  return parts.size() == 1 ? std::move(parts.front()) : join(std::move(parts));
}

}  // namespace

Reader::Reader(std::unique_ptr<Storage> inside) : inside_(std::move(inside)) {}
Reader::~Reader() = default;
Reader::Reader(Reader&&) noexcept = default;
Reader& Reader::operator=(Reader&&) noexcept = default;

Result<Reader> Reader::open(const std::string& path) {
  Result<std::unique_ptr<Storage>> storage = open_storage(path);
  if (!storage) return storage.error();
  return Reader(*std::move(storage));
}

Result<Reader> Reader::of(std::span<const std::byte> bytes) {
  Result<std::unique_ptr<Storage>> storage = read_mcap(bytes);
  if (!storage) return storage.error();
  return Reader(*std::move(storage));
}

const std::string& Reader::library() const { return inside_->library; }
std::uint64_t Reader::size() const { return inside_->size; }
bool Reader::has_index() const { return inside_->has_index; }
const std::map<std::uint16_t, Schema>& Reader::schemas() const { return inside_->summary.schemas; }
const std::map<std::uint16_t, Channel>& Reader::channels() const { return inside_->summary.channels; }
const Statistics& Reader::statistics() const { return inside_->summary.statistics; }
const std::vector<ChunkIndex>& Reader::chunks() const { return inside_->summary.chunks; }
const std::vector<IndexEntry>& Reader::attachments() const { return inside_->summary.attachments; }
const std::vector<IndexEntry>& Reader::metadata() const { return inside_->summary.metadata; }
const std::vector<Finding>& Reader::findings() const { return inside_->findings; }

Result<Attachment> Reader::attachment(const IndexEntry& entry) const {
  const std::optional<Record> record = RecordWalk(inside_->bytes, entry.offset).next();
  std::optional<Attachment> attachment =
      record && record->op == Op::attachment ? read_attachment(record->content) : std::nullopt;
  if (!attachment) return fail(Code::data_loss, "the attachment " + entry.name + " is damaged");
  return *std::move(attachment);
}

Result<Metadata> Reader::metadata(const IndexEntry& entry) const {
  const std::optional<Record> record = RecordWalk(inside_->bytes, entry.offset).next();
  std::optional<Metadata> metadata =
      record && record->op == Op::metadata ? read_metadata(record->content) : std::nullopt;
  if (!metadata) return fail(Code::data_loss, "the metadata " + entry.name + " are damaged");
  return *std::move(metadata);
}

Status Reader::messages(const std::set<std::uint16_t>& channels,
                        const std::function<bool(const Message&)>& take, Stamp from) const {
  return inside_->messages(channels, take, from);
}

bool is_recording(const std::string& path) {
  std::error_code unused;
  if (std::filesystem::is_directory(path, unused)) return true;
  const Result<MappedFile> file = MappedFile::open(path);
  return file && (is_mcap(file->bytes()) || is_database(file->bytes()) || is_zstd(file->bytes()));
}

}  // namespace orca::recording
