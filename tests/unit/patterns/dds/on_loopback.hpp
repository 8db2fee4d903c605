// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include <memory>

namespace orca::test {

/// As most DDS programs can be told: on a machine's own network only, where Orca is within a machine.
inline eprosima::fastdds::dds::DomainParticipantQos on_loopback() {
  eprosima::fastdds::dds::DomainParticipantQos qos;
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = {"127.0.0.1"};
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports = {udp};
  return qos;
}

}  // namespace orca::test
