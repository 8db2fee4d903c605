// SPDX-License-Identifier: LGPL-3.0-or-later
#include "descriptor_watch.hpp"

#include <utility>

namespace orca::host {
namespace {

bool is_among(const Descriptors& all, const Descriptors::value_type& descriptor) {
  const auto found = all.find(descriptor.first);
  return found != all.end() && found->second == descriptor.second;
}

void forget_closed(Descriptors& opened, const Descriptors& open) {
  std::erase_if(opened, [&](const auto& descriptor) { return !is_among(open, descriptor); });
}

void add_new(Descriptors& opened, const Descriptors& before, const Descriptors& open) {
  for (const auto& descriptor : open)
    if (!is_among(before, descriptor)) opened.insert(descriptor);
}

}  // namespace

void DescriptorWatch::keep() {
  own_.remember();
  first_ = last_ = own_.lowest_free();
  exhausted_ = false;
  known_.reset();
  opened_by_.clear();
}

std::optional<Finding> DescriptorWatch::look_at_streams() {
  const std::string changes = own_.restore_redirected();
  if (changes.empty()) return std::nullopt;
  return Finding{idl::REDIRECTION, "redirected " + changes};
}

void DescriptorWatch::accept() {
  if (const int lowest = own_.lowest_free(); lowest >= 0) first_ += lowest - std::exchange(last_, lowest);
  known_.reset();
  opened_by_.clear();
}

std::optional<Finding> DescriptorWatch::look(const std::string* alone) {
  const int lowest = own_.lowest_free();
  if (lowest < 0) return look_for_exhaustion();
  exhausted_ = false;
  if (std::exchange(last_, lowest) == lowest)
    return std::nullopt;  // a new descriptor always takes the lowest number
  if (!is_crowded()) return known_.reset(), std::nullopt;
  if (alone != nullptr && known_) return count_for(*alone);
  known_ = open_descriptors();
  return std::nullopt;
}

std::optional<Finding> DescriptorWatch::look_for_exhaustion() {
  if (std::exchange(exhausted_, true)) return std::nullopt;
  return Finding{idl::DESCRIPTORS, "left the process without a free descriptor"};
}

std::optional<Finding> DescriptorWatch::count_for(const std::string& who) {
  const std::optional<Descriptors> open = open_descriptors();
  if (!open) return std::nullopt;
  for (auto& [name, opened] : opened_by_) forget_closed(opened, *open);
  Descriptors& opened = opened_by_[who];
  add_new(opened, *known_, *open);
  known_ = open;
  if (opened.size() < kMany) return std::nullopt;
  return Finding{idl::DESCRIPTORS, "opened " + std::to_string(opened.size()) +
                                       " descriptors and not closed them: " + names_of(opened)};
}

void DescriptorBalance::begin(bool anew, bool alone, const Descriptors* open) {
  if (anew) *this = {};
  known_ = known_ && alone;
  if (!known_) return;
  std::optional<Descriptors> read = open != nullptr ? *open : open_descriptors();
  known_ = read.has_value();
  if (known_) at_begin_ = std::move(*read);
}

void DescriptorBalance::end(bool alone) {
  known_ = known_ && alone;
  if (!known_) return;
  const std::optional<Descriptors> open = open_descriptors();
  known_ = open.has_value();
  if (!known_) return;
  forget_closed(opened_, *open);
  add_new(opened_, at_begin_, *open);
}

}  // namespace orca::host
