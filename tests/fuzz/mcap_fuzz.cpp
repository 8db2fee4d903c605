// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes give an error or a recording, all of which can be read; what is recovered from them is a file in order with the
// same messages.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

#include "orca/recording/reader.hpp"

namespace {

using namespace orca;
using namespace orca::recording;

class Memory final : public Output {
 public:
  explicit Memory(std::vector<std::byte>& to) : to_(to) {}
  Status append(std::vector<std::byte> piece) override {
    to_.insert(to_.end(), piece.begin(), piece.end());
    return ok();
  }
  Status finish() override { return ok(); }

 private:
  std::vector<std::byte>& to_;
};

std::uint64_t count_messages(const Reader& reader) {
  std::uint64_t count = 0;
  Stamp last = 0;
  (void)reader.messages({}, [&](const Message& message) {
    if (!reader.has_index() && message.log_time < last) std::abort();
    last = message.log_time;
    return ++count, true;
  });
  return count;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  const Result<Reader> reader = Reader::of(bytes);
  if (!reader) return 0;
  (void)count_messages(*reader);
  for (const IndexEntry& entry : reader->attachments()) (void)reader->attachment(entry);
  for (const IndexEntry& entry : reader->metadata()) (void)reader->metadata(entry);
  const Result<Examination> examined = check(bytes);
  if (!examined) return 0;
  std::vector<std::byte> recovered;
  if (!recover(bytes, std::make_unique<Memory>(recovered))) std::abort();
  const Result<Reader> again = Reader::of(recovered);
  const Result<Examination> second = check(recovered);
  if (!again || !second || second->statistics.messages != examined->statistics.messages) std::abort();
  (void)count_messages(*again);
  return 0;
}
