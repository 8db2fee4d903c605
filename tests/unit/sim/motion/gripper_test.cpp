// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/gripper_model.hpp"

#include <catch2/catch.hpp>

using namespace orca::sim;
using orca::sim::detail::GripperModel;

namespace {

constexpr double kTick = 0.01;  // [s]

Gripper gripper() {
  Gripper g;
  g.opening = 0.2;
  g.depth = 0.1;
  g.lift = 0.08;
  g.paddle_time = std::chrono::seconds{1};
  g.lift_time = std::chrono::seconds{2};
  return g;
}

// Lets the gripper move for that many ticks. @return  the number of ticks in which it began to hold something.
int run(GripperModel& model, int ticks, std::optional<double> width = {}) {
  int gripped = 0;
  for (int i = 0; i < ticks; ++i) gripped += model.step(kTick, width) ? 1 : 0;
  return gripped;
}

}  // namespace

TEST_CASE("a gripper is open and down at first, and moves only when it is told to", "[sim][gripper]") {
  GripperModel model(gripper());
  run(model, 100);
  CHECK(model.opening() == 1.0);
  CHECK(model.gap() == Approx(0.2));
  CHECK(model.lift() == 0.0);
  CHECK_FALSE(model.paddles_move());
  CHECK_FALSE(model.lift_moves());
}

TEST_CASE("paddles and lift move evenly, and reach their ends exactly after their times", "[sim][gripper]") {
  GripperModel model(gripper());
  model.order({Paddles::close, Lift::up});
  run(model, 50);
  CHECK(model.opening() == Approx(0.5));
  CHECK(model.lift() == Approx(0.25));
  CHECK(model.paddles_move());
  run(model, 49);
  CHECK(model.paddles_move());
  run(model, 1);
  CHECK(model.opening() == 0.0);
  CHECK_FALSE(model.paddles_move());
  CHECK(model.lift_moves());
  run(model, 100);
  CHECK(model.lift() == 1.0);
  CHECK_FALSE(model.lift_moves());
  model.order({Paddles::open, Lift::down});
  run(model, 100);
  CHECK(model.opening() == 1.0);
  CHECK(model.lift() == Approx(0.5));
  run(model, 100);
  CHECK(model.lift() == 0.0);
}

TEST_CASE("a new order replaces only the parts that it names", "[sim][gripper]") {
  GripperModel model(gripper());
  model.order({Paddles::close, Lift::up});
  run(model, 20);
  model.order({Paddles::open, Lift::stay});
  run(model, 10);
  CHECK(model.opening() == Approx(0.9));
  CHECK(model.lift() == Approx(0.15));
  model.order({Paddles::stay, Lift::down});
  run(model, 5);
  CHECK(model.opening() == Approx(0.95));
  CHECK(model.lift() == Approx(0.125));
}

TEST_CASE("paddles and lift halt where they are", "[sim][gripper]") {
  GripperModel model(gripper());
  model.order({Paddles::close, Lift::up});
  run(model, 30);
  model.order({Paddles::halt, Lift::stay});
  CHECK_FALSE(model.paddles_move());
  run(model, 30);
  CHECK(model.opening() == Approx(0.7));
  CHECK(model.lift() == Approx(0.3));
  model.order({Paddles::stay, Lift::halt});
  run(model, 30);
  CHECK(model.lift() == Approx(0.3));
  CHECK_FALSE(model.lift_moves());
}

TEST_CASE("a gripper that is at the end already does not set off for it", "[sim][gripper]") {
  GripperModel model(gripper());
  model.order({Paddles::open, Lift::down});
  CHECK_FALSE(model.paddles_move());
  CHECK_FALSE(model.lift_moves());
}

TEST_CASE("closing paddles stop at what is between them, once, and hold it", "[sim][gripper]") {
  GripperModel model(gripper());
  model.order({Paddles::close, Lift::stay});
  CHECK(run(model, 69, 0.06) == 0);
  CHECK_FALSE(model.holds());
  CHECK(run(model, 100, 0.06) == 1);
  CHECK(model.holds());
  CHECK(model.gap() == Approx(0.06));
  CHECK_FALSE(model.paddles_move());
  model.order({Paddles::close, Lift::stay});
  CHECK_FALSE(model.paddles_move());
}

TEST_CASE("opening paddles do not hold what is between them", "[sim][gripper]") {
  GripperModel model(gripper());
  model.order({Paddles::close, Lift::stay});
  run(model, 50);
  model.order({Paddles::open, Lift::stay});
  CHECK(run(model, 10, 0.1) == 0);
  CHECK_FALSE(model.holds());
}

TEST_CASE("what is as wide as the open paddles is held at once, and can be let go", "[sim][gripper]") {
  GripperModel model(gripper());
  model.order({Paddles::close, Lift::stay});
  CHECK(run(model, 1, 0.2) == 1);
  CHECK(model.opening() == 1.0);
  CHECK_FALSE(model.wants_to_let_go());
  model.order({Paddles::open, Lift::stay});
  CHECK(model.wants_to_let_go());
  model.let_go();
  run(model, 1);
  CHECK_FALSE(model.holds());
  CHECK_FALSE(model.paddles_move());
}

TEST_CASE("paddles that may not let go stay closed until the next order", "[sim][gripper]") {
  GripperModel model(gripper());
  model.order({Paddles::close, Lift::stay});
  run(model, 100, 0.06);
  model.order({Paddles::open, Lift::stay});
  model.refuse();
  run(model, 100);
  CHECK(model.holds());
  CHECK(model.gap() == Approx(0.06));
  CHECK_FALSE(model.wants_to_let_go());
  model.order({Paddles::open, Lift::stay});
  CHECK(model.wants_to_let_go());
}
