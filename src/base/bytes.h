// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/error.h"

namespace tunica {

/// Appends plain values to a byte string, little-endian as this machine is. The same state gives the same bytes.
class ByteWriter {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class T>
  void array(const T* data, size_t count) {
    static_assert(std::is_arithmetic_v<T>);
    put(static_cast<uint64_t>(count));
    if (count) bytes_.append(reinterpret_cast<const char*>(data), count * sizeof(T));
  }
  void text(std::string_view s) { array(s.data(), s.size()); }
  void reserve(size_t size) { bytes_.reserve(size); }
  /// A text that is written piece by piece: begin_text() ... end_text(what that gave). Returns the text.
  size_t begin_text() {
    put(uint64_t{0});
    return bytes_.size();
  }
  std::string_view end_text(size_t begin) {
    const uint64_t size = bytes_.size() - begin;
    std::memcpy(bytes_.data() + begin - sizeof size, &size, sizeof size);
    return std::string_view(bytes_).substr(begin);
  }
  const std::string& bytes() const { return bytes_; }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads what a ByteWriter wrote. Every read is checked against the end: a hostile or cut file is an Error, never more.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}
  template <class T>
  T get() {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    T value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  template <class T>
  std::vector<T> array() {
    const auto count = get<uint64_t>();
    if (count > rest_.size() / sizeof(T))
      fail("the file is cut or damaged: it announces {} values and ends before", count);
    std::vector<T> values(count);
    if (count) std::memcpy(values.data(), take(count * sizeof(T)).data(), count * sizeof(T));
    return values;
  }
  std::string text() {
    const auto characters = array<char>();
    return {characters.begin(), characters.end()};
  }
  bool at_end() const { return rest_.empty(); }

 private:
  std::string_view take(size_t size) {
    if (size > rest_.size()) fail("the file is cut or damaged: it ends too early");
    const std::string_view head = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return head;
  }
  std::string_view rest_;
};

/// 64-bit hash of bytes (XXH3) as 16 hexadecimal digits.
std::string hash(std::string_view bytes);

}  // namespace tunica
