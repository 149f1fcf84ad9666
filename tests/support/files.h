// SPDX-License-Identifier: Apache-2.0
// What a test sees of files.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace iride::test {

inline std::string content(std::filesystem::path const& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline int file_count(std::filesystem::path const& folder) {
    return static_cast<int>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

}  // namespace iride::test
