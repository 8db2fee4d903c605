// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/idl/bulk.hpp"

#include <catch2/catch.hpp>

#include <cstdint>
#include <numeric>
#include <span>
#include <thread>
#include <vector>

#include "bulk_pools.hpp"
#include "orca/idl/sensing.hpp"

using namespace orca;
using namespace orca::test;

namespace {

using Bytes8 = std::vector<std::uint8_t>;

constexpr std::size_t kLarge = 100'000;

Bytes8 counted(std::size_t count) {
  Bytes8 values(count);
  std::iota(values.begin(), values.end(), std::uint8_t{0});
  return values;
}

// Lends to nobody, and counts how often it is asked.
struct CountingLender final : BulkPool::Lender {
  bool collect() noexcept override { return ++asked < 3; }
  int asked = 0;
};

}  // namespace

TEST_CASE("bulk data is used like a vector", "[idl][bulk]") {
  const std::size_t count = GENERATE(0, 1, 7, 1000, 100'000);
  if (count > 1000) provide_to_itself();
  const Bytes8 values = counted(count);
  Bulk<std::uint8_t> bulk = values;
  CHECK(bulk.size() == count);
  CHECK(bulk.empty() == (count == 0));
  CHECK(bulk == values);
  CHECK(Bytes8(bulk) == values);
  CHECK(std::accumulate(bulk.begin(), bulk.end(), 0L) == std::accumulate(values.begin(), values.end(), 0L));
  CHECK(std::span<const std::uint8_t>(bulk).size() == count);

  Bulk<std::uint8_t> copy = bulk;
  copy.push_back(42);
  CHECK(copy.size() == count + 1);
  CHECK(copy.back() == 42);
  CHECK(copy.at(count) == 42);
  CHECK(bulk == values);
  CHECK_FALSE(copy == bulk);
  CHECK_THROWS_AS(bulk.at(count), std::out_of_range);

  copy.resize(count + 50);
  CHECK(copy[count + 49] == 0);
  copy.resize(count);
  CHECK(copy == bulk);
  copy.assign(3, 9);
  CHECK(copy == Bulk<std::uint8_t>{9, 9, 9});
  copy = bulk;
  const Bulk<std::uint8_t> moved = std::move(copy);
  CHECK(moved == values);
}

TEST_CASE("numbers of bulk data grow one by one", "[idl][bulk]") {
  Bulk<double> bulk;
  for (int i = 0; i < 5000; ++i) bulk.push_back(i);
  REQUIRE(bulk.size() == 5000);
  for (int i = 0; i < 5000; ++i) REQUIRE(bulk[static_cast<std::size_t>(i)] == i);
}

TEST_CASE("large bulk data is in the pool as long as it has room, and small one never", "[idl][bulk]") {
  provide_to_itself();
  const std::size_t before = BulkPool::own().used();
  Bulk<std::uint8_t> small;
  small.resize(detail::kLeastBulk - 1);
  CHECK(small.block() == nullptr);
  std::vector<Bulk<std::uint8_t>> all(kBulkPoolSize / (8 << 20) + 1);
  for (auto& one : all) one.assign(8 << 20, 7);
  CHECK(all.front().block() != nullptr);
  CHECK(all.back().block() == nullptr);
  CHECK(all.back().back() == 7);
  CHECK(BulkPool::own().used() > before);
  all.clear();
  CHECK(BulkPool::own().used() == before);
}

TEST_CASE("what was on the heap goes to the pool when that has room again", "[idl][bulk]") {
  provide_to_itself();
  Bulk<std::uint8_t> bulk;
  {
    const Bulk<std::uint8_t> other(kBulkPoolSize - BulkPool::own().used());
    bulk.resize(kLarge);
    CHECK(bulk.block() == nullptr);
  }
  bulk.clear();
  bulk.resize(kLarge);
  CHECK(bulk.block() != nullptr);
}

TEST_CASE("an object that goes back to its own memory gives its piece of the pool back", "[idl][bulk]") {
  provide_to_itself();
  const std::size_t before = BulkPool::own().used();
  {
    Loan<idl::Image> image = make_object<idl::Image>();
    image->data().resize(kLarge);
    CHECK(BulkPool::own().used() > before);
    const ObjectPtr<idl::Image> sealed = std::move(image).seal();
    const Loan<idl::Image> copy = copy_value(sealed);
    CHECK(copy->data() == sealed->data());
    CHECK(copy->data().data() != sealed->data().data());
  }
  CHECK(BulkPool::own().used() == before);
}

TEST_CASE("a piece that was lent is not written by the next object", "[idl][bulk]") {
  provide_to_itself();
  Bulk<std::uint8_t> bulk(kLarge);
  detail::BulkBlock& lent = *bulk.block();
  ++lent.references;
  bulk.clear();
  bulk.assign(kLarge, 1);
  CHECK(bulk.block() != &lent);
  detail::release(lent);
}

TEST_CASE("the pool forgets a lender to which nothing can come back", "[idl][bulk]") {
  provide_to_itself();
  const auto lender = std::make_shared<CountingLender>();
  BulkPool::own().add(lender);
  for (int i = 0; i < 5; ++i) (void)BulkPool::own().used();
  CHECK(lender->asked == 3);
}

TEST_CASE("a pool is given once, and only what is one", "[idl][bulk]") {
  provide_to_itself();
  CHECK(BulkPool::own().provide(copy_of(make_pool())).error().code == Code::already_exists);
  const MemoryFile small = MemoryFile::create("small", 4096).value();
  CHECK(PeerPools::all().note("peer", copy_of(small)).error().code == Code::invalid_argument);
  CHECK(PeerPools::all().find(1) == nullptr);
}

TEST_CASE("nobody but its owner can map a pool to be written", "[idl][bulk]") {
  const MemoryFile file = make_pool();
  const auto owned = SharedMemory::map(file.descriptor(), SharedMemory::Use::owns);
  REQUIRE(owned);
  CHECK_FALSE(SharedMemory::map(file.descriptor()));
  const auto read = SharedMemory::map(file.descriptor(), SharedMemory::Use::reads);
  REQUIRE(read);
  owned->bytes()[5] = std::byte{42};
  CHECK(read->bytes()[5] == std::byte{42});
}

TEST_CASE("several threads take pieces of the pool and give them back", "[idl][bulk]") {
  provide_to_itself();
  const std::size_t before = BulkPool::own().used();
  std::vector<std::thread> threads;
  std::atomic<int> wrong{0};
  for (std::uint8_t number = 1; number <= 4; ++number)
    threads.emplace_back([&wrong, number] {
      for (int round = 0; round < 200; ++round) {
        const Bulk<std::uint8_t> bulk(
            Bulk<std::uint8_t>(std::vector<std::uint8_t>(20'000 + round * 100, number)));
        for (const std::uint8_t value : bulk)
          if (value != number) ++wrong;
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(wrong == 0);
  CHECK(BulkPool::own().used() == before);
}
