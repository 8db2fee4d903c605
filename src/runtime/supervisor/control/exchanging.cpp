// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/exchanging.hpp"

#include <optional>
#include <utility>

#include "orca/base/log.hpp"
#include "orca/base/time.hpp"
#include "orca/plugin/image.hpp"
#include "orca/xml/quantity.hpp"

namespace orca::supervisor {
namespace {

constexpr Duration kProbation = 2s;

// What an operator wants to exchange.
struct SwapWish {
  std::string component;
  std::string file;
  std::string type;  // empty: the present one
  Duration probation = kProbation;
};

// A file may hold a colon in the names of its folders.
void split_plugin(const std::string& word, SwapWish& wish) {
  const std::size_t colon = word.rfind(':');
  const bool has_type = colon != std::string::npos && word.find('/', colon) == std::string::npos;
  wish.file = has_type ? word.substr(0, colon) : word;
  if (has_type) wish.type = word.substr(colon + 1);
}

Result<SwapWish> read_wish(const std::vector<std::string>& words) {
  SwapWish wish;
  std::vector<std::string> plain;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] != "--probation") {
      plain.push_back(words[i]);
      continue;
    }
    const Result<Duration> read = xml::parse_duration(i + 1 < words.size() ? words[++i] : "");
    if (!read) return read.error();
    wish.probation = *read;
  }
  if (plain.size() != 2)
    return fail(Code::invalid_argument, "name a component and a plugin: COMPONENT PLUGIN.so[:TYPE]");
  wish.component = plain[0];
  split_plugin(plain[1], wish);
  return wish;
}

std::string value(const Record& record, std::string_view name) {
  for (const Cell& cell : record)
    if (cell.name == name) return cell.value;
  return "";
}

}  // namespace

const PluginFacts& Exchanging::plugin_of(const std::string& type) const {
  static const PluginFacts unknown;
  const auto found = facts_.plugins.find(type);
  return found == facts_.plugins.end() ? unknown : found->second;
}

CodeFacts Exchanging::code_of(const graph::ComponentNode& component) const {
  const auto exchanged = exchanged_.find(component.name);
  if (exchanged != exchanged_.end()) return exchanged->second;
  return {component.type, plugin_of(component.type)};
}

void Exchanging::swap(const std::vector<std::string>& words, const ReplyPtr& reply) {
  const Result<SwapWish> wish = read_wish(words);
  if (!wish) return reply->refuse(wish.error());
  const Result<const graph::ComponentNode*> node = names_.component(wish->component);
  if (!node) return reply->refuse(node.error());
  const Result<Member*> member = names_.ready_member_of(**node);
  if (!member) return reply->refuse(member.error());
  Result<plugin::PluginImage> image = plugin::PluginImage::copy(wish->file);
  if (!image) return reply->refuse(image.error());
  const std::string file = image->origin();
  log::info(wish->component, "an operator exchanges its code for " + file);
  SwapCode order{
      wish->component, wish->type, {}, static_cast<std::uint64_t>(wish->probation.count()), file, {}};
  order.plugin = std::move(*image).take_bytes();
  (*member)->ask_for(std::move(order),
                     [this, reply, component = wish->component, file](const Answer& answer) {
                       if (!answer.outcome.ok()) return reply->refuse(answer.outcome.error());
                       for (const Record& record : answer.records) {
                         note(component, {value(record, "type"), {file, value(record, "build_id")}});
                         reply->add(record);
                       }
                     });
}

void Exchanging::note(const std::string& component, CodeFacts code) {
  code.swaps = exchanged_[component].swaps + 1;
  exchanged_[component] = std::move(code);
}

void Exchanging::came_up(const std::vector<Member*>& members) {
  for (const Member* const member : members)
    for (const graph::ComponentNode& node : graph_.components)
      if (node.process == member->name() && exchanged_.erase(node.name) > 0)
        log::warning(node.name,
                     "its process was started again, with the code that the graph names; the code that had "
                     "been put in its place is not there any more");
}

}  // namespace orca::supervisor
