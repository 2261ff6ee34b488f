// SPDX-License-Identifier: Apache-2.0
#include "format/os/child_process.h"

#include "format/os/wide_path_windows.h"

#include <algorithm>
#include <array>
#include <system_error>
#include <thread>

namespace pointrt {
namespace {

/// Errors of the system, such as an access violation, have these bits in a process's exit code.
constexpr DWORD kCrash = 0xC0000000;
constexpr UINT kKilled = 0xC000013A; // STATUS_CONTROL_C_EXIT, as of processes that their console ends

HANDLE handleOf(std::intptr_t value) { return reinterpret_cast<HANDLE>(value); }

/// Quotes a word so that the C runtime recovers it from a command line: backslashes are doubled, but only before a
/// quote.
void appendQuoted(std::wstring& line, const std::wstring& word) {
    std::size_t backslashes = 0;
    line += L'"';
    for (const wchar_t c : word) {
        if (c == L'"') line.append(backslashes + 1, L'\\');
        backslashes = c == L'\\' ? backslashes + 1 : 0;
        line += c;
    }
    line.append(backslashes, L'\\');
    line += L'"';
}

std::wstring commandLine(const std::vector<std::string>& arguments) {
    std::wstring line;
    for (const std::string& argument : arguments) {
        if (!line.empty()) line += L' ';
        appendQuoted(line, format::widePath(argument));
    }
    return line;
}

[[noreturn]] void fail(const std::string& path) {
    throw std::system_error(static_cast<int>(GetLastError()), std::system_category(), path + ": cannot start");
}

} // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments) {
    SECURITY_ATTRIBUTES inherited{sizeof inherited, nullptr, TRUE};
    HANDLE ours = nullptr, theirs = nullptr;
    if (CreatePipe(&ours, &theirs, &inherited, 0) == 0) fail(arguments.front());
    SetHandleInformation(ours, HANDLE_FLAG_INHERIT, 0);
    const HANDLE nothing =
        CreateFileW(L"NUL", GENERIC_READ, FILE_SHARE_READ | FILE_SHARE_WRITE, &inherited, OPEN_EXISTING, 0, nullptr);
    STARTUPINFOW start{};
    start.cb = sizeof start;
    start.dwFlags = STARTF_USESTDHANDLES;
    start.hStdInput = nothing;
    start.hStdOutput = start.hStdError = theirs;
    PROCESS_INFORMATION process{};
    std::wstring line = commandLine(arguments);
    const BOOL started = CreateProcessW(format::widePath(arguments.front()).c_str(), line.data(), nullptr, nullptr,
                                        TRUE, CREATE_NO_WINDOW, nullptr, nullptr, &start, &process);
    CloseHandle(theirs);
    CloseHandle(nothing);
    if (started == 0) {
        CloseHandle(ours);
        fail(arguments.front());
    }
    CloseHandle(process.hThread);
    process_ = reinterpret_cast<std::intptr_t>(process.hProcess);
    output_ = reinterpret_cast<std::intptr_t>(ours);
}

ChildProcess::~ChildProcess() {
    kill();
    CloseHandle(handleOf(process_));
    if (output_ >= 0) CloseHandle(handleOf(output_));
}

/// Anonymous pipes cannot be waited for, so they are polled every few milliseconds.
std::string ChildProcess::read(std::chrono::milliseconds timeout) {
    constexpr std::chrono::milliseconds kPoll{5};
    const auto end = std::chrono::steady_clock::now() + timeout;
    for (;;) {
        DWORD ready = 0;
        if (output_ >= 0 && PeekNamedPipe(handleOf(output_), nullptr, 0, nullptr, &ready, nullptr) == 0) {
            CloseHandle(handleOf(output_));
            output_ = -1;
        }
        if (ready > 0) break;
        if (std::chrono::steady_clock::now() >= end) return {};
        std::this_thread::sleep_for(std::min(kPoll, timeout));
    }
    std::array<char, 4096> bytes;
    DWORD count = 0;
    ReadFile(handleOf(output_), bytes.data(), static_cast<DWORD>(bytes.size()), &count, nullptr);
    return {bytes.data(), count};
}

std::optional<int> ChildProcess::waitStatus() {
    DWORD code = 0;
    if (!status_ && WaitForSingleObject(handleOf(process_), 0) == WAIT_OBJECT_0 &&
        GetExitCodeProcess(handleOf(process_), &code) != 0)
        status_ = static_cast<int>(code);
    return status_;
}

void ChildProcess::terminate() { kill(); }

void ChildProcess::kill() {
    if (!waitStatus()) TerminateProcess(handleOf(process_), kKilled);
}

std::optional<int> exitStatusOf(int wait_status) {
    if ((static_cast<DWORD>(wait_status) & kCrash) == kCrash) return {};
    return wait_status;
}

std::string describeExit(int wait_status) {
    if (const auto code = exitStatusOf(wait_status)) return "ended with status " + std::to_string(*code);
    return "was ended by the system: " + format::windowsReason(static_cast<DWORD>(wait_status));
}

} // namespace pointrt
