// SPDX-License-Identifier: LGPL-3.0-or-later
#include "raw_type.hpp"

#include <array>
#include <cstdint>
#include <cstring>

#include "message.hpp"

namespace orca::dds {
namespace {

constexpr std::size_t kEncapsulation = 4;
// Plain CDR, little-endian, without options: what XCDR version 1 of final and appendable types begins with.
constexpr std::array<std::uint8_t, kEncapsulation> kPlainLittleEndian{0x00, 0x01, 0x00, 0x00};
constexpr std::uint32_t kSmall = 512;  // [bytes] for the first sample; more is taken where it is needed

void write(const Outgoing& sample, std::span<std::byte> to) {
  if (sample.object != nullptr) {
    (void)sample.object->type().write(sample.object->get(), to);
    return;
  }
  if (sample.size == sample.bytes.size()) {
    std::memcpy(to.data(), sample.bytes.data(), sample.size);
    return;
  }
  const auto length = static_cast<std::uint32_t>(sample.bytes.size());
  std::memcpy(to.data(), &length, sizeof length);
  std::memcpy(to.data() + sizeof length, sample.bytes.data(), sample.bytes.size());
}

}  // namespace

RawType::RawType(const std::string& name) {
  setName(name.c_str());
  m_typeSize = kSmall;
  m_isGetKeyDefined = false;
  auto_fill_type_object(false);
  auto_fill_type_information(false);
}

bool RawType::serialize(void* data, Payload* payload) {
  const Outgoing& sample = *static_cast<const Outgoing*>(data);
  if (payload->max_size < kEncapsulation + sample.size) return false;
  std::memcpy(payload->data, kPlainLittleEndian.data(), kEncapsulation);
  write(sample, {reinterpret_cast<std::byte*>(payload->data) + kEncapsulation, sample.size});
  payload->encapsulation = CDR_LE;
  payload->length = static_cast<std::uint32_t>(kEncapsulation + sample.size);
  return true;
}

// The payload is not trusted. Samples of other encodings are discarded.
bool RawType::deserialize(Payload* payload, void* data) {
  auto& bytes = *static_cast<std::vector<std::byte>*>(data);
  bytes.clear();
  if (payload->length < kEncapsulation ||
      std::memcmp(payload->data, kPlainLittleEndian.data(), 2) != 0)  // the other two are options
    return false;
  const auto* const begin = reinterpret_cast<const std::byte*>(payload->data);
  bytes.reserve(kHeadroom + payload->length - kEncapsulation);
  bytes.resize(kHeadroom);
  bytes.insert(bytes.end(), begin + kEncapsulation, begin + payload->length);
  return true;
}

std::function<std::uint32_t()> RawType::getSerializedSizeProvider(void* data) {
  return [data] {
    return static_cast<std::uint32_t>(kEncapsulation + static_cast<const Outgoing*>(data)->size);
  };
}

}  // namespace orca::dds
