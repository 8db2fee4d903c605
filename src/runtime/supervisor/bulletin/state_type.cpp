// SPDX-License-Identifier: LGPL-3.0-or-later
#include "state_type.hpp"

#include <array>
#include <cstdint>
#include <cstring>

namespace orca::supervisor {
namespace {

constexpr std::array<std::uint8_t, 4> kEncapsulation{0, 1, 0, 0};  // CDR, little-endian
constexpr std::uint32_t kUsual = 4096;                             // [bytes] of a state; longer ones get more

}  // namespace

StateType::StateType(const std::string& idl_name) {
  setName(idl_name.c_str());
  m_typeSize = kUsual;
  m_isGetKeyDefined = false;
  auto_fill_type_object(false);
  auto_fill_type_information(false);
}

bool StateType::serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) {
  const Sample& sample = *static_cast<Sample*>(data);
  if (payload->max_size < kEncapsulation.size() + sample.size()) return false;
  std::memcpy(payload->data, kEncapsulation.data(), kEncapsulation.size());
  if (!sample.empty()) std::memcpy(payload->data + kEncapsulation.size(), sample.data(), sample.size());
  payload->length = static_cast<std::uint32_t>(kEncapsulation.size() + sample.size());
  payload->encapsulation = CDR_LE;
  return true;
}

bool StateType::deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) {
  if (payload->length < kEncapsulation.size() || payload->data[1] != kEncapsulation[1]) return false;
  const auto* const begin = reinterpret_cast<const std::byte*>(payload->data);
  static_cast<Sample*>(data)->assign(begin + kEncapsulation.size(), begin + payload->length);
  return true;
}

std::function<uint32_t()> StateType::getSerializedSizeProvider(void* data) {
  const auto size = static_cast<std::uint32_t>(kEncapsulation.size() + static_cast<Sample*>(data)->size());
  return [size] { return size; };
}

}  // namespace orca::supervisor
