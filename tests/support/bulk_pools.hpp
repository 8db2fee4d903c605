// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fcntl.h>

#include <string>

#include "orca/idl/bulk_pool.hpp"

namespace orca::test {

inline MemoryFile make_pool() {
  return MemoryFile::create("pool of a test", kBulkPoolSize, MemoryFile::Writers::owner).value();
}

inline Descriptor copy_of(const MemoryFile& file) {
  return Descriptor(fcntl(file.descriptor(), F_DUPFD_CLOEXEC, 3));
}

/// Gives this process a pool, if it has none.
inline void provide(const MemoryFile& file) { (void)BulkPool::own().provide(copy_of(file)); }

/// Lets this process read a pool.
inline void note_peer(const std::string& peer, const MemoryFile& file) {
  (void)PeerPools::all().note(peer, copy_of(file)).ok();
}

/// The pool of the process that runs the tests.
inline const MemoryFile& own_pool() {
  static const MemoryFile file = make_pool();
  return file;
}

/// Gives this process a pool, and lets it read it as if it were another process's: for links with both ends here.
inline void provide_to_itself() {
  if (BulkPool::own().identity() != 0) return;
  provide(own_pool());
  note_peer("this process", own_pool());
}

}  // namespace orca::test
