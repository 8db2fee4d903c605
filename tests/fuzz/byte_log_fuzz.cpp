// SPDX-License-Identifier: GPL-3.0-or-later
// Byte logs: what is read, written out and read again is the same.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "orca/hw/link/byte_record.hpp"

using orca::hw::link::ByteRecord;
using orca::hw::link::read_byte_log;

namespace {

bool is_text(const ByteRecord& record) {
  return record.kind == ByteRecord::Kind::gone || record.kind == ByteRecord::Kind::full;
}

std::string written(const std::vector<ByteRecord>& records) {
  std::string text = std::string(orca::hw::link::kByteLogTitle) + "\n";
  for (const ByteRecord& record : records) text += to_lines(record);
  return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto records = read_byte_log({reinterpret_cast<const char*>(data), size});
  if (!records) {
    if (records.error().message.empty()) std::abort();
    return 0;
  }
  for (const ByteRecord& record : *records)
    if (record.time < orca::Duration{0} || (!is_text(record) && !record.text.empty())) std::abort();
  // Long records are written in several lines, and texts made printable; after one round nothing changes any more.
  const std::string once = written(*records);
  const auto again = read_byte_log(once);
  if (!again || written(*again) != once) std::abort();
  return 0;
}
