// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/recording/objects/recorded_run.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <utility>

#include "orca/recording/objects/carmen_reader.hpp"

namespace orca::recording {
namespace {

// A robot takes a moment before its first reading, too; so whoever waits for it has subscribed by then.
constexpr Duration kLead = 100ms;

TimePoint instant(std::uint64_t ns) { return TimePoint(Duration(static_cast<Duration::rep>(ns))); }

class McapRun final : public RecordedRun {
 public:
  explicit McapRun(ObjectReader reader) : reader_(std::move(reader)) {}

  const std::map<std::string, RecordedRow>& rows() const override { return reader_.rows(); }
  // In virtual time a run begins at 0, though its first object may come later.
  TimePoint begin() const override {
    return reader_.is_virtual() ? TimePoint{} : instant(reader_.file().statistics().start) - kLead;
  }
  Duration length() const override {
    return instant(reader_.file().statistics().end) - instant(reader_.file().statistics().start);
  }
  Status take_objects(const std::function<void(const RecordedObject&)>& take) override {
    return reader_.objects({}, [&](const RecordedObject& one) { return take(one), true; });
  }

 private:
  const ObjectReader reader_;
};

class CarmenRun final : public RecordedRun {
 public:
  explicit CarmenRun(CarmenReader reader) : reader_(std::move(reader)) {}

  const std::map<std::string, RecordedRow>& rows() const override { return reader_.rows(); }
  TimePoint begin() const override { return reader_.begin() - kLead; }
  Duration length() const override { return reader_.end() - reader_.begin(); }
  Status take_objects(const std::function<void(const RecordedObject&)>& take) override {
    reader_.take_objects(take);
    return ok();
  }
  std::vector<std::string> flaws() const override { return reader_.log().flaws.texts(); }

 private:
  CarmenReader reader_;
};

bool is_mcap(const std::string& path) {
  std::error_code unused;
  if (std::filesystem::is_directory(path, unused)) return true;  // a bag's
  std::array<char, 5> begin{};
  std::ifstream(path, std::ios::binary).read(begin.data(), begin.size());
  return begin == std::array<char, 5>{'\x89', 'M', 'C', 'A', 'P'};
}

template <class Run, class Reader>
Result<std::unique_ptr<RecordedRun>> run_of(Result<Reader> reader) {
  if (!reader) return reader.error();
  return std::unique_ptr<RecordedRun>(std::make_unique<Run>(*std::move(reader)));
}

}  // namespace

Result<std::unique_ptr<RecordedRun>> RecordedRun::open(const std::string& path) {
  if (is_mcap(path)) return run_of<McapRun>(ObjectReader::open(path));
  auto run = run_of<CarmenRun>(CarmenReader::open(path));
  if (run || run.error().code != Code::data_loss) return run;
  return fail(Code::data_loss, "it is neither an MCAP file nor a CARMEN log: " + run.error().message, path);
}

}  // namespace orca::recording
