// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include <cstdint>

#include "orca/patterns/dds/dds_backend.hpp"
#include "participant.hpp"

namespace orca::dds {

/// Sets what Fast DDS has once per process. Called before anything else of it.
void prepare_library();

/// Returns the settings of a participant: UDP on one interface, without shared memory.
[[nodiscard]] eprosima::fastdds::dds::DomainParticipantQos participant_qos(const DdsOptions& options);

/// Return the settings of a reliable writer and reader that keep the last samples, as many as the depth is.
[[nodiscard]] eprosima::fastdds::dds::DataWriterQos writer_qos(const TopicOptions& options);
[[nodiscard]] eprosima::fastdds::dds::DataReaderQos reader_qos(std::int32_t depth);

}  // namespace orca::dds
