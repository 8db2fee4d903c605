// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "web_files.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <map>

namespace orca::view {
namespace {

// By Debian's packages node-dagre-layout and libjs-dygraphs.
const std::map<std::string_view, std::string_view> kOthers{
    {"dagre.min.js", "/usr/share/nodejs/dagre/dist/dagre.min.js"},
    {"dygraph.min.js", "/usr/share/javascript/dygraphs/dygraph.min.js"},
    {"dygraph.css", "/usr/share/javascript/dygraphs/dygraph.css"},
};

const std::map<std::string_view, std::string_view> kTypes{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
};

bool is_plain_name(std::string_view name) {
  return !name.empty() && name.front() != '.' && std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
  });
}

std::optional<std::string> read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace

std::optional<WebFile> WebFiles::find(std::string_view target) const {
  std::string_view path = target.substr(0, target.find('?'));
  if (path == "/") path = "/index.html";
  if (path.empty() || path.front() != '/') return std::nullopt;
  path.remove_prefix(1);
  constexpr std::string_view kLib = "lib/";
  const bool is_other = path.starts_with(kLib);
  if (is_other) path.remove_prefix(kLib.size());
  const auto type = kTypes.find(path.substr(std::min(path.rfind('.'), path.size())));
  if (!is_plain_name(path) || type == kTypes.end()) return std::nullopt;
  const auto other = kOthers.find(path);
  if (is_other && other == kOthers.end()) return std::nullopt;
  std::optional<std::string> text =
      read(is_other ? std::string(other->second) : folder_ + "/" + std::string(path));
  if (!text) return std::nullopt;
  return WebFile{std::string(type->second), std::move(*text)};
}

}  // namespace orca::view
