// SPDX-License-Identifier: GPL-3.0-or-later
// All that keeps a library in memory unless it is built by the recipe: statics of templates and of inline
// functions, inline variables, make_shared, a local static with a destructor.
#include <map>
#include <memory>
#include <string>

#include "orca/component.hpp"

namespace pinning {

template <class T>
struct Counted {
  static inline int count = 0;
};

inline std::map<std::string, int> table{{"one", 1}};

inline std::string& remembered() {
  static std::string text = "long enough not to fit into the string object itself";
  return text;
}

}  // namespace pinning

namespace {

class Statics final : public orca::Component {
 public:
  explicit Statics(orca::ComponentHost& host) : Component(host) {
    ++pinning::Counted<Statics>::count;
    pinning::remembered() += '.';
    shared_ = std::make_shared<std::string>(pinning::remembered());
    pinning::table[*shared_] = 2;
  }
  orca::Outcome work() override { return orca::failed(*shared_); }

 private:
  std::shared_ptr<std::string> shared_;
};

}  // namespace

ORCA_COMPONENT(Statics, "test.Statics")
