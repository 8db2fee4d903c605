// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/recording/objects/object_reader.hpp"

#include <cstdio>
#include <cstdlib>

#include "orca/idl/object_type.hpp"

namespace orca::recording {
namespace {

constexpr std::size_t kEncapsulation = 4;  // [bytes] in front of each object

Result<ObjectRef> object_of(const ObjectType& type, std::span<const std::byte> payload) {
  if (payload.size() < kEncapsulation) return fail(Code::data_loss, "an object is cut short");
  ObjectLoan object = make_object(type);
  if (const Status read = type.deserialize(payload.subspan(kEncapsulation), object.get()); !read.ok())
    return read.error();
  return std::move(object).seal();
}

}  // namespace

Result<ObjectReader> ObjectReader::open(const std::string& path) {
  Result<Reader> file = Reader::open(path);
  if (!file) return file.error();
  ObjectReader reader(*std::move(file));
  if (const Status found = reader.find_rows(); !found.ok())
    return fail(found.error().code, found.error().message, path);
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
                  "objects of the type " + name + " of " + row + " are not known here");
    if (std::strtoull(fact(channel.metadata, "orca.layout").c_str(), nullptr, 16) != type->layout_hash)
      return fail(Code::failed_precondition,
                  "objects of the type " + name + " of " + row +
                      " had other fields when they were recorded; read the file with the build of that time");
    sources_[id] = {row, type};
    const auto& counts = file_.statistics().by_channel;
    const auto count = counts.find(id);
    RecordedRow& found = rows_[row];
    found.name = row;
    found.types[name] += count == counts.end() ? 0 : count->second;
  }
  return ok();
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

bool ObjectReader::is_virtual() const { return fact(facts_, "clock") == "virtual"; }

Status ObjectReader::objects(const std::set<std::string>& rows,
                             const std::function<bool(const RecordedObject&)>& take) const {
  std::set<std::uint16_t> channels;
  for (const auto& [id, source] : sources_)
    if (rows.empty() || rows.contains(source.row)) channels.insert(id);
  if (channels.empty()) return ok();  // no channels would be all of them
  Status status = ok();
  const Status read = file_.messages(channels, [&](const Message& message) {
    const Source& source = sources_.at(message.channel);
    const Result<ObjectRef> object = object_of(*source.type, message.payload);
    if (!object) return status = fail(object.error().code, source.row + ": " + object.error().message), false;
    const TimePoint passed{Duration(static_cast<Duration::rep>(message.log_time))};
    return take({source.row, *object, passed});
  });
  return status.ok() ? read : status;
}

}  // namespace orca::recording
