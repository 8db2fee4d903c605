// SPDX-License-Identifier: LGPL-3.0-or-later
#include "table_file.hpp"

namespace orca::host {

void TableFile::add_port(const std::string& port, const ObjectType& type) {
  silent_.insert(port);
  table_.add_type(type);
}

Status TableFile::open() {
  Status opened = output_.open(path_);
  if (opened.ok()) output_.flush();  // so that nobody takes an older file for that of a run that crashed
  return opened;
}

void TableFile::add(const std::string& port, ObjectRef object) {
  if (begun_) return output_.write(table_.row(port, object));
  silent_.erase(port);
  table_.make_room(object);
  held_.emplace_back(&port, std::move(object));
  if (silent_.empty() || held_.size() == kMostHeld) begin();
}

void TableFile::begin() {
  begun_ = true;
  output_.write(table_.header());
  for (const auto& [port, object] : held_) output_.write(table_.row(*port, object));
  held_.clear();
}

Status TableFile::close() {
  if (output_.is_open() && !begun_) begin();
  return output_.close();
}

}  // namespace orca::host
