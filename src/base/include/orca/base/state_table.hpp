// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <stdexcept>

namespace orca {

/// The origin of an event of a state machine. It decides what a state without a row for the event means.
enum class EventKind {
  circumstance,  ///< Something that holds in the world. Without a row it changes nothing.
  order,         ///< Somebody asks for it. Without a row it is refused.
  outcome,       ///< The result of an action. Without a row it cannot happen in that state.
};

/// The actions of one transition, in the order in which they are carried out.
template <class Action>
class ActionList {
 public:
  static constexpr std::size_t kCapacity = 5;

  constexpr ActionList(std::initializer_list<Action> actions) {
    for (const Action action : actions) actions_.at(size_++) = action;
  }
  [[nodiscard]] constexpr const Action* begin() const { return actions_.data(); }
  [[nodiscard]] constexpr const Action* end() const { return actions_.data() + size_; }

 private:
  std::array<Action, kCapacity> actions_{};
  std::size_t size_ = 0;
};

/// One row of a state machine's table: the event leads from one state to another through the actions.
template <class State, class Event, class Action>
struct Transition {
  State from;
  Event event;
  State to;
  ActionList<Action> actions;
};

/// The transitions of a state machine, found by state and event. A pure value: it calls nothing and knows no
/// clock; whoever owns the machine carries the actions out.
///
/// @tparam kStates, kEvents  how many there are; both enumerations count from 0.
template <class State, class Event, class Action, std::size_t kStates, std::size_t kEvents, std::size_t kRows>
class StateTable {
 public:
  using Row = Transition<State, Event, Action>;

  /// @pre  no two rows have the same state and event; in a constant expression this is an error.
  constexpr explicit StateTable(const std::array<Row, kRows>& rows) : rows_(rows) {
    for (std::size_t i = 0; i < kRows; ++i) {
      std::size_t& cell = index_.at(place(rows[i].from, rows[i].event));
      if (cell != 0) throw std::logic_error("two rows for one state and event");
      cell = i + 1;
    }
  }

  /// Returns the row for the event in the state, or null if there is none.
  [[nodiscard]] constexpr const Row* find(State state, Event event) const {
    const std::size_t cell = index_[place(state, event)];
    return cell == 0 ? nullptr : &rows_[cell - 1];
  }

  [[nodiscard]] constexpr std::span<const Row> rows() const { return rows_; }

 private:
  static constexpr std::size_t place(State state, Event event) {
    return static_cast<std::size_t>(state) * kEvents + static_cast<std::size_t>(event);
  }

  std::array<Row, kRows> rows_;
  std::array<std::size_t, kStates * kEvents> index_{};  // 1 + the number of the row; 0: none
};

}  // namespace orca
