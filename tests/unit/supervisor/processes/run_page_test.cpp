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
  CHECK_THROWS_AS(page->doorbell(3), std::out_of_range);
  CHECK_THROWS_AS(page->process_doorbell(2), std::out_of_range);
}

TEST_CASE("Memory that is no run page of this graph is refused", "[supervisor][run_page]") {
  constexpr int kSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;
  const std::size_t before = test::open_descriptors();
  const auto made = RunPage::create(2, 3);
  REQUIRE(made);
  CHECK(RunPage::map(made->descriptor(), 2, 4).error().code == Code::data_loss);
  CHECK(RunPage::map(memory_of(64 * 8 + 1, kSeals), 2, 3).error().code == Code::data_loss);
  CHECK(RunPage::map(memory_of(64 * 8, 0), 2, 3).error().code == Code::data_loss);
  CHECK(RunPage::map(Descriptor(open("/dev/null", O_RDWR)), 2, 3).error().code == Code::data_loss);
  CHECK(test::open_descriptors() == before + 1);
}

TEST_CASE("A run page can be mapped whatever was written into it", "[supervisor][run_page]") {
  const auto made = RunPage::create(2, 3);
  REQUIRE(made);
  const auto memory = SharedMemory::map(made->descriptor().number());
  REQUIRE(memory);
  std::ranges::fill(memory->bytes(), std::byte{0xff});
  const auto mapped = RunPage::map(made->descriptor(), 2, 3);
  REQUIRE(mapped);
  CHECK(mapped->processes() == 2);
  CHECK(mapped->components() == made->components());
  CHECK(&mapped->process_doorbell(1) - &mapped->doorbell(0) ==
        &made->process_doorbell(1) - &made->doorbell(0));
}

TEST_CASE("Nobody can take a run page away from those who have mapped it", "[supervisor][run_page]") {
  const auto page = RunPage::create(1, 1);
  REQUIRE(page);
  const Descriptor file = page->descriptor();
  CHECK((fcntl(file.number(), F_GETFD) & FD_CLOEXEC) != 0);
  CHECK(ftruncate(file.number(), 0) != 0);
}
