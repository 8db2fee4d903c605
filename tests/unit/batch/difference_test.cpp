// SPDX-License-Identifier: GPL-3.0-or-later
// How the first thing that differs between two batches, or two runs, is found and named.
#include "orca/batch/difference.hpp"

#include <catch2/catch.hpp>

#include "orca/batch/results_difference.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::batch;
using Catch::Contains;
using orca::test::TempFolder;

namespace {

Delivery delivery(const std::string& value) {
  const auto read = read_delivery("1.250000 deliver sink motion 12 MotionCommand from teller " + value);
  REQUIRE(read);
  return *read;
}

std::string values(const std::string& one, const std::string& other) {
  return DeliveryDifference{3, delivery(one), delivery(other)}.text("A", "B");
}

std::unique_ptr<Store> results(const TempFolder& folder, const std::string& name,
                               const std::vector<std::pair<std::uint64_t, double>>& times) {
  auto store = Store::open(folder.file(name), "1").value();
  for (const auto& [seed, time] : times) {
    Row row{"v", "w", seed, {}, {static_cast<double>(seed), 0.0}};
    row.outcome.time = time;
    REQUIRE(store->add(row).ok());
  }
  return store;
}

}  // namespace

TEST_CASE("a line of a trace is read as a delivery if it is one", "[batch]") {
  const Delivery read = delivery("<MotionCommand speed=\"0.5\"/>");
  CHECK(read.time == "1.250000");
  CHECK(read.component == "sink");
  CHECK(read.port == "motion");
  CHECK(read.origin == "teller");
  CHECK(read.value == "<MotionCommand speed=\"0.5\"/>");
  CHECK(read.text() == "MotionCommand 12 of teller to sink.motion at 1.250000 s");
  CHECK_FALSE(read_delivery("1.250000 state sink IDLE WORK"));
  CHECK_FALSE(read_delivery("1.250000 connect sink.motion teller.motion"));
  CHECK_FALSE(read_delivery(""));
}

TEST_CASE("values that differ are named by their path in the object", "[batch]") {
  CHECK(values("<P x=\"1\" y=\"2\"/>", "<P x=\"1\" y=\"3\"/>") ==
        "delivery 3, MotionCommand 12 of teller to sink.motion at 1.250000 s: y is 2 in A and 3 in B");
  CHECK_THAT(values("<P><at x=\"1\"/></P>", "<P><at x=\"2\"/></P>"), Contains(": at.x is 1 in A and 2 in B"));
  CHECK_THAT(values("<P r=\"1 2 3\"/>", "<P r=\"1 5 3\"/>"), Contains(": r[1] is 2 in A and 5 in B"));
  CHECK_THAT(values("<P r=\"1 2\"/>", "<P r=\"1 2 3\"/>"), Contains(": r is 1 2 in A and 1 2 3 in B"));
  CHECK_THAT(values("<P><a x=\"1\"/><a x=\"2\"/></P>", "<P><a x=\"1\"/><a x=\"4\"/></P>"),
             Contains(": a[1].x is 2 in A and 4 in B"));
  CHECK_THAT(values("<P><a/></P>", "<P/>"),
             Contains("the number of elements in the object is 1 in A and 0 in B"));
  CHECK_THAT(values("<P x=\"1\"/>", "<P/>"), Contains(": x is 1 in A and nothing in B"));
}

TEST_CASE("many values that differ are not all named", "[batch]") {
  CHECK_THAT(values("<P r=\"1 2 3 4 5 6 7 8 9\"/>", "<P r=\"2 3 4 5 6 7 8 9 1\"/>"), Contains("and 3 more"));
}

TEST_CASE("deliveries of other objects, or none at all, are told apart from other values", "[batch]") {
  const Delivery one = delivery("<P/>");
  Delivery later = one;
  later.time = "1.300000";
  CHECK(
      DeliveryDifference{3, one, later}.text("A", "B") ==
      "delivery 3, is MotionCommand 12 of teller to sink.motion at 1.250000 s in A, but MotionCommand 12 of "
      "teller to sink.motion at 1.300000 s in B");
  CHECK_THAT((DeliveryDifference{3, one, std::nullopt}.text("A", "B")),
             Contains("is in A only; B has no more"));
  CHECK_THAT((DeliveryDifference{3, std::nullopt, one}.text("A", "B")),
             Contains("is in B only; A has no more"));
}

TEST_CASE("two batches differ by the runs that differ and by those that only one has", "[batch]") {
  const TempFolder folder;
  const auto a = results(folder, "a", {{1, 1.0}, {2, 2.0}, {3, 3.0}, {4, 4.0}});
  const auto b = results(folder, "b", {{2, 2.0}, {3, 3.5}, {4, 4.5}});
  const ResultsDifference found = compare_results(*a, *b).value();
  CHECK(found.in_both == 3);
  CHECK(found.different == 2);
  CHECK(found.only_first == 1);
  CHECK(found.only_second == 0);
  REQUIRE(found.first);
  CHECK(found.first->first.seed == 3);
  CHECK(columns_that_differ(found.first->first.outcome, found.first->second.outcome, "A", "B") ==
        std::vector<std::string>{"time is 3 in A and 3.5 in B"});
}

TEST_CASE("what a run took of the machine makes no difference", "[batch]") {
  const TempFolder folder;
  const auto a = results(folder, "a", {{1, 1.0}});
  const auto b = Store::open(folder.file("b"), "1").value();
  Row row = *a->find("v", "w", 1);
  row.cost = {100.0, 50.0};
  REQUIRE(b->add(row).ok());
  CHECK(compare_results(*a, *b).value().is_empty());
}
