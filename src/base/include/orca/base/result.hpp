// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace orca {

/// The kinds of error, by what the *caller* can do: fix the input, retry, or give up.
enum class Code {
  invalid_argument,     ///< The input is wrong; correct it.
  not_found,            ///< A named thing does not exist.
  already_exists,       ///< A name is taken.
  failed_precondition,  ///< Not possible in the present state.
  unavailable,          ///< The peer is gone or full; try again later.
  deadline_exceeded,    ///< Time ran out.
  data_loss,            ///< Bytes or objects arrived damaged.
  unimplemented,        ///< Known, but not supported here.
  internal,             ///< A bug in Orca or in a component.
};

/// Returns the code's name as it appears in messages, e.g. "not_found".
[[nodiscard]] std::string_view to_string(Code code);

/// An error as a value.
///
/// `message` says in plain words what was found, what was expected and what to do; `where` is the file
/// position or component concerned, empty if there is none; `param` is the parameter of the component to correct,
/// empty if it is none (see Param::refuse()). A plain value; any thread.
struct Error {
  Code code = Code::internal;
  std::string message;
  std::string where;
  std::string param{};

  /// Returns "where: message", or the message alone, and before it the parameter.
  [[nodiscard]] std::string text() const {
    const std::string placed = where.empty() ? message : where + ": " + message;
    return param.empty() ? placed : "parameter \"" + param + "\": " + placed;
  }
};

/// A value or an Error, with the member names of C++23's std::expected.
///
/// Thread contract: that of the value it holds.
template <class T>
class [[nodiscard]] Result {
 public:
  using value_type = T;

  Result(T value)
      : state_(std::in_place_index<0>, std::move(value)) {}  // NOLINT(google-explicit-constructor)
  Result(Error error)
      : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] bool has_value() const { return state_.index() == 0; }
  explicit operator bool() const { return has_value(); }

  /// @errors  std::logic_error with the error's text when there is no value: a broken precondition.
  [[nodiscard]] T& value() & { return require(), std::get<0>(state_); }
  [[nodiscard]] const T& value() const& { return require(), std::get<0>(state_); }
  [[nodiscard]] T&& value() && { return require(), std::get<0>(std::move(state_)); }
  [[nodiscard]] T& operator*() & { return value(); }
  [[nodiscard]] const T& operator*() const& { return value(); }
  [[nodiscard]] T&& operator*() && { return std::move(*this).value(); }
  [[nodiscard]] T* operator->() { return &value(); }
  [[nodiscard]] const T* operator->() const { return &value(); }

  /// @pre  !has_value()
  [[nodiscard]] const Error& error() const { return std::get<1>(state_); }
  [[nodiscard]] T value_or(T other) const& { return has_value() ? std::get<0>(state_) : std::move(other); }

  template <class F>
  [[nodiscard]] auto and_then(F&& next) const& -> std::invoke_result_t<F, const T&> {
    if (!has_value()) return error();
    return std::invoke(std::forward<F>(next), std::get<0>(state_));
  }

 private:
  void require() const {
    if (!has_value()) throw std::logic_error("Result without a value: " + error().text());
  }

  std::variant<T, Error> state_;
};

/// Success or an Error: the result of a function that returns no value.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(Error error) : error_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] bool ok() const { return !error_.has_value(); }
  [[nodiscard]] bool has_value() const { return ok(); }
  explicit operator bool() const { return ok(); }

  /// @pre  !ok()
  [[nodiscard]] const Error& error() const { return *error_; }

 private:
  std::optional<Error> error_;
};

/// Returns the Status of success.
[[nodiscard]] inline Status ok() { return {}; }

/// Makes an Error, to return from a function that yields a Status or a Result.
[[nodiscard]] inline Error fail(Code code, std::string message, std::string where = {}) {
  return Error{code, std::move(message), std::move(where)};
}

}  // namespace orca
