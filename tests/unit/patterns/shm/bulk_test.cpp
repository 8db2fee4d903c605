// SPDX-License-Identifier: GPL-3.0-or-later
// Bulk data that is lent from process to process (ADR 0104), and what a reader that dies, hoards or lies can do.
#include "orca/idl/bulk.hpp"

#include <catch2/catch.hpp>

#include <atomic>
#include <cstring>
#include <numeric>
#include <random>
#include <vector>

#include "all_ports.hpp"
#include "bulk_pools.hpp"
#include "executives.hpp"
#include "orca/base/log.hpp"
#include "orca/idl/sensing.hpp"
#include "shm/bulk_loans.hpp"
#include "two_processes.hpp"

using namespace orca;
using namespace orca::test;
using idl::Image;

namespace {

constexpr std::size_t kLarge = 1'000'000;  // [bytes]

struct Camera : Peer {
  explicit Camera(Executive& executive) : Peer(executive, "camera") {}
  void push(int number, std::size_t size = kLarge) {
    auto image = out.loan();
    image->data().assign(size, static_cast<std::uint8_t>(number));
    out.push(std::move(image));
  }
  PushServer<Image> out{*this, "out"};
};

struct Viewer : Peer {
  explicit Viewer(Executive& executive) : Peer(executive, "viewer") {}
  PushProxy<Image> in{*this, "in"};
};

bool is_whole(const ObjectPtr<Image>& image, int number) {
  if (!image || image->data().size() != kLarge) return false;
  // All images together have gigabytes, and this code is not optimised: each byte is like the one before.
  const auto* const bytes = image->data().data();
  return bytes[0] == number % 256 && std::memcmp(bytes, bytes + 1, kLarge - 1) == 0;
}

// Whether it shows the memory of another process.
bool is_borrowed(const ObjectPtr<Image>& image) {
  const detail::BulkBlock* const block = image->data().block();
  return block != nullptr && block->ended != nullptr;
}

constexpr QueuePolicy kDeep{.depth = 100};
constexpr QueuePolicy kBlock{.depth = 4, .overflow = QueuePolicy::Overflow::block, .block_limit = 10s};

const MemoryFile& provided_pool() {
  provide_to_itself();
  return own_pool();
}

MemoryFile fresh_rings() { return RingSegment::create("test").value(); }

// Lets a camera in this process push to a viewer in another one, which runs `view`.
struct ToOther {
  using View = std::function<void(Viewer&)>;

  ToOther(Executive& executive, const QueuePolicy& policy, View view)
      : policy_(policy), view_(std::move(view)), camera(executive) {
    camera.strand().set_doorbell(page_->parent);
    end = &make_shm_end(port<PushServerEndpoint>(camera, "out"), map(file_), {"viewer.in", &page_->child},
                        policy_);
    camera.strand().wait_for(kForever, [&] { return camera.out.subscriber_count() == 1; });
  }
  // Ends the viewer as the supervisor tells it, so that all that was lent comes back.
  ~ToOther() {
    other->kill_now();
    end->cut(fail(Code::unavailable, "its process was killed"));
    camera.strand().take_in();
  }
  ToOther(const ToOther&) = delete;
  ToOther& operator=(const ToOther&) = delete;
  // Replaces the viewer by another one.
  void replace() {
    other->kill_now();
    end->cut(fail(Code::unavailable, "its process was killed"));
    file_ = fresh_rings();
    other.emplace([this](Executive& there) { run(there); });
    end->renew(map(file_));
    camera.strand().wait_for(kForever, [&] { return !end->is_cut() && camera.out.subscriber_count() == 1; });
  }

 private:
  void run(Executive& executive) {
    note_peer("camera", pool_);
    Viewer viewer(executive);
    viewer.strand().set_doorbell(page_->child);
    make_shm_end(port<PushClientEndpoint>(viewer, "in"), map(file_), {"camera.out", &page_->parent}, policy_,
                 Duration{0});
    viewer.in.subscribe();
    view_(viewer);
  }

  const QueuePolicy policy_;
  const View view_;
  const MemoryFile& pool_ = provided_pool();  // before the other process, which reads it, is forked
  SharedPage page_;
  MemoryFile file_ = fresh_rings();

 public:
  std::optional<OtherProcess> other{std::in_place, [this](Executive& there) { run(there); }};
  Camera camera;
  ShmEnd* end = nullptr;
};

// The writer's and the reader's state of loans, in one process.
struct BothSides {
  BothSides() {
    provide_to_itself();
    loans->restart(segment.share(), shm::loans_in(segment.memory().bytes(), 0));
  }
  ~BothSides() { loans->leave(); }
  shm::LoanControl& control() { return shm::loans_in(segment.memory().bytes(), 0); }
  std::optional<detail::BulkReference> lend(const Bulk<std::uint8_t>& bulk) {
    auto reference = loans->lend(*bulk.block());
    loans->settle(true);
    if (reference) reference->size = bulk.size();
    return reference;
  }

  MemoryFile file = fresh_rings();
  RingSegment segment = map(file);
  std::shared_ptr<shm::Loans> loans = shm::Loans::make();
  shm::Borrowing borrowing{segment.share(), control()};
};

}  // namespace

TEST_CASE("what was lent comes back when the reader drops it", "[patterns][shm][bulk]") {
  BothSides both;
  both.borrowing.look();
  const std::size_t before = BulkPool::own().used();
  std::optional<Bulk<std::uint8_t>> bulk(std::in_place, std::vector<std::uint8_t>(kLarge, 7));
  const auto reference = both.lend(*bulk);
  REQUIRE(reference);
  bulk.reset();
  CHECK(BulkPool::own().used() > before);
  Result<detail::BulkBlock*> block = both.borrowing.borrow(*reference);
  REQUIRE(block);
  CHECK(static_cast<int>((*block)->data[kLarge - 1]) == 7);
  detail::release(**block);
  CHECK(BulkPool::own().used() == before);
}

TEST_CASE("nothing is lent to a reader that cannot read the pool", "[patterns][shm][bulk]") {
  BothSides both;
  const Bulk<std::uint8_t> bulk(kLarge);
  CHECK_FALSE(both.lend(bulk));
  both.control().readable = 12345;  // another pool
  CHECK_FALSE(both.lend(bulk));
  both.borrowing.look();
  CHECK(both.lend(bulk));
}

TEST_CASE("a frame that was not sent takes back what it would have lent", "[patterns][shm][bulk]") {
  BothSides both;
  both.borrowing.look();
  const Bulk<std::uint8_t> bulk(kLarge);
  const auto first = both.loans->lend(*bulk.block());
  const auto again = both.loans->lend(*bulk.block());
  REQUIRE(first);
  REQUIRE(again);
  CHECK(first->loan == again->loan);
  both.loans->settle(false);
  CHECK(bulk.block()->references == 1);
}

TEST_CASE("one reader holds a bounded share of the pool, in loans and in bytes", "[patterns][shm][bulk]") {
  BothSides both;
  both.borrowing.look();
  const Bulk<std::uint8_t> small(detail::kLeastBulk);
  std::size_t loans = 0;
  while (both.lend(small)) ++loans;
  CHECK(loans == shm::kMostLoans);
  both.loans->take_back();
  const Bulk<std::uint8_t> large(shm::kMostLent / 2);
  CHECK(both.lend(large));
  CHECK(both.lend(large));
  CHECK_FALSE(both.lend(small));
  both.loans->take_back();
  CHECK(large.block()->references == 1);
  CHECK(both.lend(small));
}

TEST_CASE("a number that belongs to no present loan brings nothing back", "[patterns][shm][bulk]") {
  BothSides both;
  both.borrowing.look();
  const Bulk<std::uint8_t> bulk(kLarge);
  const auto reference = both.lend(bulk);
  REQUIRE(reference);
  for (auto& word : both.control().returned) word = reference->loan + 1;
  both.loans->collect();
  CHECK(bulk.block()->references == 2);
  for (auto& word : both.control().returned) word = reference->loan;
  both.loans->collect();
  CHECK(bulk.block()->references == 1);
}

TEST_CASE("a reader that goes on after its edge has gone keeps what it has", "[patterns][shm][bulk]") {
  auto both = std::make_unique<BothSides>();
  both->borrowing.look();
  const std::size_t before = BulkPool::own().used();
  Result<detail::BulkBlock*> block = fail(Code::internal, "");
  {
    const Bulk<std::uint8_t> bulk(kLarge);
    const auto reference = both->lend(bulk);
    REQUIRE(reference);
    block = both->borrowing.borrow(*reference);
  }
  REQUIRE(block);
  both.reset();
  CHECK(BulkPool::own().used() > before);
  detail::release(**block);
  CHECK(BulkPool::own().used() == before);
}

TEST_CASE("a reference to what is not there is refused", "[patterns][shm][bulk]") {
  BothSides both;
  both.borrowing.look();
  using Reference = detail::BulkReference;
  for (const Reference& wrong :
       {Reference{32, kBulkPoolSize + 64, 0}, Reference{32, 0, kBulkPoolSize + 1},
        Reference{32, kBulkPoolSize - 64, 65}, Reference{32, 64, ~std::uint64_t{0} - 32},
        Reference{32, ~std::uint64_t{0} - 63, 128}, Reference{32, 4, 64}}) {
    const auto block = both.borrowing.borrow(wrong);
    REQUIRE_FALSE(block);
    CHECK(block.error().code == Code::data_loss);
  }
  both.control().pool = 12345;
  shm::Borrowing stranger(both.segment.share(), both.control());
  CHECK_FALSE(stranger.borrow({32, 0, 64}));
}

TEST_CASE("images pass from process to process without a copy, and none is lost",
          "[patterns][shm][bulk][processes]") {
  constexpr int kImages = 300;
  run_on({}, [&](Executive& executive) {
    ToOther link(executive, kBlock, [](Viewer& viewer) {
      int borrowed = 0;
      for (int number = 1; number <= kImages; ++number) {
        const ObjectPtr<Image> image = viewer.in.get_update_wait_max(10s);
        if (!is_whole(image, number)) _exit(255);
        borrowed += is_borrowed(image) ? 1 : 0;
      }
      _exit(kImages - borrowed);
    });
    for (int number = 1; number <= kImages; ++number) link.camera.push(number);
    CHECK(link.other->join() == 1);  // the first one tells that there is a pool
    CHECK(link.end->counters().objects_lost == 0);
  });
}

TEST_CASE("a reader that keeps all images gets copies of the later ones",
          "[patterns][shm][bulk][processes]") {
  run_on({}, [&](Executive& executive) {
    ToOther link(executive, kBlock, [](Viewer& viewer) {
      std::vector<ObjectPtr<Image>> kept;
      while (kept.size() < 60) kept.push_back(viewer.in.get_update_wait_max(10s));
      const auto borrowed = static_cast<std::size_t>(std::ranges::count_if(kept, is_borrowed));
      for (std::size_t i = 0; i < kept.size(); ++i)
        if (!is_whole(kept[i], static_cast<int>(i) + 1)) _exit(1);
      _exit(borrowed > 10 && borrowed * kLarge <= shm::kMostLent ? 0 : 2);
    });
    for (int number = 1; number <= 60; ++number) link.camera.push(number);
    CHECK(link.other->join() == 0);
  });
}

TEST_CASE("a reader that hangs or is killed costs its share, which comes back with its successor",
          "[patterns][shm][bulk][processes]") {
  provide_to_itself();
  const std::size_t others = BulkPool::own().used();
  run_on({}, [&](Executive& executive) {
    ToOther link(executive, kDeep, [](Viewer& viewer) {
      const ObjectPtr<Image> kept = viewer.in.get_update_wait_max(10s);
      for (;;) pause();
    });
    for (int round = 0; round < 5; ++round) {
      for (int number = 1; number <= 40; ++number) link.camera.push(number);
      CHECK(BulkPool::own().used() - others <= shm::kMostLent);
      link.replace();
    }
  });
  CHECK(BulkPool::own().used() == others);
}

TEST_CASE("images of a writer that was killed stay whole", "[patterns][shm][bulk][processes]") {
  SharedPage page;
  const MemoryFile pool = make_pool();
  const MemoryFile file = fresh_rings();
  OtherProcess writer([&](Executive& executive) {
    provide(pool);
    Camera camera(executive);
    camera.strand().set_doorbell(page->child);
    make_shm_end(port<PushServerEndpoint>(camera, "out"), map(file), {"viewer.in", &page->parent}, kBlock);
    camera.strand().wait_for(kForever, [&] { return camera.out.subscriber_count() == 1; });
    for (int number = 1; number <= 6; ++number) camera.push(number);
    for (;;) pause();
  });
  note_peer("camera", pool);
  run_on({}, [&](Executive& executive) {
    Viewer viewer(executive);
    viewer.strand().set_doorbell(page->parent);
    make_shm_end(port<PushClientEndpoint>(viewer, "in"), map(file), {"camera.out", &page->child}, kBlock,
                 Duration{0});
    viewer.in.subscribe();
    std::vector<ObjectPtr<Image>> kept;
    for (int number = 1; number <= 6; ++number) kept.push_back(viewer.in.get_update_wait_max(10s));
    writer.kill_now();
    note_peer("camera", make_pool());  // of its successor
    CHECK(is_borrowed(kept.back()));
    for (int number = 1; number <= 6; ++number)
      CHECK(is_whole(kept[static_cast<std::size_t>(number) - 1], number));
  });
}

TEST_CASE("whatever stands in the segment, a reader sees only what is in the pool, or cuts the peer off",
          "[patterns][shm][bulk][processes]") {
  log::set_level(log::Level::error);  // being cut off is a warning
  const auto seed = GENERATE(range(1U, 9U));
  SharedPage page;
  const MemoryFile pool = make_pool();
  const MemoryFile file = RingSegment::create("test", 4096).value();
  OtherProcess writer([&](Executive& executive) {
    provide(pool);
    Camera camera(executive);
    camera.strand().set_doorbell(page->child);
    make_shm_end(port<PushServerEndpoint>(camera, "out"), map(file), {"viewer.in", &page->parent}, kDeep);
    for (;;) camera.push(1);
  });
  note_peer("camera", pool);
  OtherProcess enemy([&](Executive& executive) {
    const RingSegment segment = map(file);
    shm::LoanControl& loans = shm::loans_in(segment.memory().bytes(), 1);
    std::mt19937_64 random(seed);
    const auto ring = segment.memory().bytes().subspan(4096 + 4096, 512);
    for (;;) {
      loans.readable = loans.pool.load();  // a ring of this size carries no image that would tell the reader
      const std::uint64_t value = random() % 2 == 0 ? random() : random() % kBulkPoolSize / 64 * 64;
      std::atomic_ref(*reinterpret_cast<std::uint64_t*>(ring.data() + random() % 64 * 8)).store(value);
      executive.make_event()->wait_until(executive.now() + 50us);
    }
  });
  run_on({}, [&](Executive& executive) {
    Viewer viewer(executive);
    viewer.strand().set_doorbell(page->parent);
    const ShmEnd& end = make_shm_end(port<PushClientEndpoint>(viewer, "in"), map(file),
                                     {"camera.out", &page->child}, kDeep, Duration{0});
    viewer.in.subscribe();
    std::size_t bytes = 0;
    const TimePoint limit = executive.now() + 1s;
    while (!end.is_cut() && executive.now() < limit) {
      const ObjectPtr<Image> image = viewer.in.get_update_wait_max(1ms);
      if (!image) continue;
      bytes = std::max(bytes, image->data().size());
      CHECK(std::accumulate(image->data().begin(), image->data().end(), std::uint64_t{0}) <=
            255 * image->data().size());
    }
    CHECK(bytes <= kBulkPoolSize);
  });
  log::set_level(log::Level::info);
}
