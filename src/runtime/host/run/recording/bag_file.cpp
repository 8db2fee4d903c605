// SPDX-License-Identifier: LGPL-3.0-or-later
#include "bag_file.hpp"

#include <utility>

#include "orca/recording/objects/carmen_writer.hpp"
#include "orca/recording/objects/object_writer.hpp"

namespace orca::host {
namespace {

constexpr std::size_t kBound = std::size_t{64} << 20;  // [bytes] that wait for the disk

}  // namespace

BagFile::BagFile(std::string path) : path_(std::move(path)) {}
BagFile::~BagFile() = default;

Status BagFile::open(const BagOrigin& run, const std::vector<std::string>& ports, bool at_once) {
  auto output = at_once ? recording::open_file(path_) : recording::open_file_in_background(path_, kBound);
  if (!output) return output.error();
  if (path_.ends_with(".carmen"))
    writer_ = std::make_unique<recording::CarmenWriter>(*std::move(output));
  else
    writer_ = std::make_unique<recording::ObjectWriter>(*std::move(output));
  Status done = writer_->begin({run.name, at_once, ports, run.more});
  if (done.ok()) done = writer_->attach_graph(run.graph);
  for (const auto& [name, text] : run.json)
    if (done.ok()) done = writer_->attach_json(name, text);
  return done;
}

void BagFile::add(const std::string& row, const ObjectRef& object, TimePoint passed) {
  if (writer_ && status_.ok()) status_ = writer_->add(row, object, passed);
}

Status BagFile::close(const std::map<std::string, std::uint64_t>& lost,
                      const std::map<std::string, std::string>& more) {
  if (!writer_) return ok();
  const Status closed = writer_->close(lost, more);
  return status_.ok() ? closed : status_;
}

}  // namespace orca::host
