// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/component/state.hpp"

#include <bit>
#include <cstring>
#include <string>

namespace orca {
namespace {

using detail::StateKind;

const char* to_string(StateKind kind) {
  switch (kind) {
    case StateKind::boolean: return "a flag";
    case StateKind::integer: return "a whole number";
    case StateKind::real: return "a real number";
    case StateKind::text: return "a text";
    case StateKind::count: return "a list";
    case StateKind::object: return "an object";
  }
  return "a value of unknown kind";
}

}  // namespace

// --- Writing ----------------------------------------------------------------------------------------------
// A value is its kind in one byte and 64 bits as the machine holds them; the bytes of a text follow their number. The
// bytes never leave the machine.

void StateWriter::put_bits(StateKind kind, std::uint64_t bits) {
  const auto* const begin = reinterpret_cast<const std::byte*>(&bits);
  bytes_.push_back(static_cast<std::byte>(kind));
  bytes_.insert(bytes_.end(), begin, begin + sizeof bits);
}

void StateWriter::put_boolean(bool value) { put_bits(StateKind::boolean, value ? 1 : 0); }

void StateWriter::put_integer(std::int64_t value) {
  put_bits(StateKind::integer, static_cast<std::uint64_t>(value));
}

void StateWriter::put_real(double value) { put_bits(StateKind::real, std::bit_cast<std::uint64_t>(value)); }

void StateWriter::put_text(std::string_view value) {
  put_bits(StateKind::text, value.size());
  const auto* const begin = reinterpret_cast<const std::byte*>(value.data());
  bytes_.insert(bytes_.end(), begin, begin + value.size());
}

void StateWriter::put_count(std::size_t value) { put_bits(StateKind::count, value); }

void StateWriter::put_object(const ObjectType& type, const void* object) {
  std::vector<std::byte> payload;
  type.serialize(object, payload);
  put_bits(StateKind::object, payload.size());
  bytes_.insert(bytes_.end(), payload.begin(), payload.end());
}

void StateWriter::put_shared(const ObjectRef& object) {
  put_boolean(static_cast<bool>(object));
  if (!object) return;
  put_text(object.type().name);
  put_object(object.type(), object.get());
}

// --- Reading ----------------------------------------------------------------------------------------------

void StateReader::check(bool fits, const char* what) {
  if (!fits && !error_)
    error_ = fail(Code::data_loss, "value " + std::to_string(values_) + " of the state is " + what);
}

std::uint64_t StateReader::get_bits(StateKind kind) {
  if (error_) return 0;
  ++values_;
  const std::span<const std::byte> head = get_bytes(1 + sizeof(std::uint64_t));
  if (error_) return 0;
  const auto found = static_cast<StateKind>(head[0]);
  if (found != kind)
    check(false, (std::string(to_string(found)) + ", where " + to_string(kind) + " is expected").c_str());
  std::uint64_t bits = 0;
  std::memcpy(&bits, &head[1], sizeof bits);
  return error_ ? 0 : bits;
}

std::span<const std::byte> StateReader::get_bytes(std::uint64_t count) {
  check(count <= rest_.size(), "missing");
  if (error_) return {};
  const std::span<const std::byte> found = rest_.first(count);
  rest_ = rest_.subspan(count);
  return found;
}

bool StateReader::get_boolean() { return get_bits(StateKind::boolean) != 0; }

std::int64_t StateReader::get_integer() { return static_cast<std::int64_t>(get_bits(StateKind::integer)); }

double StateReader::get_real() { return std::bit_cast<double>(get_bits(StateKind::real)); }

std::string StateReader::get_text() {
  const std::span<const std::byte> text = get_bytes(get_bits(StateKind::text));
  return {reinterpret_cast<const char*>(text.data()), text.size()};
}

std::size_t StateReader::get_count() { return get_bits(StateKind::count); }

void StateReader::get_object(const ObjectType& type, void* object) {
  const std::span<const std::byte> payload = get_bytes(get_bits(StateKind::object));
  if (error_) return;
  if (const Status read = type.deserialize(payload, object); !read.ok())
    check(false, ("no " + std::string(type.name) + ": " + read.error().message).c_str());
}

ObjectRef StateReader::get_shared() {
  if (!get_boolean() || error_) return {};
  const std::string name = get_text();
  const ObjectType* const type = error_ ? nullptr : find_object_type(name);
  check(type != nullptr, "no name of an object type");
  if (error_) return {};
  ObjectLoan object = make_object(*type);
  get_object(*type, object.get());
  return std::move(object).seal();
}

Status StateReader::finish() const {
  if (error_) return *error_;
  if (rest_.empty()) return ok();
  return fail(Code::data_loss,
              "values are left in the state after the " + std::to_string(values_) + " that were read");
}

}  // namespace orca
