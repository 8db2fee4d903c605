// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/idl/cdr_reader.hpp"

#include <cstring>
#include <utility>

namespace orca::detail {
namespace {

// Fast DDS pads a payload to a multiple of 4 bytes.
constexpr std::size_t kMaxPadding = 3;

}  // namespace

void CdrReader::copy_out(std::span<std::byte> to) {
  if (remaining() < to.size()) {
    problem_ = "the payload ends after " + std::to_string(payload_.size()) + " bytes, but " +
               std::to_string(at_ + to.size()) + " are needed";
    return;
  }
  if (!to.empty()) std::memcpy(to.data(), payload_.data() + at_, to.size());
  at_ += to.size();
}

void CdrReader::read(bool& value) {
  std::uint8_t byte = 0;
  read(byte);
  if (failed()) return;
  if (byte > 1) {
    problem_ = "found " + std::to_string(byte) + " for a boolean, expected 0 or 1";
    return;
  }
  value = byte == 1;
}

void CdrReader::read(std::string& text) {
  const std::size_t size = read_count(1);
  if (failed()) return;
  text.resize(size);
  copy_out(std::as_writable_bytes(std::span(text)));
  if (size == 0) return;  // Some writers send an empty text without its zero.
  if (text.find('\0') != size - 1) {
    problem_ = "a text of " + std::to_string(size) + " bytes does not end with its only zero";
    return;
  }
  text.pop_back();
}

std::size_t CdrReader::read_count(std::size_t element_size) {
  std::uint32_t count = 0;
  read(count);
  if (failed()) return 0;
  if (count > remaining() / element_size) {
    problem_ = "a length of " + std::to_string(count) + " does not fit into the " +
               std::to_string(remaining()) + " bytes that follow";
    return 0;
  }
  return count;
}

bool CdrReader::read_reference(BulkReference& reference) {
  const std::size_t start = (at_ + sizeof kBulkMark - 1) / sizeof kBulkMark * sizeof kBulkMark;
  std::uint32_t mark = 0;
  if (source_ == nullptr || start > payload_.size() || payload_.size() - start < sizeof mark) return false;
  std::memcpy(&mark, payload_.data() + start, sizeof mark);
  if (mark != kBulkMark) return false;
  at_ = start + sizeof mark;
  for (std::uint64_t* const number : {&reference.loan, &reference.offset, &reference.size}) read(*number);
  return true;
}

BulkBlock* CdrReader::borrow(const BulkReference& reference, std::size_t element_size) {
  if (failed()) return nullptr;
  if (reference.size % element_size != 0) {
    problem_ = "a reference to " + std::to_string(reference.size) + " bytes, for elements of " +
               std::to_string(element_size);
    return nullptr;
  }
  const Result<BulkBlock*> block = source_->borrow(reference);
  if (block) return *block;
  problem_ = block.error().message;
  return nullptr;
}

void CdrReader::note_field(std::string_view name) {
  path_ = path_.empty() ? std::string(name) : std::string(name) + "." + path_;
}

void CdrReader::fail_enumerator(std::string_view name, std::uint32_t found, std::size_t count) {
  problem_ = "found " + std::to_string(found) + " for a " + std::string(name) + ", expected 0 to " +
             std::to_string(count - 1);
}

Status CdrReader::status(std::string_view type_name) const {
  std::string problem = problem_;
  if (!failed() && remaining() > kMaxPadding) {
    problem = std::to_string(remaining()) + " bytes follow the last field; is the sender's type newer?";
  }
  if (problem.empty()) return ok();
  return fail(Code::data_loss, std::move(problem),
              std::string(type_name) + (path_.empty() ? "" : "." + path_));
}

}  // namespace orca::detail
