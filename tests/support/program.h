// SPDX-License-Identifier: Apache-2.0
// The program, run as a user runs it.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace iride::test {

struct RunResult {
    int code;          // exit code, or 128 + the signal
    std::string text;  // what came on stdout
};

inline RunResult run_shell(std::string const& command) {
    std::FILE* const pipe = ::popen(command.c_str(), "r");
    std::string text;
    std::array<char, 4096> buffer;
    while (std::size_t const n = std::fread(buffer.data(), 1, buffer.size(), pipe)) text.append(buffer.data(), n);
    int const status = ::pclose(pipe);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text};
}

// With stderr in the text.
inline RunResult run_command(std::string const& command) { return run_shell(command + " 2>&1"); }
inline RunResult run_iride(std::string const& arguments) { return run_command(IRIDE_PROGRAM " " + arguments); }

}  // namespace iride::test
