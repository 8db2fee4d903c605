// SPDX-License-Identifier: LGPL-3.0-or-later
#include "mesh_sections.hpp"

#include <utility>

namespace orca::sim::detail {
namespace {

constexpr std::size_t kMaxSections = 64;

}  // namespace

std::shared_ptr<const Grid> MeshSections::at(double height) const {
  const MutexLock lock(mutex_);
  if (const auto known = sections_.find(height); known != sections_.end()) return known->second;
  Elements elements;
  for (const auto& mesh : meshes_)
    elements.add(section_of(*mesh, height), {height, std::numeric_limits<double>::infinity()});
  // A cast that uses a section keeps it alive, so erasing it here is safe.
  if (sections_.size() == kMaxSections) sections_.erase(sections_.begin());
  return sections_[height] = std::make_shared<const Grid>(std::move(elements));
}

}  // namespace orca::sim::detail
