// SPDX-License-Identifier: GPL-3.0-or-later
// Writes bags of ROS 2 in SQLite, with the tables that rosbag2 makes.
#pragma once

#include <sqlite3.h>

#include <catch2/catch.hpp>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "orca/ros/cdr.hpp"

namespace orca::test {

class DatabaseBag {
 public:
  /// @param version  of the schema: 2 to 4.
  explicit DatabaseBag(const std::string& path, int version = 4) {
    REQUIRE(sqlite3_open(path.c_str(), &database_) == SQLITE_OK);
    const std::string hash = version >= 4 ? ", type_description_hash TEXT NOT NULL" : "";
    run("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
        "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL" +
        hash + ")");
    run("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT "
        "NULL, data BLOB NOT NULL)");
    run("CREATE INDEX timestamp_idx ON messages (timestamp ASC)");
    if (version >= 3) {
      run("CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL)");
      run("CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT "
          "NOT "
          "NULL)");
      run("INSERT INTO schema VALUES (" + std::to_string(version) + ", 'jazzy')");
    }
    if (version >= 4)
      run("CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, encoding TEXT "
          "NOT "
          "NULL, encoded_message_definition TEXT NOT NULL, type_description_hash TEXT NOT NULL)");
    tail_ = version >= 4 ? ", '', '')" : ", '')";
  }
  ~DatabaseBag() { sqlite3_close(database_); }
  DatabaseBag(const DatabaseBag&) = delete;
  DatabaseBag& operator=(const DatabaseBag&) = delete;

  void run(const std::string& sql) {
    INFO(sql);
    REQUIRE(sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
  }

  /// Adds a topic, at its first use.
  void topic(const std::string& name, const std::string& type, const std::string& format = "cdr") {
    if (!topics_.try_emplace(name, static_cast<int>(topics_.size()) + 1).second) return;
    run("INSERT INTO topics VALUES (" + std::to_string(topics_.at(name)) + ", '" + name + "', '" + type +
        "', '" + format + "'" + tail_);
  }

  void add_bytes(const std::string& topic, std::int64_t ns, const std::vector<std::byte>& bytes) {
    sqlite3_stmt* statement = nullptr;
    REQUIRE(sqlite3_prepare_v2(database_, "INSERT INTO messages (topic_id, timestamp, data) VALUES (?, ?, ?)",
                               -1, &statement, nullptr) == SQLITE_OK);
    sqlite3_bind_int(statement, 1, topics_.at(topic));
    sqlite3_bind_int64(statement, 2, ns);
    sqlite3_bind_blob(statement, 3, bytes.data(), static_cast<int>(bytes.size()), SQLITE_STATIC);
    CHECK(sqlite3_step(statement) == SQLITE_DONE);
    sqlite3_finalize(statement);
  }

  /// Adds a message, and its topic if there is none.
  template <class Message>
  void add(const std::string& name, std::int64_t ns, const Message& message) {
    topic(name, std::string(Reflection<Message>::name));
    add_bytes(name, ns, ros::to_cdr(message));
  }

 private:
  sqlite3* database_ = nullptr;
  std::map<std::string, int> topics_;
  std::string tail_;
};

}  // namespace orca::test
