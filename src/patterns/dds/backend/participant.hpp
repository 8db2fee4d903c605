// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "line.hpp"
#include "orca/base/result.hpp"
#include "orca/idl/object.hpp"
#include "orca/patterns/dds/dds_backend.hpp"

namespace orca::dds {

/// The label of an object on its topic. It travels as the sample's related identity, which readers that do not ask
/// for it do not see.
struct Label {
  std::uint64_t layout_hash = 0;  ///< Belongs to the object's type, which may be derived from the topic's.
  std::uint64_t edges = 0;        ///< A bit for each edge for which the object is due; below 2^62.
  std::uint32_t epoch = 0;        ///< Grows with each subscription that begins to use the topic.
};

/// An object or a message that a reader has received.
struct Sample {
  std::vector<std::byte> bytes;  ///< kHeadroom bytes, then the contents.
  Label label;                   ///< Objects have one.
  Origin origin;
  std::uint64_t sequence = 0;  ///< The writer's; a gap means that samples were lost.

  /// Returns the object's XCDR1, or a message.
  [[nodiscard]] std::span<const std::byte> contents() const { return std::span(bytes).subspan(kHeadroom); }
};

/// A data writer. It keeps its topic alive.
///
/// Thread contract: one thread writes; the counter may be used by any.
class TopicWriter {
 public:
  virtual ~TopicWriter() = default;
  /// @param size  of the object, encoded [bytes].
  /// @return false if it could not be written.
  virtual bool write(const ObjectRef& object, std::size_t size, const Label& label) = 0;
  virtual bool write(std::vector<std::byte> messages) = 0;

  std::atomic<std::size_t> queued{0};  ///< Objects on their way to write() [bytes].
};

/// A data reader. No callback runs after its destructor.
class TopicReader {
 public:
  virtual ~TopicReader() = default;
};

/// A topic, and what its writer or reader does.
struct TopicOptions {
  std::string name;
  std::string type;        ///< IDL name with its modules.
  std::int32_t depth = 1;  ///< The number of samples that are kept.
  /// Is called when a reader or writer at the other side was found. It must not block.
  /// @thread  one of DDS.
  std::function<void()> found{};
  Duration reminder{
      std::chrono::milliseconds(50)};  ///< From a writer to readers that have not acknowledged a sample.
};

/// This process's part in DDS.
///
/// Thread contract: any thread.
class Participant {
 public:
  /// Takes a sample. It must not block.
  /// @thread  one of DDS.
  using Received = std::function<void(Sample)>;

  /// @errors  unavailable if DDS does not start, as a rule because of the network interface.
  [[nodiscard]] static Result<std::unique_ptr<Participant>> open(const DdsOptions& options);

  virtual ~Participant() = default;
  /// @errors  unavailable if DDS refuses.
  [[nodiscard]] virtual Result<std::shared_ptr<TopicWriter>> make_writer(const TopicOptions& topic) = 0;
  [[nodiscard]] virtual Result<std::unique_ptr<TopicReader>> make_reader(const TopicOptions& topic,
                                                                         Received received) = 0;

  /// Looks after the keys of a secured participant: whether the authority has revoked some, and whether they have expired. To be
  /// called often; does so once a second.
  /// @param now  the time of the day.
  virtual void look_after_keys(std::chrono::system_clock::time_point /*now*/) {}
  /// Returns whether a participant may speak for a process: in a secured system, its certificate must be the process's.
  [[nodiscard]] virtual bool may_speak_for(const Origin& /*speaker*/, const std::string& /*process*/) const {
    return true;
  }
};

}  // namespace orca::dds
