// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <fastdds/dds/topic/TopicDataType.hpp>

namespace orca::supervisor {

/// The encoded state of a machine or of a team's system as it travels: plain XCDR1, little-endian, under the name of its IDL type, so that any
/// program with a type made from the IDL can read it. A sample is a std::vector<std::byte> without encapsulation header.
///
/// Thread contract: none of its own.
class StateType final : public eprosima::fastdds::dds::TopicDataType {
 public:
  using Sample = std::vector<std::byte>;

  explicit StateType(const std::string& idl_name);
  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override;
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override;
  std::function<uint32_t()> getSerializedSizeProvider(void* data) override;
  void* createData() override { return new Sample; }
  void deleteData(void* data) override { delete static_cast<Sample*>(data); }
  bool getKey(void* /*data*/, eprosima::fastrtps::rtps::InstanceHandle_t* /*handle*/, bool /*md5*/) override {
    return false;
  }
};

}  // namespace orca::supervisor
