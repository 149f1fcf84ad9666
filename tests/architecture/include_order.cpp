// SPDX-License-Identifier: Apache-2.0
// The house stands as docs/architecture.md draws it: folders include only what is below them, libraries stay where they
// belong, sources are small and cite what the bibliography knows.
#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include "support/scenes.h"

namespace {

using Names = std::set<std::string>;
namespace fs = std::filesystem;

std::map<std::string, Names> const may_include{
    {"base", {"base"}},
    {"spectral", {"base", "spectral"}},
    {"colour", {"base", "spectral", "colour"}},
    {"film", {"base", "spectral", "colour", "film"}},
    {"materials", {"base", "spectral", "materials"}},
    {"scene", {"base", "spectral", "colour", "materials", "scene"}},
    {"integrators", {"base", "spectral", "colour", "materials", "scene", "film", "integrators"}},
    {"bench", {"base", "spectral", "colour", "materials", "scene", "film", "integrators", "bench"}},
    {"app", {"base", "spectral", "colour", "materials", "scene", "film", "integrators", "bench", "app"}}};

std::string content(fs::path const& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
}

// Every source of ours with its path below the project.
std::vector<std::pair<std::string, std::string>> sources(Names const& folders) {
    std::vector<std::pair<std::string, std::string>> all;
    fs::path const root = IRIDE_SOURCE_DIR;
    for (std::string const& folder : folders)
        for (auto const& entry : fs::recursive_directory_iterator(root / folder))
            if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp")
                all.emplace_back(fs::relative(entry.path(), root).string(), content(entry.path()));
    return all;
}

Names const library_folders{"base", "spectral", "colour", "film", "materials", "scene", "integrators", "bench", "app"};

// A name and a year in brackets, perhaps with a place behind a comma -> name and year as one word, in plain letters.
Names citations(std::string text) {
    for (auto const& [accented, plain] : {std::pair("ñ", "n"), {"ä", "a"}, {"ö", "o"}, {"ü", "u"}})
        for (std::size_t at; (at = text.find(accented)) != std::string::npos;) text.replace(at, 2, plain);
    Names keys;
    std::regex const citation(R"(\[([A-Z][A-Za-z]+) (\d{4})[,;\]])");
    for (std::sregex_iterator i(text.begin(), text.end(), citation), end; i != end; ++i)
        keys.insert((*i)[1].str() + (*i)[2].str());
    return keys;
}

}  // namespace

TEST_CASE("each folder includes only what stands to its left", "[architecture]") {
    std::regex const include(R"re(#include "([a-z]+)/)re");
    for (auto const& [path, text] : sources(library_folders)) {
        std::string const folder = path.substr(0, path.find('/'));
        for (std::sregex_iterator i(text.begin(), text.end(), include), end; i != end; ++i) {
            INFO(path << " includes " << (*i)[1].str());
            CHECK(may_include.at(folder).contains((*i)[1].str()));
        }
    }
}

TEST_CASE("Embree and OpenColorIO are known in one place each", "[architecture]") {
    for (auto const& [path, text] : sources(library_folders)) {
        INFO(path);
        CHECK((text.find("embree3/") == std::string::npos || path == "scene/accelerator.cpp"));
        CHECK((text.find("<OpenColorIO/") == std::string::npos || path == "colour/colour_config.cpp" ||
               path == "bench/colour_throughput.cpp"));  // which measures what it costs to go through one place
    }
}

TEST_CASE("sources carry their licence and stay small", "[architecture]") {
    Names folders = library_folders;
    folders.insert("tests");
    folders.insert("bench");
    for (auto const& [path, text] : sources(folders)) {
        INFO(path);
        CHECK(text.starts_with("// SPDX-License-Identifier: Apache-2.0"));
        CHECK(std::ranges::count(text, '\n') <= (path.ends_with(".h") ? 300 : 500));
    }
}

TEST_CASE("citations and bibliography agree", "[architecture]") {
    Names cited;
    Names folders = library_folders;
    folders.insert("tests");
    for (auto const& [path, text] : sources(folders)) cited.merge(citations(text));
    fs::path const root = IRIDE_SOURCE_DIR;
    for (char const* page : {"THIRD_PARTY.md", "docs/architecture.md", "docs/notation.md", "docs/materials.md",
                             "scripts/hourglass.py", "data/README.md"})
        cited.merge(citations(content(root / page)));
    for (auto const& entry : fs::directory_iterator(root / "data/scenes"))
        if (entry.path().extension() == ".json") cited.merge(citations(content(entry.path())));
    std::string const bibliography = content(root / "docs/references.bib");
    Names known;
    std::regex const item(R"(@\w+\{(\w+),)");
    for (std::sregex_iterator i(bibliography.begin(), bibliography.end(), item), end; i != end; ++i)
        known.insert((*i)[1].str());
    for (std::string const& key : cited) {
        INFO("cited: " << key);
        CHECK(known.contains(key));
    }
    for (std::string const& key : known) {
        INFO("in the bibliography: " << key);
        CHECK(cited.contains(key));
    }
}
