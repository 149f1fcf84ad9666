// SPDX-License-Identifier: Apache-2.0
#include "base/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "base/diagnostics.h"

namespace iride {

namespace {

[[noreturn]] void fail(std::filesystem::path const& target, std::string const& message) {
    throw InputError({target.string()}, "", "cannot be written: " + message);
}

std::filesystem::path folder_of(std::filesystem::path const& target) {
    return target.has_parent_path() ? target.parent_path() : std::filesystem::path(".");
}

// What can be told without writing anything.
void refuse_impossible(std::filesystem::path const& target) {
    std::error_code error;
    std::filesystem::path const folder = folder_of(target);
    if (!target.has_filename()) fail(target, "it names no file");
    if (!std::filesystem::exists(folder, error)) fail(target, "the folder '" + folder.string() + "' does not exist");
    if (!std::filesystem::is_directory(folder, error)) fail(target, "'" + folder.string() + "' is not a folder");
    if (std::filesystem::is_directory(target, error)) fail(target, "it is a folder");
    // Renaming onto a device, say /dev/null, would replace it.
    if (std::filesystem::exists(target, error) && !std::filesystem::is_regular_file(target, error))
        fail(target, "it is not a regular file");
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        fail(target, "the folder '" + folder.string() + "' is not writable: " + std::strerror(errno));
}

}  // namespace

// Root may write everywhere by access() and fails at the first file it creates in /proc: only trying tells.
void check_writable(std::filesystem::path const& target) { AtomicFile const trial(target); }

AtomicFile::AtomicFile(std::filesystem::path target) : target_(std::move(target)) {
    refuse_impossible(target_);
    static std::atomic<unsigned> serial{0};  // two files of one process for one target do not meet
    temporary_ = folder_of(target_) / fmt::format(".{}.{}-{}.part{}", target_.stem().string(), ::getpid(), serial++,
                                                  target_.extension().string());
    int const file = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file < 0) fail(target_, std::strerror(errno));
    ::close(file);
}

AtomicFile::~AtomicFile() {
    std::error_code ignored;
    if (!committed_) std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
    int const file = ::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
    bool const synced = file >= 0 && ::fsync(file) == 0;
    int const reason = errno;
    if (file >= 0) ::close(file);
    if (!synced) fail(target_, std::strerror(reason));
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    if (error) fail(target_, error.message());
    committed_ = true;
}

void check_output(std::string const& option, std::filesystem::path const& target, std::string const& extension) {
    if (target.extension() != extension)
        throw InputError({}, option,
                         "found '" + target.string() + "', but a name ending in " + extension + " is wanted");
    check_writable(target);
}

void write_file(std::filesystem::path const& target, std::string_view content) {
    AtomicFile file(target);
    std::ofstream out(file.temporary(), std::ios::binary);
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
    out.close();
    if (!out) fail(target, "the disk took only a part of it");
    file.commit();
}

}  // namespace iride
