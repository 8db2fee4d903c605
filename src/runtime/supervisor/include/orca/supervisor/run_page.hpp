// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "orca/base/descriptor.hpp"
#include "orca/base/doorbell.hpp"
#include "orca/base/result.hpp"
#include "orca/base/shared_memory.hpp"

namespace orca::supervisor {

/// The memory that all host processes of a machine share with their supervisor: a count of missions, how other machines' clocks differ,
/// a heartbeat for each process, and doorbells. Processes and machines are counted in the order of the graph, components as the
/// supervisor says: some may come later. Each word that is written often has a cache line of its own.
///
/// A host process can write its own heartbeat, the doorbells, the clocks and the count, and only read the heartbeats of others
/// (belong_to()). By mistake it may write anything into them, so a reader must cope with every value of every word. No size and
/// no place is read from what is written there.
///
/// Thread contract: any thread.
class RunPage {
 public:
  static constexpr std::size_t kMostMachines = 63;  ///< Clocks of further ones have no word.

  /// Makes the page of a machine, with all words 0.
  /// @param components  those that there may ever be. Some more may find room.
  /// @errors  as MemoryFile::create().
  [[nodiscard]] static Result<RunPage> create(std::size_t processes, std::size_t components);
  /// Maps the page that the supervisor has made for the same graph.
  /// @param file        may be open for reading only.
  /// @param components  those that there are at least.
  /// @errors  data_loss if the memory is no page for so many processes and components.
  [[nodiscard]] static Result<RunPage> map(Descriptor file, std::size_t processes, std::size_t components);

  /// Lets this process write no heartbeat but that of one process: itself. A stray write into another one then ends this process.
  /// @pre     process < processes(); called once.
  /// @errors  unavailable if the system refuses it.
  [[nodiscard]] Status belong_to(std::size_t process);

  /// Returns the number of missions that have begun. Adding to it begins one.
  [[nodiscard]] std::atomic<std::uint64_t>& missions() const;
  /// Returns by how much the clock of a machine is ahead of this one's [ns], as far as the instants in what it sends are to be
  /// corrected. The supervisor writes it.
  /// @pre  machine < kMostMachines
  [[nodiscard]] std::atomic<std::int64_t>& clock_ahead(std::size_t machine) const;
  /// Returns the word to which a process adds while it is well; 0: it has not begun.
  /// @pre  process < processes()
  [[nodiscard]] std::atomic<std::uint32_t>& heartbeat(std::size_t process) const;
  /// Returns the word that wakes the strand of a component.
  /// @pre  component < components()
  [[nodiscard]] DoorbellWord& doorbell(std::size_t component) const;
  /// Returns the word that wakes a process whose strands have one word together.
  /// @pre  process < processes()
  [[nodiscard]] DoorbellWord& process_doorbell(std::size_t process) const;

  [[nodiscard]] std::size_t processes() const { return processes_; }
  [[nodiscard]] std::size_t components() const { return components_; }

  /// Returns a new descriptor of the page, to give to another process. Nothing can be written through it.
  /// @errors  throws std::system_error if there are no descriptors left (orca/base/exhaustion.hpp).
  [[nodiscard]] Descriptor descriptor() const;

 private:
  RunPage(Descriptor file, SharedMemory memory, std::size_t processes, std::size_t components)
      : file_(std::move(file)), memory_(std::move(memory)), processes_(processes), components_(components) {}
  [[nodiscard]] std::atomic<std::uint32_t>& word(std::size_t place) const;

  Descriptor file_;
  SharedMemory memory_;
  std::size_t processes_;
  std::size_t components_;
};

}  // namespace orca::supervisor
