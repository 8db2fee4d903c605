// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/component/host.hpp"

namespace orca {

/// The properties of a parameter, documented in this one place.
struct ParamOptions {
  std::string unit{};                  ///< SI unit of the value; empty: none.
  std::optional<double> min{};         ///< In that unit.
  std::optional<double> max{};         ///< In that unit.
  std::vector<std::string> choices{};  ///< Allowed texts; empty: any.
  bool file = false;                   ///< The text names a file.
  bool fixed = false;                  ///< Used by configure() only: cannot change while the component runs.
  std::string text{};                  ///< One sentence for people.
};

/// A parameter of a component: declared as a member, set by the graph before configure(), read with `*`.
/// Unless it is `fixed`, its value may change between two laps; see Component::params_changed().
///
/// @tparam T  bool, std::int64_t, double, std::string or std::vector<std::string>. Numbers are in SI units.
/// Thread contract: the component's strand.
template <class T>
class Param {
  static_assert(
      std::is_same_v<T, bool> || std::is_same_v<T, std::int64_t> || std::is_same_v<T, double> ||
          std::is_same_v<T, std::string> || std::is_same_v<T, std::vector<std::string>>,
      "a Param is a bool, std::int64_t, double, std::string or std::vector<std::string>: for a whole number "
      "write Param<std::int64_t>");

 public:
  template <class Owner>
  Param(Owner& owner, std::string name, T default_value, ParamOptions options = {})
      : name_(std::move(name)), value_(default_value) {
    ParamContract contract;
    contract.name = name_;
    contract.type = type();
    contract.unit = std::move(options.unit);
    contract.min = options.min;
    contract.max = options.max;
    contract.choices = std::move(options.choices);
    contract.file = options.file;
    contract.fixed = options.fixed;
    contract.default_value = ParamValue(std::move(default_value));
    contract.text = std::move(options.text);
    owner.declare_param(
        {std::move(contract), [this](const ParamValue& value) { value_ = std::get<T>(value); }, &locked_});
  }
  Param(const Param&) = delete;
  Param& operator=(const Param&) = delete;

  /// Return the value.
  /// @pre  the constructor of the owner is over: within it the graph's value is not there yet. When a type is described, such a
  ///       read is an error that names the parameter.
  [[nodiscard]] const T& operator*() const {
    if (locked_) [[unlikely]]
      read_too_early();
    return value_;
  }
  [[nodiscard]] const T* operator->() const { return &**this; }

  /// Makes an error about this parameter's value, to return from configure() or params_changed(). It is reported
  /// at the place in the graph that sets the parameter.
  /// @param why  what was found, what was expected and what to do.
  [[nodiscard]] Error refuse(std::string why) const {
    return {Code::invalid_argument, std::move(why), {}, name_};
  }
  /// Makes such an error from one that has no place of its own, and keeps its code.
  [[nodiscard]] Error refuse(Error why) const {
    why.param = name_;
    return why;
  }

 private:
  [[noreturn]] void read_too_early() const {
    throw std::logic_error(
        "it read its parameter \"" + name_ +
        "\", but in a constructor the graph's value is not there yet, only the default; read it in "
        "configure() or later");
  }
  static constexpr ParamType type() {
    if constexpr (std::is_same_v<T, bool>) return ParamType::boolean;
    if constexpr (std::is_same_v<T, std::int64_t>) return ParamType::integer;
    if constexpr (std::is_same_v<T, double>) return ParamType::real;
    if constexpr (std::is_same_v<T, std::string>) return ParamType::text;
    return ParamType::text_list;
  }

  const std::string name_;
  T value_;
  bool locked_ = false;
};

}  // namespace orca
