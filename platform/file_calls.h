// SPDX-License-Identifier: Apache-2.0
// The calls of the system that a NewFile is made by.
// in: paths, a descriptor, bytes -> out: false, -1: errno says why.
// docs/architecture.md, floor 0.
#pragma once
#include <cstddef>
#include <cstdint>

#include "platform/file.h"

namespace pileus {

bool make_folder(const char* path);
void remove_folder(const char* path);
void remove_file(const char* path);
/// Takes the place of a file that is there.
bool move_file(const char* from, const char* to);

/// For writing; EEXIST where there is one.
int create_file(const char* path);
void close_file(int descriptor);
/// At least one of the bytes: their number; -1: none.
std::int64_t write_some(int descriptor, const void* data, std::size_t bytes);
std::int64_t write_some_at(int descriptor, std::uint64_t at, const void* data, std::size_t bytes);

FileResult system_fault();

}  // namespace pileus
