// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <fastdds/dds/topic/TopicDataType.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "orca/idl/object.hpp"

namespace orca::dds {

/// An object for a writer, bytes that are to be a sequence<octet>, or bytes that are a sample already: then `size` is theirs.
struct Outgoing {
  const ObjectRef* object = nullptr;  ///< Null: the bytes.
  std::span<const std::byte> bytes{};
  std::size_t size = 0;  ///< As it is written, without encapsulation [bytes].
};

/// A type of DDS whose samples Orca encodes and decodes itself. A writer takes Outgoing, a reader fills a
/// std::vector<std::byte> with kHeadroom bytes, and then what follows the encapsulation.
///
/// Thread contract: constant once it is registered.
class RawType final : public eprosima::fastdds::dds::TopicDataType {
 public:
  explicit RawType(const std::string& name);

  using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;
  using Handle = eprosima::fastrtps::rtps::InstanceHandle_t;
  bool serialize(void* data, Payload* payload) override;
  bool deserialize(Payload* payload, void* data) override;
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override;
  void* createData() override { return new std::vector<std::byte>; }
  void deleteData(void* data) override { delete static_cast<std::vector<std::byte>*>(data); }
  bool getKey(void* /*data*/, Handle* /*handle*/, bool /*force_md5*/) override { return false; }
  [[nodiscard]] bool is_bounded() const override { return false; }
  [[nodiscard]] bool is_plain() const override { return false; }
};

}  // namespace orca::dds
