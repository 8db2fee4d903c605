// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/exhaustion.hpp"

#include <cerrno>
#include <new>
#include <system_error>

namespace orca {
namespace {

const char* text_for(int error_number) noexcept {
  switch (error_number) {
    case ENOMEM: return kNoMemoryText;
    case EAGAIN:
      return "the system gives no more threads or processes, or no memory for them; end other programs, or "
             "raise the limits (ulimit -u, ulimit -v)";
    case EMFILE:
    case ENFILE:
      return "the system gives no more descriptors; close files elsewhere, or raise the limit (ulimit -n)";
    default: return nullptr;
  }
}

}  // namespace

void throw_if_exhausted(int error_number) {
  if (text_for(error_number) != nullptr) throw std::system_error(error_number, std::generic_category());
}

const char* exhaustion_text(const std::exception_ptr& thrown) noexcept {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    return kNoMemoryText;
  } catch (const std::system_error& error) {
    const bool from_system = error.code().category() == std::generic_category() ||
                             error.code().category() == std::system_category();
    return from_system ? text_for(error.code().value()) : nullptr;
  } catch (...) {
    return nullptr;
  }
  return nullptr;
}

}  // namespace orca
