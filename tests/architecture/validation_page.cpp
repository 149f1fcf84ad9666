// SPDX-License-Identifier: Apache-2.0
// docs/validation.md: every row names a test that exists, and its error is within its tolerance.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <sstream>
#include <vector>

#include "support/files.h"

namespace {

std::vector<std::string> cells_of(std::string const& row) {
    std::vector<std::string> cells;
    std::istringstream in(row.substr(1));
    for (std::string cell; std::getline(in, cell, '|');) {
        auto const first = cell.find_first_not_of(' '), last = cell.find_last_not_of(' ');
        if (first != std::string::npos) cells.push_back(cell.substr(first, last - first + 1));
    }
    return cells;
}

// All test sources without line ends, quotes and blanks around them, so that a name broken over two lines is one.
std::string test_sources() {
    std::string all;
    for (auto const& entry : std::filesystem::recursive_directory_iterator(IRIDE_SOURCE_DIR "/tests"))
        if (entry.path().extension() == ".cpp") all += iride::test::content(entry.path());
    for (std::size_t at; (at = all.find("\"\n")) != std::string::npos;) {
        std::size_t const next = all.find_first_not_of(" \n", at + 1);
        all.erase(at, next != std::string::npos && all[next] == '"' ? next + 1 - at : 2);
    }
    return all;
}

}  // namespace

TEST_CASE("every row of docs/validation.md names a test that exists and an error within its tolerance", "[unit]") {
    std::istringstream page(iride::test::content(IRIDE_SOURCE_DIR "/docs/validation.md"));
    std::string const sources = test_sources();
    int rows = 0;
    for (std::string line; std::getline(page, line);) {
        if (!line.starts_with("| ") || line.starts_with("| law ")) continue;
        auto const cells = cells_of(line);
        INFO(line);
        REQUIRE(cells.size() == 6);
        CHECK(std::stod(cells[4]) <= std::stod(cells[3]));
        CHECK(sources.find("TEST_CASE(\"" + cells[5] + "\"") != std::string::npos);
        ++rows;
    }
    CHECK(rows >= 16);
}
