// SPDX-License-Identifier: Apache-2.0
// Child processes through calls of Windows.
// in: a command line -> out: see process.h.
// CreateProcessW, job objects; docs/windows.md; docs/study.md, "Runs"
#include "platform/process.h"

#include <cpuid.h>
#include <fcntl.h>
#include <io.h>
#include <windows.h>
// After the types of Windows.
#include <shellapi.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "platform/clock.h"
#include "platform/windows/times.h"
#include "platform/windows/wide.h"

namespace pileus {

namespace {

constexpr std::size_t kMaxErrors = 65536;
constexpr DWORD kLookEveryMs = 10;

/// Closed with its owner.
struct Handle {
    HANDLE handle = nullptr;

    Handle() = default;
    explicit Handle(HANDLE of) : handle(of) {}
    ~Handle() { close(); }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    void close() {
        if (handle != nullptr && handle != INVALID_HANDLE_VALUE) ::CloseHandle(handle);
        handle = nullptr;
    }
};

/// A word as CommandLineToArgvW reads it: backslashes count twice before a quotation mark.
void add_word(const std::wstring& word, std::wstring& line) {
    if (!line.empty()) line += L' ';
    line += L'"';
    std::size_t slashes = 0;
    for (const wchar_t c : word) {
        if (c == L'"') line.append(slashes + 1, L'\\');
        slashes = c == L'\\' ? slashes + 1 : 0;
        line += c;
    }
    line.append(slashes, L'\\');
    line += L'"';
}

/// The environment without what begins as one of `hidden`.
std::wstring shown_environment(const std::vector<std::string>& hidden) {
    std::wstring out;
    wchar_t* const all = ::GetEnvironmentStringsW();
    for (const wchar_t* variable = all; variable != nullptr && *variable != L'\0';) {
        const std::wstring text = variable;
        bool shown = true;
        for (const std::string& name : hidden)
            shown = shown && text.compare(0, name.size(), wide_text(name)) != 0;
        if (shown) out.append(text.c_str(), text.size() + 1);
        variable += text.size() + 1;
    }
    if (all != nullptr) (void)::FreeEnvironmentStringsW(all);
    out += L'\0';
    return out;
}

/// Programs that it starts, and those that they start, end with this one.
bool make_job(Handle& job) {
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits = {};
    limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
    job.handle = ::CreateJobObjectW(nullptr, nullptr);
    return job.handle != nullptr &&
           ::SetInformationJobObject(job.handle, JobObjectExtendedLimitInformation, &limits,
                                     sizeof limits);
}

/// Starts the program in a process group of its own: Ctrl-C reaches us alone, and we decide.
bool start(const std::vector<std::string>& words, const std::vector<std::string>& hidden,
           HANDLE errors, HANDLE job, Handle& child) {
    SECURITY_ATTRIBUTES handed{sizeof handed, nullptr, TRUE};
    const Handle nothing(::CreateFileW(L"NUL", GENERIC_READ | GENERIC_WRITE,
                                       FILE_SHARE_READ | FILE_SHARE_WRITE, &handed, OPEN_EXISTING,
                                       0, nullptr));
    STARTUPINFOW how = {};
    how.cb = sizeof how;
    how.dwFlags = STARTF_USESTDHANDLES;
    how.hStdInput = how.hStdOutput = nothing.handle;
    how.hStdError = errors;
    std::wstring line;
    for (const std::string& word : words) add_word(wide_text(word), line);
    std::wstring environment = shown_environment(hidden);
    PROCESS_INFORMATION made;
    constexpr DWORD kFlags =
        CREATE_NEW_PROCESS_GROUP | CREATE_UNICODE_ENVIRONMENT | CREATE_SUSPENDED;
    if (!::CreateProcessW(wide_path(words[0]).c_str(), line.data(), nullptr, nullptr, TRUE, kFlags,
                          environment.data(), nullptr, &how, &made))
        return false;
    child.handle = made.hProcess;
    const Handle thread(made.hThread);
    (void)::AssignProcessToJobObject(job, child.handle);
    (void)::ResumeThread(thread.handle);
    return true;
}

/// Reads what the child says until it closes its end; ends the child on an interrupt.
void listen(HANDLE pipe, HANDLE job, HANDLE child, const InterruptHold& hold,
            ProcessResult& result) {
    char block[4096];
    for (;;) {
        // Of a process that has ended not every system knows it (Wine).
        result.peak_bytes = std::max(result.peak_bytes, peak_bytes_of(child));
        if (!result.interrupted && hold.pending()) {
            result.interrupted = true;
            (void)::TerminateJobObject(job, 1);
        }
        DWORD ready = 0, got = 0;
        if (!::PeekNamedPipe(pipe, nullptr, 0, nullptr, &ready, nullptr)) return;
        if (ready == 0) {
            ::Sleep(kLookEveryMs);
            continue;
        }
        if (!::ReadFile(pipe, block, sizeof block, &got, nullptr)) return;
        const std::size_t room = kMaxErrors - result.errors.size();
        result.errors.append(block, got < room ? got : room);
    }
}

}  // namespace

ProcessResult run_process(const std::vector<std::string>& words, const InterruptHold& hold,
                          const std::vector<std::string>& hidden) {
    ProcessResult result;
    Handle reads, writes, job, child;
    if (!make_job(job) || !::CreatePipe(&reads.handle, &writes.handle, nullptr, 0) ||
        !::SetHandleInformation(writes.handle, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT)) {
        result.system_error = last_errno();
        return result;
    }
    const double began = wall_seconds();
    if (!start(words, hidden, writes.handle, job.handle, child)) {
        result.system_error = last_errno();
        return result;
    }
    writes.close();
    listen(reads.handle, job.handle, child.handle, hold, result);
    (void)::WaitForSingleObject(child.handle, INFINITE);
    result.wall_s = wall_seconds() - began;
    result.cpu_s = cpu_seconds_of(child.handle);
    result.peak_bytes = std::max(result.peak_bytes, peak_bytes_of(child.handle));
    DWORD status = 0;
    if (::GetExitCodeProcess(child.handle, &status)) result.exit_status = int(status);
    return result;
}

char** begin_program(int& count, char** words) {
    // Lines end as they do elsewhere.
    (void)_setmode(_fileno(stdout), _O_BINARY);
    (void)_setmode(_fileno(stderr), _O_BINARY);
    // What main is given are texts of some code page. Kept until the program ends.
    int wide_count = 0;
    wchar_t** const wide = ::CommandLineToArgvW(::GetCommandLineW(), &wide_count);
    if (wide == nullptr) return words;
    std::size_t bytes = 0;
    for (int i = 0; i < wide_count; ++i) bytes += narrow_text(wide[i]).size() + 1;
    char** const out = new char*[std::size_t(wide_count) + 1];
    char* at = new char[bytes];
    for (int i = 0; i < wide_count; ++i) {
        const std::string word = narrow_text(wide[i]);
        out[i] = at;
        std::memcpy(at, word.c_str(), word.size() + 1);
        at += word.size() + 1;
    }
    out[wide_count] = nullptr;
    count = wide_count;
    (void)::LocalFree(wide);
    return out;
}

std::string own_program(const char* first_word) {
    std::wstring path(32768, L'\0');  // the most that there is
    const DWORD length =
        ::GetModuleFileNameW(nullptr, path.data(), static_cast<DWORD>(path.size()));
    if (length == 0 || length == path.size()) return first_word != nullptr ? first_word : "";
    path.resize(length);
    return narrow_text(path);
}

std::string processor_name() {
    // Three leaves of four registers of four letters each.
    char name[49] = {};
    for (unsigned leaf = 0; leaf < 3; ++leaf) {
        unsigned letters[4];
        if (!__get_cpuid(0x80000002u + leaf, &letters[0], &letters[1], &letters[2], &letters[3]))
            return "";
        std::memcpy(name + 16 * leaf, letters, sizeof letters);
    }
    std::string text = name;
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text.substr(std::min(text.find_first_not_of(' '), text.size()));
}

}  // namespace pileus
