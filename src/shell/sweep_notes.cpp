// SPDX-License-Identifier: MIT
#include "shell/sweep_notes.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "shell/sweep_model.h"

namespace tunica::shell {

namespace {

using nlohmann::json;

// Each reads all that is read of a note anywhere; what is missing, or of another type, is the library's exception.

size_t read_identity(const json& note) {
  for (const char* name : {"script", "program", "sampling"}) (void)note.at(name).get<std::string>();
  (void)note.at("sampling seed").get<uint64_t>();
  if (!note.at("until").is_number()) (void)note.at("until").get<std::string>();
  for (const auto& range : note.at("parameters"))
    for (const size_t i : {0, 1}) (void)range.at(i).get<std::string>();
  return note.at("parameters").size();
}

void read_settings(const json& note) {
  for (const char* name : {"seeds", "fresh"}) (void)note.at(name).get<std::vector<uint64_t>>();
  (void)note.at("seeds").at(0);
  (void)note.at("score").get<std::string>();
  (void)note.at("minimize").get<bool>();
  for (const char* name : {"winners", "shard", "shards"}) (void)note.at(name).get<uint64_t>();
  if (note.at("shards").get<uint64_t>() == 0) throw std::invalid_argument("shards is 0");
}

void read_search(const json& note) {
  for (const char* name : {"method", "step", "population", "score", "direction", "seeds", "samples before it"})
    (void)note.at(name);
  (void)note.at("start").get<std::vector<std::string>>();
}

void read_files(const json& note) {
  for (const auto& [path, hash] : note.items()) (void)hash.get<std::string>();
  if (!note.is_object()) throw std::invalid_argument("no object");
}

/// Calls `read` with a note, if it is there.
template <class Read>
void with_note(const sweep::Table& table, const char* name, Read&& read) {
  const auto text = table.note(name);
  if (!text) return;
  try {
    read(*text);
  } catch (const std::exception& error) {
    // Without the library's own name of the kind of error.
    const std::string why = error.what();
    const size_t begin = why.find("] ");
    table.damaged(fmt::format("what it notes as '{}' is not what a sweep writes ({})", name,
                              begin == std::string::npos ? why : why.substr(begin + 2)));
  }
}

}  // namespace

void check_notes(const sweep::Table& table) {
  with_note(table, "identity", [&](const std::string& text) {
    const size_t parameters = read_identity(json::parse(text));
    const auto samples = table.samples();
    if (!samples.empty() && samples[0].parameters.size() != parameters)
      table.damaged(fmt::format("its samples have {} parameters, and {} vary by what it notes",
                                samples[0].parameters.size(), parameters));
  });
  with_note(table, "settings", [](const std::string& text) { read_settings(json::parse(text)); });
  with_note(table, "search", [](const std::string& text) { read_search(json::parse(text)); });
  with_note(table, "files", [](const std::string& text) { read_files(json::parse(text)); });
  with_note(table, "about", [](const std::string& text) { read_description(text); });
  if (table.note("identity"))
    for (const char* name : {"model", "about", "settings"})
      if (!table.note(name)) table.damaged(fmt::format("it lacks what a sweep notes as '{}'", name));
}

}  // namespace tunica::shell
