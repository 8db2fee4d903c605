// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/run_page.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>

#include "orca/base/exhaustion.hpp"

namespace orca::supervisor {
namespace {

// First come lines that every process can write: the head, a doorbell for each process, a doorbell for each component. Then comes a
// page of the processor's for each process, which begins with its heartbeat: only whole pages can be protected.
constexpr std::size_t kLine = 64;  // [bytes] of a cache line

struct alignas(kLine) PageHead {
  alignas(kLine) std::atomic<std::uint64_t> missions;
  alignas(kLine) std::atomic<std::int64_t> clocks[RunPage::kMostMachines];  // rarely written
};
constexpr std::size_t kHeadLines = sizeof(PageHead) / kLine;

static_assert(std::atomic<std::int64_t>::is_always_lock_free &&
                  std::atomic<std::uint64_t>::is_always_lock_free,
              "processes cannot share locks");

std::size_t page_size() {
  static const auto kSize = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return kSize;
}

std::size_t whole_pages(std::size_t size) { return (size + page_size() - 1) / page_size() * page_size(); }

std::size_t size_of(std::size_t processes, std::size_t components) {
  return whole_pages(kLine * (kHeadLines + processes + components)) + processes * page_size();
}

PageHead& head_of(const SharedMemory& memory) { return *reinterpret_cast<PageHead*>(memory.bytes().data()); }

// Opens the same memory once more, with another right to write than the descriptor has.
Descriptor opened_again(int descriptor, int mode) {
  Descriptor again(open(("/proc/self/fd/" + std::to_string(descriptor)).c_str(), mode | O_CLOEXEC));
  if (!again) throw_if_exhausted(errno);
  return again;
}

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
  const auto file = MemoryFile::create("orca-run", size_of(processes, components));
  if (!file) return file.error();
  return map(copy_of(file->descriptor()), processes, components);
}

Result<RunPage> RunPage::map(Descriptor file, std::size_t processes, std::size_t components) {
  auto memory = SharedMemory::map(opened_again(file.number(), O_RDWR).number());
  if (!memory) return fail(Code::data_loss, "the run page: " + memory.error().message);
  const std::size_t size = memory->bytes().size();
  if (size < size_of(processes, components) || size % page_size() != 0)  // the size that nobody can change
    return fail(Code::data_loss, "the run page is for another graph, or of another version of the deployer");
  const std::size_t lines = (size - processes * page_size()) / kLine;
  return RunPage(opened_again(file.number(), O_RDONLY), std::move(*memory), processes,
                 lines - kHeadLines - processes);
}

Status RunPage::belong_to(std::size_t process) {
  const std::span<std::byte> all = memory_.bytes();
  const std::size_t own = all.size() - (processes_ - checked(process, processes_)) * page_size();
  const std::size_t begin = all.size() - processes_ * page_size();
  const std::size_t end = own + page_size();
  if (mprotect(all.data() + begin, own - begin, PROT_READ) == 0 &&
      mprotect(all.data() + end, all.size() - end, PROT_READ) == 0)
    return ok();
  throw_if_exhausted(errno);
  return fail(Code::unavailable, std::string("the run page cannot be protected: ") + std::strerror(errno));
}

std::atomic<std::uint64_t>& RunPage::missions() const { return head_of(memory_).missions; }

std::atomic<std::int64_t>& RunPage::clock_ahead(std::size_t machine) const {
  return head_of(memory_).clocks[checked(machine, kMostMachines)];
}

std::atomic<std::uint32_t>& RunPage::heartbeat(std::size_t process) const {
  return word(memory_.bytes().size() - (processes_ - checked(process, processes_)) * page_size());
}

DoorbellWord& RunPage::doorbell(std::size_t component) const {
  return word(kLine * (kHeadLines + processes_ + checked(component, components_)));
}

DoorbellWord& RunPage::process_doorbell(std::size_t process) const {
  return word(kLine * (kHeadLines + checked(process, processes_)));
}

std::atomic<std::uint32_t>& RunPage::word(std::size_t place) const {
  return *reinterpret_cast<std::atomic<std::uint32_t>*>(memory_.bytes().data() + place);
}

Descriptor RunPage::descriptor() const { return copy_of(file_.number()); }

}  // namespace orca::supervisor
