// SPDX-License-Identifier: MIT
#include "base/container.h"

#include "base/bytes.h"

namespace tunica {

namespace {
constexpr std::string_view magic = "tunica\n\x1a";  // 8 bytes; a text transfer that changes line ends breaks it
constexpr uint32_t version = 1;
constexpr size_t hash_size = 16;
}  // namespace

std::string pack_sections(const std::map<std::string, std::string_view>& sections) {
  size_t size = sizeof(uint32_t);
  for (const auto& [name, bytes] : sections) size += 2 * sizeof(uint64_t) + name.size() + bytes.size();
  ByteWriter out;
  out.reserve(size + 64);
  out.put(version);
  const size_t body = out.begin_text();
  out.put(static_cast<uint32_t>(sections.size()));
  for (const auto& [name, bytes] : sections) {
    out.text(name);
    out.text(bytes);
  }
  out.end_text(body);
  std::string packed(magic);
  packed.reserve(magic.size() + hash_size + out.bytes().size());
  return packed.append(hash(out.bytes())).append(out.bytes());
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
