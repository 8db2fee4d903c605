// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/supervisor/run_page.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "open_descriptors.hpp"

using namespace orca;
using namespace orca::supervisor;

namespace {

Descriptor memory_of(std::size_t size, int seals) {
  Descriptor file(memfd_create("test", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  REQUIRE(ftruncate(file.number(), static_cast<off_t>(size)) == 0);
  REQUIRE(fcntl(file.number(), F_ADD_SEALS, seals) == 0);
  return file;
}

// Writes all ones into each word of a page.
void scribble(const RunPage& page) {
  page.missions() = ~std::uint64_t{0};
  for (std::size_t i = 0; i < page.processes(); ++i) page.heartbeat(i) = page.process_doorbell(i) = ~0U;
  for (std::size_t i = 0; i < page.components(); ++i) page.doorbell(i) = ~0U;
}

// Returns whether this process may write a word: the kernel may, on its behalf, if it may itself.
bool is_writable(std::atomic<std::uint32_t>& word) {
  const Descriptor zero(open("/dev/zero", O_RDONLY | O_CLOEXEC));
  return read(zero.number(), &word, sizeof word) == sizeof word;
}

}  // namespace

TEST_CASE("All who map a run page see the same words", "[supervisor][run_page]") {
  const auto made = RunPage::create(2, 3);
  REQUIRE(made);
  const auto mapped = RunPage::map(made->descriptor(), 2, 3);
  REQUIRE(mapped);
  CHECK(made->missions().fetch_add(1) == 0);
  CHECK(mapped->missions() == 1);
  std::vector<std::atomic<std::uint32_t>*> there, here;
  for (const auto& [page, words] : {std::pair(&*made, &there), std::pair(&*mapped, &here)}) {
    for (std::size_t i = 0; i < 2; ++i) words->push_back(&page->heartbeat(i));
    for (std::size_t i = 0; i < 3; ++i) words->push_back(&page->doorbell(i));
    for (std::size_t i = 0; i < 2; ++i) words->push_back(&page->process_doorbell(i));
  }
  for (std::uint32_t i = 0; i < there.size(); ++i) *there[i] = i + 1;
  for (std::uint32_t i = 0; i < here.size(); ++i) CHECK(*here[i] == i + 1);
  CHECK(made->missions() == 1);
  CHECK(std::set(there.begin(), there.end()).size() == 7);
}

TEST_CASE("All who map a run page see by how much clocks are ahead", "[supervisor][run_page]") {
  const auto made = RunPage::create(2, 3);
  REQUIRE(made.has_value());
  const auto mapped = RunPage::map(made->descriptor(), 2, 3);
  REQUIRE(mapped.has_value());
  for (const std::size_t machine : {std::size_t{0}, RunPage::kMostMachines - 1}) {
    CHECK(mapped->clock_ahead(machine) == 0);
    made->clock_ahead(machine) = -7 - static_cast<std::int64_t>(machine);
  }
  CHECK(mapped->clock_ahead(0) == -7);
  CHECK(mapped->clock_ahead(RunPage::kMostMachines - 1) == -69);
  CHECK(mapped->missions() == 0);
  CHECK(mapped->process_doorbell(0) == 0);
  CHECK_THROWS_AS(mapped->clock_ahead(RunPage::kMostMachines), std::out_of_range);
}

TEST_CASE("Words of a run page share no cache line", "[supervisor][run_page]") {
  const auto page = RunPage::create(2, 2);
  REQUIRE(page);
  const auto line = [](const auto& word) { return reinterpret_cast<std::uintptr_t>(&word) / 64; };
  const std::set<std::uintptr_t> lines{line(page->missions()),         line(page->heartbeat(0)),
                                       line(page->heartbeat(1)),       line(page->doorbell(0)),
                                       line(page->doorbell(1)),        line(page->process_doorbell(0)),
                                       line(page->process_doorbell(1))};
  CHECK(lines.size() == 7);
}

TEST_CASE("A word that is not there is refused", "[supervisor][run_page]") {
  const auto page = RunPage::create(2, 3);
  REQUIRE(page);
  CHECK_THROWS_AS(page->heartbeat(2), std::out_of_range);
  CHECK_THROWS_AS(page->doorbell(page->components()), std::out_of_range);
  CHECK_THROWS_AS(page->process_doorbell(2), std::out_of_range);
}

TEST_CASE("Memory that is no run page of this graph is refused", "[supervisor][run_page]") {
  constexpr int kSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;
  const std::size_t before = test::open_descriptors();
  const auto made = RunPage::create(2, 3);
  REQUIRE(made);
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  CHECK(RunPage::map(memory_of(3 * page, kSeals), 2, 3).has_value());
  CHECK(RunPage::map(made->descriptor(), 2, 1000).error().code == Code::data_loss);
  CHECK(RunPage::map(made->descriptor(), 3, 3).error().code == Code::data_loss);
  CHECK(RunPage::map(memory_of(3 * page + 1, kSeals), 2, 3).error().code == Code::data_loss);
  CHECK(RunPage::map(memory_of(3 * page, 0), 2, 3).error().code == Code::data_loss);
  CHECK(RunPage::map(Descriptor(open("/dev/null", O_RDWR)), 2, 3).error().code == Code::data_loss);
  CHECK(test::open_descriptors() == before + 1);
}

TEST_CASE("A run page can be mapped whatever was written into it", "[supervisor][run_page]") {
  const auto made = RunPage::create(2, 3);
  REQUIRE(made);
  scribble(*made);
  const auto mapped = RunPage::map(made->descriptor(), 2, 3);
  REQUIRE(mapped);
  CHECK(mapped->processes() == 2);
  CHECK(mapped->components() == made->components());
  CHECK(&mapped->process_doorbell(1) - &mapped->doorbell(0) ==
        &made->process_doorbell(1) - &made->doorbell(0));
}

TEST_CASE("A process can write its own heartbeat and no other one, whatever its place",
          "[supervisor][run_page]") {
  const std::size_t place = GENERATE(0U, 1U, 2U);
  const auto made = RunPage::create(3, 3);
  REQUIRE(made);
  auto mapped = RunPage::map(made->descriptor(), 3, 3);
  REQUIRE(mapped);
  REQUIRE(mapped->belong_to(place).ok());
  ++mapped->doorbell(0);
  ++mapped->process_doorbell(1);
  ++mapped->missions();
  for (std::size_t process = 0; process < 3; ++process) {
    CAPTURE(place, process);
    CHECK(is_writable(mapped->heartbeat(process)) == (process == place));
    made->heartbeat(process) = 7;
    CHECK(mapped->heartbeat(process) == 7);
  }
}

TEST_CASE("Nothing can be written through the descriptor that is handed on, but who gets it can map the page",
          "[supervisor][run_page]") {
  const auto made = RunPage::create(2, 3);
  REQUIRE(made);
  const auto mapped = RunPage::map(made->descriptor(), 2, 3);
  REQUIRE(mapped);
  for (const auto* page : {&*made, &*mapped}) CHECK(write(page->descriptor().number(), "stray", 5) == -1);
  const auto next = RunPage::map(mapped->descriptor(), 2, 3);
  REQUIRE(next);
  next->missions() = 3;
  CHECK(made->missions() == 3);
}

TEST_CASE("Nobody can take a run page away from those who have mapped it", "[supervisor][run_page]") {
  const auto page = RunPage::create(1, 1);
  REQUIRE(page);
  const Descriptor file = page->descriptor();
  CHECK((fcntl(file.number(), F_GETFD) & FD_CLOEXEC) != 0);
  CHECK(ftruncate(file.number(), 0) != 0);
}
