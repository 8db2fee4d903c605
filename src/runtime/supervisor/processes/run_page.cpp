// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/run_page.hpp"

#include <fcntl.h>

#include <cerrno>
#include <stdexcept>
#include <string>

#include "orca/base/exhaustion.hpp"

namespace orca::supervisor {
namespace {

// The page is a row of lines: the head, a heartbeat for each process, a doorbell for each component, a doorbell for each
// process.
constexpr std::size_t kLine = 64;  // [bytes] of a cache line

struct alignas(kLine) PageHead {
  std::atomic<std::uint64_t> missions;
};

static_assert(sizeof(PageHead) == kLine && std::atomic<std::uint64_t>::is_always_lock_free,
              "processes cannot share locks");

std::size_t size_of(std::size_t processes, std::size_t components) {
  return kLine * (1 + processes + components + processes);
}

PageHead& head_of(const SharedMemory& memory) { return *reinterpret_cast<PageHead*>(memory.bytes().data()); }

Descriptor copy_of(int descriptor) {
  Descriptor copy(fcntl(descriptor, F_DUPFD_CLOEXEC, 0));
  if (!copy) throw_if_exhausted(errno);
  return copy;
}

// A wrong index would be a wrong place in memory that processes share.
std::size_t checked(std::size_t index, std::size_t count) {
  if (index < count) return index;
  throw std::out_of_range("the run page has " + std::to_string(count) + " of these, not " +
                          std::to_string(index + 1));
}

}  // namespace

Result<RunPage> RunPage::create(std::size_t processes, std::size_t components) {
  auto file = MemoryFile::create("orca-run", size_of(processes, components));
  if (!file) return file.error();
  auto memory = SharedMemory::map(file->descriptor());
  if (!memory) return memory.error();
  return RunPage(copy_of(file->descriptor()), std::move(*memory), processes, components);
}

Result<RunPage> RunPage::map(Descriptor file, std::size_t processes, std::size_t components) {
  auto memory = SharedMemory::map(file.number());
  if (!memory) return fail(Code::data_loss, "the run page: " + memory.error().message);
  const std::size_t size = memory->bytes().size();
  if (size < size_of(processes, components) || size % kLine != 0)  // the size that nobody can change
    return fail(Code::data_loss, "the run page is for another graph, or of another version of the deployer");
  return RunPage(std::move(file), std::move(*memory), processes, (size - size_of(processes, 0)) / kLine);
}

std::atomic<std::uint64_t>& RunPage::missions() const { return head_of(memory_).missions; }

std::atomic<std::uint32_t>& RunPage::heartbeat(std::size_t process) const {
  return word(1 + checked(process, processes_));
}

DoorbellWord& RunPage::doorbell(std::size_t component) const {
  return word(1 + processes_ + checked(component, components_));
}

DoorbellWord& RunPage::process_doorbell(std::size_t process) const {
  return word(1 + processes_ + components_ + checked(process, processes_));
}

std::atomic<std::uint32_t>& RunPage::word(std::size_t line) const {
  return *reinterpret_cast<std::atomic<std::uint32_t>*>(memory_.bytes().data() + line * kLine);
}

Descriptor RunPage::descriptor() const { return copy_of(file_.number()); }

}  // namespace orca::supervisor
