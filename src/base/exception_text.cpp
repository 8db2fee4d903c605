// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/exception_text.hpp"

#include <cxxabi.h>

#include <cstdlib>
#include <exception>
#include <typeinfo>

#include "orca/base/exhaustion.hpp"
#include "orca/base/text.hpp"

namespace orca {
namespace {

constexpr std::size_t kMostOfType = 300;   // [bytes] of the name of a type that is shown
constexpr std::size_t kMostOfText = 4000;  // [bytes] of what an exception says

std::string current_type_name() {
  // An exception of another language has no type where that of a C++ exception lies.
  if (std::current_exception() == nullptr) return "something unknown";
  const std::type_info* const type = abi::__cxa_current_exception_type();
  int status = 0;
  char* const text = abi::__cxa_demangle(type->name(), nullptr, nullptr, &status);
  const std::string name = shortened(status == 0 ? text : type->name(), kMostOfType);
  std::free(text);
  return name;
}

}  // namespace

std::string describe_current_exception() {
  const std::string type = current_type_name();
  if (const char* const text = exhaustion_text(std::current_exception()))
    return "threw " + type + ": " + text;
  try {
    throw;
  } catch (const std::exception& error) {
    const char* const text = error.what();  // null from an author's own class
    return "threw " + type + (text != nullptr ? ": " + shortened(text, kMostOfText) : "");
  } catch (int value) {
    return "threw the int " + std::to_string(value);
  } catch (const char* text) {  // a thrown nullptr lands here too
    return text != nullptr ? "threw the text \"" + shortened(text, kMostOfText) + "\""
                           : "threw an object of type " + type;
  } catch (const std::string& text) {
    return "threw the text \"" + shortened(text, kMostOfText) + "\"";
  } catch (...) {
    return "threw an object of type " + type;
  }
}

}  // namespace orca
