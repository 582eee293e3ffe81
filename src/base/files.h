// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tunica {

/// Whole content of a file (or pipe). Errors: missing, a folder, unreadable, larger than `limit` bytes.
std::string read_file(const std::string& path, size_t limit = size_t{1} << 32);

/// Replaces a file as one act: a temporary name beside it, written and synced, then renamed; then the folder is synced.
/// Whatever happens, the path holds either the old content or the new one. Errors: say what the system refused.
void write_atomic(const std::string& path, std::string_view bytes);

/// Renames `from` to `to` (replacing it) and syncs the folder of `to`. Errors: say what the system refused.
void rename_synced(const std::string& from, const std::string& to);

/// Syncs a folder, so that names made or removed in it last.
void sync_folder(const std::string& path);

/// Makes a folder and those above it that are missing. Errors: say what the system refused.
void make_folders(const std::string& path);

/// Takes the lock of a file, which is made if missing, and writes the process's number into it. The lock is held until
/// the process ends, however it ends. False: another holds it. A file system that knows no locks gives it to everyone.
/// Errors: say what the system refused.
bool lock_file(const std::string& path);

/// Names in a folder, sorted by bytes, without "." and "..". Errors: not a readable folder.
std::vector<std::string> list_folder(const std::string& path);

}  // namespace tunica
