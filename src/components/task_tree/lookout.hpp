// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "condition.hpp"
#include "orca/component.hpp"
#include "orca/text/object_table.hpp"

namespace orca::tasks {

/// The ports whose objects conditions look at.
///
/// Thread contract: as the component that has the ports.
class Lookout {
 public:
  /// Adds a port, if it is connected. @pre  it outlives this object.
  template <class T>
  void watch(PushProxy<T>& port) {
    if (!port.connected()) return;
    watched_.push_back({sight_of<T>(port.name()),
                        [&port] {
                          while (port.new_data_arrived()) (void)port.get_update();
                        },
                        [&port](const std::string& field) { return field_of<T>(port.latest(), field); }});
  }

  /// Takes what has come, so that the last objects count.
  void take_all() const {
    for (const Watched& watched : watched_) watched.take_all();
  }
  [[nodiscard]] std::vector<Sight> sights() const {
    std::vector<Sight> sights;
    for (const Watched& watched : watched_) sights.push_back(watched.sight);
    return sights;
  }
  /// Returns a field of the last object at a port, as text; nothing if none has come, or it has no such field.
  [[nodiscard]] std::optional<std::string> newest(const std::string& port, const std::string& field) const {
    const auto watched =
        std::ranges::find_if(watched_, [&](const Watched& w) { return w.sight.port == port; });
    return watched == watched_.end() ? std::nullopt : watched->newest(field);
  }

 private:
  struct Watched {
    Sight sight;
    std::function<void()> take_all;
    std::function<std::optional<std::string>(const std::string& field)> newest;
  };

  template <class T>
  static Sight sight_of(const std::string& port) {
    const auto example = make_object<T>();
    Sight sight{port, field_names(object_type<T>(), &*example)};
    for (const std::string& field : sight.fields)
      if (auto words = field_words(object_type<T>(), &*example, field); !words.empty())
        sight.words[field] = std::move(words);
    return sight;
  }

  template <class T>
  static std::optional<std::string> field_of(const ObjectPtr<T>& object, const std::string& field) {
    if (!object) return std::nullopt;
    const auto texts = field_texts(object_type<T>(), &*object, field);
    if (!texts || texts->size() != 1) return std::nullopt;
    return texts->front().text;
  }

  std::vector<Watched> watched_;
};

}  // namespace orca::tasks
