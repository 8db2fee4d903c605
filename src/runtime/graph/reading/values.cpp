// SPDX-License-Identifier: LGPL-3.0-or-later
#include "values.hpp"

#include <algorithm>
#include <filesystem>

#include "codes.hpp"
#include "naming.hpp"
#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"
#include "orca/xml/quantity.hpp"

namespace orca::graph {
namespace {

// "0.05 to 5 m is allowed", or nothing if everything is.
std::string limit_text(const ParamContract& contract) {
  const std::string unit = contract.unit.empty() ? "" : " " + contract.unit;
  const std::string min = contract.min ? xml::number_text(*contract.min) : "";
  const std::string max = contract.max ? xml::number_text(*contract.max) : "";
  if (contract.min && contract.max) return min + " to " + max + unit + " is allowed";
  if (contract.min) return "at least " + min + unit + " is allowed";
  return contract.max ? "at most " + max + unit + " is allowed" : "";
}

class Converter {
 public:
  Converter(const Text& text, const ParamContract& contract, const std::string& title, Report& report)
      : text_(text), contract_(contract), title_(title), report_(report) {}

  std::optional<ParamValue> convert() {
    switch (contract_.type) {
      case ParamType::boolean: return boolean();
      case ParamType::integer: return integer();
      case ParamType::real: return real();
      case ParamType::text: return text(text_.value);
      case ParamType::text_list: return list();
    }
    return std::nullopt;
  }

 private:
  std::optional<ParamValue> boolean() {
    const std::string_view word = xml::trimmed(text_.value);
    if (word == "true" || word == "false") return word == "true";
    return wrong(codes::kBadValue, in_quotes(text_.value) + " is neither true nor false");
  }

  std::optional<ParamValue> integer() {
    const Result<std::int64_t> value = xml::parse_integer(text_.value);
    if (!value) return no_number(value.error());
    if (!in_range(static_cast<double>(*value))) return out_of_range();
    return *value;
  }

  std::optional<ParamValue> real() {
    const Result<xml::LeadingNumber> number = xml::parse_leading_number(text_.value);
    if (!number) return no_number(number.error());
    const Result<double> value = xml::to_si(number->value, number->rest, contract_.unit);
    if (!value) return wrong(codes::kUnit, in_quotes(text_.value) + ": " + value.error().message);
    if (!in_range(*value)) return out_of_range();
    return *value;
  }

  std::optional<ParamValue> text(const std::string& value) {
    const auto& choices = contract_.choices;
    if (!choices.empty() && std::ranges::find(choices, value) == choices.end()) {
      return wrong(codes::kChoice, in_quotes(value) + " is not one of: " + xml::listed(choices) +
                                       report_.hint(value, choices));
    }
    return contract_.file && !value.empty() ? resolved_path(value, text_) : value;
  }

  std::optional<ParamValue> list() {
    std::vector<std::string> result;
    for (const std::string& part : split_list(text_.value)) {
      if (part.empty()) {
        return wrong(codes::kBadValue,
                     in_quotes(text_.value) + " has an empty part; parts are separated by ';'");
      }
      const auto value = text(part);
      if (!value) return std::nullopt;
      result.push_back(std::get<std::string>(*value));
    }
    return result;
  }

  [[nodiscard]] bool in_range(double value) const {
    return value >= contract_.min.value_or(value) && value <= contract_.max.value_or(value);
  }

  std::nullopt_t no_number(const Error& error) {
    const std::string limits = limit_text(contract_);
    return wrong(codes::kBadValue, error.message + (limits.empty() ? "" : "; " + limits));
  }

  std::nullopt_t out_of_range() {
    return wrong(codes::kRange, in_quotes(text_.value) + " is out of range: " + limit_text(contract_));
  }

  std::nullopt_t wrong(const char* code, const std::string& message) {
    report_.error(code, text_.position, title_ + ": " + message);
    return std::nullopt;
  }

  const Text& text_;
  const ParamContract& contract_;
  const std::string& title_;
  Report& report_;
};

}  // namespace

std::optional<ParamValue> read_value(const Text& text, const ParamContract& contract,
                                     const std::string& title, Report& report) {
  if (!text.known) return std::nullopt;
  return Converter(text, contract, title, report).convert();
}

std::string resolved_path(const std::string& path, const Text& origin) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(origin.named_in).parent_path();
  std::error_code problem;
  const fs::path absolute = fs::absolute(folder / path, problem);
  return (problem ? folder / path : absolute).lexically_normal().string();
}

}  // namespace orca::graph
