// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "access.hpp"

#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>

namespace orca::view {
namespace {

Result<std::string> draw_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    return fail(Code::unavailable, "the system gives no random numbers for a token");
  std::string text;
  for (const unsigned char byte : bytes) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 15U];
  }
  return text;
}

bool is_equal(std::string_view given, std::string_view token) {
  unsigned difference = given.size() == token.size() ? 0 : 1;
  for (std::size_t i = 0; i < token.size(); ++i) {
    const char one = i < given.size() ? given[i] : '\0';
    difference |= static_cast<unsigned char>(one) ^ static_cast<unsigned char>(token[i]);
  }
  return difference == 0;
}

bool is_called(std::string_view own, std::string_view name) {
  if (!own.starts_with("*.")) return own == name;
  const std::size_t dot = name.find('.');
  return dot != std::string_view::npos && dot > 0 && name.substr(dot) == own.substr(1);
}

}  // namespace

Result<Tokens> Tokens::draw() {
  std::map<Role, std::string> tokens;
  for (const Role role : kRoles) {
    Result<std::string> token = draw_token();
    if (!token) return token.error();
    tokens[role] = *std::move(token);
  }
  return Tokens(std::move(tokens));
}

std::optional<Role> Tokens::role_of(std::string_view token) const {
  std::optional<Role> found;
  for (const auto& [role, own] : tokens_)
    if (is_equal(token, own)) found = role;
  return found;
}

bool is_own_host(std::string_view host, const Calling& calling) {
  const std::size_t end = host.starts_with('[') ? host.find(']') : 0;  // of an address of IPv6
  if (end == std::string_view::npos) return false;
  const std::size_t colon = host.find(':', end);
  const std::string_view port = colon == std::string_view::npos ? "" : host.substr(colon);
  if (port == ":" || port.find_first_not_of("0123456789", 1) != std::string_view::npos) return false;
  std::string name(host.substr(0, colon));
  std::ranges::transform(name, name.begin(), [](unsigned char each) { return std::tolower(each); });
  return std::ranges::any_of(calling.names, [&](const std::string& own) { return is_called(own, name); });
}

bool is_own_origin(std::string_view origin, std::string_view host, const Calling& calling) {
  return origin.empty() || origin == calling.scheme + "://" + std::string(host);
}

std::string query_value(std::string_view target, std::string_view name) {
  std::size_t at = target.find('?');
  while (at != std::string_view::npos) {
    const std::size_t end = target.find('&', at + 1);
    const std::string_view pair = target.substr(at + 1, end == std::string_view::npos ? end : end - at - 1);
    if (pair.size() > name.size() && pair.starts_with(name) && pair[name.size()] == '=')
      return std::string(pair.substr(name.size() + 1));
    at = end;
  }
  return {};
}

// The first element of a document is its only one, and names the type of the object.
bool only_asks(std::string_view xml) {
  constexpr std::string_view kQuestions[] = {"<Ask", "<AskReading"};
  return std::ranges::any_of(kQuestions, [&](std::string_view question) {
    return xml.starts_with(question) && xml.size() > question.size() &&
           std::string_view(" \t\r\n/>").find(xml[question.size()]) != std::string_view::npos;
  });
}

}  // namespace orca::view
