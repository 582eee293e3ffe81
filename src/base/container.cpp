// SPDX-License-Identifier: MIT
#include "base/container.h"

#include "base/bytes.h"

namespace tunica {

namespace {
constexpr std::string_view magic = "tunica\n\x1a";  // 8 bytes; a text transfer that changes line ends breaks it
constexpr uint32_t version = 1;
constexpr size_t hash_size = 16;
}  // namespace

std::string pack_sections(const std::map<std::string, std::string>& sections) {
  ByteWriter body;
  body.put(static_cast<uint32_t>(sections.size()));
  for (const auto& [name, bytes] : sections) {
    body.text(name);
    body.text(bytes);
  }
  ByteWriter head;
  head.put(version);
  head.put(static_cast<uint64_t>(body.bytes().size()));
  const std::string checked = head.bytes() + body.bytes();
  return std::string(magic) + hash(checked) + checked;
}

std::map<std::string, std::string> unpack_sections(std::string_view bytes) {
  if (!bytes.starts_with(magic)) fail("not a tunica checkpoint");
  bytes.remove_prefix(magic.size());
  if (bytes.size() < hash_size) fail("the checkpoint is cut or damaged");
  const std::string_view sum = bytes.substr(0, hash_size);
  bytes.remove_prefix(hash_size);
  if (hash(bytes) != sum) fail("the checkpoint is cut or damaged: its checksum does not agree");
  ByteReader reader(bytes);
  if (const auto found = reader.get<uint32_t>(); found != version)
    fail("the checkpoint has format {}; this program reads format {}", found, version);
  reader.get<uint64_t>();
  std::map<std::string, std::string> sections;
  for (auto count = reader.get<uint32_t>(); count > 0; --count) {
    std::string name = reader.text();
    sections[std::move(name)] = reader.text();
  }
  return sections;
}

}  // namespace tunica
