// SPDX-License-Identifier: Apache-2.0
// A file is written whole or not at all: under a temporary name in the same folder, then renamed onto its own.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace iride {

class AtomicFile {
  public:
    // Throws InputError if the folder does not exist, is no folder or is not writable, or the target is a folder.
    explicit AtomicFile(std::filesystem::path target);
    AtomicFile(AtomicFile const&) = delete;
    AtomicFile& operator=(AtomicFile const&) = delete;
    ~AtomicFile();  // without commit(): the temporary file is removed, the target untouched

    // Write here. Keeps the target's extension, since writers choose the format by it.
    std::filesystem::path const& temporary() const { return temporary_; }
    // Flush to disk and rename onto the target. Throws InputError (disk full and the like) and leaves the target alone.
    void commit();

  private:
    std::filesystem::path target_, temporary_;
    bool committed_ = false;
};

// The checks of the constructor alone: to say that an output cannot be written before any work is done.
void check_writable(std::filesystem::path const& target);

// The same, and that its name ends as its format wants it (".exr"). Throws InputError for `option`.
void check_output(std::string const& option, std::filesystem::path const& target, std::string const& extension);

// Write a small text file whole.
void write_file(std::filesystem::path const& target, std::string_view content);

}  // namespace iride
