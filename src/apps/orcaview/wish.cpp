// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "wish.hpp"

#include <map>
#include <nlohmann/json.hpp>

#include "answers.hpp"

namespace orca::view {
namespace {

using nlohmann::json;

constexpr double kLeastPerSecond = 0.001;
constexpr double kMostPerSecond = 1000.0;

const std::map<std::string, Wish::Op> kOps{{"ask", Wish::Op::ask},       {"cancel", Wish::Op::cancel},
                                           {"layout", Wish::Op::layout}, {"look", Wish::Op::look},
                                           {"unlook", Wish::Op::unlook}, {"query", Wish::Op::query},
                                           {"send", Wish::Op::send},     {"types", Wish::Op::types}};

// Returns the value of a name, or what it is by default.
// @throws json::exception if it is of another type.
template <class Value>
Value member(const json& message, const char* name, Value otherwise = {}) {
  return message.value(name, std::move(otherwise));
}

Result<Wish> read(const json& message, std::uint32_t& id) {
  const std::string op = member<std::string>(message, "op");
  const auto number = message.find("id");
  if (number != message.end() && number->is_number_unsigned() && number->get<std::uint64_t>() <= UINT32_MAX)
    id = number->get<std::uint32_t>();
  else if (number != message.end())
    return fail(Code::invalid_argument, "id must be a whole number of 32 bits");
  const auto found = kOps.find(op);
  if (found == kOps.end())
    return fail(
        Code::invalid_argument,
        "there is no op \"" + op + "\"; there are: ask, cancel, layout, look, query, send, types, unlook");
  Wish wish{found->second, id};
  wish.command = member<std::string>(message, "command");
  wish.words = member<std::vector<std::string>>(message, "words");
  wish.streams = member<bool>(message, "stream");
  wish.graph = member<std::string>(message, "graph");
  wish.as_text = member<bool>(message, "as_text");
  wish.layout = member<std::string>(message, "layout");
  wish.port = member<std::string>(message, "port");
  wish.rate = member<double>(message, "rate");
  wish.xml = member<std::string>(message, "xml");
  if (wish.rate != 0.0 && !(wish.rate >= kLeastPerSecond && wish.rate <= kMostPerSecond))
    return fail(Code::invalid_argument, "rate must be from 0.001 to 1000, or 0, which means all objects");
  return wish;
}

}  // namespace

Result<Wish> read_wish(const std::string& text, std::uint32_t& id) {
  id = 0;
  const json message = read_json(text);
  if (!message.is_object()) return fail(Code::invalid_argument, "a message must be a JSON object");
  try {
    return read(message, id);
  } catch (const json::exception&) {
    return fail(
        Code::invalid_argument,
        "a value is of a wrong type: words is a list of texts, rate a number, stream true or false, all "
        "others are texts");
  }
}

}  // namespace orca::view
