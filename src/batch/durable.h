// Files that survive a crash of the machine, also on NFS: synced, then renamed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"

namespace roomlight::batch {

// Names this process among all machines: host, process and when it started. Fit for names of files.
std::string processToken();

// A reader sees the old file or the whole new one, after a crash too.
Status writeDurably(const std::filesystem::path& file, std::string_view bytes);

// Content of a folder, its files and folders, is on the disk after this.
Status syncTree(const std::filesystem::path& folder);

// Renames a synced folder; `to` is there whole or not at all. Where it is there already, `from` is removed: the same
// task has been done by another, with the same result.
Status publishFolder(const std::filesystem::path& from, const std::filesystem::path& to);

// The file's text; empty where there is none.
std::string textOf(const std::filesystem::path& file);

// Whether the line tells that a disk or quota is full.
bool tellsOfFullDisk(std::string_view line);

}  // namespace roomlight::batch
