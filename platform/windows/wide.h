// SPDX-License-Identifier: Apache-2.0
// Texts and error numbers as Windows has them.
// in: UTF-8, numbers of GetLastError -> out: UTF-16, numbers of errno; and back.
// docs/windows.md
#pragma once
#include <string>
#include <string_view>

namespace pileus {

std::wstring wide_text(std::string_view text);
std::string narrow_text(std::wstring_view text);

/// A path for calls of Windows: from the root on and marked where it is longer than they take
/// otherwise (260 characters, of folders 248).
std::wstring wide_path(const std::string& path);

/// A path from the root on.
std::string whole_path(const std::string& path);

/// "NUL", "CON", "\\\\.\\pipe\\name" and the like.
bool is_device_path(const std::string& path);

/// As Windows compares names.
std::string folded_case(const std::string& text);

/// The number of errno for the last fault of this thread.
int last_errno();

}  // namespace pileus
